//! Pictures of a certificate of equilibrium: the dual graph, the lifted surface, the arrows of a motion.

use std::collections::BTreeMap;

use super::drawing::Point;
use super::figure::Drawn;
use super::highlight::Highlight;
use super::picture::{Picture, picture};
use super::svg;
use crate::record::{Evidence, Exhibit, Statement};

/// The pictures of a statement about a triangulation that carries its whole mesh; none of any other.
pub fn figures(evidence: &Evidence) -> Vec<Drawn> {
    let exhibit = mesh(evidence);
    let highlight = Highlight::of(evidence);
    let draw = |picture: Option<Picture>, caption: &'static str| {
        picture.map(|p| Drawn { svg: svg::svg(&p.drawing, caption), caption: caption.into() })
    };
    let plain = |caption| draw(picture(&exhibit, &highlight), caption);
    let found = match &evidence.statement {
        Statement::Lift { .. } => vec![
            plain("The triangulation and its orthogonal dual: dual vertices are the gradients of the lift"),
            draw(picture(&lifted(&exhibit, &highlight.lift), &Highlight::default()), "The lifted surface, convex"),
        ],
        Statement::Motion { .. } => vec![plain("The motion that shortens no edge with an interior end")],
        Statement::Equilibrium { .. } => vec![plain("The triangulation with positive weights in equilibrium")],
        Statement::NoLift { .. } => vec![plain("The triangulation without a convex lift")],
        _ => Vec::new(),
    };
    found.into_iter().flatten().collect()
}

/// The mesh that evidence carries.
fn mesh(evidence: &Evidence) -> Exhibit {
    let excerpt = &evidence.excerpt;
    let vertices = excerpt.positions.iter().map(|p| p.0 + 1).max().unwrap_or(0);
    // A vertex without a position is one of no face; one that is far off cannot be drawn anyway.
    let mut positions = vec![[0.0; 3]; if vertices > 10 * excerpt.positions.len() { 0 } else { vertices }];
    for (v, p) in &excerpt.positions {
        if let Some(place) = positions.get_mut(*v) {
            *place = *p;
        }
    }
    Exhibit {
        laplacian: String::new(),
        property: String::new(),
        recipe: String::new(),
        faces: excerpt.faces.iter().map(|f| f.1.clone()).collect(),
        edges: Vec::new(),
        positions,
    }
}

/// The extent of a mesh: the longer side of its bounding box.
fn extent(positions: &[[f64; 3]]) -> f64 {
    let span = |k: usize| {
        let all = positions.iter().map(|p| p[k]);
        all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
    };
    span(0).max(span(1))
}

/// The arrows from tail to tip, the longest a quarter of the extent.
pub(super) fn arrows(exhibit: &Exhibit, arrows: &[(usize, [f64; 2])]) -> Vec<[Point; 2]> {
    let longest = arrows.iter().map(|(_, y)| y[0].hypot(y[1])).fold(0.0, f64::max);
    let scale = 0.25 * extent(&exhibit.positions) / longest;
    if !scale.is_finite() {
        return Vec::new();
    }
    let arrow = |(v, y): &(usize, [f64; 2])| {
        exhibit.positions.get(*v).map(|p| [[p[0], p[1]], [p[0] + scale * y[0], p[1] + scale * y[1]]])
    };
    arrows.iter().filter_map(arrow).collect()
}

