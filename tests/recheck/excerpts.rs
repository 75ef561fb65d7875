//! Excerpts that no matrix and no mesh can have, around statements that are true.

use lapjury::property::Excerpt;

use crate::refused_for;
use crate::witnesses::named;

#[test]
fn rows_positions_faces_and_edges_are_such_as_there_can_be() {
    let refused = |change: &dyn Fn(&mut Excerpt), reason: &str| {
        // About row 0, its positions and the faces 0 and 3 of a square.
        let mut evidence = named("inaccurate weight").evidence;
        change(&mut evidence.excerpt);
        refused_for(&evidence, reason);
    };
    refused(&|e| e.rows[0].entries.push((0, 1.0)), "row 0 of the evidence has columns that do not ascend");
    refused(&|e| e.rows[0].entries.push((4, 1.0)), "row 0 of the evidence has columns that do not ascend");
    for v in [f64::NAN, f64::INFINITY] {
        refused(&|e| e.rows[0].entries.push((9, v)), "row 0 of the evidence has an entry that is not finite");
        refused(&|e| e.positions.push((9, [0.0, 0.0, v])), "position 9 of the evidence has a coordinate out of range");
    }
    refused(&|e| e.positions.push((9, [0.0, -1e300, 0.0])), "position 9 of the evidence has a coordinate out of range");
    refused(&|e| e.positions.push((0, [0.0; 3])), "position 0 of the evidence is given twice");
    refused(&|e| e.rows.push(e.rows[0].clone()), "row 0 of the evidence is given twice");
    refused(&|e| e.faces[1] = e.faces[0].clone(), "face 0 of the evidence is given twice");
    refused(&|e| e.faces.push((9, vec![0, 4])), "face 9 of the evidence has fewer than three corners");
    refused(&|e| e.faces.push((9, vec![0, 4, 0])), "face 9 of the evidence names a corner twice");
    refused(&|e| e.edges.push([7, 7]), "edge 0 of the evidence has the same vertex at both ends");
    refused(&|e| e.edges = vec![[0, 1], [1, 0]], "edge 1 of the evidence is given twice");
}

#[test]
fn the_star_of_a_vertex_of_a_graph_is_excerpted_whole() {
    let e = named("entry between components");
    let mut evidence = e.evidence.clone();
    evidence.excerpt.edges.clear();
    let refusal = e.against(&evidence).unwrap_err().to_string();
    assert!(refusal.contains("every edge at vertex 1"), "{refusal}");
}
