//! Semi-definiteness, kernel and maximum principles: each decided against a second way to compute it, over all small cases
//! and over seeded ones, and against planted defects.

use lapjury::domain::{Domain, Graph, Surface};
use lapjury::generate::Stream;
use lapjury::linalg::Csr;
use lapjury::linalg::factor::{singular_values, symmetric_eigen};
use lapjury::linalg::rational::{Elimination, eliminate};
use lapjury::operator::{Mass, MassKind, Operator, Provenance};
use lapjury::property::{self, Level, Statement, Status, Trial, Verdict};
use lapjury::scalar::{Rational, Scalar};

type Edge = ([usize; 2], f64);

fn judge(id: &str, domain: &Domain, operator: &Operator) -> Verdict {
    property::find(id).unwrap().decide(&Trial::new(domain, operator, 1).unwrap(), None)
}

fn operator(matrix: Csr) -> Operator {
    Operator::new(matrix, Provenance::default()).unwrap()
}

/// The Laplacian of weighted edges.
fn laplacian(n: usize, edges: &[Edge]) -> Csr {
    let of = |&([i, j], w): &Edge| [(i, j, -w), (j, i, -w), (i, i, w), (j, j, w)];
    Csr::from_triplets(n, n, &edges.iter().flat_map(of).collect::<Vec<_>>())
}

fn graph(n: usize, edges: &[Edge], boundary: &[usize]) -> Domain {
    let list: Vec<[usize; 2]> = edges.iter().map(|e| e.0).collect();
    Graph::new(n, &list).unwrap().with_boundary(boundary).unwrap().into()
}

fn path(n: usize, w: f64) -> Vec<Edge> {
    (1..n).map(|i| ([i - 1, i], w)).collect()
}

fn statement(verdict: &Verdict) -> &Statement {
    &verdict.evidence().unwrap_or_else(|| panic!("no evidence: {verdict:?}")).statement
}

/// All 729 weightings of the complete graph on four vertices by −1, 0, 1.
fn weighted_tetrahedra() -> impl Iterator<Item = Vec<Edge>> {
    let edges = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    (0..729_u32)
        .map(move |code| (0..6).map(|k| (edges[k as usize], f64::from(code / 3_u32.pow(k) % 3) - 1.0)).collect())
}

/// The witness has negative energy, exactly, and carries the rows of its support.
fn assert_negative_energy(verdict: &Verdict, matrix: &Csr) {
    let Statement::NegativeEnergy { x } = statement(verdict) else { panic!("no direction: {verdict:?}") };
    let mut full = vec![Rational::zero(); matrix.rows()];
    x.iter().for_each(|&(i, v)| full[i] = Rational::exactly(v).unwrap());
    assert!(matrix.exact().unwrap().quadratic_form(&full).cmp_zero().is_lt());
    let rows: Vec<usize> = verdict.evidence().unwrap().excerpt.rows.iter().map(|r| r.row).collect();
    assert_eq!(rows, x.iter().map(|p| p.0).collect::<Vec<_>>());
    assert_eq!(verdict.level, Level::Exact);
}

#[test]
fn psd_agrees_with_dense_eigenvalues_for_all_weightings_of_the_tetrahedron() {
    let mut counts = [0; 2];
    for edges in weighted_tetrahedra() {
        let matrix = laplacian(4, &edges);
        let smallest = symmetric_eigen(&matrix).unwrap().0[0];
        let verdict = judge("PSD", &graph(4, &edges, &[]), &operator(matrix.clone()));
        if smallest < -1e-6 {
            assert_eq!(verdict.status(), Status::Fails, "{edges:?}: {smallest}");
            assert_negative_energy(&verdict, &matrix);
        } else {
            assert_eq!(verdict.status(), Status::Holds, "{edges:?}: {smallest:e} {verdict:?}");
        }
        counts[usize::from(smallest < -1e-6)] += 1;
    }
    assert!(counts[0] > 60 && counts[1] > 60, "{counts:?}");
}

