//! A look at statements about triangulations and drawings, in floating point and small whole numbers, by other formulas than
//! those of the experiments and of the recheck.

use lapjury::domain::Domain;
use lapjury::linalg::factor::symmetric_eigen;
use lapjury::property::evidence::{Fault, Hypothesis};
use lapjury::property::{Evidence, Statement};

type Point = [f64; 2];

/// Changes a number of the statement.
pub fn spoil(evidence: &mut Evidence) {
    match &mut evidence.statement {
        Statement::FlipsToDelaunay { flips, .. } => flips[0].quad.rotate_left(1),
        Statement::DelaunayNotMinimal { energies, .. } => energies.swap(0, 1),
        Statement::PositiveExtension { smallest, .. } => *smallest = "1/1000".into(),
        Statement::NotEmbedded { drawing, .. } => drawing.swap(0, 1),
        Statement::TorusFlips { flips, .. } => *flips += 1,
        _ => {}
    }
}

/// Whether the statement is true; its kind.
pub fn look(evidence: &Evidence) -> Result<&'static str, String> {
    match &evidence.statement {
        Statement::FlipsToDelaunay { flips, end, values, energies } => {
            let quads: Vec<_> = flips.iter().map(|f| (f.quad, quotient(&f.kappa))).collect();
            flips_to_delaunay(evidence, &quads, end, values, energies).map(|()| "flips")
        }
        Statement::DelaunayNotMinimal { delaunay, other, values, energies } => {
            not_minimal(evidence, [delaunay, other], values, energies).map(|()| "not-minimal")
        }
        Statement::PositiveExtension { i, j, weight, smallest } => {
            extension(evidence, *i, *j, quotient(weight), quotient(smallest)).map(|()| "extension")
        }
        Statement::NotEmbedded { boundary, weights, drawing, missing, fault, .. } => {
            let at: Vec<Point> = drawing.iter().map(|[x, y]| [quotient(x), quotient(y)]).collect();
            not_embedded(evidence, boundary, weights, &at, *missing, fault).map(|()| "not-embedded")
        }
        Statement::TorusFlips { start, flips, end } => torus(start, *flips, end).map(|()| "torus"),
        other => Err(format!("no way to look at {other:?}")),
    }
}

fn is(truth: bool, what: &str) -> Result<(), String> {
    if truth { Ok(()) } else { Err(what.to_string()) }
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * (a.abs() + b.abs() + 1e-9)
}

fn quotient(text: &str) -> f64 {
    let mut parts = text.split('/').map(|part| part.parse::<f64>().unwrap());
    parts.next().unwrap() / parts.next().unwrap_or(1.0)
}

