//! A look at statements about spectra, by eigenvalues in floating point of matrices put together here.

use lapjury::linalg::Csr;
use lapjury::linalg::factor::symmetric_eigen;
use lapjury::property::evidence::{Condition, Mesh, Weighting};
use lapjury::property::{Evidence, Statement};

/// Changes a number of the statement.
pub fn spoil(evidence: &mut Evidence) {
    match &mut evidence.statement {
        Statement::Cospectral { first, second, .. } => first.clone_from(second),
        Statement::Transplantation { matrix, .. } => drop(matrix.pop()),
        Statement::SpectraDiffer { below, .. } | Statement::DelaunayEigenvalue { below, .. } => below.swap(0, 1),
        _ => {}
    }
}

/// Whether the statement is true; its kind.
pub fn look(evidence: &Evidence) -> Result<&'static str, String> {
    match &evidence.statement {
        Statement::Cospectral { vertices, first, second, normalised, polynomial } => {
            let of = |edges: &[[usize; 2]]| graph_eigenvalues(*vertices, edges, *normalised);
            let (a, b) = (of(first), of(second));
            is(a.iter().zip(&b).all(|(x, y)| (x - y).abs() < 1e-10), "different eigenvalues")?;
            for x in [-1.5, 0.5, 2.5] {
                let by_roots: f64 = a.iter().map(|root| x - root).product();
                let by_powers = polynomial.iter().rev().fold(0.0, |sum, c| sum * x + c.approximate());
                is((by_roots - by_powers).abs() < 1e-9 * by_roots.abs(), "another polynomial")?;
            }
            // The pairs that are found differ in an invariant: degrees, or the number of triangles at vertices of each degree.
            is(invariant(*vertices, first) != invariant(*vertices, second), "no invariant tells them apart")?;
            Ok("cospectral")
        }
        Statement::SpectraDiffer { first, second, condition, mass, sigma, below, .. } => {
            let counts = [first, second].map(|m| count(m, *condition, *mass, sigma.approximate()));
            is(counts == below.map(Some) && counts[0] != counts[1], "other numbers of eigenvalues")?;
            Ok("spectra-differ")
        }
        Statement::DelaunayEigenvalue { other, condition, mass, sigma, below, .. } => {
            let excerpt = &evidence.excerpt;
            let points = excerpt.positions.iter().map(|(_, p)| [p[0] as i64, p[1] as i64]).collect();
            let faces = excerpt.faces.iter().filter_map(|f| f.1.clone().try_into().ok()).collect();
            let delaunay = Mesh { points, faces };
            is(!delaunay.faces.is_empty(), "no faces")?;
            let other = Mesh { points: delaunay.points.clone(), faces: other.clone() };
            let counts = [&delaunay, &other].map(|m| count(m, *condition, *mass, sigma.approximate()));
            is(counts == below.map(Some) && counts[0] < counts[1], "other numbers of eigenvalues")?;
            Ok("delaunay-eigenvalue")
        }
        other => Err(format!("no way to look at {other:?}")),
    }
}

fn is(truth: bool, what: &str) -> Result<(), String> {
    if truth { Ok(()) } else { Err(what.to_string()) }
}

fn adjacent(edges: &[[usize; 2]], i: usize, j: usize) -> bool {
    edges.contains(&[i, j]) || edges.contains(&[j, i])
}

fn graph_eigenvalues(n: usize, edges: &[[usize; 2]], normalised: bool) -> Vec<f64> {
    let degree = |i: usize| edges.iter().filter(|e| e.contains(&i)).count() as f64;
    let scale = |i: usize| if normalised { degree(i).sqrt() } else { 1.0 };
    let entry = |i: usize, j: usize| match (i == j, adjacent(edges, i, j)) {
        (true, _) => degree(i) / (scale(i) * scale(i)),
        (false, true) => -1.0 / (scale(i) * scale(j)),
        (false, false) => 0.0,
    };
    let triplets: Vec<_> = (0..n * n).map(|k| (k / n, k % n, entry(k / n, k % n))).collect();
    symmetric_eigen(&Csr::from_triplets(n, n, &triplets)).unwrap().0
}

/// For each vertex its degree, the triangles there and the degrees of its neighbours; sorted.
fn invariant(n: usize, edges: &[[usize; 2]]) -> Vec<(usize, usize, Vec<usize>)> {
    let neighbours = |i: usize| (0..n).filter(|&j| adjacent(edges, i, j)).collect::<Vec<_>>();
    let of = |i: usize| {
        let at = neighbours(i);
        let triangles = at.iter().map(|&j| at.iter().filter(|&&k| adjacent(edges, j, k)).count()).sum::<usize>() / 2;
        let mut degrees: Vec<usize> = at.iter().map(|&j| neighbours(j).len()).collect();
        degrees.sort_unstable();
        (at.len(), triangles, degrees)
    };
    let mut all: Vec<_> = (0..n).map(of).collect();
    all.sort();
    all
}

/// How many eigenvalues of `L u = λ M u` are below σ: the negative ones of `L − σM`, with L from gradients of hat functions; `None`
/// where that is not a matrix of numbers, or σ an eigenvalue.
fn count(mesh: &Mesh, condition: Condition, mass: Weighting, sigma: f64) -> Option<usize> {
    let n = mesh.points.len();
    let at = |v: usize| mesh.points[v].map(|x| x as f64);
    let mut sum = vec![vec![0.0; n]; n];
    if mass == Weighting::Unit {
        (0..n).for_each(|v| sum[v][v] -= sigma);
    }
    for f in &mesh.faces {
        let edge = |k: usize| {
            let (p, q) = (at(f[(k + 1) % 3]), at(f[(k + 2) % 3]));
            [q[0] - p[0], q[1] - p[1]]
        };
        let (u, v) = (edge(1), edge(2));
        let area = 0.5 * (u[0] * v[1] - u[1] * v[0]);
        for a in 0..3 {
            for b in 0..3 {
                let (p, q) = (edge(a), edge(b));
                let share = match (mass, a == b) {
                    (Weighting::Barycentric, true) => area / 3.0,
                    (Weighting::Consistent, true) => area / 6.0,
                    (Weighting::Consistent, false) => area / 12.0,
                    _ => 0.0,
                };
                sum[f[a]][f[b]] += (p[0] * q[0] + p[1] * q[1]) / (4.0 * area) - sigma * share;
            }
        }
    }
    let on_boundary = |v: usize| {
        let sides: Vec<[usize; 2]> =
            mesh.faces.iter().flat_map(|f| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]]).collect();
        sides.iter().any(|s| s.contains(&v) && !sides.contains(&[s[1], s[0]]))
    };
    let kept: Vec<usize> = (0..n).filter(|&v| condition == Condition::Neumann || !on_boundary(v)).collect();
    let m = kept.len();
    let triplets: Vec<_> = (0..m * m).map(|k| (k / m, k % m, sum[kept[k / m]][kept[k % m]])).collect();
    let values = symmetric_eigen(&Csr::from_triplets(m, m, &triplets)).ok()?.0;
    // A number that is an eigenvalue separates none.
    values.iter().all(|v| v.abs() > 1e-9).then(|| values.iter().filter(|v| **v < 0.0).count())
}
