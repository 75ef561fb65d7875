//! The smallest domain on which an operator fails a property: the exhaustive world first, in which the first counterexample
//! is provably the smallest; then families of small domains, for what no small planar mesh breaks.

use std::path::Path;

use super::atlas::{self, World};
use super::cases;
use super::choice::Choice;
use super::recipe::Recipe;
use super::run::exhibit;
use super::shrink::shrink;
use crate::domain::{Domain, DomainKind};
use crate::generate::listed;
use crate::property::{Property, Status};
use crate::record::{AtlasLine, Cell, Exhibit};

/// How many seeds of each size are tried.
const SEEDS: u64 = 12;

/// How often a shrinking domain is judged.
pub const CALLS: usize = 1500;

/// A domain found in a family, with the failing cell.
pub struct Found {
    /// The domain.
    pub domain: Domain,
    /// The failing cell, its evidence rechecked.
    pub cell: Cell,
    /// The cell's mesh, for a picture.
    pub exhibit: Exhibit,
    /// The recipe of the domain from which it was shrunk, if it was.
    pub from: Option<String>,
}

/// What a search through the families came to.
pub struct Search {
    /// The first domain, in the order of size, on which the property fails.
    pub found: Option<Found>,
    /// Domains on which it was decided, the last included.
    pub decided: usize,
    /// Domains on which rounding left it open.
    pub open: usize,
    /// Domains on which it says nothing or the operator is not defined.
    pub skipped: usize,
}

/// Searches the exhaustive world; `None` for operators that do not live on surfaces.
pub fn smallest(choice: &Choice, property: &'static Property) -> Option<AtlasLine> {
    let on_surfaces = choice.laplacian.accepts.contains(&DomainKind::Surface);
    on_surfaces.then(|| atlas::search(World::of(property), &[(choice, property)]).pop())?
}

/// Decides the property on one small domain of the families after the other, fewest vertices first, until it fails; the domain is then
/// shrunk while it still does.
pub fn search(choice: &Choice, property: &'static Property) -> Search {
    let mut search = Search { found: None, decided: 0, open: 0, skipped: 0 };
    let mut ladder: Vec<(usize, Recipe, Domain)> = ladder()
        .into_iter()
        .filter_map(|recipe| {
            let domain = recipe.build(Path::new(".")).ok()?;
            Some((domain.vertex_count(), recipe, domain))
        })
        .filter(|(_, _, domain)| choice.laplacian.accepts.contains(&domain.kind()))
        .collect();
    ladder.sort_by_key(|(n, _, domain)| (*n, domain.edges().len()));
    for (_, recipe, domain) in ladder {
        let cell = cases::cell(choice, property, &domain, &recipe.to_string());
        match cell.as_ref().map(|cell| cell.verdict.status()) {
            Some(Status::Fails) => {
                search.decided += 1;
                search.found = cell.map(|cell| smaller(choice, property, domain, cell));
                return search;
            }
            Some(Status::Holds) => search.decided += 1,
            Some(Status::Undecided) => search.open += 1,
            Some(Status::NotApplicable) | None => search.skipped += 1,
        }
    }
    search
}

/// A failing domain shrunk while the same property of the same operator fails, with its cell; as it was where it is no surface
/// or no step makes it smaller.
pub fn smaller(choice: &Choice, property: &'static Property, domain: Domain, cell: Cell) -> Found {
    let judge = |domain: &Domain| {
        let surface = domain.as_surface()?;
        let recipe = listed::call(surface.positions(), surface.faces());
        cases::cell(choice, property, domain, &recipe).filter(|cell| cell.verdict.status() == Status::Fails)
    };
    let shrunk = shrink(&domain, CALLS, &|domain| judge(domain).is_some()).domain;
    let is_smaller = shrunk.digest() != domain.digest();
    match judge(&shrunk).filter(|_| is_smaller) {
        Some(small) => {
            let (exhibit, from) = (exhibit(&small, &shrunk), Some(cell.recipe));
            Found { domain: shrunk, cell: small, exhibit, from }
        }
        None => Found { exhibit: exhibit(&cell, &domain), domain, cell, from: None },
    }
}

