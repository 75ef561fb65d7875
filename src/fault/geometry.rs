//! The vertices are elsewhere. Assembled again from the moved triangles.

use super::site::{Site, Triangle};
use super::{Blind, Class, Fault, Spoilt};

/// Assembles with every vertex moved by a function of (vertex, position).
fn moved(site: &Site, f: impl FnMut((usize, &[f64; 3])) -> [f64; 3]) -> Spoilt {
    let positions: Vec<[f64; 3]> = site.surface()?.positions().iter().enumerate().map(f).collect();
    if positions.iter().flatten().any(|x| !x.is_finite()) {
        return Err("the coordinates do not fit there");
    }
    let mistaken = site.triangles_at(&positions)?;
    site.assembled(mistaken.iter().flat_map(Triangle::weights), &site.triangles()?)
}

/// Multiplies the coordinate with the largest extent.
fn stretched(site: &Site, factor: f64) -> Spoilt {
    let extent = extents(site)?;
    let axis = (1..3).fold(0, |best, a| if extent[a] > extent[best] { a } else { best });
    moved(site, |(_, p)| std::array::from_fn(|a| if a == axis { factor * p[a] } else { p[a] }))
}

/// How far the positions reach along each axis.
fn extents(site: &Site) -> Result<[f64; 3], &'static str> {
    let positions = site.surface()?.positions();
    let along = |a: usize| positions.iter().map(move |p| p[a]);
    Ok([0, 1, 2].map(|a| along(a).fold(f64::MIN, f64::max) - along(a).fold(f64::MAX, f64::min)))
}

/// The length of the shortest side at each vertex, half the longest of the mesh where there is none.
fn shortest(site: &Site) -> Result<Vec<f64>, &'static str> {
    let mut shortest = vec![f64::INFINITY; site.size()];
    for t in site.triangles()? {
        for c in 0..3 {
            let length = t.squared_length(c).sqrt();
            t.side(c).iter().for_each(|&v| shortest[v] = shortest[v].min(length));
        }
    }
    Ok(shortest.into_iter().map(|l| if l.is_finite() { l } else { 0.0 }).collect())
}

/// The axes along which the mesh extends.
fn axes(site: &Site) -> Result<[bool; 3], &'static str> {
    Ok(extents(site)?.map(|e| e > 0.0))
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    Class::Geometry.fault(
        "stretched-by-2",
        "one axis stretched to twice its length",
        &["ENERGY", "FLUX"],
        &[Blind::AnglesBelow(1.0)],
        |s, _| stretched(s, 2.0),
    ),
    Class::Geometry.fault(
        "stretched-by-1e-6",
        "one axis stretched by 1e-6 of its length: inches against rounded millimetres",
        &["ENERGY", "FLUX"],
        &[Blind::AnglesBelow(1.0), Blind::Curved],
        |s, _| stretched(s, 1.0 + 1e-6),
    ),
    Class::Geometry.fault(
        "vertex-moved",
        "one vertex where it was before the last edit, a tenth of an edge away",
        &["ENERGY", "LIN", "FLUX"],
        &[Blind::AnglesBelow(1.0)],
        |s, r| {
            let (vertex, by, along) = (s.live_row(r)?, shortest(s)?, axes(s)?);
            let angle = r.between(0.3, 1.2);
            let shift = [angle.cos(), angle.sin(), 0.7];
            moved(s, |(v, p)| {
                std::array::from_fn(|a| if v == vertex && along[a] { p[a] + 0.1 * by[v] * shift[a] } else { p[a] })
            })
        },
    ),
    Class::Geometry.fault(
        "another-mesh",
        "the matrix of a mesh with the same faces, every vertex up to a twentieth of an edge away",
        &["ENERGY", "LIN", "FLUX"],
        &[Blind::AnglesBelow(1.0)],
        |s, r| {
            let (by, along) = (shortest(s)?, axes(s)?);
            moved(s, |(v, p)| {
                std::array::from_fn(|a| if along[a] { p[a] + 0.05 * by[v] * r.between(-1.0, 1.0) } else { p[a] })
            })
        },
    ),
    Class::Geometry.fault(
        "projected",
        "the third coordinate of a curved mesh left out",
        &["ENERGY"],
        &[Blind::AnglesBelow(1.0)],
        |s, _| moved(s, |(_, p)| [p[0], p[1], 0.0]),
    ),
    Class::Geometry.fault(
        "coordinates-exchanged",
        "two coordinates of one vertex exchanged",
        &["ENERGY", "LIN", "FLUX"],
        &[Blind::AnglesBelow(1.0)],
        |s, r| {
            let (vertex, along) = (s.live_row(r)?, axes(s)?);
            let used: Vec<usize> = (0..3).filter(|&a| along[a]).collect();
            let &[a, b, ..] = used.as_slice() else { return Err("the mesh lies on an axis") };
            moved(s, |(v, p)| {
                let mut q = *p;
                if v == vertex {
                    q.swap(a, b);
                }
                q
            })
        },
    ),
    Class::Geometry.fault(
        "coordinates-in-f32",
        "coordinates read in single precision",
        &["ENERGY", "LIN", "FLUX"],
        &[Blind::AnglesBelow(3.0), Blind::Curved],
        |s, _| moved(s, |(_, p)| p.map(|x| f64::from(x as f32))),
    ),
    Class::Geometry.fault(
        "coordinates-to-6-digits",
        "coordinates printed with six digits",
        &["ENERGY", "LIN", "FLUX"],
        &[Blind::AnglesBelow(1.0), Blind::Curved],
        |s, _| moved(s, |(_, p)| p.map(|x| format!("{x:.5e}").parse().unwrap_or(x))),
    ),
    Class::Geometry.fault(
        "far-from-origin",
        "weights computed a million diameters from the origin",
        &["ENERGY", "LIN", "FLUX"],
        &[Blind::AnglesBelow(5.0), Blind::Curved],
        |s, _| {
            let (extent, along) = (extents(s)?, axes(s)?);
            let far = 1e6 * extent.iter().fold(0.0_f64, |m, e| m.max(*e));
            moved(s, |(_, p)| std::array::from_fn(|a| if along[a] { (p[a] + far) - far } else { p[a] }))
        },
    ),
];