#[test]
fn psd_agrees_with_dense_eigenvalues_on_random_matrices_that_need_not_be_symmetric() {
    let mut stream = Stream::new(5, "psd");
    let mut counts = [0; 2];
    for case in 0..120 {
        let n = 5 + case % 23;
        let negative = if case % 3 == 0 { 0.0 } else { 0.12 };
        let mut t = Vec::new();
        for i in 0..n {
            for j in 0..i {
                if stream.unit() < 0.4 || j + 1 == i {
                    let w = stream.between(0.1, 2.0) * if stream.unit() < negative { -0.4 } else { 1.0 };
                    let skew = if case % 4 == 0 { stream.between(-0.05, 0.05) } else { 0.0 };
                    t.extend([(i, j, -w - skew), (j, i, -w + skew), (i, i, w + skew), (j, j, w - skew)]);
                }
            }
        }
        let matrix = Csr::from_triplets(n, n, &t);
        let smallest = symmetric_eigen(&matrix.symmetric_part()).unwrap().0[0];
        let verdict = judge("PSD", &graph(n, &[], &[]), &operator(matrix.clone()));
        if smallest < -1e-9 {
            assert_eq!(verdict.status(), Status::Fails, "case {case}: {smallest:e}");
            assert_negative_energy(&verdict, &matrix);
            counts[1] += 1;
        } else if smallest > -1e-13 {
            assert_eq!(verdict.status(), Status::Holds, "case {case}: {smallest:e}");
            counts[0] += 1;
        }
    }
    assert!(counts[0] > 20 && counts[1] > 20, "{counts:?}");
}

/// A cycle of n edges of weight 1 but for one of weight −1/r: by the rule for conductances in series its energy is positive off
/// the constants iff r > n − 1, and vanishes on one more function iff r = n − 1.
fn critical_cycle(n: usize, r: f64) -> (Domain, Csr) {
    let mut edges = path(n, 1.0);
    edges.push(([0, n - 1], -1.0 / r));
    (graph(n, &edges, &[]), laplacian(n, &edges))
}

#[test]
fn psd_and_ker_change_where_the_resistance_of_a_cycle_changes_sign() {
    for n in [17, 65, 1025] {
        let m = (n - 1) as f64;
        let case = |r: f64| {
            let (domain, matrix) = critical_cycle(n, r);
            let operator = operator(matrix.clone());
            (judge("PSD", &domain, &operator), judge("KER", &domain, &operator), matrix)
        };
        let (psd, ker, _) = case(m * 1.01);
        assert_eq!((psd.status(), ker.status()), (Status::Holds, Status::Holds), "n = {n}: {psd:?} {ker:?}");
        let (psd, _, matrix) = case(m * 0.99);
        assert_eq!(psd.status(), Status::Fails, "n = {n}: {psd:?}");
        assert_negative_energy(&psd, &matrix);
        // n − 1 is a power of two: the further kernel vector, linear along the cycle, is exact.
        let (psd, ker, matrix) = case(m);
        assert_eq!((psd.status(), ker.status()), (Status::Holds, Status::Fails), "n = {n}: {psd:?} {ker:?}");
        let Statement::KernelVector { x, a, b, threshold } = statement(&ker) else { panic!("{ker:?}") };
        let mut full = vec![0.0; n];
        x.iter().for_each(|&(i, v)| full[i] = v);
        assert!(full[*a] - full[*b] >= 1.0 && *threshold < 1e-14);
        for (image, scale) in matrix.mul(&full).iter().zip(matrix.row_scales()) {
            assert!(image.abs() <= (threshold + 1e-15) * scale);
        }
    }
}

#[test]
fn the_direction_is_small_where_one_vertex_is_spoilt() {
    let n = 900;
    let mut edges = path(n, 1.0);
    edges.push(([400, 402], -3.0));
    let matrix = laplacian(n, &edges);
    let verdict = judge("PSD", &graph(n, &edges, &[]), &operator(matrix.clone()));
    assert_negative_energy(&verdict, &matrix);
    let Statement::NegativeEnergy { x } = statement(&verdict) else { panic!("{verdict:?}") };
    assert!(x.len() <= 8, "{} components", x.len());
}

