//! Where the vertices of an exhibit go on paper.

use super::drawing::Point;

/// Vertices on paper, with their depth (larger is nearer to the reader).
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Positions, y upwards.
    pub at: Vec<Point>,
    /// Depths; all zero for a planar mesh.
    pub depth: Vec<f64>,
    /// Whether angles on paper are the true ones.
    pub planar: bool,
    /// The direction to the reader.
    towards: [f64; 3],
}

impl View {
    /// A planar mesh lies as it is; a mesh in space is seen from the side of `focus`, from slightly above; points without
    /// extent go on a circle.
    pub fn of(positions: &[[f64; 3]], faces: &[Vec<usize>], vertices: usize, focus: &[usize]) -> Self {
        let extent = extent(positions);
        if positions.len() < vertices || extent.iter().all(|e| *e == 0.0) {
            return View::flat((0..vertices).map(|k| on_circle(k, vertices)).collect());
        }
        let axes: Vec<usize> = (0..3).filter(|&k| extent[k] > 0.0).collect();
        match axes.as_slice() {
            [a] => View::flat(positions.iter().map(|p| [p[*a], 0.0]).collect()),
            [a, b] => View::flat(positions.iter().map(|p| [p[*a], p[*b]]).collect()),
            _ => View::from_side(positions, side(positions, faces, focus)),
        }
    }

    fn flat(at: Vec<Point>) -> Self {
        View { depth: vec![0.0; at.len()], at, planar: true, towards: [0.0, 0.0, 1.0] }
    }

    fn from_side(positions: &[[f64; 3]], towards: [f64; 3]) -> Self {
        let pole = if towards[1].abs() > 0.95 { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
        let right = unit(cross(pole, towards));
        let up = cross(towards, right);
        View {
            at: positions.iter().map(|p| [dot(*p, right), dot(*p, up)]).collect(),
            depth: positions.iter().map(|p| dot(*p, towards)).collect(),
            planar: false,
            towards,
        }
    }

    /// How much a face is lit, 0 to 1; a flat one fully.
    pub fn light(&self, positions: &[[f64; 3]], face: &[usize]) -> f64 {
        if self.planar { 1.0 } else { dot(unit(normal(positions, face)), self.towards).abs() }
    }
}

/// The direction to the reader: out of the faces at the focus, turned a little so that the picture has depth.
fn side(positions: &[[f64; 3]], faces: &[Vec<usize>], focus: &[usize]) -> [f64; 3] {
    let mut out = [0.0; 3];
    for face in faces.iter().filter(|f| f.iter().any(|v| focus.contains(v))) {
        let n = unit(normal(positions, face));
        out = std::array::from_fn(|k| out[k] + n[k]);
    }
    let front = if dot(out, out) > 1e-12 { unit(out) } else { unit([0.35, 0.45, 1.0]) };
    let pole = if front[1].abs() > 0.9 { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
    let right = unit(cross(pole, front));
    let up = cross(front, right);
    unit(std::array::from_fn(|k| front[k] + 0.3 * right[k] + 0.25 * up[k]))
}

/// Newell's normal of a polygon, its length twice the area.
fn normal(positions: &[[f64; 3]], face: &[usize]) -> [f64; 3] {
    let Some(&first) = face.first() else { return [0.0; 3] };
    let origin = positions[first];
    let arm = |v: usize| -> [f64; 3] { std::array::from_fn(|k| positions[v][k] - origin[k]) };
    face.windows(2).fold([0.0; 3], |sum, w| {
        let c = cross(arm(w[0]), arm(w[1]));
        std::array::from_fn(|k| sum[k] + c[k])
    })
}

fn extent(positions: &[[f64; 3]]) -> [f64; 3] {
    std::array::from_fn(|k| {
        let (low, high) =
            positions.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[k]), h.max(p[k])));
        if high > low { high - low } else { 0.0 }
    })
}

fn on_circle(k: usize, n: usize) -> Point {
    let turn = std::f64::consts::TAU * k as f64 / n.max(1) as f64;
    [turn.sin(), turn.cos()]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    if length > 0.0 { a.map(|c| c / length) } else { [0.0, 0.0, 1.0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_in_a_coordinate_plane_lies_as_it_is() {
        let p = [[0.0, 5.0, 0.0], [2.0, 5.0, 0.0], [0.0, 5.0, 1.0]];
        let view = View::of(&p, &[vec![0, 1, 2]], 3, &[]);
        assert!(view.planar);
        assert_eq!(view.at, vec![[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]]);
    }

    #[test]
    fn points_without_extent_go_on_a_circle() {
        let view = View::of(&[[1.0; 3]; 4], &[], 4, &[]);
        let radius = |p: &Point| (p[0] * p[0] + p[1] * p[1] - 1.0).abs() < 1e-12;
        assert!(view.at.len() == 4 && view.at.iter().all(radius));
    }

    #[test]
    fn the_focus_of_a_mesh_in_space_is_on_the_near_side() {
        let p = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let faces = vec![vec![0, 1, 2], vec![0, 3, 1], vec![0, 2, 3], vec![1, 3, 2]];
        for focus in 0..4 {
            let view = View::of(&p, &faces, 4, &[focus]);
            let nearest = (0..4).max_by(|&a, &b| view.depth[a].total_cmp(&view.depth[b]));
            assert_eq!(nearest, Some(focus));
        }
    }
}
