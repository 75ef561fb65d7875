//! Whether a witness stands at a place the property speaks of, and what only the operator can say of it.

use super::terms::U;
use super::{Rechecked, Refusal, moment};
use crate::domain::Domain;
use crate::linalg::Csr;
use crate::operator::{Operator, Signs};
use crate::property::evidence::{Statement, Which};

/// Refuses a true witness that stands where the property says nothing.
pub(super) fn check_place(
    statement: &Statement,
    property: &str,
    domain: &Domain,
    operator: &Operator,
) -> Result<(), Refusal> {
    let interior = |i: usize| {
        if domain.boundary()[i] {
            return Err(Refusal::untrue(
                format!("vertex {i} is one of which {property} speaks"),
                "it is on the boundary",
            ));
        }
        Ok(())
    };
    match *statement {
        Statement::FarEntry { i, j, rings } => {
            if property == "KER" && rings.is_some() {
                return Err(Refusal::untrue(format!("{i} and {j} belong to different components"), "they do not"));
            }
            check_rings(domain, i, j, rings)
        }
        Statement::Weight { i, j, zero, .. } => {
            check_edge_class(domain, property, i, j)?;
            if zero {
                return check_carries_weight(domain, operator, i, j);
            }
            // The weights of a graph are given, not computed: their signs are literal.
            if matches!(domain, Domain::Graph(_)) { Ok(()) } else { check_sign(operator, i, j) }
        }
        Statement::Moment { i, axes, boundary, .. } => {
            if boundary.is_none() {
                interior(i)?;
            }
            moment::check_place(domain, i, axes, boundary)
        }
        Statement::BothSigns { i, positive, negative } => {
            interior(i)?;
            check_sign(operator, i, positive)?;
            check_sign(operator, i, negative)
        }
        Statement::NoWeight { i } => interior(i),
        Statement::NotConvex { i, j } => {
            interior(i)?;
            if i == j { Ok(()) } else { check_sign(operator, i, j) }
        }
        Statement::Energy { trace: false, .. } => match domain.as_surface().and_then(|s| s.plane()) {
            Some(_) => Ok(()),
            None => Err(Refusal::untrue("the mesh lies unfolded in a plane", "it does not")),
        },
        Statement::KernelVector { a, b, .. } => {
            let components = domain.components();
            if components.get(a).is_some() && components.get(a) == components.get(b) {
                return Ok(());
            }
            Err(Refusal::untrue(format!("{a} and {b} belong to one component"), "they do not"))
        }
        Statement::Overshoot { ref set, .. } | Statement::Singular { ref set, .. } => {
            let prescribed = prescribed(domain, operator);
            let count = prescribed.iter().filter(|p| **p).count();
            let same = set.len() == count && set.iter().all(|&v| prescribed.get(v) == Some(&true));
            if same || !domain.boundary().contains(&true) {
                return Ok(());
            }
            Err(Refusal::untrue("values are prescribed on the boundary", "the set is another one"))
        }
        _ => Ok(()),
    }
}

/// What the operator alone can say of a witness whose excerpt does not decide it.
pub(super) fn on_operator(statement: &Statement, operator: &Operator) -> Result<Option<Rechecked>, Refusal> {
    let entry = |which: Which, i: usize, j: usize| {
        let matrix = match which {
            Which::Stiffness => Some(operator.stiffness()),
            Which::Mass => operator.mass().map(|m| m.matrix()),
        };
        let matrix = matrix.filter(|m| i < m.rows() && j < m.columns());
        matrix.map(|m| m.at(i, j)).ok_or(Refusal::Missing { what: "row", index: i })
    };
    match statement {
        Statement::NotFinite { matrix, i, j, value } => {
            let found = entry(*matrix, *i, *j)?.to_string();
            if found == *value && ["NaN", "inf", "-inf"].contains(&found.as_str()) {
                return Ok(Some(Rechecked::Exact));
            }
            Err(Refusal::untrue(format!("entry ({i}, {j}) is {value}"), found))
        }
        Statement::Changed { matrix, i, j, before, .. } => {
            let found = entry(*matrix, *i, *j)?;
            if found == *before {
                return Ok(None);
            }
            Err(Refusal::untrue(format!("entry ({i}, {j}) is {before} on the original domain"), found.to_string()))
        }
        _ => Ok(None),
    }
}

