//! For each property a defect of a chosen size, and the two sizes that the formulas of the page give.

use lapjury::domain::Domain;
use lapjury::linalg::Csr;
use lapjury::operator::{Mass, MassKind, Operator, Provenance};
use lapjury::property::{self, Status, Trial};

use super::inverse::inverse;
use super::worlds::{U, World, length};

/// What the table says of one property on one mesh: up to which size the verdict is `holds`, from which it is `fails`.
pub type Sizes = [f64; 2];

pub struct Plant {
    pub id: &'static str,
    /// The verdict on a defect of this size, `None` where the property does not apply.
    pub verdict: fn(&World, f64) -> Option<Status>,
    /// What the formulas give; infinite where no size makes it fail.
    pub formula: fn(&World) -> Sizes,
    /// The factor that the formula's slack allows between it and what is measured.
    pub slack: f64,
}

/// Rounding that is in the matrix before anything is planted takes up to a third of what is explained.
const ROUNDING: f64 = 1.5;
/// First order in the defect, the largest of several entries.
const SOLUTION: f64 = 3.0;

pub const ALL: [Plant; 23] = [
    Plant { id: "FIN", verdict: fin, formula: |_| [0.0, 0.0], slack: 1.0 },
    Plant { id: "LOC", verdict: loc, formula: |w| [0.0, far_row(w)], slack: ROUNDING },
    Plant { id: "SYM", verdict: sym, formula: sym_sizes, slack: ROUNDING },
    Plant { id: "NULL", verdict: null, formula: |w| bounded(w.row(w.c)), slack: ROUNDING },
    Plant { id: "KER", verdict: ker, formula: ker_sizes, slack: SOLUTION },
    Plant { id: "POS", verdict: pos, formula: pos_sizes, slack: ROUNDING },
    Plant { id: "POS0", verdict: pos0, formula: pos0_sizes, slack: ROUNDING },
    Plant { id: "POS-boundary", verdict: pos_boundary, formula: pos_boundary_sizes, slack: ROUNDING },
    Plant { id: "PSD", verdict: psd, formula: psd_sizes, slack: ROUNDING },
    Plant { id: "LIN", verdict: lin, formula: lin_sizes, slack: ROUNDING },
    Plant { id: "ENERGY", verdict: energy, formula: energy_sizes, slack: ROUNDING },
    Plant { id: "FLUX", verdict: flux, formula: flux_sizes, slack: ROUNDING },
    Plant { id: "MVP", verdict: mvp, formula: |w| bounded(w.row(w.c)), slack: ROUNDING },
    Plant { id: "MASS", verdict: mass, formula: mass_sizes, slack: ROUNDING },
    Plant { id: "MAX-local", verdict: max_local, formula: max_local_sizes, slack: ROUNDING },
    Plant { id: "MAX-global", verdict: max_global, formula: max_global_sizes, slack: SOLUTION },
    Plant { id: "MAX-heat", verdict: max_heat, formula: max_heat_sizes, slack: SOLUTION },
    Plant { id: "PERM", verdict: |w, d| relation("PERM", w, d), formula: relation_sizes, slack: ROUNDING },
    Plant { id: "RIGID", verdict: |w, d| relation("RIGID", w, d), formula: relation_sizes, slack: ROUNDING },
    Plant { id: "SCALE", verdict: |w, d| relation("SCALE", w, d), formula: relation_sizes, slack: ROUNDING },
    Plant { id: "ISO", verdict: |w, d| relation("ISO", w, d), formula: iso_sizes, slack: ROUNDING },
    Plant { id: "REACH", verdict: |w, d| relation("REACH", w, d), formula: relation_sizes, slack: SOLUTION },
    Plant { id: "UNION", verdict: |w, d| relation("UNION", w, d), formula: relation_sizes, slack: ROUNDING },
];

/// A residual never exceeds the row scale: where the second size reaches one, nothing fails.
fn bounded([explained, defect]: Sizes) -> Sizes {
    [explained, if defect < 1.0 { defect / (1.0 - defect) } else { f64::INFINITY }]
}

fn applicable(status: Status) -> Option<Status> {
    (status != Status::NotApplicable).then_some(status)
}

