//! Relations between constructions: each holds for a construction that respects it and fails for one with a planted defect.

use std::collections::BTreeSet;

use lapjury::domain::{Domain, Graph, Surface, Volume, geometry};
use lapjury::generate::Stream;
use lapjury::linalg::Csr;
use lapjury::operator::{Mass, MassKind, Operator, Provenance};
use lapjury::property::{self, Statement, Status, Trial, Verdict};

const ALL: [&str; 6] = ["PERM", "RIGID", "SCALE", "ISO", "REACH", "UNION"];

type Build<'a> = dyn Fn(&Domain) -> Result<Operator, String> + Sync + 'a;

fn judge(id: &str, domain: &Domain, build: &Build) -> Verdict {
    let operator = build(domain).unwrap();
    property::find(id).unwrap().decide(&Trial::new(domain, &operator, 7).unwrap(), Some(&|d: &Domain| build(d)))
}

/// A k × k grid of squares, each with a diagonal; inner vertices moved by up to `noise`, all by `offset`.
fn grid(k: usize, noise: f64, offset: f64) -> Domain {
    let mut stream = Stream::new(2, "grid");
    let mut p = Vec::new();
    for y in 0..=k {
        for x in 0..=k {
            let inner = x > 0 && y > 0 && x < k && y < k;
            let mut shift = || if inner { stream.between(-noise, noise) } else { 0.0 } + offset;
            p.push([x as f64 + shift(), y as f64 + shift()]);
        }
    }
    let mut faces = Vec::new();
    for y in 0..k {
        for x in 0..k {
            let a = y * (k + 1) + x;
            faces.extend([[a, a + 1, a + k + 2], [a, a + k + 2, a + k + 1]]);
        }
    }
    Surface::planar(&p, &faces).unwrap().into()
}

/// Edge weights and vertex masses by any rule.
fn assembled(
    domain: &Domain,
    weight: impl Fn(&Surface, usize) -> f64,
    mass: impl Fn(&Surface, usize) -> f64,
) -> Result<Operator, String> {
    let surface = domain.as_surface().ok_or("no surface")?;
    let (n, edges) = (domain.vertex_count(), surface.topology().edges());
    let mut t = Vec::new();
    for (e, &[i, j]) in edges.iter().enumerate() {
        let w = weight(surface, e);
        t.extend([(i, j, -w), (j, i, -w), (i, i, w), (j, j, w)]);
    }
    let diagonal: Vec<f64> = (0..n).map(|v| mass(surface, v)).collect();
    let operator = Operator::new(Csr::from_triplets(n, n, &t), Provenance::default()).map_err(|e| e.to_string())?;
    operator.with_mass(Mass::lumped(MassKind::Barycentric, &diagonal)).map_err(|e| e.to_string())
}

fn cot(surface: &Surface, edge: usize) -> f64 {
    let [i, j] = surface.topology().edges()[edge];
    let at = |v| surface.point(v);
    surface.opposite(edge).iter().map(|&(_, k)| 0.5 * geometry::cotangent(at(k), at(i), at(j))).sum()
}

fn third(surface: &Surface, vertex: usize) -> f64 {
    surface.topology().star(vertex).iter().map(|c| surface.face_area(c.face()) / 3.0).sum()
}

fn length(surface: &Surface, edge: usize) -> f64 {
    let [i, j] = surface.topology().edges()[edge];
    (surface.point(i) - surface.point(j)).norm()
}

fn cotan(domain: &Domain) -> Result<Operator, String> {
    assembled(domain, cot, third)
}

fn changed(verdict: &Verdict) -> (&str, usize, usize) {
    let evidence = verdict.evidence().unwrap_or_else(|| panic!("{verdict:?}"));
    let Statement::Changed { transformation, i, j, before, after, threshold, .. } = &evidence.statement else {
        panic!("{verdict:?}")
    };
    assert!((before - after).abs() > *threshold);
    (transformation, *i, *j)
}

