//! A grid whose interior vertices are displaced at random, as far as no triangle folds.

use super::grid::{NX, NY, lattice};
use super::shape::displace::{in_ball, unfolded};
use super::shape::input::admit;
use super::shape::sheet::{DIAGONALS, Sheet};
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Surface};
use crate::parameter::{Parameter, Range, Settings};

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "perturbed-grid",
    name: "grid with randomly displaced interior vertices",
    guarantees: &[
        "connectivity and boundary of the grid: a rectangle of nx × ny",
        "planar, every triangle counter-clockwise (exact), manifold, connected, genus 0, one boundary loop",
        "no vertex moves further than displacement; where a triangle would fold its corners move half, a quarter, … as far",
    ],
    sources: &[],
    parameters: &[
        NX,
        NY,
        DIAGONALS,
        Parameter {
            name: "displacement",
            meaning: "largest displacement, as a fraction of the spacing, uniform in the disc of this radius",
            default: "0.3",
            range: Range::Number(0.0, 0.499),
        },
    ],
    make: Make::Source(make),
};

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let sheet = Sheet::open(settings.whole("nx"), settings.whole("ny"));
    admit("perturbed-grid", "vertices", (sheet.columns + 1) * (sheet.rows + 1))?;
    let faces = sheet.cut(settings.get("diagonals"), stream);
    let radius = settings.number("displacement");
    let inside = |[i, j]: [usize; 2]| i > 0 && j > 0 && i < sheet.columns && j < sheet.rows;
    let shift = sheet
        .vertices()
        .map(|at| if inside(at) { in_ball::<2>(stream).map(|x| radius * x) } else { [0.0; 2] })
        .collect();
    Ok(Surface::planar(&unfolded(&lattice(&sheet), shift, &faces), &faces)?.into())
}

#[cfg(test)]
mod tests {
    use crate::domain::Domain;
    use crate::generate::testing::{disc, make};

    #[test]
    fn no_triangle_folds_and_no_vertex_moves_too_far_whatever_the_seed() {
        for seed in 0..40 {
            let given = [("nx", "7"), ("ny", "5"), ("displacement", "0.499"), ("diagonals", "random")];
            let domain = make("perturbed-grid", &given, seed);
            let facts = disc(&domain);
            assert!((facts.area - 35.0).abs() < 1e-12);
            let grid = make("grid", &[("nx", "7"), ("ny", "5")], seed);
            let (p, q) = (domain.positions().unwrap(), grid.positions().unwrap());
            for (v, (p, q)) in p.iter().zip(q).enumerate() {
                assert!((p[0] - q[0]).hypot(p[1] - q[1]) <= 0.4991);
                assert!(p == q || !domain.boundary()[v]);
            }
        }
    }

    #[test]
    fn without_displacement_it_is_the_grid() {
        let given = [("displacement", "0")];
        assert_eq!(make("perturbed-grid", &given, 3).digest(), make("grid", &[], 3).digest());
        let Domain::Surface(_) = make("perturbed-grid", &[], 3) else { panic!("a surface") };
    }
}