/// An infinite entry, of any size but none.
fn fin(w: &World, size: f64) -> Option<Status> {
    let value = if size > 0.0 { f64::INFINITY } else { f64::MAX };
    Some(w.judge("FIN", &w.changed(&[(w.c, w.c, value)])))
}

/// The vertex farthest from the place.
fn farthest(w: &World) -> usize {
    (0..w.l.rows()).max_by(|&a, &b| length(w, w.c, a).total_cmp(&length(w, w.c, b))).unwrap()
}

/// `L_cf = δ s_c` far off the stencil.
fn loc(w: &World, size: f64) -> Option<Status> {
    Some(w.judge("LOC", &w.changed(&[(w.c, farthest(w), size * w.s(w.c))])))
}

fn far_row(w: &World) -> f64 {
    w.factors(w.l.row(w.c).len() + 1, w.q.iter().copied().fold(1.0, f64::max))[0]
}

/// `L_cj (1 + δ)` on one side.
fn sym(w: &World, size: f64) -> Option<Status> {
    Some(w.judge("SYM", &w.changed(&[(w.c, w.j, size * w.l.at(w.c, w.j))])))
}

fn sym_sizes(w: &World) -> Sizes {
    let weight = w.l.at(w.c, w.j).abs();
    let [there, back] = [[w.c, w.j], [w.j, w.c]].map(|e| (w.edge(e, weight), w.s(e[0])));
    let sizes = [0, 1].map(|k| (there.0[k] * there.1 + back.0[k] * back.1) / weight);
    // The unit of the row grows with the defect: by |L_cj| δ of s_c.
    let share = sizes[1] * weight / w.s(w.c) / 2.0;
    [sizes[0], if share < 0.5 { sizes[1] / (1.0 - share) } else { f64::INFINITY }]
}

/// `L_cc + δ s_c`.
fn null(w: &World, size: f64) -> Option<Status> {
    Some(w.judge("NULL", &w.changed(&[(w.c, w.c, size * w.s(w.c))])))
}

fn mvp(w: &World, size: f64) -> Option<Status> {
    Some(w.judge("MVP", &w.changed(&[(w.c, w.c, size * w.s(w.c))])))
}

/// The two halves of the mesh, by the direction in which weights are small.
fn half(w: &World) -> Vec<bool> {
    let at = |v: usize| w.surface.positions()[v][1];
    (0..w.l.rows()).map(|v| at(v) > at(w.c) + 1e-3).collect()
}

/// Weights between the halves times δ, so that for small δ the indicator of a half is nearly in the kernel.
fn ker(w: &World, size: f64) -> Option<Status> {
    let side = half(w);
    Some(w.judge("KER", &w.reweighted(|i, j, v| if side[i] == side[j] { v } else { v * size })))
}

/// The weights between the halves are seen while the largest of them is more than rounding in its row, or the energy
/// `δ Σ ω (1/S_A + 1/S_B)` of the step exceeds the shift of 512 u.
fn ker_sizes(w: &World) -> Sizes {
    let side = half(w);
    let scale = |which: bool| (0..w.l.rows()).filter(|&i| side[i] == which).map(|i| w.s(i)).sum::<f64>();
    let crossing: Vec<_> = w.l.entries().filter(|&(i, j, _)| side[i] != side[j]).collect();
    let cut = crossing.iter().filter(|(i, ..)| side[*i]).map(|(_, _, v)| -**v).sum::<f64>();
    let strongest = crossing.iter().map(|(i, _, v)| -**v / w.s(*i) / w.coupled(*i)[0]).fold(0.0, f64::max);
    let by_energy = 512.0 * U / (cut * (1.0 / scale(true) + 1.0 / scale(false)));
    let size = by_energy.min(1.0 / strongest);
    // If not even δ = 1 is seen, the other lines of the mesh are not joined to each other either.
    [if size < 1.0 { size } else { f64::INFINITY }, 0.0]
}

/// A weight of `−δ s_c` on an interior edge.
fn negative(w: &World, id: &str, size: f64) -> Option<Status> {
    Some(w.judge(id, &w.with_weight([w.c, w.j], -size * w.s(w.c))))
}

fn pos(w: &World, size: f64) -> Option<Status> {
    negative(w, "POS", size)
}

fn pos0(w: &World, size: f64) -> Option<Status> {
    negative(w, "POS0", size)
}

