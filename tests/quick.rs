//! Identities that hold for whatever is drawn.

use lapjury::domain::Surface;
use lapjury::exchange::{parse_matrix, write_matrix_market};
use lapjury::generate::Stream;
use lapjury::linalg::Csr;
use quickcheck::{Arbitrary, Gen, QuickCheck};

/// A matrix of small whole numbers: sums and products of them are exact.
#[derive(Clone, Debug)]
struct Whole(Csr);

/// The side of the square matrices drawn.
const SIDE: usize = 6;

impl Arbitrary for Whole {
    fn arbitrary(g: &mut Gen) -> Self {
        let entry = |_| (usize::arbitrary(g) % SIDE, usize::arbitrary(g) % SIDE, f64::from(i8::arbitrary(g)));
        Whole(Csr::from_triplets(SIDE, SIDE, &(0..20).map(entry).collect::<Vec<_>>()))
    }
}

/// A vector of small whole numbers.
#[derive(Clone, Debug)]
struct Vector(Vec<f64>);

impl Arbitrary for Vector {
    fn arbitrary(g: &mut Gen) -> Self {
        Vector((0..SIDE).map(|_| f64::from(i8::arbitrary(g))).collect())
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn a_transpose_moves_to_the_other_side_of_a_dot_product() {
    fn property(a: Whole, x: Vector, y: Vector) -> bool {
        let t = a.0.transpose();
        t.transpose() == a.0 && dot(&x.0, &a.0.mul(&y.0)) == dot(&t.mul(&x.0), &y.0)
    }
    QuickCheck::new().quickcheck(property as fn(Whole, Vector, Vector) -> bool);
}

#[test]
fn sums_and_submatrices_are_those_of_the_entries() {
    fn property(a: Whole, b: Whole, x: Vector, order: u64) -> bool {
        let (a, b) = (a.0, b.0);
        let image: Vec<f64> = a.mul(&x.0).iter().zip(b.mul(&x.0)).map(|(p, q)| p + q).collect();
        let mut rows: Vec<usize> = (0..SIDE).collect();
        Stream::new(order, "rows").shuffle(&mut rows);
        let part = a.submatrix(&rows, &rows);
        let same = |i: usize, j: usize| part.at(i, j) == a.at(rows[i], rows[j]);
        a.add(&b).mul(&x.0) == image
            && (0..SIDE * SIDE).all(|k| same(k / SIDE, k % SIDE))
            && a.symmetric_part().quadratic_form(&x.0) == a.quadratic_form(&x.0)
    }
    QuickCheck::new().quickcheck(property as fn(Whole, Whole, Vector, u64) -> bool);
}

#[test]
fn matrix_market_gives_back_every_bit() {
    fn property(entries: Vec<(u8, u8, f64)>) -> bool {
        let triplets: Vec<_> = entries.iter().map(|&(i, j, v)| (i as usize, j as usize, v)).collect();
        let matrix = Csr::from_triplets(256, 256, &triplets);
        let back = parse_matrix("drawn.mtx", write_matrix_market(&matrix).as_bytes()).unwrap().matrix;
        // Of a NaN only the sign is kept.
        let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
        back.stored() == matrix.stored()
            && back.entries().zip(matrix.entries()).all(|(a, b)| (a.0, a.1) == (b.0, b.1) && same(*a.2, *b.2))
    }
    QuickCheck::new().quickcheck(property as fn(Vec<(u8, u8, f64)>) -> bool);
}

#[test]
fn a_number_below_n_is_below_n_and_every_one_occurs() {
    fn property(seed: u64, n: u8) -> bool {
        let (mut stream, n) = (Stream::new(seed, "below"), usize::from(n));
        let drawn: Vec<usize> = (0..40 * n).map(|_| stream.below(n)).collect();
        // A number is missed by all 40 n draws with probability (1 − 1/n)^(40 n) < e⁻⁴⁰.
        stream.below(0) == 0 && drawn.iter().all(|k| *k < n) && (0..n).all(|k| drawn.contains(&k))
    }
    QuickCheck::new().tests(30).quickcheck(property as fn(u64, u8) -> bool);
}

#[test]
fn a_triangle_has_the_area_of_the_three_that_its_centroid_makes() {
    fn property(p: [i8; 6]) -> bool {
        // Threefold, so that the centroid has whole coordinates and every area is exact.
        let corner = |k: usize| [3.0 * f64::from(p[2 * k]), 3.0 * f64::from(p[2 * k + 1])];
        let centroid = [0, 1].map(|axis| (0..3).map(|k| f64::from(p[2 * k + axis])).sum());
        let points = [corner(0), corner(1), corner(2), centroid];
        let area = |faces: &[[usize; 3]]| Surface::planar(&points, faces).unwrap().area();
        area(&[[0, 1, 2]]) == area(&[[0, 1, 3], [1, 2, 3], [2, 0, 3]])
    }
    fn drawn(a: (i8, i8), b: (i8, i8), c: (i8, i8)) -> bool {
        property([a.0, a.1, b.0, b.1, c.0, c.1])
    }
    QuickCheck::new().quickcheck(drawn as fn((i8, i8), (i8, i8), (i8, i8)) -> bool);
}