#[test]
fn a_negative_energy_that_rounding_explains_is_no_failure() {
    // A path whose diagonal is too small, by a unit in the last place or by a billionth.
    let n = 40;
    let edges = path(n, 1.0 / 3.0);
    let domain = graph(n, &edges, &[]);
    let nudged = |by: f64| operator(laplacian(n, &edges).map(|i, j, v| if i == j { v * (1.0 - by) } else { *v }));
    assert_eq!(judge("PSD", &domain, &nudged(4e-16)).status(), Status::Holds);
    assert_eq!(judge("PSD", &domain, &nudged(1e-9)).status(), Status::Fails);
}

#[test]
fn ker_agrees_with_the_exact_rank_for_all_weightings_of_the_tetrahedron() {
    let mut counts = [0; 2];
    for edges in weighted_tetrahedra() {
        let matrix = laplacian(4, &edges);
        // The kernel is the constants iff the minor without the last vertex is not zero (matrix-tree theorem).
        let minor = matrix.submatrix(&[0, 1, 2], &[0, 1, 2]);
        let regular = matches!(eliminate(&minor, &[]), Some(Elimination::Solution(_)));
        let verdict = judge("KER", &graph(4, &edges, &[]), &operator(matrix));
        let expected = if regular { Status::Holds } else { Status::Fails };
        assert_eq!(verdict.status(), expected, "{edges:?}: {verdict:?}");
        counts[usize::from(regular)] += 1;
    }
    assert!(counts[0] > 100 && counts[1] > 100, "{counts:?}");
}

#[test]
fn ker_counts_components_and_isolated_vertices() {
    let mut edges = vec![([0, 1], 1.0), ([1, 2], 2.0), ([3, 4], 1.0)];
    let verdict = judge("KER", &graph(6, &edges, &[]), &operator(laplacian(6, &edges)));
    assert!(matches!(statement(&verdict), Statement::ClosedClasses { kernel: 3 }), "{verdict:?}");
    // 1 and 2 in series are 2/3 > 1/4: semi-definite with a negative weight, so the inertia has to count.
    edges.push(([0, 2], -0.25));
    let verdict = judge("KER", &graph(6, &edges, &[]), &operator(laplacian(6, &edges)));
    assert!(matches!(statement(&verdict), Statement::InertiaCount { kernel: 3, .. }), "{verdict:?}");
}

#[test]
fn ker_fails_for_a_missing_row_a_row_sum_and_an_entry_between_components() {
    let edges = path(4, 1.0);
    let domain = graph(4, &edges, &[]);
    let verdict = judge("KER", &domain, &operator(laplacian(4, &edges[..2])));
    let Statement::KernelVector { x, .. } = statement(&verdict) else { panic!("{verdict:?}") };
    assert_eq!((x.as_slice(), verdict.level), (&[(3, 1.0)][..], Level::Exact));
    let lifted = laplacian(4, &edges).add(&Csr::diagonal(&[0.0, 1e-3, 0.0, 0.0]));
    let verdict = judge("KER", &domain, &operator(lifted));
    assert!(matches!(statement(&verdict), Statement::RowSum { i: 1, .. }), "{verdict:?}");
    let apart = graph(4, &edges[..2], &[]);
    let verdict = judge("KER", &apart, &operator(laplacian(4, &edges)));
    assert!(matches!(statement(&verdict), Statement::FarEntry { .. }), "{verdict:?}");
}

