//! A drawing as SVG with float coordinates: one `<path>` for each run of marks of a class, painted by presentation
//! attributes so that it reads without a style sheet, with class names so that a style sheet can repaint it.

use std::fmt::Write as _;

use super::drawing::{Class, Drawing, Mark, Point, Shape};

/// The SVG element; `title` is what a screen reader says.
pub fn svg(drawing: &Drawing, title: &str) -> String {
    let (width, height) = (short(drawing.width), short(drawing.height));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"mesh\" role=\"img\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\"><title>{}</title>",
        escape(title)
    );
    let mut marks = drawing.marks.as_slice();
    while let Some(first) = marks.first() {
        let run = marks.iter().take_while(|m| m.class == first.class).count();
        let (now, later) = marks.split_at(run);
        write_run(&mut out, first.class, now);
        marks = later;
    }
    out + "</svg>"
}

fn write_run(out: &mut String, class: Class, marks: &[Mark]) {
    let mut path = String::new();
    for mark in marks {
        match &mark.shape {
            Shape::Polygon(points) => {
                polyline(&mut path, points);
                path.push('Z');
            }
            Shape::Chain(points) => polyline(&mut path, points),
            Shape::Disc([x, y], r) => {
                let (left, r, d) = (short(x - r), short(*r), short(2.0 * r));
                let _ = write!(path, "M{left} {}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0Z", short(*y));
            }
            Shape::Text(at, text) => write_text(out, class, *at, text),
        }
    }
    if !path.is_empty() {
        let _ = write!(out, "<path class=\"{}\"{} d=\"{path}\"/>", class.name(), attributes(class));
    }
}

fn write_text(out: &mut String, class: Class, [x, y]: Point, text: &str) {
    let _ = write!(
        out,
        "<text class=\"{}\" x=\"{}\" y=\"{}\" font-size=\"{}\" font-family=\"sans-serif\" text-anchor=\"middle\" \
         fill=\"currentColor\">{}</text>",
        class.name(),
        short(x),
        short(y),
        short(class.text_size()),
        escape(text)
    );
}

fn polyline(path: &mut String, points: &[Point]) {
    for (k, [x, y]) in points.iter().enumerate() {
        let _ = write!(path, "{}{} {}", if k == 0 { 'M' } else { 'L' }, short(*x), short(*y));
    }
}

fn attributes(class: Class) -> String {
    let paint = class.paint();
    let colour = |c: Option<[u8; 3]>| c.map_or("none".into(), |[r, g, b]| format!("#{r:02x}{g:02x}{b:02x}"));
    let mut out = format!(" fill=\"{}\" stroke=\"{}\"", colour(paint.fill), colour(paint.stroke));
    if paint.stroke.is_some() {
        let _ =
            write!(out, " stroke-width=\"{}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"", short(paint.width));
    }
    if let Some((dash, gap)) = paint.dash {
        let _ = write!(out, " stroke-dasharray=\"{} {}\"", short(dash), short(gap));
    }
    out
}

/// A coordinate with two decimals at most.
fn short(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// Escapes text for XML.
pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
