//! Real meshes under the cotangent Laplacian and all other operators: counts from an independent program, totals from a sum
//! of our own, and clear answers on the broken ones.

use std::collections::BTreeMap;
use std::path::PathBuf;

use lapjury::domain::Domain;
use lapjury::exchange::read_domain;
use lapjury::laplacian;
use lapjury::operator::Operator;
use lapjury::property::tolerance::UNIT_ROUNDOFF;
use lapjury::property::{self, Outcome, Statement, Status, Tally, Trial, Verdict, recheck};

fn mesh(name: &str) -> Domain {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("fixtures/meshes").join(name);
    read_domain(&path).unwrap_or_else(|e| panic!("{e}"))
}

fn cotan(domain: &Domain, settings: &[(&str, &str)]) -> Operator {
    let settings: BTreeMap<String, String> = settings.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect();
    laplacian::find("cotan").unwrap().build(domain, &settings).unwrap_or_else(|e| panic!("{e}"))
}

fn judge(id: &str, domain: &Domain, operator: &Operator) -> Verdict {
    let trial = Trial::new(domain, operator, 1).unwrap();
    property::find(id).unwrap().decide(&trial, None)
}

/// Mesh; negative weights on interior edges as measured by an independent program; how many more there are on the doubles than
/// on the decimals in the file.
const NEGATIVE: [(&str, usize, usize); 11] = [
    ("spot.ply", 269, 0),
    ("bob_small.ply", 94, 0),
    ("fox.ply", 118, 0),
    ("eight.off", 161, 0),
    ("anchor.off", 163, 2),
    ("blade.off", 4, 0),
    ("three_peaks.off", 397, 0),
    ("retinal.off", 809, 0),
    ("femur.off", 1046, 0),
    ("bones.off", 841, 0),
    ("oblong.off", 94, 1),
];

#[test]
fn negative_weights_are_the_non_delaunay_edges_and_rounding_of_coordinates_accounts_for_the_rest() {
    for (name, measured, tipped) in NEGATIVE {
        let domain = mesh(name);
        let operator = cotan(&domain, &[]);
        let facts = domain.facts().surface.unwrap();
        let Tally { violations, zeros, undecided, total } = judge("POS", &domain, &operator).tally.unwrap();
        assert_eq!((violations, undecided), (measured + tipped, 0), "{name}");
        assert_eq!((Some(violations), Some(zeros)), (facts.non_delaunay_edges, facts.cocircular_edges), "{name}");
        assert_eq!(facts.non_delaunay_within_rounding, Some(tipped), "{name}");
        assert_eq!(total, domain.edges().len() - facts.boundary_edges, "{name}");
        let negative = |e: &usize| {
            let [i, j] = domain.edges()[*e];
            !domain.as_surface().unwrap().topology().is_boundary_edge(*e) && operator.stiffness().at(i, j) > 0.0
        };
        assert_eq!((0..domain.edges().len()).filter(negative).count(), violations, "{name}");
    }
}

#[test]
fn three_peaks_has_nineteen_negative_weights_on_its_boundary() {
    let domain = mesh("three_peaks.off");
    let tally = judge("POS-boundary", &domain, &cotan(&domain, &[])).tally.unwrap();
    assert_eq!((tally.violations, tally.undecided), (19, 0));
    assert_eq!(tally.total, domain.facts().surface.unwrap().boundary_edges);
}

#[test]
fn the_bones_have_a_kernel_of_dimension_twenty_six() {
    let domain = mesh("bones.off");
    let verdict = judge("KER", &domain, &cotan(&domain, &[]));
    let Outcome::Holds(evidence) = &verdict.outcome else { panic!("{verdict:?}") };
    let Statement::InertiaCount { kernel, .. } = evidence.statement else { panic!("{:?}", evidence.statement) };
    assert_eq!((kernel, domain.facts().components), (26, 26));
}

/// The area of a mesh, and a bound for what two roundings of `Σ ℓ² cot θ / 4` or of the triangle areas may differ by: a cotangent is
/// off by `8u / sin² θ`, and a sum of F terms by F u of their magnitudes.
fn area_and_leeway(domain: &Domain) -> (f64, f64) {
    let surface = domain.as_surface().unwrap();
    let terms = surface.faces().len() as f64;
    let (mut area, mut leeway) = (0.0, 0.0);
    for face in surface.faces() {
        let p: Vec<_> = face.iter().map(|&v| surface.point(v)).collect();
        let doubled = (p[1] - p[0]).cross(&(p[2] - p[0])).norm();
        area += 0.5 * doubled;
        for k in 0..3 {
            let (u, v) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            let (cot, squared) = (u.dot(&v) / doubled, (u - v).norm_squared());
            if cot.is_finite() && doubled > 0.0 {
                leeway += 2.0 * UNIT_ROUNDOFF * 0.25 * squared * ((terms + 16.0) * cot.abs() + 8.0 * (1.0 + cot * cot));
            }
        }
    }
    (area, leeway)
}

const MASSES: [&str; 4] = ["barycentric", "voronoi", "mixed", "consistent"];

#[test]
fn every_mass_adds_up_to_the_area_of_every_triangle_mesh() {
    let more = ["oblong-shuffled.off", "3DSMaxExport.STL", "spider.obj"];
    for name in NEGATIVE.iter().map(|n| n.0).chain(more) {
        let domain = mesh(name);
        let (area, leeway) = area_and_leeway(&domain);
        assert!(leeway < 1e-8 * area, "{name}: {leeway} of {area} would prove little");
        for mass in MASSES {
            let operator = cotan(&domain, &[("mass", mass), ("degenerate", "skip")]);
            let total = operator.mass().unwrap().total();
            assert!((total - area).abs() <= leeway, "{name} {mass}: {total} against {area}, leeway {leeway:e}");
        }
    }
}