#[test]
fn ker_of_random_walks_agrees_with_singular_values() {
    let mut stream = Stream::new(11, "walk");
    let mut counts = [0; 2];
    for _ in 0..150 {
        let n = 3 + stream.below(7);
        let mut t = Vec::new();
        for i in 0..n {
            for j in 0..n {
                if i != j && stream.unit() < 0.2 {
                    let w = stream.between(0.5, 2.0);
                    t.extend([(i, j, -w), (i, i, w)]);
                }
            }
        }
        let matrix = Csr::from_triplets(n, n, &t);
        let values = singular_values(&matrix).unwrap().0;
        let kernel = values.iter().filter(|v| **v <= 1e-12).count();
        let verdict = judge("KER", &graph(n, &path(n, 1.0), &[]), &operator(matrix));
        let expected = if kernel == 1 { Status::Holds } else { Status::Fails };
        assert_eq!(verdict.status(), expected, "kernel {kernel}: {verdict:?}");
        counts[usize::from(kernel == 1)] += 1;
    }
    assert!(counts[0] > 20 && counts[1] > 20, "{counts:?}");
}

/// H by exact elimination: `None` if `L_II` is singular.
fn harmonic(matrix: &Csr, set: &[usize]) -> Option<Vec<f64>> {
    let free: Vec<usize> = (0..matrix.rows()).filter(|i| !set.contains(i)).collect();
    let right: Vec<Vec<f64>> = set.iter().map(|&b| free.iter().map(|&i| -matrix.at(i, b)).collect()).collect();
    match eliminate(&matrix.submatrix(&free, &free), &right)? {
        Elimination::Solution(h) => Some(h.iter().flatten().map(Scalar::approximate).collect()),
        Elimination::Kernel(_) => None,
    }
}

#[test]
fn the_maximum_principles_of_all_weighted_tetrahedra_follow_from_cramers_rule() {
    let mut seen = std::collections::BTreeMap::new();
    for edges in weighted_tetrahedra() {
        let (domain, matrix) = (graph(4, &edges, &[0, 1]), laplacian(4, &edges));
        let w = |i: usize, j: usize| -matrix.at(i, j);
        // L_II = [a b; b d] on vertices 2 and 3; the adjugate over the determinant is the inverse.
        let (a, b, d) = (matrix.at(2, 2), matrix.at(2, 3), matrix.at(3, 3));
        let determinant = a * d - b * b;
        let h = [0, 1].map(|s| [d * w(2, s) - b * w(3, s), a * w(3, s) - b * w(2, s)]);
        let inside = h.as_flattened().iter().all(|v| (0.0..=1.0).contains(&(v / determinant)));
        let expected = if determinant != 0.0 && inside { Status::Holds } else { Status::Fails };
        let global = judge("MAX-global", &domain, &operator(matrix.clone()));
        assert_eq!(global.status(), expected, "{edges:?}: {global:?}");
        let one_sign = |i: usize| {
            let row: Vec<f64> = (0..4).filter(|&j| j != i).map(|j| w(i, j)).collect();
            row.iter().any(|w| *w > 0.0) != row.iter().any(|w| *w < 0.0)
        };
        let local = judge("MAX-local", &domain, &operator(matrix.clone()));
        let expected = if one_sign(2) && one_sign(3) { Status::Holds } else { Status::Fails };
        assert_eq!(local.status(), expected, "{edges:?}: {local:?}");
        *seen.entry((local.status(), global.status())).or_insert(0) += 1;
    }
    // Neither principle implies the other: all four pairs occur.
    assert_eq!(seen.len(), 4, "{seen:?}");
}

