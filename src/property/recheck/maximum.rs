//! Certificates of the maximum principle by the pattern of signs.

use super::leeway::Leeway;
use super::scan;
use super::terms::{Terms, U};
use super::{Answer, Rechecked, Refusal, place, solutions};
use crate::domain::Domain;
use crate::operator::{Mass, Operator, Signs};

/// MAX-global, MAX-heat: no negative weight, row sums not negative, and chains of positive weights to the set.
///
/// On a closed domain the sets are not named: the pattern is then required of every row, and every component must be
/// strongly connected, which decides every set that meets each component. A step of heat flow needs no chain, but a positive
/// diagonal mass.
pub(super) fn sign_pattern(property: &str, domain: &Domain, operator: &Operator, set: usize) -> Answer {
    if property == "MAX-heat" {
        return heat(domain, operator);
    }
    let prescribed = place::prescribed(domain, operator);
    let count = prescribed.iter().filter(|p| **p).count();
    let closed = !domain.boundary().contains(&true);
    if !closed && set != count {
        return Err(Refusal::untrue(
            format!("values are prescribed at {set} vertices"),
            format!("they are at {count}"),
        ));
    }
    if closed && set > operator.size() {
        return Err(Refusal::untrue(
            format!("the largest set had {set} vertices"),
            format!("there are {}", operator.size()),
        ));
    }
    let free: Vec<usize> = (0..prescribed.len()).filter(|&i| !prescribed[i]).collect();
    let exact = check_rows(domain, operator, &free, |_, _| false)?;
    let leads = positive_weights(operator);
    if closed {
        check_connected(domain, &leads, &prescribed)?
    } else {
        check_reached(&leads, &prescribed, |_| true)?
    }
    Ok(level(exact && operator.signs() == Signs::Exact))
}

/// `M + tL` is an M-matrix for each t of the property: a row that sums to less than zero is outweighed by its mass.
fn heat(domain: &Domain, operator: &Operator) -> Answer {
    let (mass, masses) = masses(operator)?;
    let times = solutions::times(domain, operator.stiffness(), mass);
    let all: Vec<usize> = (0..operator.size()).collect();
    let exact = check_rows(domain, operator, &all, |i, sum| {
        // The product, the sum and the row's sum round less than eight times in all.
        let mass = masses[i] * (1.0 - 8.0 * U);
        times.iter().all(|t| mass > t * (sum.value().abs() + sum.bound()))
    })?;
    Ok(level(exact))
}

fn level(exact: bool) -> Rechecked {
    if exact { Rechecked::Exact } else { Rechecked::Bounded }
}

/// Refuses a negative weight, or a row sum below zero that nothing outweighs; whether no rounding had to be excused.
fn check_rows(
    domain: &Domain,
    operator: &Operator,
    rows: &[usize],
    outweighed: impl Fn(usize, &Terms) -> bool,
) -> Result<bool, Refusal> {
    let l = operator.stiffness();
    scan::check_finite(l)?;
    let leeway = Leeway::of(domain, l);
    let mut exact = true;
    for &i in rows {
        let zone = if operator.signs() == Signs::Exact { 0.0 } else { leeway.rows[i] };
        let mut sum = Terms::default();
        for (j, v) in l.row(i) {
            sum.add(*v);
            if j != i && *v > zone {
                return Err(Refusal::untrue(format!("row {i} has no negative weight"), format!("L_{i},{j} = {v}")));
            }
            exact &= j == i || *v <= 0.0;
        }
        if sum.sign().is_lt() && !outweighed(i, &sum) {
            exact = false;
            if sum.exceeds(leeway.rows[i]) {
                return Err(Refusal::untrue(format!("row {i} has no negative sum"), format!("{:e}", sum.value())));
            }
        }
    }
    Ok(exact)
}

/// A lumped positive mass, and its diagonal.
fn masses(operator: &Operator) -> Result<(&Mass, Vec<f64>), Refusal> {
    let Some(mass) = operator.mass() else {
        return Err(Refusal::untrue("there is a mass matrix", "there is none"));
    };
    if !mass.is_lumped() {
        return Err(Refusal::untrue("the mass is diagonal", "it is full, and the sign pattern decides nothing"));
    }
    let diagonal = mass.diagonal();
    match diagonal.iter().position(|m| m.is_nan() || *m <= 0.0) {
        Some(i) => Err(Refusal::untrue("the mass is positive", format!("M_{i},{i} = {}", diagonal[i]))),
        None => Ok((mass, diagonal)),
    }
}

