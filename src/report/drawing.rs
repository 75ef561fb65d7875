//! A picture as a list of marks in float coordinates, for the SVG and the PNG writer alike.

/// A point of the picture: x to the right, y downwards.
pub type Point = [f64; 2];

/// A picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
    /// The marks, each over the ones before.
    pub marks: Vec<Mark>,
}

/// A shape and what it stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// What it stands for.
    pub class: Class,
    /// Its shape.
    pub shape: Shape,
}

/// A shape.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A closed polygon.
    Polygon(Vec<Point>),
    /// A chain of segments.
    Chain(Vec<Point>),
    /// A disc by centre and radius.
    Disc(Point, f64),
    /// A text by the middle of its baseline.
    Text(Point, String),
}

/// What a mark stands for; its paint follows from that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// A face; 0 is turned away from the light, [`SHADES`] − 1 towards it.
    Face(u8),
    /// A face of the star of a marked vertex.
    Star,
    /// An edge.
    Edge,
    /// An edge at fault.
    Bad,
    /// An edge to tell from it.
    Good,
    /// A pair without an edge.
    Pair,
    /// An angle.
    Angle,
    /// A vertex.
    Vertex,
    /// A vertex at fault.
    Focus,
    /// An edge of a dual graph.
    Dual,
    /// An arrow of a motion.
    Arrow,
    /// A vertex with a value; [`STEPS`] steps from negative to positive, the middle one zero.
    Value(u8),
    /// A label.
    Label,
    /// A small label.
    Small,
}

/// Number of shades of a face.
pub const SHADES: u8 = 6;

/// Number of colours for values, odd: the middle one is zero.
pub const STEPS: u8 = 9;

/// How a class is painted on paper and on a white screen; a style sheet may say otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paint {
    /// The fill as `[red, green, blue]`.
    pub fill: Option<[u8; 3]>,
    /// The stroke.
    pub stroke: Option<[u8; 3]>,
    /// The width of the stroke.
    pub width: f64,
    /// The lengths of dash and gap.
    pub dash: Option<(f64, f64)>,
}

const INK: [u8; 3] = [29, 36, 48];
const ORANGE: [u8; 3] = [196, 78, 0];
const BLUE: [u8; 3] = [31, 95, 168];
const LINE: [u8; 3] = [138, 149, 164];

impl Class {
    /// The paint of the class.
    pub fn paint(self) -> Paint {
        let of = |fill, stroke, width| Paint { fill, stroke, width, dash: None };
        match self {
            Class::Face(shade) => of(Some(between([196, 206, 219], [241, 244, 248], shade, SHADES)), Some(LINE), 0.7),
            Class::Star => of(Some([253, 228, 203]), Some(LINE), 0.7),
            Class::Edge => of(None, Some(LINE), 0.9),
            Class::Bad => of(None, Some(ORANGE), 3.0),
            Class::Good => of(None, Some(BLUE), 3.0),
            Class::Pair => Paint { dash: Some((5.0, 4.0)), ..of(None, Some(ORANGE), 2.2) },
            Class::Dual => of(None, Some(BLUE), 1.4),
            Class::Arrow => of(None, Some(ORANGE), 2.0),
            Class::Angle => of(None, Some(INK), 1.0),
            Class::Vertex => of(Some(LINE), None, 0.0),
            Class::Focus => of(Some(ORANGE), Some([255, 255, 255]), 1.2),
            Class::Value(step) => of(Some(diverging(step)), Some(INK), 0.8),
            Class::Label | Class::Small => of(Some(INK), None, 0.0),
        }
    }

    /// The name of the class in a style sheet.
    pub fn name(self) -> String {
        match self {
            Class::Face(shade) => format!("f{shade}"),
            Class::Value(step) => format!("v{step}"),
            Class::Star => "star".into(),
            Class::Edge => "edge".into(),
            Class::Bad => "bad".into(),
            Class::Good => "good".into(),
            Class::Pair => "pair".into(),
            Class::Dual => "dual".into(),
            Class::Arrow => "arrow".into(),
            Class::Angle => "angle".into(),
            Class::Vertex => "vertex".into(),
            Class::Focus => "focus".into(),
            Class::Label => "label".into(),
            Class::Small => "small".into(),
        }
    }

    /// The size of a text of this class.
    pub fn text_size(self) -> f64 {
        if self == Class::Small { 10.5 } else { 13.0 }
    }
}

/// The step of a value between `−largest` and `largest`. A value that is not zero never has the colour of zero.
pub fn step(value: f64, largest: f64) -> u8 {
    let half = f64::from(STEPS / 2);
    if value == 0.0 || largest <= 0.0 || !value.is_finite() {
        return STEPS / 2;
    }
    let away = (value / largest * half).abs().round().clamp(1.0, half);
    (half + away.copysign(value)) as u8
}

/// Orange for negative, white for zero, blue for positive: told apart by everyone.
fn diverging(step: u8) -> [u8; 3] {
    let middle = STEPS / 2;
    match step < middle {
        true => between([179, 88, 6], [247, 247, 247], step, middle + 1),
        false => between([247, 247, 247], [33, 102, 172], step.min(STEPS - 1) - middle, middle + 1),
    }
}

fn between(from: [u8; 3], to: [u8; 3], at: u8, of: u8) -> [u8; 3] {
    let t = f64::from(at) / f64::from(of.saturating_sub(1).max(1));
    std::array::from_fn(|k| (f64::from(from[k]) + t * (f64::from(to[k]) - f64::from(from[k]))).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_next_to_zero_is_not_painted_as_zero() {
        assert_eq!(step(0.0, 1.0), STEPS / 2);
        assert_eq!(step(-1e-9, 1.0), STEPS / 2 - 1);
        assert_eq!((step(-1.0, 1.0), step(1.0, 1.0)), (0, STEPS - 1));
        assert_eq!(diverging(STEPS / 2), [247, 247, 247]);
    }
}
