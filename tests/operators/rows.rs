//! Matrices written row by row against the same sums made from triplets, face by face: the same bits, on any number of threads.

use lapjury::domain::{Domain, Surface};
use lapjury::laplacian::shape::Triangles;
use lapjury::linalg::Csr;
use rayon::ThreadPoolBuilder;

use crate::{build, meshes};

/// Every entry with its bits.
fn bits(matrix: &Csr) -> Vec<(usize, usize, u64)> {
    matrix.entries().map(|(i, j, v)| (i, j, v.to_bits())).collect()
}

/// `½ cot` put down for each side of each triangle, face after face, negated where an entry is stored; a third of each area; and for
/// each edge what its cotangents are in magnitude together.
fn from_triplets(surface: &Surface) -> (Csr, Csr, Vec<f64>) {
    let n = surface.positions().len();
    let triangles = Triangles::new("cotan", surface, true).unwrap();
    let edges = surface.topology().edges();
    // An edge whose triangles are all left out keeps its place with weight zero.
    let (mut sums, mut sizes) = (vec![0.0; edges.len()], vec![0.0; edges.len()]);
    let mut areas = vec![0.0; n];
    for (_, corners, shape) in triangles.each() {
        for k in 0..3 {
            let (a, b) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
            let edge = edges.binary_search(&[a.min(b), a.max(b)]).unwrap();
            sums[edge] += 0.5 * shape.cotangents[k];
            sizes[edge] += shape.cotangents[k].abs();
            areas[corners[k]] += shape.doubled_area / 6.0;
        }
    }
    let pairs = edges.iter().zip(&sums).flat_map(|(&[i, j], &w)| [(i, j, 0.0 - w), (j, i, 0.0 - w)]);
    let off_diagonal = Csr::from_triplets(n, n, &pairs.collect::<Vec<_>>());
    let diagonal: Vec<f64> = (0..n).map(|i| off_diagonal.row(i).fold(0.0, |sum, (_, v)| sum - v)).collect();
    (off_diagonal.add(&Csr::diagonal(&diagonal)), Csr::diagonal(&areas), sizes)
}

/// Large enough for several threads, with edges of three faces, a fold, isolated vertices and triangles without area.
fn bad() -> Surface {
    let (points, mut faces) = meshes::jittered(5, 110);
    let n = points.len();
    let mut p: Vec<[f64; 3]> = points.iter().map(|&[x, y]| [x, y, (0.3 * x).sin()]).collect();
    // A fin on every tenth edge of the first row, and a vertex of its own for each.
    for k in (0..100).step_by(10) {
        p.push([k as f64 + 0.4, 0.1, 2.0]);
        faces.push([k, k + 1, p.len() - 1]);
    }
    p.push([7.0; 3]);
    // The mean of two neighbours and the two: collinear, twice.
    for k in [3, 9000] {
        let mean = std::array::from_fn(|c| 0.5 * (p[k][c] + p[k + 1][c]));
        // Means of these are exact only where the sum is: otherwise the triangle is proper, and as good a test.
        p.push(mean);
        faces.push([k, k + 1, p.len() - 1]);
    }
    p.extend([[0.0, 0.0, 9.0], [1.0, 0.0, 9.0], [3.0, 0.0, 9.0]]);
    faces.push([p.len() - 3, p.len() - 2, p.len() - 1]);
    assert!(p.len() > n);
    Surface::triangles(p, &faces).unwrap()
}

#[test]
fn cotan_and_its_mass_have_the_bits_of_triplets_on_one_thread_and_on_more() {
    let mut all = meshes::all();
    all.push(("bad", bad()));
    all.push(("a large sphere", meshes::bumpy_sphere(3, 6)));
    for (name, surface) in all {
        let (stiffness, mass, sizes) = from_triplets(&surface);
        let edges = surface.topology().edges().to_vec();
        let domain = Domain::from(surface);
        for threads in [1, 2, 3] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let operator = pool.install(|| build("cotan", "degenerate=skip", &domain));
            assert_eq!(bits(operator.mass().unwrap().matrix()), bits(&mass), "{name}, {threads} threads");
            let found = bits(operator.stiffness());
            for ((i, j, found), (k, l, expected)) in found.iter().zip(bits(&stiffness)) {
                assert_eq!((*i, *j), (k, l), "{name}");
                if i == j || *found == expected {
                    continue;
                }
                // Where cotangents cancel, a sum of higher precision is put in the place of the rounded one.
                let size = sizes[edges.binary_search(&[*i.min(j), *i.max(j)]).unwrap()];
                let (found, expected) = (f64::from_bits(*found), f64::from_bits(expected));
                assert!(found.abs() <= 0.25 * size, "{name}, {threads} threads: entry ({i}, {j}) does not cancel");
                assert!((found - expected).abs() <= 2.0 * f64::EPSILON * size, "{name}: {found} against {expected}");
            }
            assert_eq!(found.len(), stiffness.stored());
        }
    }
}

#[test]
fn every_operator_on_triangles_is_the_same_on_one_thread_and_on_two() {
    let domain = Domain::from(bad());
    let flipped = Domain::from(meshes::landscape(8, 100));
    let cases = [
        ("cotan", "degenerate=skip mass=mixed", &domain),
        ("cotan", "degenerate=skip mass=consistent", &domain),
        ("mean-value", "degenerate=skip mass=voronoi", &domain),
        ("intrinsic-delaunay", "", &flipped),
    ];
    for (id, parameters, domain) in cases {
        let on = |threads: usize| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let operator = pool.install(|| build(id, parameters, domain));
            (bits(operator.stiffness()), bits(operator.mass().unwrap().matrix()), operator.provenance().clone())
        };
        assert_eq!(on(1), on(2), "{id} {parameters}");
    }
}

#[test]
fn the_matrix_equals_its_transpose_bit_for_bit() {
    for (id, domain) in [("cotan", Domain::from(bad())), ("intrinsic-delaunay", meshes::landscape(8, 100).into())] {
        let operator = build(id, "degenerate=skip", &domain);
        assert_eq!(bits(operator.stiffness()), bits(&operator.stiffness().transpose()), "{id}");
    }
}
