//! The drums of Gordon, Webb and Wolpert: two polygons that are not congruent, with one spectrum for the cotangent operator with its
//! mass.
//!
//! # How it is decided
//! The matrices that take functions from one drum to the other are the solutions of a linear system over the rationals
//! ([`world::drums`](super::world::drums)), found here and not written down. For rational tiles and meshes of them the products
//! `X_B R = S X_A` are compared entry by entry, and R has an inverse, the lift of T⁻¹. A second way knows no transplantation: on small
//! meshes the characteristic polynomials of both drums are computed and compared.
//!
//! # What a mass is needed for
//! Stiffness and masses are sums over tiles; the identity is not, since a vertex on a side that two tiles share counts once. Under
//! Dirichlet's condition that changes nothing, because such vertices correspond to such vertices. Under Neumann's condition a vertex
//! inside of one drum corresponds to vertices on the boundary of the other, and the eigenvalues of the stiffness alone differ.

mod sound;

use super::poll::{Case, Every, Search};
use super::world::drums::{
    Entries, Pair, Side, Tile, invertible, outline, product, same_outline, transplantations, transposed,
};
use super::{Experiment, Finding, Setting};
use crate::generate::Stream;
use crate::generate::drum::{DRUMS, Drum};
use crate::linalg::pencil::{Pencil, out_of_order, simplest};
use crate::linalg::{Dense, Polynomial};
use crate::operator::MassKind;
use crate::property::evidence::{Condition, Fraction, Mesh, Weighting};
use crate::property::{Evidence, Statement};
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "isospectral-drums",
    name: "Drums that sound alike",
    statement: "two polygons glued from seven triangles have one spectrum for the cotangent operator and are not congruent: X_B R = S X_A \
                exactly for stiffness and masses, under Dirichlet and under Neumann; without mass under Dirichlet only",
    sources: &["wardetzky-primer", "gordon-webb-wolpert1992", "buser1994", "berard1992"],
    parts: &[
        "transplantations",
        "dirichlet-intertwines",
        "neumann-intertwines",
        "same-polynomials",
        "not-congruent",
        "neumann-without-mass-differs",
        "spectra-agree",
    ],
    run,
};

/// The tile of the octagons.
const RIGHT: Tile = [[2, 0], [0, 2], [0, 0]];

/// The masses that are sums over tiles.
const MASSES: [MassKind; 4] = [MassKind::Barycentric, MassKind::Consistent, MassKind::Mixed, MassKind::Voronoi];

/// A condition with a transplantation from A to B.
struct Way {
    condition: Condition,
    t: Dense<Rational>,
}

fn run(setting: &Setting) -> Vec<Finding> {
    let mut stream = Stream::new(setting.seed, ENTRY.id);
    let mut tiles = vec![RIGHT, [[5, 1], [1, 4], [0, 0]]];
    tiles.extend((0..setting.pick(1, 4)).map(|_| random_tile(&mut stream)));
    let refinements = [2, 4, setting.pick(5, 8)];

    let gluings = [&DRUMS[0], &DRUMS[1]];
    let mut exist = Every::default();
    let mut ways = Vec::new();
    let mut dimensions = Vec::new();
    for condition in [Condition::Dirichlet, Condition::Neumann] {
        let basis = transplantations(gluings, condition);
        dimensions.push(format!("{} under {condition}", basis.len()));
        let t = invertible(&basis);
        exist.ask(t.is_none().then(|| Case::told(format!("none is invertible under {condition}"))));
        ways.extend(t.map(|t| Way { condition, t }));
    }
    let mut transplanted = exist.answer(
        ENTRY.parts[0],
        "Has T A_k = B_k T, k = 1, 2, 3, an invertible solution T over the rationals?",
        "boundary conditions",
    );
    transplanted.finding += &format!("; the dimensions of all solutions: {}", dimensions.join(", "));

    let mut intertwined: [Every; 2] = Default::default();
    for way in &ways {
        let poll = &mut intertwined[usize::from(way.condition == Condition::Neumann)];
        for (tile, parts) in tiles.iter().flat_map(|t| refinements.map(|n| (*t, n))) {
            ask_matrices(way, tile, parts, poll);
        }
    }
    let [dirichlet, neumann] = intertwined;
    let cases = format!(
        "matrices on drums of {} rational tiles with sides in {refinements:?} parts, entry by entry and exactly",
        tiles.len()
    );
    let dirichlet = dirichlet.answer(
        ENTRY.parts[1],
        "Under Dirichlet: is R X_A = X_B R for the stiffness, the identity and every mass, and R invertible?",
        &cases,
    );
    let neumann = neumann.answer(
        ENTRY.parts[2],
        "Under Neumann: is X_B R = S X_A for the stiffness and every mass, and R invertible?",
        &cases,
    );
    let certified = |finding: Finding, condition: Condition| {
        let way = ways.iter().find(|w| w.condition == condition).filter(|_| finding.agrees);
        let certificate = way.and_then(certificate);
        Finding { evidence: finding.evidence.into_iter().chain(certificate).collect(), ..finding }
    };
    vec![
        transplanted,
        certified(dirichlet, Condition::Dirichlet),
        certified(neumann, Condition::Neumann),
        same_polynomials(&tiles, setting),
        not_congruent(&tiles),
        without_mass(&tiles),
        sound::agree(setting, &ways),
    ]
}