#[test]
fn max_global_in_floating_point_agrees_with_rational_elimination() {
    let mut stream = Stream::new(3, "dirichlet");
    let mut counts = [0; 2];
    for case in 0..60 {
        let n = 16 + stream.below(6);
        let share = [0.0, 0.03, 0.1][case % 3];
        let mut edges = Vec::new();
        for i in 1..n {
            for j in 0..i {
                if j + 1 == i || stream.unit() < 0.15 {
                    let sign = if stream.unit() < share { -0.3 } else { 1.0 };
                    edges.push(([j, i], sign * stream.between(0.5, 2.0)));
                }
            }
        }
        let set = [0, n / 2, n - 1];
        let (domain, matrix) = (graph(n, &edges, &set), laplacian(n, &edges));
        let Some(h) = harmonic(&matrix, &set) else { continue };
        let verdict = judge("MAX-global", &domain, &operator(matrix));
        let (low, high) = h.iter().fold((0.0_f64, 0.0_f64), |(l, u), v| (l.min(*v), u.max(*v)));
        let expected = if low < 0.0 || high > 1.0 { Status::Fails } else { Status::Holds };
        assert_eq!(verdict.status(), expected, "case {case}: {low:e} {high} {verdict:?}");
        if let Statement::Overshoot { value, low: below, .. } = statement(&verdict) {
            assert!(h.iter().any(|v| (v - value).abs() < 1e-9) && *below == (*value < 0.0));
        }
        counts[usize::from(expected == Status::Holds)] += 1;
    }
    assert!(counts[0] > 8 && counts[1] > 20, "{counts:?}");
}

#[test]
fn a_long_path_keeps_its_maximum_principle_beyond_a_sign_pattern() {
    // 1 and 1 in series are ½; with −0.1 beside them 0.4 > 0, so that values stay monotone along the path.
    let n = 700;
    let mut edges = path(n, 1.0);
    edges.push(([300, 302], -0.1));
    let verdict = judge("MAX-global", &graph(n, &edges, &[0, n - 1]), &operator(laplacian(n, &edges)));
    assert_eq!((verdict.status(), verdict.level), (Status::Holds, Level::Bounded), "{verdict:?}");
    assert!(matches!(statement(&verdict), Statement::Solved { columns: 2, .. }));
}

#[test]
fn a_part_that_no_weight_joins_to_the_boundary_is_singular() {
    let domain = graph(5, &path(5, 1.0), &[0]);
    let edges = [([0, 1], 1.0), ([2, 3], 0.5), ([3, 4], 0.25)];
    let verdict = judge("MAX-global", &domain, &operator(laplacian(5, &edges)));
    let Statement::Singular { set, x } = statement(&verdict) else { panic!("{verdict:?}") };
    assert_eq!((set.as_slice(), x.as_slice()), (&[0][..], &[(2, 1.0), (3, 1.0), (4, 1.0)][..]));
    assert_eq!(verdict.level, Level::Exact);
    // 0.1 + 0.7 is rounded: the rows vanish up to that only.
    let edges = [([0, 1], 1.0), ([2, 3], 0.1), ([3, 4], 0.7)];
    let verdict = judge("MAX-global", &domain, &operator(laplacian(5, &edges)));
    assert!(matches!(statement(&verdict), Statement::Singular { .. }), "{verdict:?}");
}

#[test]
fn closed_domains_draw_sets_and_say_so() {
    let n = 40;
    let mut edges = path(n, 1.0);
    edges.push(([0, n - 1], 1.0));
    let verdict = judge("MAX-global", &graph(n, &edges, &[]), &operator(laplacian(n, &edges)));
    assert!(matches!(statement(&verdict), Statement::SignPattern { .. }), "{verdict:?}");
    assert!(verdict.notes.iter().any(|n| n.contains("4 sets were drawn")), "{verdict:?}");
    edges.extend((0..n).map(|i| ([i.min((i + 2) % n), i.max((i + 2) % n)], -0.2)));
    let verdict = judge("MAX-global", &graph(n, &edges, &[]), &operator(laplacian(n, &edges)));
    assert!(matches!(statement(&verdict), Statement::Overshoot { .. }), "{verdict:?}");
}

#[test]
fn isolated_vertices_do_not_spoil_the_maximum_principles() {
    let edges = path(3, 1.0);
    let (domain, operator) = (graph(4, &edges, &[0, 2]), operator(laplacian(4, &edges)));
    assert_eq!(judge("MAX-global", &domain, &operator).status(), Status::Holds);
    assert_eq!(judge("MAX-local", &domain, &operator).status(), Status::Holds);
}

