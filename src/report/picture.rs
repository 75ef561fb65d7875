//! The picture of an exhibit: its mesh or graph with what the witness points at.

use std::collections::{BTreeMap, BTreeSet};

use super::drawing::{Class, Drawing, Mark, Point, SHADES, STEPS, Shape, step};
use super::highlight::Highlight;
use super::number::{degrees, number};
use super::reciprocal;
use super::view::View;
use crate::record::Exhibit;

/// A picture, and what a reader should know of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The marks.
    pub drawing: Drawing,
    /// Faces (edges of a graph) left out because only the neighbourhood is drawn.
    pub left_out: usize,
}

/// The most faces or edges in a picture: beyond, only the neighbourhood of the witness is drawn.
const MOST: usize = 700;
const WIDTH: f64 = 400.0;
const TALLEST: f64 = 320.0;
const MARGIN: f64 = 24.0;

/// Draws an exhibit. `None` where it has nothing to draw.
pub fn picture(exhibit: &Exhibit, highlight: &Highlight) -> Option<Picture> {
    let focus = highlight.focus();
    let (faces, edges, left_out) = neighbourhood(exhibit, &focus);
    let named = exhibit.faces.iter().flatten().chain(exhibit.edges.iter().flatten()).copied().max();
    let vertices = named.map_or(0, |v| v + 1).max(exhibit.positions.len());
    if vertices == 0 {
        return None;
    }
    let view = View::of(&exhibit.positions, &exhibit.faces, vertices, &focus);
    let mut shown: BTreeSet<usize> =
        faces.iter().flat_map(|f| f.iter()).chain(edges.iter().flatten()).copied().collect();
    match shown.is_empty() {
        true => shown.extend(0..vertices.min(MOST)),
        false => shown.extend(focus.iter().copied().filter(|v| *v < vertices)),
    }
    let frame = Frame::of(&view, &shown, !highlight.values.is_empty());
    let mut artist = Artist { exhibit, highlight, view: &view, frame, shown, marks: Vec::new() };
    artist.edges(&edges, faces.is_empty());
    artist.faces_and_values(&faces);
    artist.witness();
    let Artist { frame, marks, .. } = artist;
    Some(Picture { drawing: Drawing { width: WIDTH, height: frame.height, marks }, left_out })
}

/// The faces and edges to draw: all, or the nearest to the focus ring by ring.
fn neighbourhood<'a>(exhibit: &'a Exhibit, focus: &[usize]) -> (Vec<&'a [usize]>, Vec<[usize; 2]>, usize) {
    let faces: Vec<&[usize]> = exhibit.faces.iter().map(Vec::as_slice).collect();
    let edges: Vec<&[usize]> = exhibit.edges.iter().map(|e| e.as_slice()).collect();
    let all = if faces.is_empty() { &edges } else { &faces };
    let kept = if all.len() <= MOST { (0..all.len()).collect() } else { nearest(all, focus) };
    let left_out = all.len() - kept.len();
    if faces.is_empty() {
        return (Vec::new(), kept.iter().map(|&k| exhibit.edges[k]).collect(), left_out);
    }
    (kept.iter().map(|&k| faces[k]).collect(), Vec::new(), left_out)
}

fn nearest(elements: &[&[usize]], focus: &[usize]) -> Vec<usize> {
    let mut at: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (k, element) in elements.iter().enumerate() {
        element.iter().for_each(|v| at.entry(*v).or_default().push(k));
    }
    let mut kept = BTreeSet::new();
    let mut front: Vec<usize> = if focus.is_empty() {
        elements.iter().find_map(|e| e.first()).copied().into_iter().collect()
    } else {
        focus.to_vec()
    };
    let mut met: BTreeSet<usize> = front.iter().copied().collect();
    while kept.len() < MOST && !front.is_empty() {
        let mut next = Vec::new();
        for k in front.iter().filter_map(|v| at.get(v)).flatten() {
            if kept.len() < MOST && kept.insert(*k) {
                next.extend(elements[*k].iter().copied().filter(|v| met.insert(*v)));
            }
        }
        front = next;
    }
    kept.into_iter().collect()
}