/// Corners below 16 of a tile that is not flat, with three different sides: where two are alike, drums can be congruent.
fn random_tile(stream: &mut Stream) -> Tile {
    loop {
        let tile: Tile = std::array::from_fn(|_| std::array::from_fn(|_| stream.below(16) as i64));
        let side = |p: usize, q: usize| [0, 1].map(|axis| tile[q][axis] - tile[p][axis]);
        let sides = [side(0, 1), side(0, 2), side(1, 2)];
        let [a, b, c] = sides.map(|[x, y]| x * x + y * y);
        if sides[0][0] * sides[1][1] != sides[0][1] * sides[1][0] && a != b && b != c && a != c {
            return tile;
        }
    }
}

/// R and S of a pair of drums.
fn lifts(pair: &Pair, t: &Dense<Rational>) -> Option<[Entries; 2]> {
    Some([pair.lifted(t, 1)?, transposed(&pair.lifted(&t.transpose(), 0)?)])
}

/// Every matrix on one mesh.
fn ask_matrices(way: &Way, tile: Tile, parts: usize, poll: &mut Every) {
    let told = |what: &str| Some(Case::told(format!("{what}: the tile {tile:?} with sides in {parts} parts")));
    let Some(pair) = Pair::new(tile, parts, way.condition) else { return poll.ask(told("no drum")) };
    let Some([r, s]) = lifts(&pair, &way.t) else { return poll.ask(told("functions are torn apart")) };
    poll.ask(if is_inverted(&pair, &way.t, &r) { None } else { told("R has no inverse") });
    let mut kinds: Vec<Option<MassKind>> = MASSES.into_iter().map(Some).chain([None]).collect();
    if way.condition == Condition::Dirichlet {
        poll.ask(if r == s { None } else { told("S is not R") });
        kinds.push(Some(MassKind::Unit));
    }
    for kind in kinds {
        let name = kind.map_or("stiffness", MassKind::name);
        poll.ask(match pair.matrices(kind) {
            Some([a, b]) if product(&b, &r) == product(&s, &a) => None,
            _ => told(&format!("X_B R is not S X_A for {name}")),
        });
    }
}

/// The lift of T⁻¹ takes R to the identity.
fn is_inverted(pair: &Pair, t: &Dense<Rational>, r: &Entries) -> bool {
    let back = t.inverse().and_then(|inverse| pair.lifted(&inverse, 0));
    let identity: Entries = pair.kept[0].iter().map(|&v| ((v, v), Rational::ONE)).collect();
    pair.kept[0].len() == pair.kept[1].len() && back.is_some_and(|back| product(&back, r) == identity)
}

/// The transplantation on a small mesh, written down.
fn certificate(way: &Way) -> Option<Evidence> {
    const PARTS: usize = 2;
    let pair = Pair::new(RIGHT, PARTS, way.condition)?;
    let written = |entries: &Entries| entries.iter().map(|(&(i, j), x)| (i, j, Fraction::from(x))).collect();
    let [r, s] = lifts(&pair, &way.t)?;
    let [first, second] = meshes(PARTS);
    let (matrix, dual) = (written(&r), written(&s));
    let scale = Rational::from((PARTS * PARTS) as u64);
    let whole = |side: &Side| u64::try_from((side[0].clone() * scale.clone()).floor()).ok();
    let lengths = |k: usize| outline(&DRUMS[k], RIGHT).iter().map(whole).collect::<Option<Vec<u64>>>();
    let outlines = [lengths(0)?, lengths(1)?];
    let condition = way.condition;
    Some(Evidence::bare(Statement::Transplantation { first, second, condition, matrix, dual, outlines }))
}

/// Both octagons with whole coordinates.
fn meshes(parts: usize) -> [Mesh; 2] {
    [0, 1].map(|k| {
        let tile = RIGHT.map(|p| p.map(|x| (x * parts as i64) as f64));
        let drum = Drum::new(&DRUMS[k], tile, parts);
        let points = drum.points().iter().map(|p| p.map(|x| x as i64)).collect();
        Mesh { points, faces: drum.faces() }
    })
}

