//! Tutte's theorem without one of its hypotheses: the equilibrium and the fault of a drawing, in exact fractions.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::str::FromStr;

use dashu_int::IBig;

use super::alone::{check_exact, fraction, triangles, whole, written};
use super::polygon::{self, Point, minus};
use super::{Answer, Rechecked, Refusal};
use crate::property::evidence::{Excerpt, Fault, Hypothesis};
use crate::scalar::{Rational, Scalar};

/// What a statement says of a drawing.
pub(super) struct Drawn<'a> {
    /// The boundary cycle.
    pub boundary: &'a [usize],
    /// Edges with an end inside, and their weights.
    pub weights: &'a [(usize, usize, f64)],
    /// The positions.
    pub drawing: &'a [[String; 2]],
    /// The checksum.
    pub checksum: &'a str,
}

/// What was read.
struct Graph {
    at: Vec<Point>,
    boundary: Vec<usize>,
    weights: BTreeMap<[usize; 2], Rational>,
    faces: Vec<[usize; 3]>,
}

/// Every hypothesis but one holds, that one does not, the inner vertices are in equilibrium, and the fault is there.
pub(super) fn decide(excerpt: &Excerpt, drawn: &Drawn, missing: Hypothesis, fault: &Fault) -> Answer {
    let Excerpt { rows, mass_rows, positions, edges, faces } = excerpt;
    if !(rows.is_empty() && mass_rows.is_empty() && positions.is_empty() && edges.is_empty()) {
        return Err(Refusal::untrue("the excerpt carries faces only", "it carries more"));
    }
    let graph = Graph::read(drawn, triangles(faces)?)?;
    check_exact("the checksum", drawn.checksum, &graph.checksum())?;
    graph.check_equilibrium()?;
    graph.check_boundary(missing)?;
    graph.check_weights(missing)?;
    graph.check_shape(missing)?;
    graph.check_fault(missing, fault)?;
    Ok(Rechecked::Exact)
}

impl Graph {
    fn read(drawn: &Drawn, faces: Vec<[usize; 3]>) -> Result<Self, Refusal> {
        let n = drawn.drawing.len();
        let at = drawn.drawing.iter().enumerate().map(|(k, p)| Ok([read(k, &p[0])?, read(k, &p[1])?]));
        let at = at.collect::<Result<Vec<Point>, Refusal>>()?;
        let mentioned = drawn.boundary.iter().chain(drawn.weights.iter().flat_map(|(a, b, _)| [a, b]));
        if let Some(&index) = mentioned.chain(faces.iter().flatten()).find(|&&v| v >= n) {
            return Err(Refusal::Missing { what: "position", index });
        }
        // A vertex that is on it twice is refused with the polygons that are not simple.
        if drawn.boundary.len() < 3 {
            return Err(Refusal::untrue("the boundary is a cycle", "it is not"));
        }
        let mut weights = BTreeMap::new();
        for (index, &(a, b, weight)) in drawn.weights.iter().enumerate() {
            let inner = a < b && !(drawn.boundary.contains(&a) && drawn.boundary.contains(&b));
            let weight = Rational::from(whole("weight", index, weight)?);
            if !inner || weights.insert([a, b], weight).is_some() {
                let problem = "is not of an edge a < b with an end inside, once";
                return Err(Refusal::Malformed { what: "weight", index, problem });
            }
        }
        Ok(Graph { at, boundary: drawn.boundary.to_vec(), weights, faces })
    }

    fn sides(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let n = self.boundary.len();
        (0..n).map(move |k| [self.boundary[k], self.boundary[(k + 1) % n]])
    }

    fn is_inside(&self, v: usize) -> bool {
        !self.boundary.contains(&v)
    }

