//! What every generator keeps, whichever it is: the meaning of a seed, the ranges of its parameters, its place in a recipe.

use std::collections::BTreeMap;

use lapjury::domain::{Domain, DomainKind};
use lapjury::generate::{ALL, GenerateError, Generator, Make, find};
use lapjury::parameter::Range;

fn given(settings: &[(&str, &str)]) -> BTreeMap<String, String> {
    settings.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect()
}

fn make(id: &str, settings: &[(&str, &str)], seed: u64) -> Domain {
    find(id).unwrap().run(None, &given(settings), seed).unwrap()
}

/// A domain that a modifier with this id accepts.
fn something_to_change(id: &str) -> Domain {
    match id {
        "random-weights" => make("gnp", &[], 1),
        _ => make("random-delaunay", &[], 1),
    }
}

fn run(generator: &Generator, settings: &BTreeMap<String, String>, seed: u64) -> Result<Domain, GenerateError> {
    match generator.make {
        Make::Source(_) => generator.run(None, settings, seed),
        Make::Modifier(_) => generator.run(Some(&something_to_change(generator.id)), settings, seed),
    }
}

/// Settings with which the result depends on the seed; `None` for generators without randomness.
fn random_settings(id: &str) -> Option<BTreeMap<String, String>> {
    Some(match id {
        "grid" | "square" | "torus" | "flat-torus" => given(&[("diagonals", "random")]),
        "cycle" | "complete" | "hypercube" => given(&[("boundary", "5")]),
        "tet-grid" => given(&[("displacement", "0.1")]),
        "perturbed-grid" | "random-delaunay" | "random-delaunay-disk" | "convex-polygon" | "gnp" | "planar-graph" => {
            given(&[])
        }
        "flip" | "perturb" | "rotate" | "renumber" | "random-weights" => given(&[]),
        _ => return None,
    })
}

#[test]
fn every_file_is_a_registered_entry_of_the_same_name_with_guarantees() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/generate");
    let mut files: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .filter_map(|f| f.unwrap().file_name().to_str()?.strip_suffix(".rs").map(|name| name.replace('_', "-")))
        .filter(|name| !["mod", "stream", "testing"].contains(&name.as_str()))
        .collect();
    files.sort();
    let mut ids: Vec<&str> = ALL.iter().map(|g| g.id).collect();
    ids.sort_unstable();
    assert_eq!(files, ids);
    for g in ALL {
        assert!(!g.guarantees.is_empty() && !g.name.is_empty(), "{}", g.id);
        assert!(g.parameters.iter().all(|p| !p.meaning.is_empty()), "{}", g.id);
    }
}

#[test]
fn the_same_seed_makes_the_same_domain_and_another_seed_another_one() {
    for g in ALL {
        let settings = random_settings(g.id).unwrap_or_default();
        let digest = |seed| run(g, &settings, seed).unwrap_or_else(|e| panic!("{}: {e}", g.id)).digest();
        let first: Vec<String> = (0..8).map(digest).collect();
        assert_eq!(first, (0..8).map(digest).collect::<Vec<_>>(), "{}", g.id);
        let mut different = first.clone();
        different.sort();
        different.dedup();
        let expected = if random_settings(g.id).is_some() { 8 } else { 1 };
        assert_eq!(different.len(), expected, "{}", g.id);
    }
}

#[test]
fn values_at_the_ends_of_a_range_are_served_or_refused_with_a_reason_and_beyond_they_are_refused() {
    for g in ALL {
        for p in g.parameters {
            let (inside, outside): (Vec<String>, Vec<String>) = match p.range {
                Range::Choice(words) => (words.iter().map(|w| w.to_string()).collect(), vec!["nonsense".into()]),
                Range::Number(low, high) => {
                    (vec![low.to_string(), high.to_string()], vec!["NaN".into(), "inf".into(), "-1e300".into()])
                }
                // The upper ends of whole parameters are sizes: many seconds each.
                Range::Whole(low, high) => {
                    (vec![low.to_string()], vec![(high + 1).to_string(), "-1".into(), "1.5".into()])
                }
                Range::Form(..) => (vec![p.default.into()], vec!["nonsense".into(), ";".into(), "0 1 x".into()]),
            };
            for value in inside {
                match run(g, &given(&[(p.name, &value)]), 1) {
                    Ok(_) | Err(GenerateError::Impossible { .. }) => {}
                    Err(other) => panic!("{} {} = {value}: {other}", g.id, p.name),
                }
            }
            for value in outside {
                let refused = run(g, &given(&[(p.name, &value)]), 1);
                assert!(matches!(refused, Err(GenerateError::Settings(_))), "{} {} = {value}", g.id, p.name);
            }
        }
    }
}