#[test]
fn cotan_respects_every_relation_on_planar_grids() {
    for domain in [grid(5, 0.0, 0.0), grid(5, 0.0, 0.3), grid(4, 0.0, 1e3 + 0.1)] {
        for id in ALL {
            let verdict = judge(id, &domain, &cotan);
            assert_eq!(verdict.status(), Status::Holds, "{id}: {verdict:?}");
            assert!(verdict.margin.is_some_and(|m| m <= 1.0));
        }
    }
}

#[test]
fn cotan_respects_every_relation_on_perturbed_grids_and_in_space() {
    let flat = grid(6, 0.3, 0.1);
    let Domain::Surface(s) = &flat else { unreachable!() };
    let lifted = s.positions().iter().map(|p| [p[0], p[1], (p[0] * 0.7).sin() + 0.3 * p[1]]).collect();
    let bent = Domain::from(Surface::new(lifted, s.faces().to_vec()).unwrap());
    // The perturbed grid still folds along the edges that cut off its corners.
    for (domain, folds) in [(&flat, true), (&bent, false)] {
        for id in ALL {
            let verdict = judge(id, domain, &cotan);
            let expected = if id == "ISO" && !folds { Status::NotApplicable } else { Status::Holds };
            assert_eq!(verdict.status(), expected, "{id}: {verdict:?}");
        }
    }
}

#[test]
fn a_thin_sliver_is_no_excuse_for_its_neighbours_and_no_failure() {
    for height in [1e-3, 1e-6, 1e-9] {
        let p = [[0.0, 0.0], [1.0, 0.0], [0.4, height], [0.5, 1.0], [0.3, -1.0], [2.0, 0.5]];
        let faces = [[0, 1, 2], [1, 3, 2], [0, 2, 3], [0, 4, 1], [1, 5, 3]];
        let domain = Domain::from(Surface::planar(&p, &faces).unwrap());
        for id in ["PERM", "RIGID", "SCALE", "UNION"] {
            let verdict = judge(id, &domain, &cotan);
            assert!(matches!(verdict.status(), Status::Holds), "{id} at {height:e}: {verdict:?}");
        }
    }
}

#[test]
fn a_weight_that_depends_on_indices_fails_perm() {
    let spoilt = |d: &Domain| assembled(d, |s, e| cot(s, e) + if e == 3 { 1e-9 } else { 0.0 }, third);
    let verdict = judge("PERM", &grid(4, 0.2, 0.0), &spoilt);
    assert!(changed(&verdict).0.contains("renumbering the vertices"), "{verdict:?}");
    // The first corner of a face decides: only the order within faces tells.
    let cornered = |d: &Domain| {
        assembled(
            d,
            |s, e| cot(s, e) * if s.faces()[s.topology().sides(e)[0].face()][0] % 2 == 0 { 1.0 } else { 1.1 },
            third,
        )
    };
    assert_eq!(judge("PERM", &grid(4, 0.2, 0.0), &cornered).status(), Status::Fails);
}

#[test]
fn a_weight_that_depends_on_coordinates_fails_rigid() {
    let domain = grid(4, 0.2, 0.0);
    let along = |s: &Surface, e: usize| {
        let [i, j] = s.topology().edges()[e];
        (s.point(i) - s.point(j)).x.abs()
    };
    let axis = move |d: &Domain| assembled(d, |s, e| cot(s, e) + 1e-9 * along(s, e), third);
    assert!(changed(&judge("RIGID", &domain, &axis)).0.contains("rotating"));
    let place = |d: &Domain| assembled(d, |s, e| cot(s, e) + 1e-9 * s.point(s.topology().edges()[e][0]).norm(), third);
    assert_eq!(judge("RIGID", &domain, &place).status(), Status::Fails);
    // Signed areas change sign in the mirror.
    let handed = |d: &Domain| assembled(d, cot, |s, v| third(s, v) * if s.point(1).x > 0.0 { 1.0 } else { 2.0 });
    assert_eq!(judge("RIGID", &domain, &handed).status(), Status::Fails);
}

