//! A box of unit cubes, each cut into six tetrahedra, with its inner vertices moved at random.

use super::shape::input::admit;
use super::{GenerateError, Generator, Make, Stream};
use crate::domain::{Domain, Volume};
use crate::parameter::{Parameter, Range, Settings};

/// The number of cubes along an axis.
const CUBES: Range = Range::Whole(1, 100);

/// The catalogue entry.
pub static ENTRY: Generator = Generator {
    id: "tet-grid",
    name: "box of unit cubes, six tetrahedra each (Kuhn's), inner vertices moved at random",
    guarantees: &[
        "6 nx·ny·nz tetrahedra of volume 1/6 where nothing is moved; (nx−1)(ny−1)(nz−1) interior vertices",
        "every tetrahedron is positively oriented, also where vertices were moved; the boundary stays in place",
    ],
    sources: &[],
    parameters: &[
        Parameter { name: "nx", meaning: "cubes along x", default: "2", range: CUBES },
        Parameter { name: "ny", meaning: "cubes along y", default: "2", range: CUBES },
        Parameter { name: "nz", meaning: "cubes along z", default: "2", range: CUBES },
        Parameter {
            name: "displacement",
            meaning: "the most that a coordinate of an inner vertex is moved, in cubes",
            default: "0",
            // The edge vectors along a path of three steps are the unit vectors up to 2d in each coordinate: diagonally
            // dominant, hence of positive determinant, while 1 − 2d > 4d.
            range: Range::Number(0.0, 0.16),
        },
    ],
    make: Make::Source(make),
};

/// The orders of three steps along the axes, with the sign of the permutation.
const PATHS: [([usize; 3], bool); 6] = [
    ([0, 1, 2], true),
    ([1, 2, 0], true),
    ([2, 0, 1], true),
    ([0, 2, 1], false),
    ([2, 1, 0], false),
    ([1, 0, 2], false),
];

fn make(settings: &Settings, stream: &mut Stream) -> Result<Domain, GenerateError> {
    let cubes = ["nx", "ny", "nz"].map(|name| settings.whole(name));
    let points = cubes.map(|n| n + 1);
    admit("tet-grid", "vertices", points.iter().product())?;
    let radius = settings.number("displacement");
    let number = |at: [usize; 3]| (at[2] * points[1] + at[1]) * points[0] + at[0];
    let mut positions = Vec::with_capacity(points.iter().product());
    let mut tetrahedra = Vec::with_capacity(6 * cubes.iter().product::<usize>());
    for k in 0..points[2] {
        for j in 0..points[1] {
            for i in 0..points[0] {
                let at = [i, j, k];
                let inside = (0..3).all(|a| at[a] > 0 && at[a] < cubes[a]);
                let shift: [f64; 3] =
                    std::array::from_fn(|_| if inside { stream.between(-radius, radius) } else { 0.0 });
                positions.push(std::array::from_fn(|a| at[a] as f64 + shift[a]));
                if (0..3).all(|a| at[a] < cubes[a]) {
                    tetrahedra.extend(PATHS.map(|(path, even)| tetrahedron(at, path, even, number)));
                }
            }
        }
    }
    Ok(Volume::new(positions, tetrahedra)?.into())
}

/// The corners along a path from the lowest corner of a cube to the highest.
fn tetrahedron(lowest: [usize; 3], path: [usize; 3], even: bool, number: impl Fn([usize; 3]) -> usize) -> [usize; 4] {
    let mut at = lowest;
    let mut corners = [number(at); 4];
    for (step, axis) in path.into_iter().enumerate() {
        at[axis] += 1;
        corners[step + 1] = number(at);
    }
    if !even {
        corners.swap(1, 2);
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::geometry::Vec3;
    use crate::generate::testing::make;

    fn volumes(domain: &Domain) -> Vec<f64> {
        let Domain::Volume(volume) = domain else { panic!("a volume") };
        let at = |v: usize| Vec3::from(volume.positions()[v]);
        let of = |t: &[usize; 4]| {
            let [a, b, c, d] = t.map(at);
            (b - a).dot(&(c - a).cross(&(d - a))) / 6.0
        };
        volume.tetrahedra().iter().map(of).collect()
    }

    #[test]
    fn the_tetrahedra_fill_the_box_with_the_counts_that_euler_asks_for() {
        for (nx, ny, nz) in [(1, 1, 1), (2, 1, 3), (3, 3, 2)] {
            let given = [("nx", nx), ("ny", ny), ("nz", nz)].map(|(k, n): (&str, usize)| (k, n.to_string()));
            let given: Vec<(&str, &str)> = given.iter().map(|(k, n)| (*k, n.as_str())).collect();
            let domain = make("tet-grid", &given, 0);
            assert!(volumes(&domain).iter().all(|v| (v - 1.0 / 6.0).abs() < 1e-15));
            let facts = domain.facts();
            assert_eq!((facts.vertices, facts.faces), ((nx + 1) * (ny + 1) * (nz + 1), 6 * nx * ny * nz));
            assert_eq!(facts.vertices - facts.boundary_vertices, (nx - 1) * (ny - 1) * (nz - 1));
            let Domain::Volume(volume) = &domain else { panic!("a volume") };
            // A ball: V − E + F − T = 1, and each tetrahedron has four faces, inner ones twice.
            let triangles = (4 * facts.faces + volume.boundary_triangles().len()) / 2;
            assert_eq!(facts.vertices + triangles, facts.edges + facts.faces + 1);
            assert_eq!(volume.boundary_triangles().len(), 4 * (nx * ny + ny * nz + nz * nx));
        }
    }

    #[test]
    fn the_largest_displacement_turns_no_tetrahedron_over_and_keeps_the_volume() {
        for seed in 0..30 {
            let given = [("nx", "3"), ("ny", "3"), ("nz", "3"), ("displacement", "0.16")];
            let all = volumes(&make("tet-grid", &given, seed));
            assert!(all.iter().all(|v| *v > 0.0));
            assert!((all.iter().sum::<f64>() - 27.0).abs() < 1e-12);
        }
    }
}