    /// All edges: of the polygon, of the faces, and those with a weight.
    fn edges(&self) -> BTreeSet<[usize; 2]> {
        let of_faces = self.faces.iter().flat_map(|f| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]]);
        let all = self.sides().chain(of_faces).chain(self.weights.keys().copied());
        all.map(|[a, b]| [a.min(b), a.max(b)]).collect()
    }

    /// `Σ k (|e_k|² + ω_k)` over the edges in their order.
    fn checksum(&self) -> Rational {
        (1_u32..).zip(self.edges()).fold(Rational::zero(), |sum, (k, [a, b])| {
            let [x, y] = minus(&self.at[a], &self.at[b]);
            let weight = self.weights.get(&[a, b]).cloned().unwrap_or_else(Rational::zero);
            (sum + Rational::from(k) * (x.clone() * x + y.clone() * y + weight)).reduced()
        })
    }

    fn check_equilibrium(&self) -> Result<(), Refusal> {
        let inside: Vec<usize> = (0..self.at.len()).filter(|&v| self.is_inside(v)).collect();
        if inside.is_empty() {
            return Err(Refusal::untrue("there is a vertex inside", "there is none"));
        }
        for v in inside {
            let mut force = [Rational::zero(), Rational::zero()];
            for (&[a, b], weight) in self.weights.iter().filter(|(e, _)| e.contains(&v)) {
                let pull = minus(&self.at[a + b - v], &self.at[v]);
                for (f, p) in force.iter_mut().zip(pull) {
                    *f = (f.clone() + weight.clone() * p).reduced();
                }
            }
            if force.iter().any(|f| f.cmp_zero() != Ordering::Equal) {
                let found = format!("({}, {})", written(&force[0]), written(&force[1]));
                return Err(Refusal::untrue(format!("the force at vertex {v} vanishes"), found));
            }
        }
        Ok(())
    }

    fn area(&self, a: usize, b: usize, c: usize) -> Rational {
        polygon::area(&self.at[a], &self.at[b], &self.at[c])
    }

    fn turns(&self) -> Vec<Ordering> {
        let n = self.boundary.len();
        let corner = |k: usize| self.boundary[k % n];
        (0..n).map(|k| self.area(corner(k), corner(k + 1), corner(k + 2)).cmp_zero()).collect()
    }

    /// Twice the area that the polygon encloses, counter-clockwise.
    fn polygon(&self) -> Rational {
        let first = self.boundary[0];
        self.sides().fold(Rational::zero(), |sum, [a, b]| (sum + self.area(first, a, b)).reduced())
    }

    /// A simple polygon runs counter-clockwise; it is strictly convex, convex with a straight corner, or not convex, as the
    /// hypothesis that is missing asks for.
    fn check_boundary(&self, missing: Hypothesis) -> Result<(), Refusal> {
        let turns = self.turns();
        let fits = match missing {
            Hypothesis::ConvexBoundary => turns.contains(&Ordering::Less),
            Hypothesis::NoChordOnASide => !turns.contains(&Ordering::Less),
            _ => turns.iter().all(|t| *t == Ordering::Greater),
        };
        let corners: Vec<Point> = self.boundary.iter().map(|&v| self.at[v].clone()).collect();
        if !fits || self.polygon().cmp_zero() != Ordering::Greater || !polygon::is_simple(&corners) {
            let stated = format!("the boundary is a simple polygon, as it must be where {missing:?} alone is missing");
            return Err(Refusal::untrue(stated, format!("its corners turn {turns:?}")));
        }
        Ok(())
    }

    fn check_weights(&self, missing: Hypothesis) -> Result<(), Refusal> {
        let signs: Vec<Ordering> = self.weights.values().map(Scalar::cmp_zero).collect();
        let wanted = if missing == Hypothesis::PositiveWeights {
            signs.contains(&Ordering::Less) && !signs.contains(&Ordering::Equal)
        } else {
            signs.iter().all(|s| *s == Ordering::Greater)
        };
        if wanted {
            return Ok(());
        }
        Err(Refusal::untrue(
            format!("the weights have the signs of a case where {missing:?} is missing"),
            format!("{signs:?}"),
        ))
    }

    /// The surface or the graph is what the statement needs.
    fn check_shape(&self, missing: Hypothesis) -> Result<(), Refusal> {
        let inner = |[a, b]: &[usize; 2]| self.is_inside(*a) || self.is_inside(*b);
        if missing == Hypothesis::ThreeConnected {
            return self.check_loosely_connected();
        }
        let edges = self.edges();
        if !edges.iter().filter(|e| inner(e)).eq(self.weights.keys()) {
            return Err(Refusal::untrue(
                "every edge of a face with an end inside has a weight, and no other",
                "not so",
            ));
        }
        self.check_surface(&edges)?;
        let euler = self.at.len() as i64 - edges.len() as i64 + self.faces.len() as i64;
        if (euler == 1) == (missing == Hypothesis::Disc) {
            return Err(Refusal::untrue("the Euler number is that of the shape stated", euler.to_string()));
        }
        let polygon: BTreeSet<[usize; 2]> = self.sides().map(|[a, b]| [a.min(b), a.max(b)]).collect();
        let chords: Vec<&[usize; 2]> = edges.iter().filter(|e| !inner(e) && !polygon.contains(*e)).collect();
        let on_a_side = |e: &[usize; 2]| {
            self.sides().any(|[a, b]| e.iter().all(|&v| self.area(a, b, v).cmp_zero() == Ordering::Equal))
        };
        let fits = match missing {
            Hypothesis::ConvexBoundary => chords.is_empty(),
            Hypothesis::NoChordOnASide => chords.iter().any(|e| on_a_side(e)),
            _ => true,
        };
        if fits {
            Ok(())
        } else {
            Err(Refusal::untrue(format!("the chords are those of a case without {missing:?}"), format!("{chords:?}")))
        }
    }

    /// One or two faces at each edge, one exactly at those of the polygon; the faces at a vertex form one fan; all vertices
    /// are used and hang together. Where it is a disc, orientations agree and follow the polygon.
    fn check_surface(&self, edges: &BTreeSet<[usize; 2]>) -> Result<(), Refusal> {
        let polygon: BTreeSet<[usize; 2]> = self.sides().map(|[a, b]| [a.min(b), a.max(b)]).collect();
        for e in edges {
            let faces = self.faces.iter().filter(|f| f.contains(&e[0]) && f.contains(&e[1])).count();
            if faces != if polygon.contains(e) { 1 } else { 2 } {
                return Err(Refusal::untrue(
                    "the faces form a surface with the polygon as its boundary",
                    format!("{faces} faces at {e:?}"),
                ));
            }
        }
        for v in 0..self.at.len() {
            let at: Vec<&[usize; 3]> = self.faces.iter().filter(|f| f.contains(&v)).collect();
            let share = |f: &[usize; 3], g: &[usize; 3]| f.iter().any(|&w| w != v && g.contains(&w));
            if !hangs_together(at.len(), |i, j| share(at[i], at[j])) {
                return Err(Refusal::untrue("the faces at a vertex form one fan", format!("not at vertex {v}")));
            }
        }
        if hangs_together(self.at.len(), |i, j| edges.contains(&[i.min(j), i.max(j)])) {
            return Ok(());
        }
        Err(Refusal::untrue("the surface is connected", "it is not"))
    }

    /// At most four vertices, connected, and no longer so without one or two of them.
    fn check_loosely_connected(&self) -> Result<(), Refusal> {
        let n = self.at.len();
        let another = || {
            let stated = "the graph has at most four vertices, is connected and not 3-connected";
            Err(Refusal::untrue(stated, "it is another one"))
        };
        if n > 4 || !self.faces.is_empty() {
            return another();
        }
        let edges = self.edges();
        let joined = |a: usize, b: usize| edges.contains(&[a.min(b), a.max(b)]);
        let without = |gone: &[usize]| {
            let left: Vec<usize> = (0..n).filter(|v| !gone.contains(v)).collect();
            hangs_together(left.len(), |i, j| joined(left[i], left[j]))
        };
        let separated = (0..n).any(|a| (0..n).any(|b| !without(&[a, b])));
        if without(&[]) && separated { Ok(()) } else { another() }
    }

    fn check_fault(&self, missing: Hypothesis, fault: &Fault) -> Result<(), Refusal> {
        match fault {
            Fault::Face { face } if !matches!(missing, Hypothesis::Disc | Hypothesis::ThreeConnected) => {
                self.check_oriented()?;
                let Some(&[a, b, c]) = self.faces.get(*face) else {
                    return Err(Refusal::Missing { what: "face", index: *face });
                };
                let area = self.area(a, b, c);
                if area.cmp_zero() == Ordering::Greater {
                    return Err(Refusal::untrue(format!("face {face} is not counter-clockwise"), written(&area)));
                }
                Ok(())
            }
            Fault::Edge { a, b } if missing == Hypothesis::ThreeConnected => {
                let edge = a < b && self.weights.contains_key(&[*a, *b]);
                if edge && minus(&self.at[*a], &self.at[*b]).iter().all(|x| x.cmp_zero() == Ordering::Equal) {
                    return Ok(());
                }
                Err(Refusal::untrue(format!("the ends of the edge ({a}, {b}) coincide"), "they do not"))
            }
            Fault::Overlap { faces, polygon } if missing == Hypothesis::Disc => {
                let areas = self.faces.iter().map(|f| self.area(f[0], f[1], f[2]).magnitude());
                let total = areas.fold(Rational::zero(), |sum, a| (sum + a).reduced());
                let enclosed = self.polygon();
                check_exact("twice the area of the faces", faces, &total)?;
                check_exact("twice the area of the polygon", polygon, &enclosed)?;
                if total > enclosed {
                    return Ok(());
                }
                Err(Refusal::untrue("the faces have more area than the polygon", faces.as_str()))
            }
            _ => Err(Refusal::untrue(format!("the fault shows what {missing:?} is needed for"), format!("{fault:?}"))),
        }
    }

    /// The faces agree in orientation, and the polygon runs around them with the faces on its left.
    fn check_oriented(&self) -> Result<(), Refusal> {
        let directed: Vec<[usize; 2]> =
            self.faces.iter().flat_map(|f| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]]).collect();
        let once: BTreeSet<&[usize; 2]> = directed.iter().collect();
        if once.len() == directed.len() && self.sides().all(|s| once.contains(&s)) {
            return Ok(());
        }
        Err(Refusal::untrue("the faces are oriented as the polygon runs", "they are not"))
    }
}

/// Whether `0..n` hang together by the pairs that are joined.
fn hangs_together(n: usize, joined: impl Fn(usize, usize) -> bool) -> bool {
    let (mut reached, mut queue) = (BTreeSet::from([0]), vec![0]);
    while let Some(i) = queue.pop() {
        for j in 0..n {
            if joined(i, j) && reached.insert(j) {
                queue.push(j);
            }
        }
    }
    n == 0 || reached.len() == n
}

/// Reads `p` or `p/q`, in lowest terms.
fn read(index: usize, text: &str) -> Result<Rational, Refusal> {
    let malformed = |problem| Refusal::Malformed { what: "drawn position", index, problem };
    if text.len() > 10_000 {
        return Err(malformed("is too long"));
    }
    let (p, q) = text.split_once('/').unwrap_or((text, "1"));
    let (Ok(p), Ok(q)) = (IBig::from_str(p), IBig::from_str(q)) else {
        return Err(malformed("is no fraction"));
    };
    if q <= IBig::ZERO {
        return Err(malformed("has a denominator that is not positive"));
    }
    let value = fraction(p, q);
    if written(&value) == text { Ok(value) } else { Err(malformed("is not in lowest terms")) }
}
