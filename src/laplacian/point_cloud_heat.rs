//! The heat Laplacian of a point cloud: Gaussian weights over all pairs within reach, times the area of each point, on points that sample
//! a surface or a curve. Of a mesh it reads the vertices only.
//!
//! # Definition
//! ```text
//! ω_ij = A_i A_j K(i, j)/t,   K(i, j) = (4πt)^(−d/2) exp(−|p_i − p_j|²/4t)   where |p_i − p_j| ≤ cutoff · √t,   else 0
//! L_ij = −ω_ij,   L_ii = Σ_j ω_ij,   M = diag(A_i);     (M⁻¹Lf)_i = 1/t Σ_j A_j K(i, j) (f_i − f_j)
//! ```
//! A_i is the share of point i in its star, a third of the areas of the triangles there: the Delaunay triangulation of the nearest points
//! in the tangent plane, lifted back (`local_star` in the sources). On a curve, d = 1, half the distances to the next point on either
//! side. With h the spacing, `h^d` the mean of the A_i, the bandwidth is `t = bandwidth · h²`, one number for all points.
//!
//! # Shapes and units
//! L: n×n, length^(d−2); dimensionless on surfaces. M: n×n, length^d. `bandwidth` and `cutoff` have no unit.
//!
//! # Convention
//! The crate's, that is −1 times that of the source. The source gives each row a triangulation of its own, in the tangent plane of p_i,
//! so that A_j depends on i and the matrix is not symmetric; here a point has one area, which makes `L = Lᵀ` as in \[liu2012\], who take
//! the cell of a Voronoi diagram for it.
//!
//! # Consistency
//! For a smooth f on a smooth closed surface or curve two errors add up. The kernel: the integral of `K (f(p) − f)/t` is `−Δf +
//! O(t)`. The sum: thirds of triangles integrate linear functions exactly as far as neighbouring stars agree on their triangles,
//! and `K (f_i − f)/t` has second derivatives of the size `t^(−3/2)` where K lives, so that the sum is off by `O(h² t^(−3/2))`, h
//! the longest side of a triangle. The larger of both is smallest for `t ∝ h^(4/5)`, which is `bandwidth ∝ h^(−6/5)`, and then it
//! is `O(h^(4/5))`. The source proves convergence for `t = h^(1/(2+ξ))`, any ξ > 0. A fixed bandwidth, as the default is, keeps
//! rows of the same length (some 28 entries on a surface) and is *not* consistent: on irregular points the error of the sum then
//! grows like 1/h.
//!
//! # Guarantees
//! * FIN, SYM, NULL, PSD: wherever it is built.
//! * POS0, MVP, MAX-local, MAX-heat: wherever it is built; every weight that there is is positive.
//!
//! # Does not hold
//! * LOC: that is what it is made for.
//! * POS, POS-boundary: a mesh edge that is longer than the reach has no weight.
//! * KER, MAX-global: a connected mesh whose edges are longer than the reach here and there falls into pieces.
//! * LIN: sums over irregular points do not cancel; `lapjury witness point-cloud-heat LIN` prints the smallest example.
//! * ENERGY, FLUX: at a boundary the kernel sees one side only.
//! * MASS: the areas are those of the points, not of the triangles of the mesh.
//! * REACH: the bandwidth comes from all areas.
//! * ISO: distances are those of space.
//! * UNION: a copy nearby is among the neighbours, whatever the faces say.
//!
//! # Boundary
//! Rows at the rim of a cloud are sums over the points that there are, with the triangles that there are. There the operator is not
//! consistent: `M⁻¹Lf` grows like `t^(−½)` times the normal derivative. How many stars are open is a note of the operator.
//!
//! # Degenerate input
//! Refused: fewer than d + 1 points (but for none at all), points that coincide, a point whose nearest neighbours have no tangent space (they
//! lie on a line, or are as far off the plane as within it), a point that reaches no other. Faces and edges are not read, whatever is wrong with
//! them.
//!
//! # Cost and accuracy
//! O(n log n) for the areas and O(n) rows of `π cutoff² bandwidth` entries (surfaces; `2 cutoff √bandwidth` on curves) where points are
//! spread evenly; at worst, all crowded in one place, n² entries. Leaving out what lies beyond the cutoff c takes the share `(1 + c²/4)
//! e^(−c²/4)` from the second moment of the kernel, and so from Δf: 1.3e-3 for the default 6, 3.4e-8 for 9, 8.6e-15 for 12; less on curves. A
//! weight has a relative error of some tens of u, and is symmetric to the last bit.
//!
//! # References
//! \[belkin-sun-wang2009\] section 3 (the algorithm) and its main theorem (t and h); \[liu2012\] for one area a point.
//!
//! # Example
//! Three points: each has a third of the triangle, 1/6, which is h². With `bandwidth=1.5`, t = ¼ and `ω₀₁ = (1/6)² e⁻¹/(π · ¼)`.
//! ```
//! use lapjury::domain::{Domain, PointCloud};
//! let cloud = PointCloud::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], None)?;
//! let heat = lapjury::laplacian::find("point-cloud-heat").ok_or("missing")?;
//! let operator = heat.build(&Domain::from(cloud), &[("bandwidth".into(), "1.5".into())].into())?;
//! let expected = |squared: f64| -(-squared).exp() / (9.0 * std::f64::consts::PI);
//! assert!((operator.stiffness().at(0, 1) - expected(1.0)).abs() < 1e-15);
//! assert!((operator.stiffness().at(1, 2) - expected(2.0)).abs() < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::f64::consts::PI;

