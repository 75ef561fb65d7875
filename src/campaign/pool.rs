//! The meshes that faults are planted on: of every class, good and bad.

use std::path::Path;

use super::CampaignError;
use crate::domain::{Domain, Surface};
use crate::suite::Recipe;

/// How large a pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Size {
    /// Generated and hand-made meshes of up to a hundred vertices
    #[default]
    Small,
    /// The same, larger generated ones, and the real meshes
    Full,
}

impl Size {
    /// The size in a word.
    pub fn name(self) -> &'static str {
        match self {
            Size::Small => "small",
            Size::Full => "full",
        }
    }
}

/// A mesh of the pool.
pub struct Place {
    /// Its class.
    pub class: &'static str,
    /// Its recipe, or its name in words.
    pub name: String,
    make: Make,
}

#[derive(Clone, Copy)]
enum Make {
    Recipe,
    Hand(fn() -> Result<Domain, crate::domain::DomainError>),
}

impl Place {
    /// Makes the domain; paths are relative to `root`.
    ///
    /// # Errors
    /// A file that cannot be read, a generator that refuses.
    pub fn domain(&self, root: &Path) -> Result<Domain, CampaignError> {
        let failed = |error: String| CampaignError::Domain { name: self.name.clone(), error };
        match self.make {
            Make::Hand(make) => make().map_err(|e| failed(e.to_string())),
            Make::Recipe => {
                let recipe: Recipe = self.name.parse().map_err(|e: crate::suite::RecipeError| failed(e.to_string()))?;
                recipe.build(root).map_err(|e| failed(e.to_string()))
            }
        }
    }
}

/// Classes of generated meshes in both pools.
const SMALL: &[(&str, &[&str])] = &[
    (
        "planar",
        &[
            "perturbed-grid:nx=3,ny=4,displacement=0.3,seed=2",
            "perturbed-grid:nx=4,ny=4,diagonals=alternating,displacement=0.2,seed=3",
            "grid:nx=3,ny=3,diagonals=alternating",
            "wheel:n=7",
            "disk:levels=1",
        ],
    ),
    ("planar-delaunay", &["random-delaunay:n=14,seed=4", "random-delaunay:n=30,seed=9", "convex-polygon:n=9,seed=1"]),
    (
        "planar-flipped",
        &[
            "random-delaunay:n=14,seed=4 | flip:count=12,seed=1",
            "random-delaunay:n=10,seed=6 | worst-angle",
            "schonhardt:nested=2",
        ],
    ),
    (
        "closed",
        &[
            "icosphere:levels=1 | perturb:amount=0.2,seed=1",
            "torus:levels=0 | flip:count=9,seed=3",
            "genus:genus=1,levels=0 | perturb:amount=0.1,seed=5",
            "polyhedron:shape=tetrahedron",
            "polyhedron:shape=cube",
            "polyhedron:shape=icosahedron | perturb:amount=0.3,seed=4",
        ],
    ),
    (
        "curved-with-boundary",
        &["lantern:m=4,n=5", "wheel:n=6,height=0.7", "flat-torus:levels=0", "disk:levels=1 | rotate:seed=2"],
    ),
    (
        "slivers",
        &[
            "slivers:shape=needle,aspect=1e2,columns=3,rows=3",
            "slivers:shape=needle,aspect=1e6,columns=3,rows=3",
            "slivers:shape=cap,aspect=1e4,columns=3,rows=3",
            "slivers:shape=cap,aspect=1e8,columns=3,rows=4",
            "slivers:shape=needle,aspect=1e3,columns=3,rows=3 | perturb:amount=0.3,seed=2",
        ],
    ),
    (
        "moved",
        &[
            "random-delaunay:n=12,seed=5 | scale:factor=1e12",
            "random-delaunay:n=12,seed=5 | scale:factor=1e-12",
            "random-delaunay:n=12,seed=5 | translate:x=1e6,y=-1e6",
            "icosphere:levels=1 | translate:x=2e6,y=1e6,z=-1e6",
        ],
    ),
    ("high-valence", &["wheel:n=60", "wheel:n=90,height=0.4"]),
    ("not-manifold", &["fan:k=3", "fan:k=4,kind=half-disks"]),
    ("graph", &["gnp:n=9,p=0.5,boundary=2,seed=5", "cycle:n=7", "path:n=6,boundary=2", "hypercube:d=3"]),
];

