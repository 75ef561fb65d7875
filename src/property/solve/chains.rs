//! Chains of positive weights: who leads to whom.

use crate::linalg::Csr;

/// The directed graph with an arrow from i to j for each weight that counts.
pub(crate) struct Chains {
    next: Vec<Vec<usize>>,
    previous: Vec<Vec<usize>>,
}

impl Chains {
    /// The arrows `i → j`, i ≠ j, for the entries `(i, j, L_ij)` that `counts` admits.
    pub(crate) fn new(matrix: &Csr, mut counts: impl FnMut(usize, usize, f64) -> bool) -> Self {
        let n = matrix.rows();
        let mut chains = Chains { next: vec![Vec::new(); n], previous: vec![Vec::new(); n] };
        for (i, j, &v) in matrix.entries() {
            if i != j && counts(i, j, v) {
                chains.next[i].push(j);
                chains.previous[j].push(i);
            }
        }
        chains
    }

    /// For each vertex whether a chain leads from it to the set.
    pub(crate) fn lead_to(&self, set: &[usize]) -> Vec<bool> {
        let mut reached = vec![false; self.next.len()];
        set.iter().for_each(|&v| reached[v] = true);
        let mut list = set.to_vec();
        while let Some(v) = list.pop() {
            for &w in &self.previous[v] {
                if !reached[w] {
                    reached[w] = true;
                    list.push(w);
                }
            }
        }
        reached
    }

    /// For each vertex its class: vertices that lead to each other (Kosaraju and Sharir).
    pub(crate) fn classes(&self) -> Vec<usize> {
        let n = self.next.len();
        let mut order = Vec::with_capacity(n);
        let mut seen = vec![false; n];
        for start in 0..n {
            if seen[start] {
                continue;
            }
            seen[start] = true;
            let mut path = vec![(start, 0)];
            while let Some(top) = path.last_mut() {
                let (v, at) = *top;
                top.1 += 1;
                match self.next[v].get(at) {
                    Some(&w) if !seen[w] => {
                        seen[w] = true;
                        path.push((w, 0));
                    }
                    Some(_) => {}
                    None => {
                        order.push(v);
                        path.pop();
                    }
                }
            }
        }
        let mut class = vec![usize::MAX; n];
        let mut count = 0;
        for &root in order.iter().rev() {
            if class[root] != usize::MAX {
                continue;
            }
            class[root] = count;
            let mut list = vec![root];
            while let Some(v) = list.pop() {
                for &w in &self.previous[v] {
                    if class[w] == usize::MAX {
                        class[w] = count;
                        list.push(w);
                    }
                }
            }
            count += 1;
        }
        class
    }

    /// The number of classes that no arrow leaves.
    pub(crate) fn closed_classes(&self) -> usize {
        let class = self.classes();
        let mut closed = vec![true; class.iter().max().map_or(0, |m| m + 1)];
        for (v, next) in self.next.iter().enumerate() {
            if next.iter().any(|&w| class[w] != class[v]) {
                closed[class[v]] = false;
            }
        }
        closed.into_iter().filter(|c| *c).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chains(n: usize, arrows: &[(usize, usize)]) -> Chains {
        let t: Vec<_> = arrows.iter().map(|&(i, j)| (i, j, -1.0)).collect();
        Chains::new(&Csr::from_triplets(n, n, &t), |_, _, _| true)
    }

    #[test]
    fn a_cycle_is_one_closed_class_and_a_tail_into_it_none() {
        let c = chains(5, &[(0, 1), (1, 2), (2, 0), (3, 0), (4, 3)]);
        assert_eq!(c.closed_classes(), 1);
        assert_eq!(c.lead_to(&[1]), [true; 5]);
        assert_eq!(c.lead_to(&[3]), [false, false, false, true, true]);
    }

    #[test]
    fn closed_classes_of_every_digraph_on_three_vertices_are_those_of_the_definition() {
        let arrows = [(0, 1), (1, 0), (0, 2), (2, 0), (1, 2), (2, 1)];
        for mask in 0..64_usize {
            let list: Vec<_> = (0..6).filter(|k| mask >> k & 1 == 1).map(|k| arrows[k]).collect();
            let c = chains(3, &list);
            // Reachability by two steps of the definition.
            let direct = |a: usize, b: usize| a == b || list.contains(&(a, b));
            let leads = |a: usize, b: usize| (0..3).any(|m| direct(a, m) && direct(m, b));
            let recurrent: Vec<usize> = (0..3).filter(|&a| (0..3).all(|b| !leads(a, b) || leads(b, a))).collect();
            let representatives = recurrent.iter().filter(|&&a| recurrent.iter().all(|&b| b >= a || !leads(a, b)));
            assert_eq!(c.closed_classes(), representatives.count(), "mask {mask}");
        }
    }
}