use super::local_star::{Star, star};
use super::{BuildError, Laplacian, Promise, stiffness};
use crate::domain::nearest::Nearest;
use crate::domain::{Domain, DomainKind};
use crate::linalg::parallel;
use crate::operator::{Mass, MassKind, Operator, Provenance};
use crate::parameter::{Parameter, Range, Settings};

/// The kinds of domain accepted.
const ACCEPTS: &[DomainKind] = &[DomainKind::Surface, DomainKind::Points];

/// The catalogue entry.
pub static ENTRY: Laplacian = Laplacian {
    id: "point-cloud-heat",
    name: "heat Laplacian of a point cloud",
    definition: "ω_ij = A_i A_j exp(−|ij|²/4t)/(t (4πt)^(d/2)) with the areas A of stars in the tangent planes",
    sources: &["belkin-sun-wang2009", "liu2012"],
    accepts: ACCEPTS,
    parameters: &[
        Parameter {
            name: "dimension",
            meaning: "the dimension d of what is sampled: 2 for a surface, 1 for a curve",
            default: "2",
            range: Range::Choice(&["1", "2"]),
        },
        Parameter {
            name: "bandwidth",
            meaning: "the time t over the square of the spacing h, where h^d is the mean area of a point; consistent only if it grows \
                      as h tends to zero",
            default: "0.25",
            range: Range::Number(0.01, 1e6),
        },
        Parameter {
            name: "cutoff",
            meaning: "the distance beyond which weights are left out, over √t",
            default: "6",
            range: Range::Number(2.0, 12.0),
        },
    ],
    promises: &[
        Promise::holds("FIN"),
        Promise::holds("SYM"),
        Promise::holds("NULL"),
        Promise::holds("PSD"),
        Promise::holds("POS0"),
        Promise::holds("MVP"),
        Promise::holds("MAX-local"),
        Promise::holds("MAX-heat"),
        Promise::fails_somewhere("LOC"),
        Promise::fails_somewhere("POS"),
        Promise::fails_somewhere("POS-boundary"),
        Promise::fails_somewhere("KER"),
        Promise::fails_somewhere("MAX-global"),
        Promise::fails_somewhere("LIN"),
        Promise::fails_somewhere("ENERGY"),
        Promise::fails_somewhere("FLUX"),
        Promise::fails_somewhere("MASS"),
        Promise::fails_somewhere("REACH"),
        Promise::fails_somewhere("ISO"),
        Promise::fails_somewhere("UNION"),
    ],
    build,
};

fn build(domain: &Domain, settings: &Settings) -> Result<Operator, BuildError> {
    let laplacian = ENTRY.id;
    let points =
        domain.positions().ok_or(BuildError::WrongKind { laplacian, kind: domain.kind(), accepts: ACCEPTS })?;
    let dimension = if settings.get("dimension") == "1" { 1 } else { 2 };
    let sample = Sample::new(points, dimension)?;
    let heat = sample.heat(settings.number("bandwidth"), settings.number("cutoff"));
    let rows = parallel::collect(points.len(), |i| heat.weights(i)).into_iter().collect::<Result<Vec<_>, _>>()?;
    let matrix = stiffness::of_rows(laplacian, &rows)?;
    let vanishes = |i: &usize| matrix.at(*i, *i) <= 0.0 || !(sample.areas[*i] > 0.0 && sample.areas[*i].is_finite());
    if let Some(i) = (0..points.len()).find(vanishes) {
        return Err(BuildError::NotFinite { laplacian, i, j: i, value: format!("{:e}", matrix.at(i, i)) });
    }
    let mut notes = vec![format!("bandwidth t = {:e}, spacing {:e}", heat.t, sample.spacing)];
    if sample.open > 0 {
        notes.push(format!("{} points have an open star", sample.open));
    }
    let provenance = Provenance { id: laplacian.into(), parameters: settings.all().clone(), notes };
    let mass = Mass::lumped(MassKind::Barycentric, &sample.areas);
    Ok(Operator::new(matrix, provenance)?.with_mass(mass)?)
}

