//! Pictures as PNG: a drawing is painted at three times its size and shrunk, for smooth lines; fonts are embedded.

use std::io::Write as _;

use flate2::{Compression, Crc, write::ZlibEncoder};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::drawing::{Class, Drawing, Mark, Point, Shape};
use super::plot::{PlotError, fonts};

/// How much larger a drawing is painted before it is shrunk.
const OVERSAMPLING: u32 = 3;

/// An image of 8-bit red, green, blue.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Row by row from the top, three bytes a pixel.
    pub pixels: Vec<u8>,
}

/// A drawing as a PNG file on white, `scale` pixels a unit.
///
/// # Errors
/// What the painter refuses.
pub fn drawing(drawing: &Drawing, scale: u32) -> Result<Vec<u8>, PlotError> {
    fonts();
    let factor = f64::from(scale.clamp(1, 8) * OVERSAMPLING);
    let side = |x: f64| ((x * f64::from(scale.clamp(1, 8))).ceil() as u32).clamp(1, 8192) * OVERSAMPLING;
    let (width, height) = (side(drawing.width), side(drawing.height));
    let mut image = Image { width, height, pixels: vec![255; 3 * width as usize * height as usize] };
    {
        let area = BitMapBackend::with_buffer(&mut image.pixels, (width, height)).into_drawing_area();
        drawing.marks.iter().try_for_each(|mark| paint(&area, mark, factor))?;
        area.present().map_err(PlotError::of)?;
    }
    Ok(encode(&shrunk(&image)))
}

fn paint<B: DrawingBackend>(
    area: &DrawingArea<B, plotters::coord::Shift>,
    mark: &Mark,
    factor: f64,
) -> Result<(), PlotError> {
    let pixel = |p: &Point| ((p[0] * factor).round() as i32, (p[1] * factor).round() as i32);
    let paint = mark.class.paint();
    let colour = |[r, g, b]: [u8; 3]| RGBColor(r, g, b);
    let stroke = |c: [u8; 3]| colour(c).stroke_width((paint.width * factor).round().max(1.0) as u32);
    let fill = |points: Vec<(i32, i32)>| match paint.fill {
        Some(c) => area.draw(&Polygon::new(points, colour(c).filled())).map_err(PlotError::of),
        None => Ok(()),
    };
    let outline = |points: Vec<(i32, i32)>| match (paint.stroke, paint.dash) {
        (Some(c), None) => area.draw(&PathElement::new(points, stroke(c))).map_err(PlotError::of),
        (Some(c), Some((dash, gap))) => {
            let (dash, gap) = ((dash * factor) as u32, (gap * factor) as u32);
            area.draw(&DashedPathElement::new(points, dash.max(1), gap.max(1), stroke(c))).map_err(PlotError::of)
        }
        (None, _) => Ok(()),
    };
    match &mark.shape {
        Shape::Polygon(points) => {
            let mut ring: Vec<_> = points.iter().map(pixel).collect();
            fill(ring.clone())?;
            ring.extend(ring.first().copied());
            outline(ring)
        }
        Shape::Chain(points) => outline(points.iter().map(pixel).collect()),
        Shape::Disc(centre, r) => {
            let turn = |k: i32| f64::from(k) * std::f64::consts::TAU / 48.0;
            let ring = |k: i32| pixel(&[centre[0] + r * turn(k).cos(), centre[1] + r * turn(k).sin()]);
            fill((0..48).map(ring).collect())?;
            outline((0..=48).map(ring).collect())
        }
        Shape::Text(at, text) => {
            let size = mark.class.text_size() * factor;
            let ink = colour(Class::Label.paint().fill.unwrap_or_default());
            let style = ("sans-serif", size).into_font().color(&ink).pos(Pos::new(HPos::Center, VPos::Bottom));
            area.draw(&Text::new(text.as_str(), pixel(at), style)).map_err(PlotError::of)
        }
    }
}

/// Each pixel the mean of a square of [`OVERSAMPLING`]² pixels.
fn shrunk(image: &Image) -> Image {
    let (width, height, k) = (image.width / OVERSAMPLING, image.height / OVERSAMPLING, OVERSAMPLING);
    let at = |x: u32, y: u32, channel: u32| u32::from(image.pixels[(3 * (y * image.width + x) + channel) as usize]);
    let mean = |x: u32, y: u32, channel: u32| {
        let sum: u32 = (0..k * k).map(|s| at(x * k + s % k, y * k + s / k, channel)).sum();
        ((sum + k * k / 2) / (k * k)) as u8
    };
    let rows = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Image { width, height, pixels: rows.flat_map(|(x, y)| [0, 1, 2].map(|c| mean(x, y, c))).collect() }
}

/// The image as a PNG file.
pub fn encode(image: &Image) -> Vec<u8> {
    let mut out = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut header = Vec::new();
    header.extend(image.width.to_be_bytes());
    header.extend(image.height.to_be_bytes());
    header.extend([8, 2, 0, 0, 0]); // 8 bits a channel, red-green-blue, the only compression and filter set, not interlaced
    chunk(&mut out, b"IHDR", &header);
    chunk(&mut out, b"IDAT", &compressed(image));
    chunk(&mut out, b"IEND", &[]);
    out
}

/// The rows, each after the number of its filter (0: none), as a zlib stream.
fn compressed(image: &Image) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    for row in image.pixels.chunks(3 * image.width.max(1) as usize) {
        encoder.write_all(&[0]).and_then(|()| encoder.write_all(row)).expect("writing into memory cannot fail");
    }
    encoder.finish().expect("writing into memory cannot fail")
}

fn chunk(out: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) {
    let mut crc = Crc::new();
    crc.update(kind);
    crc.update(data);
    out.extend((data.len() as u32).to_be_bytes());
    out.extend(kind);
    out.extend(data);
    out.extend(crc.sum().to_be_bytes());
}
