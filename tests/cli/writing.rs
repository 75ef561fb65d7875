//! `generate` and `report`: files that are written.

use crate::{Scratch, lapjury};

#[test]
fn a_generated_domain_reads_back_as_the_same() {
    let scratch = Scratch::new();
    for (recipe, file) in [
        ("random-delaunay:n=30,seed=7 | flip:count=5", "mesh.off"),
        ("icosphere:levels=2", "mesh.obj"),
        ("gnp:n=12,p=0.4,seed=2 | random-weights", "graph.mtx"),
    ] {
        let path = scratch.at(file);
        assert!(lapjury(&["generate", recipe, "--out", &path]).ends_with(0).err.starts_with(&path));
        let check = |kind: &str, name: &str| {
            let arguments = ["check", kind, name, "--laplacian", "graph", "--property", "SYM", "--format", "json"];
            lapjury(&arguments).ends_with(0).json()["domain"]["digest"].clone()
        };
        assert_eq!(check("--mesh", &path), check("--domain", recipe), "{recipe}");
    }
}

#[test]
fn without_a_file_a_domain_is_printed_and_what_the_format_has_no_place_for_is_said() {
    // Two triangles on the unit square, the diagonal from south-west to north-east.
    let ran = lapjury(&["generate", "grid:nx=1,ny=1"]).ends_with(0);
    let numbers: Vec<f64> = ran.out.split_whitespace().skip(1).map(|word| word.parse().unwrap()).collect();
    assert_eq!(numbers[..3], [4.0, 2.0, 0.0]);
    assert_eq!(numbers[3..15], [0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0.]);
    assert_eq!((ran.out.lines().next(), ran.err.as_str()), (Some("OFF"), ""));
    let graph = lapjury(&["generate", "path:n=4,boundary=2"]).ends_with(0);
    assert!(graph.out.starts_with("%%MatrixMarket matrix coordinate pattern symmetric\n4 4 3\n"), "{}", graph.out);
    assert!(graph.err.contains("does not say which 2 vertices are boundary"), "{}", graph.err);
}

#[test]
fn a_file_that_cannot_be_written_ends_with_2() {
    let scratch = Scratch::new();
    let err = lapjury(&["generate", "grid", "--out", &scratch.at("no/such/folder.off")]).ends_with(2).err;
    assert!(err.contains("cannot write") && err.contains("folder.off"), "{err}");
    let err = lapjury(&["generate", "grid", "--out", &scratch.at("mesh.stl")]).ends_with(2).err;
    assert!(err.contains("write it as .off"), "{err}");
}