/// A cloud with the area of each point.
pub struct Sample<'a> {
    cloud: Nearest<'a>,
    dimension: usize,
    areas: Vec<f64>,
    spacing: f64,
    open: usize,
}

impl<'a> Sample<'a> {
    /// Measures the stars, in parallel.
    ///
    /// # Errors
    /// Too few points, coincident points, a point without a tangent space.
    pub fn new(points: &'a [[f64; 3]], dimension: usize) -> Result<Self, BuildError> {
        let (laplacian, needed) = (ENTRY.id, dimension + 1);
        if (1..needed).contains(&points.len()) {
            return Err(BuildError::TooFewPoints { laplacian, points: points.len(), needed, dimension });
        }
        let cloud = Nearest::new(points);
        let largest = points.iter().flatten().fold(0.0, |a: f64, x| a.max(x.abs()));
        let stars = parallel::collect(points.len(), |i| star(laplacian, &cloud, i, dimension, largest));
        let stars: Vec<Star> = stars.into_iter().collect::<Result<_, _>>()?;
        let open = stars.iter().filter(|s| !s.closed).count();
        let areas: Vec<f64> = stars.into_iter().map(|s| s.share).collect();
        Ok(Sample::with_areas(cloud, dimension, areas, open))
    }

    fn with_areas(cloud: Nearest<'a>, dimension: usize, areas: Vec<f64>, open: usize) -> Self {
        let mean = areas.iter().sum::<f64>() / areas.len().max(1) as f64;
        let spacing = if dimension == 1 { mean } else { mean.sqrt() };
        Sample { cloud, dimension, areas, spacing, open }
    }

    /// The areas of the points.
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// The spacing h: `h^d` is the mean area.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// How many points have an open star.
    pub fn open(&self) -> usize {
        self.open
    }

    /// The kernel with a bandwidth in units of h² and a cutoff in units of √t.
    pub fn heat(&self, bandwidth: f64, cutoff: f64) -> Heat<'_> {
        let t = bandwidth * self.spacing * self.spacing;
        // ω = b_i b_j exp, the same for both orders; b = A/√(t (4πt)^(d/2)).
        let root = t.sqrt() * (4.0 * PI * t).powf(0.25 * self.dimension as f64);
        Heat { sample: self, t, reach: cutoff * cutoff * t, root }
    }
}

/// The kernel on a cloud.
pub struct Heat<'a> {
    sample: &'a Sample<'a>,
    t: f64,
    /// The square of the distance within which there are weights.
    reach: f64,
    root: f64,
}

