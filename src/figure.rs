//! Figures as data: charts and sketches that a finding carries, to be drawn by a report.
//!
//! A figure knows nothing of pixels, colours or files. It holds the numbers a reader would want to read off, so that drawing a
//! record again needs no mathematics.

use serde::{Deserialize, Serialize};

/// Something to look at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Figure {
    /// Numbers over numbers.
    Chart(Chart),
    /// A mesh or a graph in the plane.
    Sketch(Sketch),
}

/// Named series of points over two axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chart {
    /// What it shows, in a sentence without its full stop.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The series, in the order of the legend.
    pub series: Vec<Series>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// The quantity, with its unit if it has one.
    pub label: String,
    /// Whether equal steps are equal factors. Points that are not positive are then left out of the drawing.
    pub logarithmic: bool,
}

impl Axis {
    /// An axis on which equal steps are equal differences.
    pub fn linear(label: impl Into<String>) -> Self {
        Axis { label: label.into(), logarithmic: false }
    }

    /// An axis on which equal steps are equal factors.
    pub fn logarithmic(label: impl Into<String>) -> Self {
        Axis { label: label.into(), logarithmic: true }
    }
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// The name in the legend.
    pub name: String,
    /// The points `[x, y]`, in the order in which a line joins them.
    pub points: Vec<[f64; 2]>,
    /// How they are marked.
    pub mark: Mark,
}

impl Series {
    /// A series of the points that are finite: a record cannot hold others.
    pub fn new(name: impl Into<String>, mark: Mark, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let points = points.into_iter().filter(|p| p.iter().all(|x| x.is_finite())).collect();
        Series { name: name.into(), points, mark }
    }
}

/// How a series is marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mark {
    /// A dot for each point.
    Dots,
    /// A line through the points.
    Line,
    /// Dots, joined by a line.
    Both,
    /// A dashed line: a slope or a closed form to compare with.
    Reference,
}

/// A mesh or a graph with values at its vertices or edges that stand out; a surface in space is seen from the side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sketch {
    /// What it shows, in a sentence without its full stop.
    pub title: String,
    /// The places of the vertices; in the plane where the third coordinate is zero.
    pub points: Vec<[f64; 3]>,
    /// The faces, by vertices.
    pub faces: Vec<Vec<usize>>,
    /// The edges that are drawn besides those of the faces.
    pub edges: Vec<[usize; 2]>,
    /// Empty, or a value for each vertex, shown as a colour.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<f64>,
    /// The edges drawn bold.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub marked: Vec<[usize; 2]>,
}

impl Sketch {
    /// A graph with its vertices on a circle, the first on the right, counter-clockwise.
    pub fn of_graph(title: impl Into<String>, vertices: usize, edges: &[[usize; 2]]) -> Self {
        let turn = |v: usize| std::f64::consts::TAU * v as f64 / vertices as f64;
        let points = (0..vertices).map(|v| [turn(v).cos(), turn(v).sin(), 0.0]).collect();
        Sketch {
            title: title.into(),
            points,
            faces: Vec::new(),
            edges: edges.to_vec(),
            values: Vec::new(),
            marked: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_keeps_what_a_record_can_hold() {
        let points = [[1.0, 2.0], [f64::NAN, 1.0], [3.0, f64::INFINITY], [0.0, -0.0]];
        assert_eq!(Series::new("s", Mark::Dots, points).points, [[1.0, 2.0], [0.0, -0.0]]);
    }

    #[test]
    fn a_figure_survives_json() {
        let sketch = Sketch::of_graph("a triangle", 3, &[[0, 1], [1, 2], [0, 2]]);
        let series = vec![Series::new("h²", Mark::Reference, [[1.0, 1.0], [2.0, 4.0]])];
        let chart = Chart { title: "order".into(), x: Axis::logarithmic("h"), y: Axis::linear("error"), series };
        for figure in [Figure::Sketch(sketch), Figure::Chart(chart)] {
            let text = serde_json::to_string(&figure).unwrap();
            assert_eq!(serde_json::from_str::<Figure>(&text).unwrap(), figure, "{text}");
        }
    }
}