/// For each row the columns of its positive weights.
fn positive_weights(operator: &Operator) -> Vec<Vec<usize>> {
    let l = operator.stiffness();
    let positive = |i: usize| l.row(i).filter(|&(j, v)| j != i && *v < 0.0).map(|(j, _)| j).collect();
    (0..l.rows()).map(positive).collect()
}

/// Refuses a component of which two vertices are not joined by chains in both directions.
fn check_connected(domain: &Domain, leads: &[Vec<usize>], outside: &[bool]) -> Result<(), Refusal> {
    let of = domain.components();
    let mut back = vec![Vec::new(); leads.len()];
    leads.iter().enumerate().for_each(|(i, row)| row.iter().for_each(|&j| back[j].push(i)));
    let mut roots = vec![false; leads.len()];
    let mut known = vec![false; leads.len()];
    for i in (0..of.len()).filter(|&i| !outside[i]) {
        roots[i] = !std::mem::replace(&mut known[of[i]], true);
    }
    // A vertex that reaches a root of another component only is not joined throughout its own.
    let within = |arrows: &[Vec<usize>]| -> Vec<Vec<usize>> {
        let own = |i: usize| arrows[i].iter().copied().filter(|&j| of[j] == of[i]).collect();
        (0..arrows.len()).map(own).collect()
    };
    check_reached(&within(leads), &roots, |i| !outside[i])?;
    check_reached(&within(&back), &roots, |i| !outside[i])
}

/// Refuses a vertex of interest from which no chain of arrows leads to a seed.
fn check_reached(arrows: &[Vec<usize>], seed: &[bool], of_interest: impl Fn(usize) -> bool) -> Result<(), Refusal> {
    let mut into = vec![Vec::new(); arrows.len()];
    arrows.iter().enumerate().for_each(|(i, row)| row.iter().for_each(|&j| into[j].push(i)));
    let mut reached = seed.to_vec();
    let mut queue: Vec<usize> = (0..seed.len()).filter(|&i| seed[i]).collect();
    while let Some(j) = queue.pop() {
        for &i in &into[j] {
            if !reached[i] {
                reached[i] = true;
                queue.push(i);
            }
        }
    }
    match (0..seed.len()).find(|&i| of_interest(i) && !reached[i]) {
        Some(i) => {
            Err(Refusal::untrue(format!("a chain of positive weights leads from {i} to the set"), "there is none"))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::{Graph, Surface};
    use crate::linalg::Csr;
    use crate::operator::{MassKind, Provenance};

    #[test]
    fn a_negative_row_sum_is_outweighed_by_a_mass_above_sixteen_times_it() {
        // Row sums of −½; on a graph h² = 1, so that M + tL is dominant for t = 1/16, 1, 16 iff the masses exceed 8.
        let domain = Domain::from(Graph::new(2, &[[0, 1]]).unwrap());
        let l = Csr::from_triplets(2, 2, &[(0, 0, 0.5), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 0.5)]);
        let operator = |mass: f64| {
            let plain = Operator::new(l.clone(), Provenance::default()).unwrap();
            plain.with_mass(Mass::lumped(MassKind::Given, &[mass, mass])).unwrap()
        };
        assert_eq!(sign_pattern("MAX-heat", &domain, &operator(8.5), 0), Ok(Rechecked::Exact));
        for mass in [8.0, 7.5, 1.0] {
            let refusal = sign_pattern("MAX-heat", &domain, &operator(mass), 0).unwrap_err();
            assert!(matches!(refusal, Refusal::Untrue { .. }), "mass {mass}: {refusal}");
        }
        assert!(sign_pattern("MAX-global", &domain, &operator(8.5), 0).is_err());
    }

    #[test]
    fn a_mass_that_counts_has_its_time_in_1_and_one_of_areas_in_squared_lengths() {
        // Row sums of −½; edges of lengths 1, 1 and √2 make h² = 4/3, and masses of 10 exceed 16·½ but not 16·4/3·½.
        let plane = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let domain = Domain::from(Surface::triangles(plane, &[[0, 1, 2]]).unwrap());
        let entries: Vec<_> = (0..9).map(|k| (k / 3, k % 3, if k / 3 == k % 3 { 1.5 } else { -1.0 })).collect();
        let operator = |kind| {
            let plain = Operator::new(Csr::from_triplets(3, 3, &entries), Provenance::default()).unwrap();
            plain.with_mass(Mass::lumped(kind, &[10.0; 3])).unwrap()
        };
        for kind in [MassKind::Unit, MassKind::Degree] {
            assert_eq!(sign_pattern("MAX-heat", &domain, &operator(kind), 0), Ok(Rechecked::Exact));
        }
        assert!(sign_pattern("MAX-heat", &domain, &operator(MassKind::Given), 0).is_err());
    }
}