impl Heat<'_> {
    /// The bandwidth, a length squared.
    pub fn t(&self) -> f64 {
        self.t
    }

    fn decay(&self, squared: f64) -> f64 {
        (-squared / (4.0 * self.t)).exp()
    }

    /// The weights of a row, `(j, ω_ij)`, columns ascending.
    ///
    /// # Errors
    /// A point that reaches no other.
    fn weights(&self, i: usize) -> Result<Vec<(usize, f64)>, BuildError> {
        let Sample { cloud, areas, .. } = self.sample;
        let found = cloud.within(i, self.reach);
        if found.is_empty() {
            let distance = cloud.nearest_to(i, 1).first().map_or(f64::INFINITY, |f| f.squared.sqrt());
            return Err(BuildError::OutOfReach { laplacian: ENTRY.id, vertex: i, distance, reach: self.reach.sqrt() });
        }
        let scaled = |j: usize| areas[j] / self.root;
        let weight = |point: usize, squared: f64| (scaled(i) * scaled(point)) * self.decay(squared);
        Ok(found.into_iter().map(|f| (f.point, weight(f.point, f.squared))).collect())
    }

    /// The coefficients `(j, A_j K(i, j)/t)` of a row of `M⁻¹L`, columns ascending, without the matrix.
    pub fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let found = self.sample.cloud.within(i, self.reach);
        let scaled = |j: usize| self.sample.areas[j] / self.root / self.root;
        found.into_iter().map(move |f| (f.point, scaled(f.point) * self.decay(f.squared)))
    }

    /// `(M⁻¹Lf)_i`, summed by ascending j.
    pub fn apply(&self, f: &[f64], i: usize) -> f64 {
        self.row(i).map(|(j, c)| c * (f[i] - f[j])).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::PointCloud;

    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    fn sphere(n: usize) -> Vec<[f64; 3]> {
        let mut next = numbers(5);
        let point = |_| {
            let (z, (s, c)) = (2.0 * next() - 1.0, (2.0 * PI * next()).sin_cos());
            let r = (1.0 - z * z).sqrt();
            [r * c, r * s, z]
        };
        (0..n).map(point).collect()
    }

    fn circle(n: usize) -> Vec<[f64; 3]> {
        let mut next = numbers(3);
        let turn = |k: usize| (2.0 * PI * (k as f64 + 0.6 * next()) / n as f64).sin_cos();
        (0..n).map(turn).map(|(s, c)| [c, s, 0.0]).collect()
    }

    fn operator(points: &[[f64; 3]], settings: &[(&str, &str)]) -> Result<Operator, BuildError> {
        let settings = settings.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect();
        ENTRY.build(&Domain::from(PointCloud::new(points.to_vec(), None).unwrap()), &settings)
    }

    #[test]
    fn every_entry_is_that_of_the_sum_over_all_pairs() {
        for (points, dimension, power) in [(sphere(200), "2", 1.0), (circle(90), "1", 0.5)] {
            let built = operator(&points, &[("dimension", dimension), ("bandwidth", "0.7"), ("cutoff", "5")]).unwrap();
            let areas = built.mass().unwrap().diagonal();
            let mean = areas.iter().sum::<f64>() / areas.len() as f64;
            let t = 0.7 * mean.powf(1.0 / power);
            for i in 0..points.len() {
                let mut sum = 0.0;
                for j in (0..points.len()).filter(|&j| j != i) {
                    let squared: f64 = (0..3).map(|k| (points[i][k] - points[j][k]).powi(2)).sum();
                    let weight = match squared <= 25.0 * t {
                        true => areas[i] * areas[j] / t / (4.0 * PI * t).powf(power) * (-squared / (4.0 * t)).exp(),
                        false => 0.0,
                    };
                    sum += weight;
                    assert!((built.stiffness().at(i, j) + weight).abs() <= 1e-13 * weight, "{i} {j}");
                    assert_eq!(built.stiffness().at(i, j), built.stiffness().at(j, i));
                }
                assert!((built.stiffness().at(i, i) - sum).abs() <= 1e-13 * sum);
            }
        }
    }

    #[test]
    fn rows_without_the_matrix_are_those_of_the_matrix() {
        let points = sphere(120);
        let built = operator(&points, &[]).unwrap();
        let sample = Sample::new(&points, 2).unwrap();
        let heat = sample.heat(0.25, 6.0);
        let f: Vec<f64> = points.iter().map(|p| p[0] + p[1] * p[2]).collect();
        let product = built.stiffness().mul(&f);
        for (i, value) in product.iter().enumerate() {
            let expected = value / sample.areas()[i];
            let scale: f64 = heat.row(i).map(|(_, c)| c).sum();
            assert!((heat.apply(&f, i) - expected).abs() < 1e-13 * scale);
        }
    }

    /// By Poisson's summation formula `Σ_j h (4πt)^(−½) exp(−(jh)²/4t) = Σ_k q^(k²)` over all integers, `q = exp(−4π²t/h²)`; and with
    /// `(jh)²/t` inside, `Σ_k (2 − 16π²k²t/h²) q^(k²)`. On the grid `−M⁻¹L x²` at zero is the product.
    #[test]
    fn on_a_grid_the_sum_is_that_of_poisson() {
        let side = 8_i32;
        let points: Vec<[f64; 3]> = (-side..=side)
            .flat_map(|i| (-side..=side).map(move |j| [0.5 * f64::from(i), 0.5 * f64::from(j), 0.25]))
            .collect();
        let sample = Sample::new(&points, 2).unwrap();
        let middle = points.len() / 2;
        assert!((sample.areas()[middle] - 0.25).abs() < 1e-15);
        let f: Vec<f64> = points.iter().map(|p| p[0] * p[0]).collect();
        for bandwidth in [0.1, 0.2, 0.3] {
            let heat = sample.heat(bandwidth, 12.0);
            let ratio = heat.t() / 0.25;
            let sum = |factor: &dyn Fn(f64) -> f64| {
                let term = |k: f64| factor(4.0 * PI * PI * k * k * ratio) * (-4.0 * PI * PI * k * k * ratio).exp();
                term(0.0) + 2.0 * (1..9).map(|k| term(f64::from(k))).sum::<f64>()
            };
            let expected = sum(&|_| 1.0) * sum(&|x| 2.0 - 4.0 * x);
            let found = -heat.apply(&f, middle);
            assert!((found - expected).abs() < 1e-12, "{bandwidth}: {found} {expected}");
        }
    }

    /// The largest error for x on a circle, `−Δx = x`, of coefficients made wrong.
    fn error(sample: &Sample, points: &[[f64; 3]], factor: f64) -> f64 {
        let x: Vec<f64> = points.iter().map(|p| p[0]).collect();
        let heat = sample.heat(0.05 / sample.spacing() / sample.spacing(), 12.0);
        (0..points.len()).map(|i| (factor * heat.apply(&x, i) - x[i]).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn a_missing_time_a_wrong_dimension_and_a_doubled_area_are_seen() {
        let points = circle(64);
        let sample = Sample::new(&points, 1).unwrap();
        let right = error(&sample, &points, 1.0);
        assert!(right < 0.1, "{right}");
        assert!(error(&sample, &points, 0.05) > 0.9);
        assert!(error(&sample, &points, 1.0 / (4.0 * PI * 0.05_f64).sqrt()) > 0.2);
        let mut areas = sample.areas().to_vec();
        areas[7] *= 2.0;
        assert!(areas.iter().sum::<f64>() - 2.0 * PI > 0.05, "the circle is longer than it is");
        let doubled = Sample::with_areas(Nearest::new(&points), 1, areas, 0);
        assert!(error(&doubled, &points, 1.0) > 3.0 * right);
    }

    #[test]
    fn the_same_bits_come_out_on_any_number_of_threads() {
        let points = circle(6000);
        let bits = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let built = pool.install(|| operator(&points, &[("dimension", "1")]).unwrap());
            built.stiffness().entries().map(|(i, j, v)| (i, j, v.to_bits())).collect::<Vec<_>>()
        };
        let one = bits(1);
        assert!(bits(2) == one && bits(5) == one);
    }

    fn refusal(points: &[[f64; 3]], settings: &[(&str, &str)]) -> String {
        operator(points, settings).unwrap_err().to_string()
    }

    #[test]
    fn what_has_no_areas_or_no_weights_is_refused_by_name() {
        let [a, b, c] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(
            refusal(&[a, b], &[]),
            "'point-cloud-heat' needs at least 3 points for a tangent space of dimension 2, and there are 2; add points"
        );
        assert_eq!(
            refusal(&[a, b, c, b], &[]),
            "points 1 and 3 coincide, or nearly so, and 'point-cloud-heat' gives each point an area of its own; merge points \
             that coincide"
        );
        let sample = "so that 'point-cloud-heat' finds no tangent space there; sample what is curved more densely, and set \
                      the dimension to that of what is sampled";
        let line: Vec<[f64; 3]> = (0..9).map(|k| [f64::from(k), 0.0, 0.0]).collect();
        assert_eq!(refusal(&line, &[]), format!("the 8 points nearest to point 0 lie on a line, {sample}"));
        let cube: Vec<[f64; 3]> = (0..8).map(|k| [0, 1, 2].map(|b| f64::from(k >> b & 1))).collect();
        let crooked = format!("the 7 points nearest to point 0 do not lie near a plane, {sample}");
        assert_eq!(refusal(&cube, &[]), crooked);
        let curve = format!("the 5 points nearest to point 0 do not lie near a line, {sample}");
        let grid: Vec<[f64; 3]> = (0..9).map(|k| [f64::from(k / 3), f64::from(k % 3), 0.0]).collect();
        assert_eq!(refusal(&grid, &[("dimension", "1")]), curve);
        let refused = refusal(&[a, b, c], &[("bandwidth", "0.01")]);
        assert!(
            refused.starts_with("point 0 is 1e0 away from the next, and 'point-cloud-heat' reaches 2.449"),
            "{refused}"
        );
        assert!(operator(&[], &[]).is_ok_and(|o| o.size() == 0));
    }
}
