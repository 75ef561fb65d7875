//! Degenerate, non-manifold and extreme input: refused with the element named, or built with a note; never a NaN.

use lapjury::domain::{Domain, Graph, Surface};
use lapjury::laplacian::{self, BuildError};

use crate::{U, build, distance, meshes, try_build};

const ON_TRIANGLES: [&str; 5] = ["cotan", "intrinsic-delaunay", "mean-value", "wachspress", "three-point"];

/// The unit square whose diagonal, on one side, passes through a vertex in its middle: the triangle 0 2 4 between is degenerate.
fn with_degenerate() -> Surface {
    let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]];
    Surface::planar(&points, &[[0, 1, 2], [0, 2, 4], [0, 4, 3], [4, 2, 3]]).unwrap()
}

#[test]
fn a_degenerate_triangle_is_refused_by_name_or_left_out_with_a_note() {
    let domain = Domain::from(with_degenerate());
    for id in ON_TRIANGLES {
        assert_eq!(
            try_build(id, "", &domain).unwrap_err().to_string(),
            format!(
                "triangle 1 (0, 2, 4) has zero area, where '{id}' is not defined (1 such triangles in all); \
                 remove them, or leave them out with degenerate=skip"
            )
        );
        let operator = build(id, "degenerate=skip", &domain);
        assert!(operator.stiffness().entries().all(|(_, _, v)| v.is_finite()));
        assert!(operator.provenance().notes.contains(&"1 triangles of zero area were left out".to_string()), "{id}");
        assert!((operator.mass().unwrap().total() - 1.0).abs() < 1e-15);
    }
    // Without the degenerate triangle the diagonal belongs to the lower right one alone: ω = ½ cot 90° = 0.
    let cotan = build("cotan", "degenerate=skip", &domain);
    assert_eq!(cotan.stiffness().at(0, 2), 0.0);
}

#[test]
fn a_fan_of_three_sheets_is_summed_with_a_note_or_refused_with_its_edge() {
    let points = vec![[0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]];
    let domain = Domain::from(Surface::triangles(points, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]).unwrap());
    // Right isosceles triangles with the right angle at 0: opposite the common edge 45° three times.
    let cotan = build("cotan", "", &domain);
    assert!((cotan.stiffness().at(0, 1) + 1.5).abs() <= 8.0 * U);
    let note =
        "1 edges have more than two faces, the first is (0, 1) with 3 faces; their weights are sums over all of them";
    assert_eq!(cotan.provenance().notes, [note]);
    for id in ["mean-value", "wachspress", "three-point"] {
        assert_eq!(build(id, "", &domain).provenance().notes, [note]);
    }
    assert_eq!(
        try_build("intrinsic-delaunay", "", &domain).unwrap_err().to_string(),
        "edge (0, 1) has 3 faces, and 'intrinsic-delaunay' needs a manifold; separate the sheets first"
    );
}

#[test]
fn three_sheets_whose_cotangents_cancel_weigh_exactly_zero() {
    // Opposite the edge (0,0,0)–(2,0,0): right angles in three sheets.
    let points = vec![[0.0; 3], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 0.0, 1.0]];
    let domain = Domain::from(Surface::triangles(points, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]).unwrap());
    assert_eq!(build("cotan", "", &domain).stiffness().get(0, 1), Some(&0.0));
}

#[test]
fn a_moebius_strip_is_refused_by_flips_only() {
    let ring = |k: usize| (std::f64::consts::TAU * k as f64 / 7.0).sin_cos();
    let points = (0..7).map(|k| [ring(k).0, ring(k).1, 0.3 * (k % 3) as f64]).collect();
    let faces: Vec<[usize; 3]> = (0..7).map(|k| [k, (k + 1) % 7, (k + 2) % 7]).collect();
    let domain = Domain::from(Surface::triangles(points, &faces).unwrap());
    build("cotan", "", &domain);
    assert!(matches!(try_build("intrinsic-delaunay", "", &domain), Err(BuildError::NotOrientable { .. })));
}

#[test]
fn a_quadrilateral_and_a_graph_are_not_triangle_surfaces() {
    let square = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let quad = Domain::from(Surface::new(square, vec![vec![0, 1, 2, 3]]).unwrap());
    let graph = Domain::from(Graph::new(2, &[[0, 1]]).unwrap());
    for id in ON_TRIANGLES {
        let refusal = try_build(id, "", &quad).unwrap_err().to_string();
        assert_eq!(
            refusal,
            format!("face 0 has 4 corners; '{id}' is defined on triangles: triangulate the mesh first")
        );
        let refusal = try_build(id, "", &graph).unwrap_err().to_string();
        assert_eq!(refusal, format!("'{id}' is not defined on a graph; it accepts surface"));
    }
    assert_eq!(build("graph", "", &quad).stiffness().at(0, 0), 2.0);
}

#[test]
fn weights_that_the_domain_does_not_have_are_missed_by_name() {
    let graph = Domain::from(Graph::new(2, &[[0, 1]]).unwrap());
    assert_eq!(
        try_build("weighted-graph", "", &graph).unwrap_err().to_string(),
        "'weighted-graph' needs weights given with the edges; use a weighted graph, or choose weights=unit, \
         inverse-length or inverse-squared-length"
    );
    assert!(try_build("weighted-graph", "weights=inverse-length", &graph).is_err());
    let p = vec![[0.0; 3], [0.0; 3], [1.0, 0.0, 0.0]];
    let coincident = Domain::from(Surface::triangles(p, &[[0, 1, 2]]).unwrap());
    assert!(matches!(
        try_build("weighted-graph", "weights=inverse-length", &coincident),
        Err(BuildError::ZeroLength { a: 0, b: 1, count: 1, .. })
    ));
}