/// The vertices of the Dirichlet problem at which values are prescribed: the boundary, and vertices with neither an edge nor
/// an entry off the diagonal, where there is no equation.
pub(super) fn prescribed(domain: &Domain, operator: &Operator) -> Vec<bool> {
    let mut alone = vec![!matches!(domain, Domain::Points(_)); domain.vertex_count()];
    domain.edges().iter().flatten().for_each(|&v| alone[v] = false);
    for (i, j, _) in operator.stiffness().entries().filter(|(i, j, v)| i != j && **v != 0.0) {
        (alone[i], alone[j]) = (false, false);
    }
    alone.iter().zip(domain.boundary()).map(|(a, b)| *a || *b).collect()
}

/// Refuses an absent entry that is no weight: not on an edge, or on one that an operator with edges of its own does not have.
fn check_carries_weight(domain: &Domain, operator: &Operator, i: usize, j: usize) -> Result<(), Refusal> {
    let l = operator.stiffness();
    let edge = domain.edges().binary_search(&[i.min(j), i.max(j)]).is_ok();
    let absent = l.get(i, j).is_none() && l.get(j, i).is_none();
    if edge && !(absent && has_own_edges(domain, l)) {
        return Ok(());
    }
    Err(Refusal::untrue(format!("({i}, {j}) carries a weight"), "the operator has no edge there"))
}

/// Whether the operator has a non-zero entry at a pair that shares neither an edge nor a face.
pub(super) fn has_own_edges(domain: &Domain, l: &Csr) -> bool {
    let share = |i: usize, j: usize| {
        domain.edges().binary_search(&[i.min(j), i.max(j)]).is_ok()
            || domain
                .as_surface()
                .is_some_and(|s| s.topology().star(i).iter().any(|c| s.faces()[c.face()].contains(&j)))
    };
    !matches!(domain, Domain::Points(_)) && l.entries().any(|(i, j, v)| i != j && *v != 0.0 && !share(i, j))
}

/// Where signs near zero may be those of rounding errors, refuses an entry that one rounding of its row explains.
fn check_sign(operator: &Operator, i: usize, j: usize) -> Result<(), Refusal> {
    let entry = operator.stiffness().at(i, j);
    let scale: f64 = operator.stiffness().row(i).map(|(_, v)| v.abs()).sum();
    if operator.signs() == Signs::Exact || entry.abs() > U * scale {
        return Ok(());
    }
    Err(Refusal::untrue(
        format!("the sign of entry ({i}, {j}) is certain"),
        format!("it is {entry}, below one rounding of the row scale {scale}"),
    ))
}

fn check_edge_class(domain: &Domain, property: &str, i: usize, j: usize) -> Result<(), Refusal> {
    let boundary = match domain.edges().binary_search(&[i.min(j), i.max(j)]) {
        Ok(edge) => boundary_edges(domain)[edge],
        Err(_) => false,
    };
    match (property, boundary) {
        ("POS-boundary", false) => Err(Refusal::untrue(format!("({i}, {j}) is a boundary edge"), "it is not")),
        ("POS", true) => Err(Refusal::untrue(format!("({i}, {j}) is an interior edge"), "it is on the boundary")),
        _ => Ok(()),
    }
}

/// For each edge of the domain, whether it is on the boundary: at one face, or at a boundary triangle of a volume.
pub(super) fn boundary_edges(domain: &Domain) -> Vec<bool> {
    let edges = domain.edges();
    match domain {
        Domain::Surface(s) => (0..edges.len()).map(|e| s.topology().is_boundary_edge(e)).collect(),
        Domain::Volume(v) => {
            let mut on_boundary = vec![false; edges.len()];
            let sides = v.boundary_triangles().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [a, c]]);
            sides.filter_map(|e| edges.binary_search(&e).ok()).for_each(|e| on_boundary[e] = true);
            on_boundary
        }
        Domain::Graph(_) | Domain::Points(_) => vec![false; edges.len()],
    }
}

fn check_rings(domain: &Domain, from: usize, to: usize, stated: Option<usize>) -> Result<(), Refusal> {
    let mut neighbours = vec![Vec::new(); domain.vertex_count()];
    for &[a, b] in domain.edges() {
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
    for face in domain.as_surface().into_iter().flat_map(|s| s.faces()).filter(|f| f.len() > 3) {
        face.iter().for_each(|&v| neighbours[v].extend(face));
    }
    let mut distance = vec![None; neighbours.len()];
    distance[from] = Some(0);
    let (mut queue, mut next) = (vec![from], 0);
    while next < queue.len() && distance[to].is_none() {
        let v = queue[next];
        next += 1;
        for &w in &neighbours[v] {
            if distance[w].is_none() {
                distance[w] = distance[v].map(|d: usize| d + 1);
                queue.push(w);
            }
        }
    }
    if distance[to] == stated {
        return Ok(());
    }
    Err(Refusal::untrue(format!("{to} is {stated:?} rings away from {from}"), format!("{:?}", distance[to])))
}