fn max_local(w: &World, size: f64) -> Option<Status> {
    negative(w, "MAX-local", size)
}

/// The size at which a negative weight is clear: `defect_ij` with the unit of the matrix and the weight itself, or `explained_i`.
fn clear(w: &World, edge: [usize; 2]) -> f64 {
    let defect = w.edge(edge, 0.0)[1] * w.rest(edge);
    let row = w.row(edge[0])[0] * w.rest(edge);
    if defect < 0.5 { defect.max(row) } else { f64::INFINITY }
}

fn pos_sizes(w: &World) -> Sizes {
    [0.0, clear(w, [w.c, w.j])]
}

fn pos0_sizes(w: &World) -> Sizes {
    let edge = [w.c, w.j];
    [w.edge(edge, 0.0)[0] * w.rest(edge), clear(w, edge)]
}

fn max_local_sizes(w: &World) -> Sizes {
    bounded(w.coupled(w.c).map(|t| t * w.rest([w.c, w.j])))
}

fn pos_boundary(w: &World, size: f64) -> Option<Status> {
    let rim = w.rim?;
    Some(w.judge("POS-boundary", &w.with_weight(rim, -size * w.s(rim[0]))))
}

fn pos_boundary_sizes(w: &World) -> Sizes {
    [0.0, w.rim.map_or(0.0, |rim| clear(w, rim).min(clear(w, [rim[1], rim[0]])))]
}

/// `L − δ diag(s)`.
fn psd(w: &World, size: f64) -> Option<Status> {
    let changes: Vec<_> = (0..w.l.rows()).map(|i| (i, i, -size * w.s(i))).collect();
    Some(w.judge("PSD", &w.changed(&changes)))
}

/// `explained + 512 u`, and the mean of the defects, both weighted by the rows: the energy of constants.
fn psd_sizes(w: &World) -> Sizes {
    let total: f64 = (0..w.l.rows()).map(|i| w.s(i)).sum();
    let mean = |k: usize| (0..w.l.rows()).map(|i| w.coupled(i)[k] * w.s(i)).sum::<f64>() / total;
    let defect = mean(1);
    let hides = mean(0) + 512.0 * U;
    [hides, if defect < 0.5 { defect.max(hides) } else { f64::INFINITY }]
}

/// `Σ_j |L_ij| |x_j − x_i|`.
fn moment(w: &World, i: usize) -> f64 {
    w.l.row(i).map(|(j, v)| v.abs() * length(w, i, j)).sum()
}

/// `L_cj (1 + δ)` on one side, with its diagonal.
fn moved(w: &World, id: &str, [i, j]: [usize; 2], size: f64) -> Option<Status> {
    let d = size * w.l.at(i, j);
    applicable(w.judge(id, &w.changed(&[(i, j, d), (i, i, -d)])))
}

fn lin(w: &World, size: f64) -> Option<Status> {
    moved(w, "LIN", [w.c, w.j], size)
}

fn lin_sizes(w: &World) -> Sizes {
    let own = w.l.at(w.c, w.j).abs() * length(w, w.c, w.j);
    let [explained, defect] = w.row(w.c).map(|t| t * moment(w, w.c) / own);
    [
        explained,
        if defect * own < moment(w, w.c) { defect / (1.0 - defect * own / moment(w, w.c)) } else { f64::INFINITY },
    ]
}

/// `(1 + δ) L`.
fn energy(w: &World, size: f64) -> Option<Status> {
    Some(w.judge("ENERGY", &w.given(w.l.map(|_, _, v| v * (1.0 + size)))))
}

fn energy_sizes(w: &World) -> Sizes {
    let squared = |i: usize| w.l.row(i).map(|(j, v)| 0.5 * v.abs() * length(w, i, j).powi(2)).sum::<f64>();
    let area: f64 = w.mass.iter().sum();
    let expected = if w.rim.is_some() { area } else { 2.0 * area };
    let of_area = |f: &Vec<usize>| w.factors(3, f.iter().map(|&v| w.q[v]).fold(f64::INFINITY, f64::min));
    let faces =
        |k: usize| w.surface.faces().iter().map(|f| of_area(f)[k]).sum::<f64>() / w.surface.faces().len() as f64;
    let sum = |k: usize| (0..w.l.rows()).map(|i| w.row(i)[k] * squared(i)).sum::<f64>() + faces(k) * area;
    let defect = sum(1) / expected;
    [(sum(0) / expected).min(1.0 / 1_048_576.0), if defect < 0.5 { defect } else { f64::INFINITY }]
}