#[test]
fn inverse_lengths_fail_scale_and_the_exponent_is_told() {
    let inverse = |d: &Domain| assembled(d, |s, e| 1.0 / length(s, e), third);
    let verdict = judge("SCALE", &grid(3, 0.2, 0.0), &inverse);
    changed(&verdict);
    assert!(verdict.notes.iter().any(|n| n.contains("stiffness times s^-1.000, mass times s^2.000")), "{verdict:?}");
    let unit = |d: &Domain| assembled(d, cot, |_, _| 1.0);
    assert_eq!(judge("SCALE", &grid(3, 0.2, 0.0), &unit).status(), Status::Fails);
}

#[test]
fn a_weight_that_sees_the_space_around_fails_iso_only() {
    // The distance between the two vertices opposite an edge is not intrinsic.
    let across = |s: &Surface, e: usize| match s.opposite(e)[..] {
        [(_, k), (_, l)] => cot(s, e) + 0.01 * (s.point(k) - s.point(l)).norm() / length(s, e),
        _ => cot(s, e),
    };
    let extrinsic = move |d: &Domain| assembled(d, across, third);
    for id in ALL {
        let verdict = judge(id, &grid(4, 0.0, 0.0), &extrinsic);
        let expected = if id == "ISO" { Status::Fails } else { Status::Holds };
        assert_eq!(verdict.status(), expected, "{id}: {verdict:?}");
    }
    assert!(changed(&judge("ISO", &grid(4, 0.0, 0.0), &extrinsic)).0.contains("folding by 90°"));
}

#[test]
fn a_weight_that_looks_two_rings_away_fails_reach() {
    let domain = grid(6, 0.2, 0.0);
    let near = |s: &Surface, e: usize| -> BTreeSet<usize> {
        let ends = s.topology().edges()[e];
        let one: BTreeSet<usize> =
            ends.iter().flat_map(|&v| s.topology().star(v).iter().flat_map(|c| s.faces()[c.face()].to_vec())).collect();
        one.iter().flat_map(|&v| s.topology().star(v).iter().flat_map(|c| s.faces()[c.face()].to_vec())).collect()
    };
    let wide = move |d: &Domain| {
        assembled(d, |s, e| cot(s, e) + 1e-6 * near(s, e).iter().map(|&v| s.point(v).norm()).sum::<f64>(), third)
    };
    let verdict = judge("REACH", &domain, &wide);
    assert!(changed(&verdict).0.starts_with("moving vertex"), "{verdict:?}");
}

#[test]
fn a_global_normalisation_fails_union_and_reach() {
    let domain = grid(4, 0.2, 0.0);
    let normal = |d: &Domain| assembled(d, |s, e| cot(s, e) / s.area(), third);
    for id in ["UNION", "REACH", "SCALE"] {
        // Moving an inner vertex leaves the area as it is.
        let expected = if id == "REACH" { Status::Holds } else { Status::Fails };
        assert_eq!(judge(id, &domain, &normal).status(), expected, "{id}");
    }
    let longest = |s: &Surface| (0..s.topology().edges().len()).map(|e| length(s, e)).sum::<f64>();
    let by_length = move |d: &Domain| assembled(d, |s, e| cot(s, e) * longest(s), third);
    assert_eq!(judge("REACH", &domain, &by_length).status(), Status::Fails);
}

#[test]
fn an_entry_between_the_two_parts_of_a_union_is_named_by_its_number_there() {
    let joined = |d: &Domain| {
        let plain = cotan(d)?;
        let n = d.vertex_count();
        let extra =
            Csr::from_triplets(n, n, &[(0, n - 1, -1e-6), (n - 1, 0, -1e-6), (0, 0, 1e-6), (n - 1, n - 1, 1e-6)]);
        let operator =
            Operator::new(plain.stiffness().add(&extra), Provenance::default()).map_err(|e| e.to_string())?;
        operator.with_mass(plain.mass().unwrap().clone()).map_err(|e| e.to_string())
    };
    let domain = grid(3, 0.1, 0.0);
    let n = domain.vertex_count();
    let verdict = judge("UNION", &domain, &joined);
    let (_, i, j) = changed(&verdict);
    assert!((i, j) == (0, 2 * n - 1) || (i, j) == (0, n - 1) || i == j, "({i}, {j})");
}