fn area(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The energy by gradients: |∇u|² of each triangle times its area.
fn energy(at: &[Point], faces: &[[usize; 3]], u: &[f64]) -> f64 {
    let of = |&[a, b, c]: &[usize; 3]| {
        let doubled = area(at[a], at[b], at[c]);
        let (p, q) = (u[b] - u[a], u[c] - u[a]);
        let x = (p * (at[c][1] - at[a][1]) - q * (at[b][1] - at[a][1])) / doubled;
        let y = (q * (at[b][0] - at[a][0]) - p * (at[c][0] - at[a][0])) / doubled;
        0.25 * doubled * (x * x + y * y)
    };
    faces.iter().map(of).sum()
}

/// The circumcentre is at the same distance from the corners; nothing is nearer.
fn is_delaunay(at: &[Point], faces: &[[usize; 3]]) -> bool {
    faces.iter().all(|&[a, b, c]| {
        let square = |p: Point| p[0] * p[0] + p[1] * p[1];
        let (p, q, r) = (at[a], at[b], at[c]);
        let d = 2.0 * area(p, q, r);
        let x = (square(p) * (q[1] - r[1]) + square(q) * (r[1] - p[1]) + square(r) * (p[1] - q[1])) / d;
        let y = (square(p) * (r[0] - q[0]) + square(q) * (p[0] - r[0]) + square(r) * (q[0] - p[0])) / d;
        let distance = |p: Point| (p[0] - x).hypot(p[1] - y);
        at.iter().all(|&s| distance(s) >= distance(p) * (1.0 - 1e-9))
    })
}

fn flips_to_delaunay(
    evidence: &Evidence,
    flips: &[([usize; 4], f64)],
    end: &[[usize; 3]],
    u: &[f64],
    energies: &[f64],
) -> Result<(), String> {
    let at: Vec<Point> = evidence.excerpt.positions.iter().map(|p| [p.1[0], p.1[1]]).collect();
    let mut faces: Vec<[usize; 3]> = evidence.excerpt.faces.iter().map(|f| f.1.clone().try_into().unwrap()).collect();
    is(!faces.is_empty() && at.len() == u.len() && energies.len() == flips.len() + 1, "something is missing")?;
    is(close(energy(&at, &faces, u), energies[0]), "another energy at the start")?;
    for (k, ([a, b, c, d], kappa)) in flips.iter().copied().enumerate() {
        let before = faces.len();
        let has = |f: &[usize; 3], t: [usize; 3]| t.iter().all(|v| f.contains(v));
        faces.retain(|f| !has(f, [a, b, c]) && !has(f, [a, c, d]));
        is(faces.len() + 2 == before, "no such quadrilateral")?;
        faces.extend([[a, b, d], [b, c, d]]);
        let areas = [[b, c, d], [a, c, d], [a, b, d], [a, b, c]].map(|t| area(at[t[0]], at[t[1]], at[t[2]]));
        is(kappa > 0.0 && areas.iter().all(|a| *a > 0.0), "κ or an area is not positive")?;
        let now = energy(&at, &faces, u);
        is(close(now, energies[k + 1]) && now <= energies[k] * (1.0 + 1e-9), "another energy")?;
        let along = areas[0] * u[a] - areas[1] * u[b] + areas[2] * u[c] - areas[3] * u[d];
        let fall = 0.5 * kappa * along * along;
        is((energies[k] - now - fall).abs() < 1e-9 * energies[0], "the energy falls by another amount")?;
    }
    let sorted = |faces: &[[usize; 3]]| {
        let mut all: Vec<[usize; 3]> = faces
            .iter()
            .map(|f| {
                let mut f = *f;
                f.sort_unstable();
                f
            })
            .collect();
        all.sort_unstable();
        all
    };
    is(sorted(&faces) == sorted(end) && is_delaunay(&at, end), "another end, or not Delaunay")
}

fn not_minimal(
    evidence: &Evidence,
    tetrahedra: [&[[usize; 4]]; 2],
    u: &[f64],
    energies: &[String; 2],
) -> Result<(), String> {
    let at: Vec<[f64; 3]> = evidence.excerpt.positions.iter().map(|p| p.1).collect();
    is(at.len() == 5, "not five points")?;
    let matrix = |t: &[usize; 4], column: Option<&[f64]>| {
        // The rows are edge vectors from the first corner; a column may be replaced by other differences.
        let row = |k: usize, axis: usize| at[t[k]][axis] - at[t[0]][axis];
        let mut m = [[0.0; 3]; 3];
        for (r, row_of) in m.iter_mut().enumerate() {
            for (axis, entry) in row_of.iter_mut().enumerate() {
                *entry = row(r + 1, axis);
            }
        }
        (m, column.map(|c| [c[t[1]] - c[t[0]], c[t[2]] - c[t[0]], c[t[3]] - c[t[0]]]))
    };
    // The gradient solves m ∇u = differences (Cramer's rule), the volume is |det m| / 6.
    let on = |all: &[[usize; 4]]| -> f64 {
        let of = |t: &[usize; 4]| {
            let (m, right) = matrix(t, Some(u));
            let (d, right) = (det(m), right.unwrap());
            let gradient: [f64; 3] = std::array::from_fn(|axis| {
                let mut replaced = m;
                (0..3).for_each(|r| replaced[r][axis] = right[r]);
                det(replaced) / d
            });
            d.abs() / 12.0 * gradient.iter().map(|g| g * g).sum::<f64>()
        };
        all.iter().map(of).sum()
    };
    let volume = |all: &[[usize; 4]]| all.iter().map(|t| det(matrix(t, None).0).abs()).sum::<f64>();
    is(close(volume(tetrahedra[0]), volume(tetrahedra[1])), "different volumes")?;
    // Centre of the sphere: 2 (x_k − x_0) · c = |x_k|² − |x_0|².
    let square = |v: usize| at[v].iter().map(|x| x * x).sum::<f64>();
    for t in tetrahedra[0] {
        let (m, right) = matrix(t, Some(&(0..5).map(|v| 0.5 * square(v)).collect::<Vec<_>>()));
        let centre: [f64; 3] = std::array::from_fn(|axis| {
            let mut replaced = m;
            (0..3).for_each(|r| replaced[r][axis] = right.unwrap()[r]);
            det(replaced) / det(m)
        });
        let distance = |v: usize| (0..3).map(|k| (at[v][k] - centre[k]).powi(2)).sum::<f64>();
        let empty = (0..5).filter(|v| !t.contains(v)).all(|v| distance(v) > distance(t[0]) + 1e-9);
        is(empty, "a point is in or on a sphere")?;
    }
    let (first, second) = (on(tetrahedra[0]), on(tetrahedra[1]));
    is(first > second + 1e-9, "the energy on Delaunay is not larger")?;
    is(close(first, quotient(&energies[0])) && close(second, quotient(&energies[1])), "other energies")
}

fn det(m: [[f64; 3]; 3]) -> f64 {
    m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
}

/// The catalogue's operator on the triangulation, and floating-point solutions of the rows written down.
fn extension(evidence: &Evidence, i: usize, j: usize, weight: f64, smallest: f64) -> Result<(), String> {
    let excerpt = &evidence.excerpt;
    is(!excerpt.rows.is_empty() && !excerpt.faces.is_empty(), "nothing to look at")?;
    let domain = Domain::from(super::surface(evidence));
    let cotan = lapjury::laplacian::find("cotan").unwrap().build(&domain, &Default::default()).unwrap();
    for row in &excerpt.rows {
        let same = |e: &(usize, f64)| (cotan.stiffness().at(row.row, e.0) - e.1).abs() < 1e-12;
        is(row.entries.iter().all(same), "the operator has another row")?;
    }
    let set: Vec<usize> = (0..domain.vertex_count()).filter(|&v| domain.boundary()[v]).collect();
    is(weight < 0.0 && close(-cotan.stiffness().at(i, j), weight), "another weight")?;
    is(!(set.contains(&i) && set.contains(&j)), "both ends are on the boundary")?;
    let mut least = f64::INFINITY;
    for &source in &set {
        for (_, value) in super::harmonic(&excerpt.rows, &set, source)? {
            least = least.min(value);
        }
    }
    is(least > 1e-6 && close(least, smallest), "another smallest value")?;
    let (eigenvalues, _) = symmetric_eigen(cotan.stiffness()).map_err(|e| e.to_string())?;
    is(eigenvalues[0] > -1e-12, "not semi-definite")
}

fn not_embedded(
    evidence: &Evidence,
    boundary: &[usize],
    weights: &[(usize, usize, f64)],
    at: &[Point],
    missing: Hypothesis,
    fault: &Fault,
) -> Result<(), String> {
    let faces: Vec<[usize; 3]> = evidence.excerpt.faces.iter().map(|f| f.1.clone().try_into().unwrap()).collect();
    is(faces.is_empty() == (missing == Hypothesis::ThreeConnected), "the faces are missing")?;
    for v in (0..at.len()).filter(|v| !boundary.contains(v)) {
        let mut force = [0.0; 2];
        for &(a, b, w) in weights.iter().filter(|e| e.0 == v || e.1 == v) {
            let other = if a == v { b } else { a };
            (0..2).for_each(|k| force[k] += w * (at[other][k] - at[v][k]));
        }
        is(force.iter().all(|f| f.abs() < 1e-12), "a force is left")?;
    }
    let m = boundary.len();
    let corner = |k: usize| at[boundary[k % m]];
    let turns: Vec<f64> = (0..m).map(|k| area(corner(k), corner(k + 1), corner(k + 2))).collect();
    let least = turns.iter().copied().fold(f64::INFINITY, f64::min);
    let lightest = weights.iter().map(|w| w.2).fold(f64::INFINITY, f64::min);
    is((lightest < 0.0) == (missing == Hypothesis::PositiveWeights), "signs of the weights")?;
    let doubled = |f: &[usize; 3]| area(at[f[0]], at[f[1]], at[f[2]]);
    match missing {
        Hypothesis::ConvexBoundary => is(least < 0.0, "the polygon is convex")?,
        Hypothesis::NoChordOnASide => is(least == 0.0, "the polygon has no straight corner")?,
        _ => is(least > 0.0, "the polygon is not strictly convex")?,
    }
    let surface_euler = || {
        let mut edges: Vec<[usize; 2]> = faces
            .iter()
            .flat_map(|f| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]])
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        at.len() as i64 - edges.len() as i64 + faces.len() as i64
    };
    match fault {
        Fault::Face { face } => {
            is(surface_euler() == 1 && faces.get(*face).is_some_and(|f| doubled(f) <= 1e-12), "the face is not folded")
        }
        Fault::Edge { a, b } => is(at[*a] == at[*b] && weights.iter().any(|w| (w.0, w.1) == (*a, *b)), "apart"),
        Fault::Overlap { faces: total, polygon } => {
            let found: f64 = faces.iter().map(|f| doubled(f).abs()).sum();
            let enclosed: f64 = (1..m - 1).map(|k| area(corner(0), corner(k), corner(k + 1))).sum();
            is(surface_euler() != 1, "a disc")?;
            is(close(found, quotient(total)) && close(enclosed, quotient(polygon)), "other areas")?;
            is(found > enclosed + 1e-9, "no more area than the polygon")
        }
    }
}

/// Lagrange's reduction of the shortest basis: by Euclid's division the number of flips is the sum of the quotients, and here
/// of a shear by s over (1, 0) it is s.
fn torus(start: &[[i64; 2]; 2], flips: usize, end: &[[i64; 2]; 2]) -> Result<(), String> {
    let [u, v] = *start;
    is(u == [1, 0] && v[1] == 1 && v[0] == flips as i64, "not the shear by the number of flips")?;
    let length = |p: [i64; 2]| p[0] * p[0] + p[1] * p[1];
    let edges = [end[0], end[1], [end[0][0] + end[1][0], end[0][1] + end[1][1]]];
    let mut lengths = edges.map(length);
    lengths.sort_unstable();
    is(lengths == [1, 1, 2], "the edges at the end are not those of the square lattice")
}