/// The characteristic polynomials of both drums.
fn polynomials(
    tile: Tile,
    parts: usize,
    condition: Condition,
    mass: MassKind,
) -> Option<([Polynomial<Rational>; 2], [Pencil; 2])> {
    let pair = Pair::new(tile, parts, condition)?;
    let (l, m) = (pair.matrices(None)?, pair.matrices(Some(mass))?);
    let pencil = |k: usize| Pencil::new(pair.dense(&l[k], k), pair.dense(&m[k], k));
    let pencils = [pencil(0)?, pencil(1)?];
    Some(([pencils[0].characteristic()?, pencils[1].characteristic()?], pencils))
}

fn same_polynomials(tiles: &[Tile], setting: &Setting) -> Finding {
    let mut same = Every::default();
    let problems = [
        (Condition::Neumann, 1, vec![MassKind::Barycentric, MassKind::Consistent]),
        (Condition::Dirichlet, 2, vec![MassKind::Unit, MassKind::Barycentric, MassKind::Consistent]),
        (Condition::Dirichlet, 3, vec![MassKind::Unit, MassKind::Barycentric]),
    ];
    for (condition, parts, masses) in problems.into_iter().take(setting.pick(2, 3)) {
        // Nineteen rows with long fractions take seconds.
        let tried = if parts == 3 { 1 } else { tiles.len() };
        for (&tile, mass) in tiles[..tried].iter().flat_map(|t| masses.iter().map(move |m| (t, *m))) {
            let equal = polynomials(tile, parts, condition, mass).is_some_and(|([a, b], _)| a == b);
            let what = || format!("{condition}, mass {}, the tile {tile:?} in {parts} parts", mass.name());
            same.ask((!equal).then(|| Case::told(what())));
        }
    }
    same.answer(
        ENTRY.parts[3],
        "Is det(xI − M⁻¹L) of both drums the same polynomial?",
        "pairs of small problems, of up to 19 rows, with and without boundary condition",
    )
}

fn not_congruent(tiles: &[Tile]) -> Finding {
    let mut differ = Every::default();
    let mut shown = String::new();
    for &tile in tiles {
        let sides = DRUMS.map(|gluing| outline(&gluing, tile));
        if tile == RIGHT {
            let list = |s: &[Side]| s.iter().map(|side| side[0].to_string()).collect::<Vec<_>>().join(", ");
            shown =
                format!("; squared lengths with right isosceles tiles: {} and {}", list(&sides[0]), list(&sides[1]));
        }
        differ.ask(same_outline(&sides[0], &sides[1]).then(|| Case::told(format!("the tile {tile:?}"))));
    }
    let mut finding = differ.answer(
        ENTRY.parts[4],
        "Do the sides of the boundary polygons, by squared lengths and dot products of neighbours in their order, tell the drums apart?",
        "tiles",
    );
    finding.finding += &shown;
    finding
}

/// Whether the eigenvalues of the stiffness alone differ under Neumann's condition.
fn without_mass(tiles: &[Tile]) -> Finding {
    let mut search = Search::default();
    for (tile, parts) in [(RIGHT, 1), (RIGHT, 2)].into_iter().chain(tiles.iter().skip(1).map(|t| (*t, 1))) {
        search.ask(polynomials(tile, parts, Condition::Neumann, MassKind::Unit).and_then(|(both, pencils)| {
            let what = format!("the tile {tile:?} with sides in {parts} parts");
            if (tile, parts) != (RIGHT, 1) {
                return (both[0] != both[1]).then(|| Case::told(what));
            }
            let t = out_of_order(&both[0], &both[1]).or_else(|| out_of_order(&both[1], &both[0]))?;
            let counts = |t: &Rational| pencils.each_ref().map(|p| p.inertia(t));
            let separates = |t: &Rational| {
                let [a, b] = counts(t);
                (a.zero, b.zero) == (0, 0) && a.negative != b.negative
            };
            let sigma = simplest(&t, 64, separates).unwrap_or(t);
            let below = counts(&sigma).map(|inertia| inertia.negative);
            let [first, second] = meshes(parts);
            let determinants = pencils.each_ref().map(|p| Fraction::from(&determinant(&p.shifted(&sigma))));
            let statement = Statement::SpectraDiffer {
                first,
                second,
                condition: Condition::Neumann,
                mass: Weighting::Unit,
                sigma: Fraction::from(&sigma),
                below,
                determinants,
            };
            let text = format!("{what}: {} and {} eigenvalues of L below {sigma}", below[0], below[1]);
            Some(Case::shown(text, Evidence::bare(statement)))
        }));
    }
    search.answer(
        ENTRY.parts[5],
        "Under Neumann, with M = I: has the stiffness of one drum another characteristic polynomial?",
        "meshes of both drums",
    )
}

/// `det A`, the constant coefficient of the characteristic polynomial up to its sign.
fn determinant(a: &Dense<Rational>) -> Rational {
    let value = Polynomial::characteristic(a).at(&Rational::ZERO);
    if a.rows().is_multiple_of(2) { value } else { -value }.reduced()
}
