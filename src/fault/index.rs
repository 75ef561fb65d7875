//! The right numbers in the wrong places.

use super::site::{Site, Triangle, pick};
use super::{Blind, Class, Fault, Spoilt};
use crate::linalg::Csr;
use crate::stream::Stream;

/// What sees a row that belongs to another vertex.
const PLACES: &[&str] = &["LOC", "ENERGY", "LIN", "FLUX"];

/// Where none does.
const BLIND: &[Blind] = &[Blind::AnglesBelow(1.0), Blind::Graph];

/// The matrix with row and column i of the correct one at `to[i]`.
fn renumbered(site: &Site, to: &[usize]) -> Spoilt {
    let n = site.size();
    let triplets: Vec<_> = site.stiffness().entries().map(|(i, j, v)| (to[i], to[j], *v)).collect();
    site.with_stiffness(Csr::from_triplets(n, n, &triplets))
}

/// Assembles with one corner of one triangle named wrongly.
fn misread(site: &Site, stream: &mut Stream, by: usize) -> Spoilt {
    let (n, triangles) = (site.size(), site.triangles()?);
    let (chosen, corner) = (stream.below(triangles.len()), stream.below(3));
    let at = site.domain.positions().ok_or("there are no positions")?;
    let mut corners = triangles[chosen].corners;
    corners[corner] = (corners[corner] + by) % n;
    let wrong = Triangle::of(at, corners).ok_or("the misread triangle is degenerate")?;
    let weights =
        triangles.iter().enumerate().flat_map(|(k, t)| if k == chosen { wrong.weights() } else { t.weights() });
    site.assembled(weights, &triangles)
}

/// The faults.
pub(super) static FAULTS: &[Fault] = &[
    Class::Index.fault("vertices-swapped", "rows and columns of two vertices exchanged", PLACES, BLIND, |s, r| {
        let n = s.size();
        let (i, j) = (s.live_row(r)?, r.below(n));
        let mut to: Vec<usize> = (0..n).collect();
        to.swap(i, j);
        renumbered(s, &to)
    }),
    Class::Index.fault(
        "vertices-permuted",
        "the vertices in another order than those of the mesh",
        PLACES,
        BLIND,
        |s, r| {
            let mut to: Vec<usize> = (0..s.size()).collect();
            r.shuffle(&mut to);
            renumbered(s, &to)
        },
    ),
    Class::Index.fault(
        "indices-off-by-one",
        "every index one too large, the last one wrapped round",
        PLACES,
        BLIND,
        |s, _| {
            let n = s.size();
            renumbered(s, &(0..n).map(|i| (i + 1) % n).collect::<Vec<_>>())
        },
    ),
    Class::Index.fault(
        "rows-off-by-one",
        "row indices one too large, column indices right",
        &["SYM", "LOC"],
        &[Blind::AnglesBelow(0.01)],
        |s, _| {
            let n = s.size();
            let triplets: Vec<_> = s.stiffness().entries().map(|(i, j, v)| ((i + 1) % n, j, *v)).collect();
            s.with_stiffness(Csr::from_triplets(n, n, &triplets))
        },
    ),
    Class::Index.fault(
        "corner-off-by-one",
        "one corner of one triangle one index too large",
        PLACES,
        &[Blind::AnglesBelow(1.0), Blind::Curved],
        |s, r| misread(s, r, 1),
    ),
    Class::Index.fault(
        "corner-misread",
        "one corner of one triangle read as some other vertex",
        PLACES,
        &[Blind::AnglesBelow(1.0), Blind::Curved],
        |s, r| {
            let by = 1 + r.below(s.size().saturating_sub(1));
            misread(s, r, by)
        },
    ),
    Class::Index.fault(
        "row-and-column-of-another",
        "the row of one vertex written to another, its column not",
        &["SYM"],
        &[Blind::AnglesBelow(0.01)],
        |s, r| {
            let (l, n) = (s.stiffness(), s.size());
            let scales = l.row_scales();
            let i = s.live_row(r)?;
            let others: Vec<usize> = (0..n).filter(|&k| k != i && scales[k] > 0.0).collect();
            let k = pick(&others, r).ok_or("there is no other row")?;
            let rest = l.entries().filter(|(row, _, _)| *row != k).map(|(a, b, v)| (a, b, *v));
            let copy = l.row(i).map(|(j, v)| (k, j, *v));
            s.with_stiffness(Csr::from_triplets(n, n, &rest.chain(copy).collect::<Vec<_>>()))
        },
    ),
    Class::Index.fault(
        "vertices-welded",
        "the contributions to one vertex added to a neighbour's, as by a weld",
        &["KER", "ENERGY", "LIN", "FLUX", "LOC"],
        BLIND,
        |s, r| {
            let [i, j] = s.heavy_edge(r)?;
            let to: Vec<usize> = (0..s.size()).map(|k| if k == i { j } else { k }).collect();
            renumbered(s, &to)
        },
    ),
];