fn flux(w: &World, size: f64) -> Option<Status> {
    moved(w, "FLUX", w.rim?, size)
}

/// As LIN, with half the distance of the neighbours on the boundary: on a straight rim twice the edge.
fn flux_sizes(w: &World) -> Sizes {
    let Some([i, j]) = w.rim else { return [0.0, 0.0] };
    let own = w.l.at(i, j).abs() * length(w, i, j);
    let scale = moment(w, i) + length(w, i, j);
    let [explained, defect] = w.row(i).map(|t| t * scale / own);
    [explained, if defect * own < scale { defect / (1.0 - defect * own / scale) } else { f64::INFINITY }]
}

/// The share of c times 1 + δ, of a mass that says it is barycentric.
fn mass(w: &World, size: f64) -> Option<Status> {
    let mut mass = w.mass.clone();
    mass[w.c] *= 1.0 + size;
    let plain = Operator::new(w.l.clone(), Provenance::default()).unwrap();
    Some(w.judge("MASS", &plain.with_mass(Mass::lumped(MassKind::Barycentric, &mass)).unwrap()))
}

/// The star is three times the share.
fn mass_sizes(w: &World) -> Sizes {
    let [explained, defect] = w.factors(w.surface.topology().star(w.c).len(), w.q[w.c]);
    [3.0 * explained, 3.0 * defect]
}

/// The mesh on which a vertex of the boundary has one neighbour in the interior, and both.
fn dirichlet(w: &World) -> (Option<World>, [usize; 2]) {
    if w.rim.is_none() {
        let (open, b) = w.opened();
        let c = open.c;
        return (Some(open), [c, b]);
    }
    let boundary = w.domain.boundary();
    let inner = |b: usize| w.l.row(b).map(|(j, _)| j).filter(|&j| !boundary[j]).collect::<Vec<_>>();
    let b = (0..boundary.len()).find(|&b| boundary[b] && inner(b).len() == 1).unwrap();
    (None, [inner(b)[0], b])
}

/// The weight between them is `−δ s_c`: the harmonic extension of the indicator of b is then negative at c.
fn max_global(w: &World, size: f64) -> Option<Status> {
    let (open, [c, b]) = dirichlet(w);
    let w = open.as_ref().unwrap_or(w);
    Some(w.judge("MAX-global", &w.with_weight([c, b], -size * w.s(c))))
}

/// `δ s_c (A⁻¹)_cc = g_c / (1 − ‖g‖)`.
fn max_global_sizes(w: &World) -> Sizes {
    let (open, [c, b]) = dirichlet(w);
    let w = open.as_ref().unwrap_or(w);
    let l = w.with_weight([c, b], 0.0).stiffness().clone();
    let boundary = w.domain.boundary();
    let free: Vec<usize> = (0..boundary.len()).filter(|&v| !boundary[v]).collect();
    let a: Vec<Vec<f64>> = free.iter().map(|&i| free.iter().map(|&j| l.at(i, j)).collect()).collect();
    let y = inverse(&a);
    let at = free.iter().position(|&v| v == c).unwrap();
    [0, 1].map(|k| {
        let influence =
            |i: usize| free.iter().enumerate().map(|(m, &v)| y[i][m].abs() * w.coupled(v)[k] * w.s(v)).sum();
        let g: Vec<f64> = (0..free.len()).map(influence).collect();
        let largest = g.iter().copied().fold(0.0, f64::max);
        let size = g[at] / (1.0 - largest) / (w.s(c) * y[at][at]);
        // A solution that rounding may move by a thousandth certifies nothing.
        let certain = largest / (1.0 - largest) <= 1.0 / 1024.0;
        match k {
            0 if certain => size,
            0 => 0.0,
            _ if largest < 0.5 => size,
            _ => f64::INFINITY,
        }
    })
}