#[test]
fn on_graphs_only_names_and_unions_are_asked_for() {
    let edges = [[0, 1], [1, 2], [2, 3], [0, 3], [1, 3]];
    let weights = [1.0, 0.1, 2.5, 0.7, 3.0];
    let domain = Domain::from(Graph::weighted(4, &edges, &weights).unwrap().with_boundary(&[2]).unwrap());
    let build = |scale: fn(&Graph) -> f64| {
        move |d: &Domain| {
            let Domain::Graph(g) = d else { return Err("no graph".to_string()) };
            let n = g.vertex_count();
            let mut t = Vec::new();
            for (&[i, j], w) in g.edges().iter().zip(g.weights().ok_or("no weights")?) {
                let w = w * scale(g);
                t.extend([(i, j, -w), (j, i, -w), (i, i, w), (j, j, w)]);
            }
            Operator::new(Csr::from_triplets(n, n, &t), Provenance::default()).map_err(|e| e.to_string())
        }
    };
    let plain = build(|_| 1.0);
    for id in ALL {
        let expected = if ["PERM", "UNION"].contains(&id) { Status::Holds } else { Status::NotApplicable };
        assert_eq!(judge(id, &domain, &plain).status(), expected, "{id}");
    }
    let normalised = build(|g| 1.0 / g.edges().len() as f64);
    assert_eq!(judge("UNION", &domain, &normalised).status(), Status::Fails);
    let first = build(|g| if g.boundary()[2] { 1.0 } else { 2.0 });
    assert_eq!(judge("PERM", &domain, &first).status(), Status::Fails);
}

#[test]
fn a_refusal_is_no_verdict_and_is_told() {
    let domain = grid(3, 0.0, 0.0);
    let operator = cotan(&domain).unwrap();
    let refuse = |_: &Domain| Err::<Operator, String>("too hot today".into());
    for id in ALL {
        let trial = Trial::new(&domain, &operator, 7).unwrap();
        let verdict = property::find(id).unwrap().decide(&trial, Some(&refuse));
        assert!(verdict.reason().is_some_and(|why| why.contains("too hot today")), "{id}: {verdict:?}");
        let verdict = property::find(id).unwrap().decide(&trial, None);
        assert!(verdict.reason().is_some_and(|why| why.contains("came as a matrix")), "{id}");
    }
}

#[test]
fn the_stiffness_of_a_volume_grows_with_lengths_and_its_mass_with_volumes() {
    let p = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
    let domain = Domain::from(Volume::new(p, vec![[0, 1, 2, 3], [4, 1, 3, 2]]).unwrap());
    let by_length = |power: i32| {
        move |d: &Domain| {
            let (n, p) = (d.vertex_count(), d.positions().ok_or("no positions")?);
            let mut t = Vec::new();
            for &[i, j] in d.edges() {
                let w = (geometry::Vec3::from(p[i]) - geometry::Vec3::from(p[j])).norm().powi(power);
                t.extend([(i, j, -w), (j, i, -w), (i, i, w), (j, j, w)]);
            }
            Operator::new(Csr::from_triplets(n, n, &t), Provenance::default()).map_err(|e| e.to_string())
        }
    };
    for id in ["PERM", "RIGID", "SCALE", "UNION"] {
        assert_eq!(judge(id, &domain, &by_length(1)).status(), Status::Holds, "{id}");
    }
    assert_eq!(judge("SCALE", &domain, &by_length(0)).status(), Status::Fails);
}

#[test]
fn iso_needs_a_straight_chain_and_finds_it_at_any_slope() {
    // A skewed grid: x + y/3, y − x/7 keeps straight lines straight only up to rounding, unless coordinates are dyadic.
    let Domain::Surface(s) = grid(4, 0.0, 0.0) else { unreachable!() };
    let skewed = s.positions().iter().map(|p| [p[0] + 0.25 * p[1], p[1] - 0.125 * p[0], 0.0]).collect();
    let domain = Domain::from(Surface::new(skewed, s.faces().to_vec()).unwrap());
    assert_eq!(judge("ISO", &domain, &cotan).status(), Status::Holds);
    let triangle = Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &[[0, 1, 2]]).unwrap().into();
    assert_eq!(judge("ISO", &triangle, &cotan).status(), Status::NotApplicable);
}