/// The families searched: every shape that the literature's counterexamples take, at its smallest sizes.
fn ladder() -> Vec<Recipe> {
    let mut texts: Vec<String> = Vec::new();
    for shape in ["tetrahedron", "cube", "octahedron", "icosahedron"] {
        texts.push(format!("polyhedron:shape={shape}"));
    }
    for diagonals in ["right", "alternating"] {
        for n in 2..=4 {
            texts.push(format!("grid:nx={n},ny={n},diagonals={diagonals}"));
        }
    }
    for n in 4..=12 {
        for seed in 0..SEEDS {
            texts.push(format!("random-delaunay:n={n},seed={seed}"));
            texts.push(format!("random-delaunay:n={n},seed={seed} | flip:count={n},seed={seed}"));
            texts.push(format!("random-delaunay:n={n},seed={seed} | worst-angle"));
            texts.push(format!("convex-polygon:n={},seed={seed}", n - 1));
            texts.push(format!("gnp:n={n},p=0.5,boundary=2,seed={seed}"));
            texts.push(format!("gnp:n={n},p=0.5,boundary=2,seed={seed} | random-weights:negative=0.3,seed={seed}"));
        }
    }
    for twist in ["-0.5", "0.3"] {
        texts.push(format!("schonhardt:twist={twist}"));
    }
    for n in 3..=6 {
        texts.push(format!("lantern:m=2,n={n}"));
        texts.push(format!("perturbed-grid:nx={n},ny={n},displacement=0.4,seed={n}"));
        texts.push(format!("slivers:columns={n},aspect=1e4"));
    }
    for n in 1..=3 {
        for seed in 0..SEEDS {
            texts.push(format!("tet-grid:nx=2,ny={n},nz=2,displacement=0.16,seed={seed}"));
        }
    }
    for levels in 1..=2 {
        texts.push(format!("icosphere:levels={levels}"));
        texts.push(format!("icosphere:levels={levels} | flip:count=30"));
    }
    texts.iter().filter_map(|text| text.parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::GenerateError;
    use crate::property;
    use crate::suite::RecipeError;

    #[test]
    fn every_rung_of_the_ladder_is_a_domain_unless_no_edge_of_it_can_be_flipped() {
        let ladder = ladder();
        let mut rigid = 0;
        for recipe in &ladder {
            match recipe.build(Path::new(".")) {
                Ok(_) => {}
                Err(RecipeError::Generate(GenerateError::Impossible { generator: "flip", .. })) => rigid += 1,
                Err(error) => panic!("{recipe}: {error}"),
            }
        }
        assert!(ladder.len() > 600 && rigid < 20, "{rigid} of {} cannot be flipped", ladder.len());
    }

    fn search(laplacian: &str, property: &str) -> Search {
        super::search(&laplacian.parse().unwrap(), property::find(property).unwrap())
    }

    #[test]
    fn the_first_failing_domain_in_the_order_of_size_is_found() {
        // A triangle has no interior edge, and the star of three triangles none that is not Delaunay.
        let found = search("cotan", "POS0").found.unwrap();
        assert!((4..=6).contains(&found.domain.vertex_count()), "{}", found.cell.recipe);
        assert_eq!(found.cell.recheck, crate::record::Recheck::Exact);
        let smaller = ladder().into_iter().filter_map(|r| r.build(Path::new(".")).ok());
        let choice: Choice = "cotan".parse().unwrap();
        for domain in smaller.filter(|d| d.vertex_count() < found.domain.vertex_count() && d.as_surface().is_some()) {
            let Ok(operator) = choice.build(&domain) else { continue };
            let trial = property::Trial::new(&domain, &operator, 0).unwrap();
            assert_ne!(property::find("POS0").unwrap().decide(&trial, None).status(), Status::Fails);
        }
    }

    #[test]
    fn what_is_found_in_a_family_is_shrunk_and_keeps_failing() {
        let found = search("cotan", "MAX-global").found.unwrap();
        assert!(found.from.is_some() && found.domain.vertex_count() <= 7, "{}", found.cell.recipe);
        assert_eq!(found.cell.verdict.status(), Status::Fails);
        let again = found.cell.recipe.parse::<Recipe>().unwrap().build(Path::new(".")).unwrap();
        assert_eq!(again.digest(), found.domain.digest());
    }

    #[test]
    fn a_property_that_always_holds_has_no_counterexample() {
        let search = search("graph", "LOC");
        assert!(search.found.is_none() && search.decided > 600 && search.open == 0);
    }
}