#[test]
fn a_source_refuses_a_domain_and_a_modifier_needs_one() {
    let path = make("path", &[], 0);
    for g in ALL {
        let wrong = match g.make {
            Make::Source(_) => g.run(Some(&path), &given(&[]), 0),
            Make::Modifier(_) => g.run(None, &given(&[]), 0),
        };
        assert!(matches!(wrong, Err(GenerateError::Position { .. })), "{}", g.id);
    }
}

#[test]
fn modifiers_serve_every_kind_of_domain_or_refuse_it_with_a_reason() {
    let mut domains: Vec<Domain> =
        ALL.iter().filter(|g| matches!(g.make, Make::Source(_))).map(|g| run(g, &given(&[]), 3).unwrap()).collect();
    let polygons = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let faces = vec![vec![0, 1, 2, 3]];
    domains.push(lapjury::domain::Surface::new(polygons.clone(), faces).unwrap().into());
    domains.push(lapjury::domain::Surface::new(Vec::new(), Vec::new()).unwrap().into());
    domains.push(lapjury::domain::Volume::new(polygons.clone(), vec![[0, 1, 2, 3]]).unwrap().into());
    domains.push(lapjury::domain::PointCloud::new(polygons.clone(), Some(polygons)).unwrap().into());
    for g in ALL.iter().filter(|g| matches!(g.make, Make::Modifier(_))) {
        let mut served = 0;
        for domain in &domains {
            match g.run(Some(domain), &given(&[]), 5) {
                Ok(_) => served += 1,
                Err(GenerateError::Impossible { .. }) => {}
                Err(other) => panic!("{} on {}: {other}", g.id, domain.kind()),
            }
        }
        assert!(served > 3, "{} served {served} of {}", g.id, domains.len());
    }
}

/// The modifiers that keep the topology of a planar mesh and leave it planar.
const PLANAR: [(&str, &[(&str, &str)]); 8] = [
    ("flip", &[("count", "7")]),
    ("worst-angle", &[]),
    ("delaunay", &[]),
    ("perturb", &[("amount", "0.4"), ("boundary", "free")]),
    ("scale", &[("factor", "0.5")]),
    ("translate", &[("x", "3"), ("y", "-5")]),
    ("rotate", &[("axis", "z")]),
    ("renumber", &[]),
];

quickcheck::quickcheck! {
    fn any_recipe_of_planar_modifiers_keeps_a_planar_disc(points: u8, steps: Vec<u8>, seed: u64) -> bool {
        let n = 6 + usize::from(points) % 40;
        let start = make("random-delaunay", &[("n", &n.to_string())], seed);
        let mut domain = start.clone();
        for (k, step) in steps.iter().take(8).enumerate() {
            let (id, settings) = PLANAR[usize::from(*step) % PLANAR.len()];
            match find(id).unwrap().run(Some(&domain), &given(settings), seed ^ k as u64) {
                Ok(changed) => domain = changed,
                // Few points may leave no edge to flip, and rounding in a rotation may flatten a thin triangle.
                Err(GenerateError::Impossible { .. }) => return true,
                Err(_) => return false,
            }
        }
        let (before, after) = (start.facts(), domain.facts());
        let s = after.surface.clone().unwrap();
        (before.vertices, before.edges, before.faces, before.boundary_vertices)
            == (after.vertices, after.edges, after.faces, after.boundary_vertices)
            && s.manifold && s.genus == Some(0) && s.boundary_loops == 1 && after.components == 1 && s.flipped_faces == 0
    }

    fn any_number_of_flips_of_a_closed_surface_keeps_its_genus(flips: u8, genus: u8, seed: u64) -> bool {
        let genus = usize::from(genus) % 4;
        let start = make("genus", &[("genus", &genus.to_string())], seed);
        let flipped = find("flip").unwrap().run(Some(&start), &given(&[("count", &flips.to_string())]), seed).unwrap();
        let s = flipped.facts().surface.unwrap();
        s.genus == Some(genus) && s.closed && s.manifold && s.degenerate_faces == 0 && s.duplicate_faces == 0
    }
}

#[test]
fn generators_work_as_a_library() {
    let start = make("random-delaunay-disk", &[("n", "30")], 11);
    let flipped = find("flip").unwrap().run(Some(&start), &given(&[("count", "12")]), 11).unwrap();
    let graph = find("as-graph").unwrap().run(Some(&flipped), &given(&[]), 11).unwrap();
    let weighted = find("random-weights").unwrap().run(Some(&graph), &given(&[("negative", "0.1")]), 11).unwrap();
    assert_eq!((weighted.kind(), weighted.edges().len()), (DomainKind::Graph, start.edges().len()));
}