#[test]
fn isolated_vertices_have_empty_rows_and_degrees_must_be_positive() {
    let lonely = Domain::from(Graph::new(3, &[[0, 1]]).unwrap());
    for parameters in ["", "form=random-walk"] {
        let operator = build("normalized-graph", parameters, &lonely);
        assert_eq!(operator.stiffness().at(2, 2), 0.0);
        assert_eq!(operator.mass().unwrap().diagonal()[2], 1.0);
        assert_eq!(operator.provenance().notes, ["1 isolated vertices have degree zero: empty rows and mass one"]);
    }
    let signed = Graph::weighted(3, &[[0, 1], [1, 2]], &[1.0, -1.0]).unwrap();
    assert_eq!(
        try_build("normalized-graph", "weights=given", &signed.into()).unwrap_err().to_string(),
        "vertex 1 has degree 0e0 (the sum of its weights), where 'normalized-graph' needs a positive one; \
         give its edges positive weights"
    );
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [5.0, 5.0]];
    let isolated = Domain::from(Surface::planar(&points, &[[0, 1, 2]]).unwrap());
    for id in ON_TRIANGLES {
        let operator = build(id, "", &isolated);
        assert_eq!((operator.stiffness().at(3, 3), operator.mass().unwrap().diagonal()[3]), (0.0, 0.0));
    }
}

#[test]
fn every_operator_is_the_same_up_to_its_unit_at_extreme_scales() {
    let surface = meshes::bumpy_sphere(2, 1);
    for (id, parameters, power) in [
        ("cotan", "", 0),
        ("intrinsic-delaunay", "", 0),
        ("mean-value", "", -1),
        ("wachspress", "", -2),
        ("three-point", "p=0.5", -2),
        ("weighted-graph", "weights=inverse-length", -1),
        ("weighted-graph", "weights=inverse-squared-length", -2),
    ] {
        let at_one = build(id, parameters, &surface.clone().into());
        for s in [1e8, 1e-8, 1e100, 1e-100] {
            let operator = build(id, parameters, &meshes::scaled(&surface, s).into());
            let unit = if parameters == "p=0.5" { f64::powf(s, -1.5) } else { f64::powi(s, power) };
            let back = operator.stiffness().map(|_, _, v| v / unit);
            let apart = distance(at_one.stiffness(), &back);
            // Angles above 10°: rounding the scaled coordinates turns a side by u, 1/sin² < 40.
            assert!(apart < 1e-13, "{id} {parameters} at {s:e}: {apart:e}");
        }
    }
}

#[test]
fn what_is_beyond_the_range_is_refused_and_never_a_nan() {
    let triangle = |s: f64| Domain::from(meshes::scaled(&meshes::regular_star(5, 1.0), s));
    for s in [1e-300, 1e-160] {
        for id in ["cotan", "mean-value", "wachspress", "three-point"] {
            let refusal = try_build(id, "", &triangle(s)).unwrap_err();
            assert!(refusal.to_string().contains("beyond the range of f64; rescale the domain"), "{refusal}");
        }
    }
    assert!(matches!(try_build("three-point", "p=8", &triangle(1e100)), Err(BuildError::NotFinite { .. })));
    let sliver = |h: f64| Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [0.5, h]], &[[0, 1, 2]]).unwrap();
    for h in [1e-8, 1e-17, 1e-100, 1e-300] {
        for id in ON_TRIANGLES {
            match try_build(id, "", &sliver(h).into()) {
                Ok(operator) => assert!(operator.stiffness().entries().all(|(_, _, v)| v.is_finite()), "{id} {h:e}"),
                Err(refusal) => assert!(matches!(refusal, BuildError::NotFinite { .. }), "{id} {h:e}: {refusal}"),
            }
        }
    }
}

#[test]
fn a_sliver_keeps_the_digits_of_its_cotangents() {
    for h in [1e-6, 1e-8, 1e-12] {
        let sliver = Surface::planar(&[[0.0, 0.0], [1.0, 0.0], [0.5, h]], &[[0, 1, 2]]).unwrap();
        let l = build("cotan", "", &sliver.into());
        // cot at the base 1/2h, at the top (h² − ¼)/h.
        let (base, top) = (0.5 / h, (h * h - 0.25) / h);
        assert!((-l.stiffness().at(0, 2) / (0.5 * base) - 1.0).abs() < 1e-9);
        assert!((-l.stiffness().at(0, 1) / (0.5 * top) - 1.0).abs() < 1e-9);
    }
}

#[test]
fn promises_depend_on_parameters_where_they_say_so() {
    let facts = Domain::from(meshes::tetrahedron(1.0)).facts();
    let cotan = laplacian::find("cotan").unwrap();
    let with = |mass: &str| cotan.promises_with("SCALE", &facts, &[("mass".to_string(), mass.to_string())].into());
    assert_eq!((with("voronoi"), with("unit")), (Some(true), None));
    assert_eq!(cotan.promises("SCALE", &facts), None);
    assert_eq!(cotan.promises_with("SCALE", &facts, &Default::default()), Some(true));
    assert_eq!(cotan.promises("SYM", &facts), Some(true));
    let family = laplacian::find("three-point").unwrap();
    let p = |p: &str| family.promises_with("POS", &facts, &[("p".to_string(), p.to_string())].into());
    assert_eq!((p("1"), p("1.0"), p("1.5"), p("3")), (Some(true), Some(true), Some(true), None));
    let obtuse = Domain::from(meshes::rhombus()).facts();
    assert_eq!(family.promises_with("POS", &obtuse, &[("p".to_string(), "1.5".to_string())].into()), None);
}