/// A fan of four triangles around vertex 0 at (1, 0): the edge to (−2, 0) has two opposite angles of 155°.
#[test]
fn an_obtuse_pair_breaks_both_maximum_principles_of_cotan_and_not_its_energy() {
    let p = [[1.0, 0.0], [-2.0, 0.0], [0.0, -0.3], [2.0, 0.0], [0.0, 0.3]];
    let domain = Domain::from(Surface::planar(&p, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]).unwrap());
    let cotan = lapjury::laplacian::find("cotan").unwrap();
    let operator = cotan.build(&domain, &Default::default()).unwrap();
    // cot at (0, ±0.3) = (1, −0.3)·(−2, −0.3) / 0.9 = −1.91/0.9.
    assert!((operator.stiffness().at(0, 1) - 1.91 / 0.9).abs() < 1e-14);
    let local = judge("MAX-local", &domain, &operator);
    assert!(matches!(statement(&local), Statement::BothSigns { i: 0, negative: 1, .. }), "{local:?}");
    let global = judge("MAX-global", &domain, &operator);
    let overshoot = matches!(statement(&global), Statement::Overshoot { source: 1, at: 0, low: true, .. });
    assert!(overshoot && global.level == Level::Exact, "{global:?}");
    assert_eq!(judge("PSD", &domain, &operator).status(), Status::Holds);
    assert_eq!(judge("KER", &domain, &operator).status(), Status::Holds);
}

#[test]
fn on_a_mesh_squeezed_by_ten_million_no_kernel_vector_is_claimed() {
    // Linear functions along the grid have an energy of 1e-14 of the row scale: rounding could have made that of a kernel.
    let mut stream = Stream::new(9, "squeezed");
    let k = 5;
    for squeeze in [1e-7, 1.3e-7, 1.7e-7, 2.6e-7, 1e-5, 1e-3] {
        for _ in 0..8 {
            let mut place = |v: usize| {
                let (x, y) = (v % (k + 1), v / (k + 1));
                let noise = if x > 0 && x < k { stream.between(-0.45, 0.45) } else { 0.0 };
                [x as f64 + noise, y as f64 * squeeze]
            };
            let p: Vec<[f64; 2]> = (0..(k + 1) * (k + 1)).map(&mut place).collect();
            let corners = (0..k * k).map(|c| c / k * (k + 1) + c % k);
            let faces: Vec<[usize; 3]> =
                corners.flat_map(|a| [[a, a + 1, a + k + 2], [a, a + k + 2, a + k + 1]]).collect();
            let domain = Domain::from(Surface::planar(&p, &faces).unwrap());
            let operator = lapjury::laplacian::find("cotan").unwrap().build(&domain, &Default::default()).unwrap();
            for id in ["KER", "PSD"] {
                let verdict = judge(id, &domain, &operator);
                assert_ne!(verdict.status(), Status::Fails, "{id} at {squeeze:e}: {verdict:?}");
                assert!(squeeze < 1e-4 || verdict.status() == Status::Holds, "{id} at {squeeze:e}: {verdict:?}");
            }
        }
    }
}