#[test]
fn no_mass_but_the_signed_one_fails_on_a_real_mesh() {
    for name in ["bob_small.ply", "eight.off", "anchor.off", "oblong.off", "3DSMaxExport.STL"] {
        let domain = mesh(name);
        for mass in ["barycentric", "mixed", "consistent"] {
            let verdict = judge("MASS", &domain, &cotan(&domain, &[("mass", mass)]));
            assert_eq!(verdict.status(), Status::Holds, "{name} {mass}: {verdict:?}");
        }
    }
}

/// Every operator that can be built, every property, on a mesh that something is wrong with: each verdict is made of numbers and
/// its evidence survives. Returns the refusals.
fn tried_in_full(name: &str, settings: &[(&str, &str)]) -> Vec<String> {
    let domain = mesh(name);
    let mut refusals = Vec::new();
    for laplacian in laplacian::ALL.iter().filter(|l| l.accepts.contains(&domain.kind())) {
        let admits = |k: &str, v: &str| laplacian.parameters.iter().any(|p| p.name == k && p.range.admits(v));
        let known = settings.iter().filter(|(k, v)| admits(k, v));
        let known: BTreeMap<String, String> = known.map(|(k, v)| (k.to_string(), v.to_string())).collect();
        let construction = |domain: &Domain| laplacian.build(domain, &known).map_err(|refusal| refusal.to_string());
        let operator = match construction(&domain) {
            Ok(operator) => operator,
            Err(refusal) => {
                refusals.push(format!("{}: {refusal}", laplacian.id));
                continue;
            }
        };
        assert!(operator.stiffness().entries().all(|(_, _, v)| v.is_finite()), "{name} {}", laplacian.id);
        let trial = Trial::new(&domain, &operator, 1).unwrap();
        for property in property::ALL {
            let verdict = property.decide(&trial, Some(&construction));
            let told = format!("{verdict:?}");
            assert!(!told.contains("NaN") && !told.contains("inf"), "{name} {} {}: {told}", laplacian.id, property.id);
            assert!(verdict.evidence().is_some() != verdict.reason().is_some(), "{told}");
            assert!(verdict.reason().is_none_or(|why| !why.is_empty()));
            if let Err(refusal) = recheck::of_verdict(&verdict, property.id, &domain, &operator) {
                panic!("{name} {} {}: {refusal}", laplacian.id, property.id);
            }
        }
    }
    refusals
}

/// Weights for `weighted-graph`, which a mesh does not bring.
const WEIGHTS: (&str, &str) = ("weights", "inverse-length");

/// What `optimal-positive` says on a surface in space.
const CURVED: &str = "optimal-positive: 'optimal-positive' needs a triangulation that lies unfolded in a coordinate plane, with at most \
                      two triangles at an edge; use intrinsic-delaunay on a surface in space";

/// What `point-cloud-heat` says where the twelve points nearest to a point are no sample of a smooth surface.
fn crooked(point: usize) -> String {
    format!(
        "point-cloud-heat: the 12 points nearest to point {point} do not lie near a plane, so that 'point-cloud-heat' finds no \
         tangent space there; sample what is curved more densely, and set the dimension to that of what is sampled"
    )
}

#[test]
fn on_degenerate_triangles_operators_refuse_and_say_what_to_do() {
    let cotangents = ["cotan", "intrinsic-delaunay", "mean-value", "wachspress", "three-point", "orthogonal-dual"].map(|id| {
        format!(
            "{id}: triangle 924 (487, 490, 509) has zero area, where '{id}' is not defined (56 such triangles in all); \
             remove them, or leave them out with degenerate=skip"
        )
    });
    let expected: Vec<String> = cotangents.into_iter().chain([CURVED.to_string(), crooked(0)]).collect();
    assert_eq!(tried_in_full("spider.obj", &[("weights", "unit")]), expected);
}

#[test]
fn without_the_degenerate_triangles_every_verdict_is_made_of_numbers() {
    // An independent program counts 56 edges between vertices at the same place, (487, 490) first.
    let lengths = ["weighted-graph", "normalized-graph"].map(|id| {
        format!(
            "{id}: edge (487, 490) has length zero, and '{id}' divides by it (56 such edges in all); merge the vertices that \
             coincide, or choose weights=unit"
        )
    });
    let expected: Vec<String> = lengths.into_iter().chain([CURVED.to_string(), crooked(0)]).collect();
    assert_eq!(tried_in_full("spider.obj", &[WEIGHTS, ("degenerate", "skip")]), expected);
}

#[test]
fn on_a_mesh_that_is_no_manifold_intrinsic_flips_are_refused_and_a_plane_is_missed() {
    let expected = "intrinsic-delaunay: edge (722, 723) has 3 faces, and 'intrinsic-delaunay' needs a manifold; separate the \
                    sheets first";
    assert_eq!(tried_in_full("3DSMaxExport.STL", &[WEIGHTS]), [expected, CURVED, &crooked(0)]);
}

#[test]
fn on_a_mesh_that_was_oriented_anew_every_verdict_is_made_of_numbers() {
    assert_eq!(tried_in_full("oblong-shuffled.off", &[WEIGHTS]), [CURVED, &crooked(14)]);
}

#[test]
fn edges_without_weights_are_refused_with_the_ways_to_weigh_them() {
    let refusal = laplacian::find("weighted-graph").unwrap().build(&mesh("oblong-shuffled.off"), &BTreeMap::new());
    assert_eq!(
        refusal.unwrap_err().to_string(),
        "'weighted-graph' needs weights given with the edges; use a weighted graph, or choose weights=unit, inverse-length \
         or inverse-squared-length"
    );
}