/// The edges of the dual graph of a lift: the gradients of neighbouring triangles joined, moved and scaled as a whole so
/// that they lie as near to the triangles' centroids as possible.
pub(super) fn dual(exhibit: &Exhibit, lift: &[(usize, f64)]) -> Vec<[Point; 2]> {
    let h: BTreeMap<usize, f64> = lift.iter().copied().collect();
    let corner = |v: &usize| exhibit.positions.get(*v).zip(h.get(v)).map(|(p, h)| [p[0], p[1], *h]);
    let mut nodes: Vec<(Point, Point)> = Vec::new();
    let mut beside: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for face in &exhibit.faces {
        let Some([a, b, c]) =
            face.iter().map(corner).collect::<Option<Vec<_>>>().and_then(|f| <[[f64; 3]; 3]>::try_from(f).ok())
        else {
            return Vec::new();
        };
        for k in 0..3 {
            let (p, q) = (face[k], face[(k + 1) % 3]);
            beside.entry([p.min(q), p.max(q)]).or_default().push(nodes.len());
        }
        nodes.push((gradient([a, b, c]), [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0)));
    }
    let count = nodes.len().max(1) as f64;
    let mean =
        |pick: fn(&(Point, Point)) -> Point| [0, 1].map(|k| nodes.iter().map(|n| pick(n)[k]).sum::<f64>() / count);
    let (from, to) = (mean(|n| n.0), mean(|n| n.1));
    let terms = |f: &dyn Fn(f64, f64) -> f64| {
        nodes.iter().map(|(g, c)| (0..2).map(|k| f(g[k] - from[k], c[k] - to[k])).sum::<f64>()).sum::<f64>()
    };
    let scale = terms(&|g, c| g * c) / terms(&|g, _| g * g);
    if !scale.is_finite() {
        return Vec::new();
    }
    let place = |k: usize| [0, 1].map(|a| to[a] + scale * (nodes[k].0[a] - from[a]));
    beside.values().filter(|s| s.len() == 2).map(|s| [place(s[0]), place(s[1])]).collect()
}

fn gradient([a, b, c]: [[f64; 3]; 3]) -> Point {
    let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    let area = u[0] * v[1] - u[1] * v[0];
    [(u[2] * v[1] - v[2] * u[1]) / area, (v[2] * u[0] - u[2] * v[0]) / area]
}

/// The mesh as a surface in space with heights upwards, their range half the extent.
fn lifted(exhibit: &Exhibit, lift: &[(usize, f64)]) -> Exhibit {
    let range = |f: fn(f64, f64) -> f64, start: f64| lift.iter().map(|(_, h)| *h).fold(start, f);
    let span = range(f64::max, f64::NEG_INFINITY) - range(f64::min, f64::INFINITY);
    let scale = if span > 0.0 { 0.5 * extent(&exhibit.positions) / span } else { 0.0 };
    let h: BTreeMap<usize, f64> = lift.iter().copied().collect();
    let place = |(v, p): (usize, &[f64; 3])| [p[0], scale * h.get(&v).copied().unwrap_or(0.0), -p[1]];
    Exhibit { positions: exhibit.positions.iter().enumerate().map(place).collect(), ..exhibit.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The star of (0, 0) in the square with corners (±1, ±1), lifted by ½|x|².
    fn star() -> (Exhibit, Vec<(usize, f64)>) {
        let positions = vec![[0.0; 3], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0], [1.0, -1.0, 0.0]];
        let faces = (0..4).map(|k| vec![0, 1 + k, 1 + (k + 1) % 4]).collect();
        let exhibit = Exhibit {
            laplacian: String::new(),
            property: String::new(),
            recipe: String::new(),
            positions,
            faces,
            edges: Vec::new(),
        };
        (exhibit, vec![(0, 0.0), (1, 1.0), (2, 1.0), (3, 1.0), (4, 1.0)])
    }

    #[test]
    fn the_dual_of_the_paraboloid_crosses_every_edge_at_a_right_angle() {
        let (exhibit, lift) = star();
        let edges = dual(&exhibit, &lift);
        assert_eq!(edges.len(), 4);
        // Circumcentres (0, ±1), (±1, 0), drawn at the centroids (0, ±⅔), (±⅔, 0).
        for [p, q] in edges {
            let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
            assert!((dx.abs() - 2.0 / 3.0).abs() < 1e-15 && (dy.abs() - 2.0 / 3.0).abs() < 1e-15, "{p:?} {q:?}");
        }
    }

    #[test]
    fn the_longest_arrow_is_a_quarter_of_the_extent_and_none_is_drawn_of_a_vertex_that_is_not_there() {
        let (exhibit, _) = star();
        let drawn = arrows(&exhibit, &[(0, [3.0, 4.0]), (9, [1.0, 0.0])]);
        assert_eq!(drawn.len(), 1);
        assert!((drawn[0][1][0] - 0.3).abs() < 1e-15 && (drawn[0][1][1] - 0.4).abs() < 1e-15);
        assert!(arrows(&exhibit, &[(0, [0.0, 0.0])]).is_empty());
    }
}