#[test]
fn max_heat_agrees_with_rational_elimination_for_lumped_and_consistent_masses() {
    let mut seen = std::collections::BTreeSet::new();
    for diagonal in [-0.6, -0.2, 0.0, 0.5] {
        for coupling in [0.0, 0.02, 0.2] {
            let mut edges = path(4, 1.0);
            edges.extend([([0, 3], 1.0), ([0, 2], diagonal)]);
            let matrix = laplacian(4, &edges);
            let mass = matrix.map(|i, j, v| f64::from(u8::from(i == j)) - coupling * v);
            let kind = if coupling == 0.0 { MassKind::Unit } else { MassKind::Consistent };
            let with_mass = operator(matrix.clone()).with_mass(Mass::full(kind, mass.clone())).unwrap();
            let verdict = judge("MAX-heat", &graph(4, &edges, &[]), &with_mass);
            if (0..4).any(|i| mass.at(i, i) <= 0.0) {
                assert_eq!(verdict.status(), Status::NotApplicable);
                continue;
            }
            let negative = [1.0 / 16.0, 1.0, 16.0].iter().any(|t| {
                let step = mass.add(&matrix.map(|_, _, v| t * v));
                let columns: Vec<Vec<f64>> = (0..4).map(|j| (0..4).map(|i| mass.at(i, j)).collect()).collect();
                let Some(Elimination::Solution(x)) = eliminate(&step, &columns) else { panic!("regular") };
                x.iter().flatten().any(|v| v.cmp_zero().is_lt())
            });
            let expected = if negative { Status::Fails } else { Status::Holds };
            assert_eq!(verdict.status(), expected, "{diagonal} {coupling}: {verdict:?}");
            seen.insert((coupling == 0.0, expected));
        }
    }
    assert!(seen.len() >= 3, "{seen:?}");
}

#[test]
fn max_heat_needs_a_positive_mass_and_states_its_sample() {
    let n = 400;
    let edges = path(n, 1.0);
    let (domain, matrix) = (graph(n, &edges, &[]), laplacian(n, &edges));
    assert_eq!(judge("MAX-heat", &domain, &operator(matrix.clone())).status(), Status::NotApplicable);
    let with = |mass: Mass| operator(matrix.clone()).with_mass(mass).unwrap();
    let mut diagonal = vec![1.0; n];
    let lumped = judge("MAX-heat", &domain, &with(Mass::lumped(MassKind::Unit, &diagonal)));
    assert!(matches!(statement(&lumped), Statement::SignPattern { set: 0 }), "{lumped:?}");
    // Coupled by 1/64 < t: M + tL keeps its sign pattern, so the step is not negative.
    let full = matrix.map(|i, j, v| f64::from(u8::from(i == j)) - v / 64.0);
    let sampled = judge("MAX-heat", &domain, &with(Mass::full(MassKind::Consistent, full)));
    assert_eq!((sampled.status(), sampled.level), (Status::Holds, Level::Measured), "{sampled:?}");
    assert!(sampled.notes.iter().any(|n| n.contains("32 of 400")), "{:?}", sampled.notes);
    diagonal[7] = -1.0;
    let negative = judge("MAX-heat", &domain, &with(Mass::lumped(MassKind::Voronoi, &diagonal)));
    assert!(negative.reason().is_some_and(|why| why.contains("row 7")), "{negative:?}");
}

#[test]
fn a_matrix_with_a_nan_is_left_to_fin() {
    let domain = graph(3, &path(3, 1.0), &[0]);
    let operator = operator(laplacian(3, &path(3, f64::NAN)));
    for id in ["PSD", "KER", "MAX-local", "MAX-global", "MAX-heat"] {
        let verdict = judge(id, &domain, &operator);
        assert_eq!(verdict.reason(), Some("the matrix has a non-finite entry; see FIN"), "{id}");
    }
}

#[test]
fn degenerate_domains_are_answered_without_a_panic() {
    for domain in [graph(0, &[], &[]), graph(1, &[], &[]), graph(2, &path(2, 1.0), &[0, 1]), graph(3, &[], &[])] {
        let n = domain.vertex_count();
        for matrix in [Csr::from_triplets(n, n, &[]), Csr::diagonal(&vec![0.0; n]), Csr::diagonal(&vec![1.0; n])] {
            let mass = Mass::lumped(MassKind::Unit, &vec![1.0; n]);
            let operator = operator(matrix).with_mass(mass).unwrap();
            let again = operator.clone();
            let construction = move |_: &Domain| Ok(again.clone());
            for id in ["PSD", "KER", "MAX-local", "MAX-global", "MAX-heat", "PERM", "RIGID", "UNION"] {
                let trial = Trial::new(&domain, &operator, 1).unwrap();
                property::find(id).unwrap().decide(&trial, Some(&construction));
            }
        }
    }
}