/// The map from the view to the paper.
struct Frame {
    scale: f64,
    origin: Point,
    height: f64,
    bottom: f64,
}

impl Frame {
    fn of(view: &View, shown: &BTreeSet<usize>, legend: bool) -> Self {
        let span = |k: usize| {
            let coordinates = shown.iter().filter_map(|&v| view.at.get(v)).map(|p| p[k]);
            coordinates.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
        };
        let ((left, right), (low, high)) = (span(0), span(1));
        let (wide, tall) = ((right - left).max(f64::MIN_POSITIVE), high - low);
        let inner = (WIDTH - 2.0 * MARGIN, TALLEST - 2.0 * MARGIN);
        let scale = (inner.0 / wide).min(if tall > 0.0 { inner.1 / tall } else { f64::INFINITY });
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let bottom = tall * scale + 2.0 * MARGIN;
        let origin = [(WIDTH - wide * scale) / 2.0 - left * scale, MARGIN + high * scale];
        Frame { scale, origin, height: bottom + if legend { 40.0 } else { 0.0 }, bottom }
    }

    fn place(&self, p: Point) -> Point {
        [self.origin[0] + p[0] * self.scale, self.origin[1] - p[1] * self.scale]
    }
}

struct Artist<'a> {
    exhibit: &'a Exhibit,
    highlight: &'a Highlight,
    view: &'a View,
    frame: Frame,
    shown: BTreeSet<usize>,
    marks: Vec<Mark>,
}