/// More of them in the full pool.
const LARGE: &[(&str, &[&str])] = &[
    ("planar", &["perturbed-grid:nx=20,ny=20,displacement=0.3,seed=7"]),
    ("planar-delaunay", &["random-delaunay:n=400,seed=1"]),
    ("planar-flipped", &["random-delaunay:n=300,seed=2 | flip:count=200,seed=2"]),
    ("closed", &["icosphere:levels=3", "genus:genus=3,levels=1", "dumbbell:levels=1"]),
    ("slivers", &["slivers:shape=needle,aspect=1e8,columns=8,rows=9", "slivers:shape=cap,aspect=1e5,columns=8,rows=9"]),
    ("high-valence", &["wheel:n=500", "wheel:n=500,height=1"]),
    (
        "real",
        &[
            "fixtures/meshes/retinal.off",
            "fixtures/meshes/spot.ply",
            "fixtures/meshes/bones.off",
            "fixtures/meshes/three_peaks.off",
            "fixtures/meshes/anchor.off",
            "fixtures/meshes/oblong.off",
            "fixtures/meshes/eight.off",
            "fixtures/meshes/fox.ply",
            "fixtures/meshes/bob_small.ply",
            "fixtures/meshes/femur.off",
            "fixtures/meshes/blade.off",
        ],
    ),
    (
        "real-faulty",
        &["fixtures/meshes/3DSMaxExport.STL", "fixtures/meshes/spider.obj", "fixtures/meshes/oblong-shuffled.off"],
    ),
];

/// A square of side 2 joined to its centre, vertex 4, its corners a little off.
const WINDMILL: [[f64; 2]; 5] = [[0.0, 0.0], [2.0, 0.1], [2.2, 2.0], [0.1, 1.9], [1.0, 0.9]];
const SAILS: [[usize; 3]; 4] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];

type Hand = (&'static str, &'static str, fn() -> Result<Domain, crate::domain::DomainError>);

/// Meshes that no generator makes.
const BY_HAND: &[Hand] = &[
    ("tiny", "a single triangle", || Ok(Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [0.3, 0.8]], &[[0, 1, 2]])?.into())),
    ("tiny", "a pillow of two triangles", || {
        Ok(Surface::triangles(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.2, 1.0, 0.0]], &[[0, 1, 2], [0, 2, 1]])?.into())
    }),
    ("tiny", "a windmill", || Ok(Surface::planar(&WINDMILL, &SAILS)?.into())),
    ("unsound", "a windmill between isolated vertices", || {
        let mut points = vec![[9.0, 9.0]];
        points.extend(WINDMILL);
        points.push([8.0, 8.0]);
        Ok(Surface::planar(&points, &SAILS.map(|f| f.map(|v| v + 1)))?.into())
    }),
    ("unsound", "two windmills", || {
        let points: Vec<[f64; 2]> =
            WINDMILL.iter().copied().chain(WINDMILL.map(|p| [p[0] + 5.0, 1.1 * p[1]])).collect();
        let faces: Vec<[usize; 3]> = SAILS.iter().copied().chain(SAILS.map(|f| f.map(|v| v + 5))).collect();
        Ok(Surface::planar(&points, &faces)?.into())
    }),
    ("unsound", "a face given twice", || {
        Ok(Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [0.2, 1.0], [1.0, 1.1]], &[[0, 1, 2], [1, 3, 2], [0, 1, 2]])?
            .into())
    }),
    ("unsound", "a triangle folded back over its neighbour", || {
        Ok(Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [0.3, 1.0], [0.6, 0.7]], &[[0, 1, 2], [1, 0, 3]])?.into())
    }),
    ("unsound", "a windmill with a triangle of collinear corners", || {
        let mut points = WINDMILL.to_vec();
        points.push([4.0, 0.0]);
        points[1] = [2.0, 0.0];
        let faces = [SAILS.as_slice(), &[[0, 5, 1]]].concat();
        Ok(Surface::planar(&points, &faces)?.into())
    }),
    ("unsound", "two triangles that share a vertex", || {
        let points = [[0.0, 0.0], [1.0, 0.2], [1.0, 1.0], [-1.0, 0.1], [-1.0, -1.0]];
        Ok(Surface::planar(&points, &[[0, 1, 2], [0, 3, 4]])?.into())
    }),
    ("slivers", "a sliver of height 1e-17 inside a windmill", || {
        let mut points = WINDMILL;
        (points[1], points[4]) = ([2.0, 0.0], [1.0, 1e-17]);
        Ok(Surface::planar(&points, &SAILS)?.into())
    }),
];

/// The meshes of a pool, class by class.
pub fn places(size: Size) -> Vec<Place> {
    let of = |lists: &'static [(&'static str, &'static [&'static str])]| {
        lists.iter().flat_map(|(class, recipes)| {
            recipes.iter().map(|recipe| Place { class, name: (*recipe).to_string(), make: Make::Recipe })
        })
    };
    let by_hand = BY_HAND.iter().map(|&(class, name, make)| Place { class, name: name.into(), make: Make::Hand(make) });
    let small = of(SMALL).chain(by_hand);
    match size {
        Size::Small => small.collect(),
        Size::Full => small.chain(of(LARGE)).collect(),
    }
}
