//! Piecewise linear lifts of a planar triangulation, and the weights that they give.

use std::cmp::Ordering;

use super::Net;
use super::net::{DIGITS, rounded};
use crate::domain::{Surface, geometry};
use crate::scalar::{Rational, Scalar};

/// An interior edge with the vertices opposite, left and right of the way from its first end to the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Hinge {
    edge: usize,
    ends: [usize; 2],
    apexes: [usize; 2],
    faces: [usize; 2],
}

/// The interior edges of a planar triangulation, on which a lift is folded.
#[derive(Clone, Debug)]
pub struct Lift {
    positions: Vec<[Rational; 2]>,
    faces: Vec<[usize; 3]>,
    edges: Vec<[usize; 2]>,
    hinges: Vec<Hinge>,
    /// Whether faces are clockwise in these coordinates.
    turned: bool,
    disc: bool,
    /// The face of the smallest area. Heights are counted from its plane, so that where a mesh is finest they are smallest,
    /// and floating point has most digits.
    smallest: usize,
}

impl Lift {
    /// `None` unless the surface is planar and made of triangles, none of them degenerate, at most two at an edge.
    pub fn of(surface: &Surface) -> Option<Self> {
        let positions = surface.planar_positions::<Rational>()?;
        let faces: Vec<[usize; 3]> = (0..surface.faces().len()).map(|f| surface.triangle(f)).collect::<Option<_>>()?;
        let area =
            |f: &[usize; 3]| geometry::doubled_area(&positions[f[0]], &positions[f[1]], &positions[f[2]]).cmp_zero();
        let turn = area(faces.first()?);
        let topology = surface.topology();
        let even = turn != Ordering::Equal && faces.iter().all(|f| area(f) == turn);
        if !even || !topology.non_manifold_edges().is_empty() {
            return None;
        }
        let mut hinges = Vec::new();
        for (edge, &ends) in topology.edges().iter().enumerate() {
            if let [s, t] = topology.sides(edge) {
                let [left, right] = if s.forward() { [s, t] } else { [t, s] };
                let apex = |side: &crate::domain::topology::Side| faces[side.face()][(side.corner() + 2) % 3];
                hinges.push(Hinge {
                    edge,
                    ends,
                    apexes: [apex(left), apex(right)],
                    faces: [left.face(), right.face()],
                });
            }
        }
        let vertices = positions.len();
        let whole = crate::domain::topology::components(vertices, topology.edges()).iter().all(|c| *c == 0);
        let euler = vertices + faces.len() == topology.edges().len() + 1;
        let pinched = !topology.non_manifold_vertices(surface.faces()).is_empty();
        let disc = whole && euler && !pinched && topology.boundary_loops() == 1;
        let edges = topology.edges().to_vec();
        let size = |f: &[usize; 3]| {
            geometry::doubled_area(&positions[f[0]], &positions[f[1]], &positions[f[2]]).magnitude().approximate()
        };
        let smallest = (0..faces.len()).min_by(|&f, &g| size(&faces[f]).total_cmp(&size(&faces[g])))?;
        Some(Lift { positions, faces, edges, hinges, turned: turn == Ordering::Less, disc, smallest })
    }

    /// Whether the triangulation is a disc: then every equilibrium is a lift.
    pub fn is_disc(&self) -> bool {
        self.disc
    }

    /// The interior edges.
    pub fn edges(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.hinges.iter().map(|h| h.ends)
    }

    /// The weights of the interior edges that follow from heights: the jump of the gradient over the length, exactly.
    pub fn weights(&self, heights: &[Rational]) -> Vec<Rational> {
        self.hinges.iter().map(|hinge| self.weight(hinge, heights)).collect()
    }

    fn weight(&self, hinge: &Hinge, h: &[Rational]) -> Rational {
        let ([i, j], [k, l]) = (hinge.ends, hinge.apexes);
        let area = |a: usize, b: usize, c: usize| {
            geometry::doubled_area(&self.positions[a], &self.positions[b], &self.positions[c])
        };
        let (left, right) = (area(i, j, k), area(j, i, l));
        let rise = h[l].clone() * left.clone() - h[i].clone() * area(l, j, k) - h[j].clone() * area(i, l, k)
            + h[k].clone() * right.clone();
        let weight = rise / (left * right);
        if self.turned { -weight } else { weight }
    }

    /// Whether heights are strictly convex across every interior edge. Exact.
    pub fn is_convex(&self, heights: &[Rational]) -> bool {
        self.hinges.iter().all(|hinge| self.weight(hinge, heights).cmp_zero() == Ordering::Greater)
    }