impl Artist<'_> {
    fn mark(&mut self, class: Class, shape: Shape) {
        self.marks.push(Mark { class, shape });
    }

    fn at(&self, v: usize) -> Option<Point> {
        self.shown.contains(&v).then(|| self.view.at.get(v).map(|p| self.frame.place(*p))).flatten()
    }

    fn path(&self, ends: &[usize]) -> Option<Vec<Point>> {
        ends.iter().map(|v| self.at(*v)).collect()
    }

    /// The faces from back to front, each vertex with a value right after the nearest of its faces.
    fn faces_and_values(&mut self, faces: &[&[usize]]) {
        let depth = |f: &[usize]| f.iter().map(|&v| self.view.depth[v]).sum::<f64>() / f.len().max(1) as f64;
        let mut marks: Vec<(f64, Mark)> = Vec::new();
        let mut nearest: BTreeMap<usize, f64> = BTreeMap::new();
        for face in faces {
            let depth = depth(face);
            for v in face.iter() {
                nearest.entry(*v).and_modify(|d| *d = d.max(depth)).or_insert(depth);
            }
            marks.extend(self.face(face).map(|mark| (depth, mark)));
        }
        for (v, mark) in self.values() {
            marks.push((nearest.get(&v).copied().unwrap_or(f64::INFINITY), mark));
        }
        marks.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.marks.extend(marks.into_iter().map(|m| m.1));
    }

    fn face(&self, face: &[usize]) -> Option<Mark> {
        let star = face.iter().any(|v| self.highlight.stars.contains(v));
        let shade = (self.view.light(&self.exhibit.positions, face) * f64::from(SHADES - 1)).round() as u8;
        let class = if star { Class::Star } else { Class::Face(shade) };
        self.path(face).map(|outline| Mark { class, shape: Shape::Polygon(outline) })
    }

    /// The vertices with a value.
    fn values(&self) -> Vec<(usize, Mark)> {
        let h = self.highlight;
        let radius = if self.shown.len() > 200 { 3.0 } else { 5.5 };
        let disc = |&(v, value): &(usize, f64)| {
            let bigger = if h.vertices.contains(&v) { 2.0 } else { 0.0 };
            let class = Class::Value(step(value, self.largest()));
            self.at(v).map(|at| (v, Mark { class, shape: Shape::Disc(at, radius + bigger) }))
        };
        h.values.iter().filter_map(disc).collect()
    }

    /// The largest magnitude of a value.
    fn largest(&self) -> f64 {
        self.highlight.values.iter().map(|v| v.1.abs()).filter(|a| a.is_finite()).fold(0.0, f64::max)
    }

    /// The edges of a graph, with its vertices. On a mesh the outlines of the faces are the edges.
    fn edges(&mut self, edges: &[[usize; 2]], graph: bool) {
        for edge in edges {
            if let Some(path) = self.path(edge) {
                self.mark(Class::Edge, Shape::Chain(path));
            }
        }
        if graph {
            let radius = if self.shown.len() > 60 { 2.0 } else { 3.5 };
            for v in self.shown.clone() {
                if let Some(at) = self.at(v) {
                    self.mark(Class::Vertex, Shape::Disc(at, radius));
                }
            }
        }
    }

    fn witness(&mut self) {
        let h = self.highlight;
        let lines = [(Class::Good, &h.good), (Class::Bad, &h.bad), (Class::Pair, &h.pairs)];
        for (class, ends) in lines.into_iter().flat_map(|(class, list)| list.iter().map(move |e| (class, e))) {
            if let Some(path) = self.path(ends) {
                self.mark(class, Shape::Chain(path));
            }
        }
        h.angles.iter().for_each(|&(v, a, b, angle)| self.angle(v, a, b, angle));
        let exhibit = self.exhibit;
        reciprocal::dual(exhibit, &h.lift).into_iter().for_each(|ends| self.segment(Class::Dual, ends, false));
        reciprocal::arrows(exhibit, &h.arrows).into_iter().for_each(|ends| self.segment(Class::Arrow, ends, true));
        if !h.values.is_empty() {
            self.legend(self.largest());
        }
        for &v in h.vertices.iter().filter(|v| !h.values.iter().any(|(w, _)| w == *v)) {
            if let Some(at) = self.at(v) {
                self.mark(Class::Focus, Shape::Disc(at, 4.5));
            }
        }
        h.focus().into_iter().take(12).for_each(|v| self.label(v));
    }

    /// A segment between points of the mesh's plane, with or without a head at its end; left out where it leaves the paper.
    fn segment(&mut self, class: Class, ends: [Point; 2], head: bool) {
        let [tail, tip] = ends.map(|p| self.frame.place(p));
        let (width, height) = (WIDTH, self.frame.height);
        let on_paper = |p: Point| (0.0..=width).contains(&p[0]) && (0.0..=height).contains(&p[1]);
        if !on_paper(tail) || !on_paper(tip) {
            return;
        }
        self.mark(class, Shape::Chain(vec![tail, tip]));
        let (dx, dy) = (tip[0] - tail[0], tip[1] - tail[1]);
        let length = dx.hypot(dy);
        if head && length > 3.0 {
            let size = 7.0_f64.min(0.5 * length) / length;
            let barb = |side: f64| [tip[0] - size * (dx + side * dy), tip[1] - size * (dy - side * dx)];
            let barbs = [barb(0.5), tip, barb(-0.5)];
            if barbs.into_iter().all(on_paper) {
                self.mark(class, Shape::Chain(barbs.to_vec()));
            }
        }
    }

    /// An arc at a corner with its angle; only where the paper shows it true.
    fn angle(&mut self, v: usize, a: usize, b: usize, angle: f64) {
        let (Some(at), Some(a), Some(b)) = (self.at(v), self.at(a), self.at(b)) else { return };
        let arm = |p: Point| [p[0] - at[0], p[1] - at[1]];
        let length = |p: Point| p[0].hypot(p[1]);
        let (a, b) = (arm(a), arm(b));
        let radius = 22.0_f64.min(0.4 * length(a)).min(0.4 * length(b));
        let start = a[1].atan2(a[0]);
        let turn = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
        let on_arc = |t: f64, r: f64| [at[0] + r * (start + t * turn).cos(), at[1] + r * (start + t * turn).sin()];
        if self.view.planar && radius > 1.0 {
            self.mark(Class::Angle, Shape::Chain((0..=12).map(|k| on_arc(f64::from(k) / 12.0, radius)).collect()));
        }
        let [x, y] = on_arc(0.5, radius + 15.0);
        self.mark(Class::Small, Shape::Text([x, y + 4.0], degrees(angle)));
    }

    fn legend(&mut self, largest: f64) {
        let (left, top, box_width) = (WIDTH / 2.0 - 81.0, self.frame.bottom + 2.0, 18.0);
        for k in 0..STEPS {
            let x = left + f64::from(k) * box_width;
            let corners = [[x, top], [x + box_width, top], [x + box_width, top + 10.0], [x, top + 10.0]];
            self.mark(Class::Value(k), Shape::Polygon(corners.to_vec()));
        }
        let ends = [(0.0, number(-largest)), (4.5, "0".into()), (9.0, number(largest))];
        for (k, text) in ends {
            self.mark(Class::Small, Shape::Text([left + k * box_width, top + 24.0], text));
        }
    }

    /// The number of a vertex, away from the middle of the picture.
    fn label(&mut self, v: usize) {
        let Some([x, y]) = self.at(v) else { return };
        let middle = [WIDTH / 2.0, self.frame.bottom / 2.0];
        let (dx, dy) = (x - middle[0], y - middle[1]);
        let away = dx.hypot(dy).max(1e-9);
        let (dx, dy) = if away < 1.0 { (0.0, -1.0) } else { (dx / away, dy / away) };
        let at =
            [(x + 14.0 * dx).clamp(10.0, WIDTH - 10.0), (y + 14.0 * dy + 4.5).clamp(12.0, self.frame.bottom - 3.0)];
        self.mark(Class::Label, Shape::Text(at, v.to_string()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(n: usize) -> Exhibit {
        let squares = (0..n * n).filter(|k| k % n + 1 < n && k / n + 1 < n);
        Exhibit {
            laplacian: "cotan".into(),
            property: "POS".into(),
            recipe: format!("grid(n={n})"),
            positions: (0..n * n).map(|k| [(k % n) as f64, (k / n) as f64, 0.0]).collect(),
            faces: squares.flat_map(|k| [vec![k, k + 1, k + n + 1], vec![k, k + n + 1, k + n]]).collect(),
            edges: Vec::new(),
        }
    }

    fn count(picture: &Picture, class: Class) -> usize {
        picture.drawing.marks.iter().filter(|m| m.class == class).count()
    }

    #[test]
    fn of_a_large_mesh_only_the_neighbourhood_of_the_witness_is_drawn() {
        let highlight = Highlight { bad: vec![[1275, 1276]], ..Highlight::default() };
        let picture = picture(&grid(50), &highlight).unwrap();
        assert_eq!(picture.left_out, 2 * 49 * 49 - MOST);
        assert_eq!((count(&picture, Class::Face(SHADES - 1)), count(&picture, Class::Bad)), (MOST, 1));
    }

    #[test]
    fn every_mark_lies_on_the_paper() {
        let highlight = Highlight { values: vec![(0, 1.0), (24, -0.5)], vertices: vec![24], ..Highlight::default() };
        let picture = picture(&grid(5), &highlight).unwrap();
        let Drawing { width, height, marks } = picture.drawing;
        for mark in marks {
            let points = match mark.shape {
                Shape::Polygon(p) | Shape::Chain(p) => p,
                Shape::Disc(p, _) | Shape::Text(p, _) => vec![p],
            };
            assert!(
                points.iter().all(|p| (0.0..=width).contains(&p[0]) && (0.0..=height).contains(&p[1])),
                "{points:?}"
            );
        }
    }

    #[test]
    fn an_exhibit_whose_witness_names_a_vertex_that_is_not_there_is_drawn_without_it() {
        let highlight = Highlight { bad: vec![[3, 999]], vertices: vec![999], ..Highlight::default() };
        assert_eq!(count(&picture(&grid(3), &highlight).unwrap(), Class::Bad), 0);
    }
}
