//! The kernel of a random walk: one dimension for each closed class.

use super::leeway::Leeway;
use super::{Answer, Rechecked, Refusal, scan, spectrum};
use crate::domain::Domain;
use crate::operator::{Operator, Signs};

/// KER: no negative weight, vanishing row sums, and as many closed classes as components.
///
/// A vector of the kernel takes its largest value over a class that is closed only on the whole of it (maximum principle), and
/// is determined by its values on the closed classes; so the kernel has one dimension for each.
pub(super) fn decide(domain: &Domain, operator: &Operator, kernel: usize) -> Answer {
    let l = operator.stiffness();
    scan::check_finite(l)?;
    spectrum::check_kernel(domain, operator, kernel, 0)?;
    let sums = scan::row_sums(l, &Leeway::of(domain, l), 0..l.rows())?;
    if let Some((i, j, v)) = l.entries().find(|(i, j, v)| i != j && **v > 0.0) {
        return Err(Refusal::untrue("no weight is negative", format!("that of ({i}, {j}) is {}", -v)));
    }
    let leads: Vec<Vec<usize>> =
        (0..l.rows()).map(|i| l.row(i).filter(|&(j, v)| j != i && *v < 0.0).map(|e| e.0).collect()).collect();
    let found = closed_classes(&leads);
    if found != kernel {
        return Err(Refusal::untrue(format!("{kernel} closed classes"), found.to_string()));
    }
    Ok(if sums && operator.signs() == Signs::Exact { Rechecked::Exact } else { Rechecked::Bounded })
}

/// The number of strongly connected classes that no arrow leaves (Tarjan 1972, without recursion).
fn closed_classes(leads: &[Vec<usize>]) -> usize {
    const UNSEEN: usize = usize::MAX;
    let n = leads.len();
    let (mut number, mut low, mut class) = (vec![UNSEEN; n], vec![0; n], vec![UNSEEN; n]);
    let (mut next, mut open, mut closed) = (0, Vec::new(), Vec::new());
    for root in 0..n {
        let mut path = if number[root] == UNSEEN { vec![(root, 0)] } else { Vec::new() };
        while let Some((v, at)) = path.pop() {
            if at == 0 {
                (number[v], low[v]) = (next, next);
                next += 1;
                open.push(v);
            }
            match leads[v].get(at) {
                Some(&w) => {
                    path.push((v, at + 1));
                    if number[w] == UNSEEN {
                        path.push((w, 0));
                    } else if class[w] == UNSEEN {
                        low[v] = low[v].min(number[w]);
                    }
                }
                None => {
                    if low[v] == number[v] {
                        let members = open.split_off(open.iter().rposition(|&w| w == v).unwrap_or(0));
                        members.iter().for_each(|&w| class[w] = closed.len());
                        closed.push(members.iter().all(|&w| leads[w].iter().all(|&x| class[x] == closed.len())));
                    }
                    if let Some(&(parent, _)) = path.last() {
                        low[parent] = low[parent].min(low[v]);
                    }
                }
            }
        }
    }
    closed.into_iter().filter(|c| *c).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A vertex is in a closed class iff everything it reaches leads back to it; such vertices that reach each other are one
    /// class.
    fn by_reachability(leads: &[Vec<usize>]) -> usize {
        let n = leads.len();
        let mut reach = vec![vec![false; n]; n];
        for (i, row) in leads.iter().enumerate() {
            reach[i][i] = true;
            row.iter().for_each(|&j| reach[i][j] = true);
        }
        for k in 0..n {
            let through = reach[k].clone();
            for row in reach.iter_mut().filter(|row| row[k]) {
                row.iter_mut().zip(&through).for_each(|(r, t)| *r |= t);
            }
        }
        let recurrent = |i: usize| (0..n).all(|j| !reach[i][j] || reach[j][i]);
        let first = |i: usize| (0..i).all(|j| !reach[i][j]);
        (0..n).filter(|&i| recurrent(i) && first(i)).count()
    }

    #[test]
    fn every_graph_of_four_vertices_has_as_many_closed_classes_as_reachability_says() {
        let pairs: Vec<[usize; 2]> =
            (0..4).flat_map(|i| (0..4).filter(move |&j| j != i).map(move |j| [i, j])).collect();
        for mask in 0_u32..1 << pairs.len() {
            let mut leads = vec![Vec::new(); 4];
            let chosen = pairs.iter().enumerate().filter(|(k, _)| mask >> k & 1 == 1);
            chosen.for_each(|(_, &[i, j])| leads[i].push(j));
            assert_eq!(closed_classes(&leads), by_reachability(&leads), "{leads:?}");
        }
    }
}