    /// The heights of a disc that have the given weights on the constrained edges and 1 on other interior edges: the
    /// gradient, and then the height, is carried from triangle to triangle.
    pub fn heights<S: Scalar>(&self, weights: &[S], net: &Net) -> Vec<S> {
        let number = |x: &Rational| S::exactly(x.approximate()).unwrap_or_else(S::zero);
        let positions: Vec<[S; 2]> = self.positions.iter().map(|p| std::array::from_fn(|a| number(&p[a]))).collect();
        let one = S::half() + S::half();
        let mut of_edge = vec![one; self.edges.len()];
        for (edge, weight) in net.edges().iter().zip(weights) {
            if let Ok(at) = self.edges.binary_search(edge) {
                of_edge[at] = weight.clone();
            }
        }
        let mut beside = vec![Vec::new(); self.faces.len()];
        for hinge in &self.hinges {
            let [left, right] = hinge.faces;
            beside[left].push((right, hinge, false));
            beside[right].push((left, hinge, true));
        }
        let mut gradients: Vec<Option<[S; 2]>> = vec![None; self.faces.len()];
        let mut heights: Vec<Option<S>> = vec![None; positions.len()];
        gradients[self.smallest] = Some([S::zero(), S::zero()]);
        self.faces[self.smallest].iter().for_each(|&v| heights[v] = Some(S::zero()));
        let mut queue = std::collections::VecDeque::from([self.smallest]);
        while let Some(face) = queue.pop_front() {
            let Some(gradient) = gradients[face].clone() else { continue };
            for &(other, hinge, back) in &beside[face] {
                if gradients[other].is_some() {
                    continue;
                }
                let [p, q] = hinge.ends.map(|v| &positions[v]);
                let weight = &of_edge[hinge.edge];
                // To the right of the way (a, b) lies (b, −a), and across the edge the gradient grows by ω times that.
                let step = [q[1].clone() - p[1].clone(), p[0].clone() - q[0].clone()].map(|x| x * weight.clone());
                let forward = back == self.turned;
                let next: [S; 2] = std::array::from_fn(|a| {
                    let (from, step) = (gradient[a].clone(), step[a].clone());
                    (if forward { from + step } else { from - step }).reduced()
                });
                let (apex, base) = (hinge.apexes[usize::from(!back)], hinge.ends[0]);
                if heights[apex].is_none() {
                    let rise = (0..2).fold(S::zero(), |sum, a| {
                        sum + next[a].clone() * (positions[apex][a].clone() - positions[base][a].clone())
                    });
                    heights[apex] = heights[base].clone().map(|h| (h + rise).reduced());
                }
                gradients[other] = Some(next);
                queue.push_back(other);
            }
        }
        heights.into_iter().map(|h| h.unwrap_or_else(S::zero)).collect()
    }

    /// The heights of proposed weights in whole numbers, with as few digits as survive the verification.
    pub fn rounded(&self, weights: &[f64], net: &Net) -> Option<Vec<Rational>> {
        let exact = self.heights(weights, net);
        let heights = self.levelled(&exact);
        let largest = heights.iter().fold(0.0, |m: f64, h| m.max(h.abs()));
        if !(largest.is_finite() && largest > 0.0) {
            let flat = vec![Rational::ZERO; heights.len()];
            return self.hinges.is_empty().then_some(flat);
        }
        let whole = DIGITS.iter().map(|bits| {
            let scale = 2_f64.powi(*bits) / largest;
            heights.iter().map(|h| rounded(h * scale)).collect::<Vec<Rational>>()
        });
        // A mesh of many scales has heights of many scales, which floating point has and a whole number has not.
        let floating = exact.iter().map(|&h| Rational::exactly(h).unwrap_or_else(Rational::zero)).collect();
        whole.chain([floating]).find(|proposed| self.is_convex(proposed))
    }

    /// Heights less the linear function that fits them best, so that no digits are spent on it.
    fn levelled(&self, heights: &[f64]) -> Vec<f64> {
        let n = heights.len() as f64;
        let x: Vec<[f64; 2]> = self.positions.iter().map(|p| [p[0].approximate(), p[1].approximate()]).collect();
        let mean = |value: &dyn Fn(usize) -> f64| (0..heights.len()).map(value).sum::<f64>() / n;
        let (a, b, c) = (mean(&|v| x[v][0]), mean(&|v| x[v][1]), mean(&|v| heights[v]));
        let moment = |f: &dyn Fn(usize) -> f64, g: &dyn Fn(usize) -> f64| mean(&|v| f(v) * g(v));
        let (dx, dy, dh) = (|v: usize| x[v][0] - a, |v: usize| x[v][1] - b, |v: usize| heights[v] - c);
        let (xx, xy, yy) = (moment(&dx, &dx), moment(&dx, &dy), moment(&dy, &dy));
        let (xh, yh) = (moment(&dx, &dh), moment(&dy, &dh));
        let determinant = xx * yy - xy * xy;
        let (s, t) = ((yy * xh - xy * yh) / determinant, (xx * yh - xy * xh) / determinant);
        if !(s.is_finite() && t.is_finite()) {
            return heights.to_vec();
        }
        (0..heights.len()).map(|v| dh(v) - s * dx(v) - t * dy(v)).collect()
    }
}