/// A weight of `−δ s_c` from c to the vertex farthest away.
fn max_heat(w: &World, size: f64) -> Option<Status> {
    let (c, f) = (w.c, farthest(w));
    Some(w.judge("MAX-heat", &w.changed(&[(c, f, size * w.s(c))])))
}

/// `t δ s_c (K⁻¹)_cc (K⁻¹M)_ff = (K⁻¹M)_cf + g_c`, `K = M + tL`; the smallest of the t that are tried.
fn max_heat_sizes(w: &World) -> Sizes {
    let n = w.l.rows();
    let edges = w.domain.edges();
    let unit = edges.iter().map(|e| length(w, e[0], e[1]).powi(2)).sum::<f64>() / edges.len() as f64;
    let (c, f) = (w.c, farthest(w));
    let mut sizes = [f64::INFINITY; 2];
    for t in [unit / 16.0, unit, 16.0 * unit] {
        let mass = |i: usize, j: usize| if i == j { w.mass[i] } else { 0.0 };
        let y = inverse(&(0..n).map(|i| (0..n).map(|j| mass(i, j) + t * w.l.at(i, j)).collect()).collect::<Vec<_>>());
        for (k, size) in sizes.iter_mut().enumerate() {
            let row = |v: usize| w.coupled(v)[k] * (w.mass[v] + t * w.s(v));
            let influence = |i: usize| (0..n).map(|v| y[i][v].abs() * row(v)).sum::<f64>();
            let largest = (0..n).map(influence).fold(0.0, f64::max);
            let certain = if k == 0 { largest <= 1.0 / 1024.0 } else { largest < 0.5 };
            let found = if certain {
                (y[c][f] * w.mass[f] + influence(c) / (1.0 - largest)) / (t * w.s(c) * y[c][c] * y[f][f] * w.mass[f])
            } else if k == 0 {
                0.0
            } else {
                f64::INFINITY
            };
            *size = size.min(found);
        }
    }
    sizes
}

/// A construction that makes `(1 + δ) L` of every domain but the one on trial.
fn relation(id: &str, w: &World, size: f64) -> Option<Status> {
    let own = w.domain.digest();
    let construct = |domain: &Domain| {
        let cotan = lapjury::laplacian::find("cotan").ok_or("in the catalogue")?;
        let made = cotan.build(domain, &Default::default()).map_err(|e| e.to_string())?;
        let factor = if domain.digest() == own { 1.0 } else { 1.0 + size };
        let l: Csr = made.stiffness().map(|_, _, v| v * factor);
        let plain = Operator::new(l, Provenance::default()).map_err(|e| e.to_string())?;
        plain.with_mass(made.mass().ok_or("a mass")?.clone()).map_err(|e| e.to_string())
    };
    let operator = construct(&w.domain).unwrap();
    let trial = Trial::new(&w.domain, &operator, 5).unwrap();
    applicable(property::find(id).unwrap().decide(&trial, Some(&construct)).status())
}

/// The diagonal is half of the row scale: `2 (4m + 32Q) u`, the row with the fewest entries first.
fn relation_sizes(w: &World) -> Sizes {
    let least = |k: usize| (0..w.l.rows()).map(|i| w.coupled(i)[k]).fold(f64::INFINITY, f64::min);
    let defect = 2.0 * least(1);
    [2.0 * least(0), if defect < 0.5 { defect / (1.0 - defect) } else { f64::INFINITY }]
}

/// The same with vertices moved by 32 u diameters.
fn iso_sizes(w: &World) -> Sizes {
    let n = w.l.rows();
    let p = w.surface.positions();
    let span =
        |k: usize| p.iter().map(|p| p[k]).fold(f64::MIN, f64::max) - p.iter().map(|p| p[k]).fold(f64::MAX, f64::min);
    let diameter = (span(0).powi(2) + span(1).powi(2) + span(2).powi(2)).sqrt();
    let shortest = w.domain.edges().iter().map(|e| length(w, e[0], e[1])).fold(f64::INFINITY, f64::min);
    let worst = w.q.iter().copied().fold(1.0, f64::max);
    let moved = 8.0 * worst * 32.0 * U * diameter / shortest;
    let least = |k: usize| (0..n).map(|i| w.coupled(i)[k]).fold(f64::INFINITY, f64::min);
    [2.0 * (least(0) + moved), 2.0 * (least(1) + 8.0 * moved)]
}
