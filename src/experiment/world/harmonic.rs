//! The three forms of the maximum principle, decided exactly on a small matrix.

use std::cmp::Ordering;

use crate::linalg::Dense;
use crate::property::Statement;
use crate::scalar::{Rational, Scalar};

use super::excerpt::sparse;

/// What is wrong with a maximum principle, with the rows that show it.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// The witness.
    pub statement: Statement,
    /// The rows of the matrix that it speaks of.
    pub rows: Vec<usize>,
    /// The witness in words.
    pub text: String,
}

/// MAX-local at a vertex: its weights neither take both signs nor vanish all.
pub fn local(l: &Dense<Rational>, i: usize) -> Option<Violation> {
    let with_sign = |sign| (0..l.columns()).find(|&j| j != i && l.at(i, j).cmp_zero() == sign);
    let statement = match (with_sign(Ordering::Less), with_sign(Ordering::Greater)) {
        (Some(positive), Some(negative)) => Statement::BothSigns { i, positive, negative },
        (None, None) => Statement::NoWeight { i },
        _ => return None,
    };
    Some(Violation { statement, rows: vec![i], text: format!("the weights at vertex {i} take both signs or vanish") })
}

/// The vertices outside a set, ascending.
pub fn outside(n: usize, set: &[usize]) -> Vec<usize> {
    (0..n).filter(|i| !set.contains(i)).collect()
}

/// The harmonic extension `H = −L_II⁻¹ L_IB` from a set B to the vertices outside; `None` if `L_II` is singular.
pub fn extension(l: &Dense<Rational>, set: &[usize]) -> Option<Dense<Rational>> {
    let inside = outside(l.rows(), set);
    let right = l.submatrix(&inside, set);
    let right = Dense::from_fn(right.rows(), right.columns(), |i, b| -right.at(i, b).clone());
    l.submatrix(&inside, &inside).solve(&right)
}

/// MAX-global for a set B of prescribed values: `L_II` is non-singular and the harmonic extension of every value in `[0, 1]`
/// stays there. Its rows sum to one where `L 1 = 0`, so that no entry may be negative.
pub fn global(l: &Dense<Rational>, set: &[usize]) -> Option<Violation> {
    let inside = outside(l.rows(), set);
    let Some(h) = extension(l, set) else { return Some(singular(l, set, inside)) };
    let places = (0..inside.len()).flat_map(|i| (0..set.len()).map(move |b| (i, b)));
    let (at, source, low) = places.into_iter().find_map(|(i, b)| {
        let above = (h.at(i, b).clone() - Rational::ONE).cmp_zero() == Ordering::Greater;
        let below = h.at(i, b).cmp_zero() == Ordering::Less;
        (above || below).then_some((i, b, below))
    })?;
    let value = h.at(at, source).clone();
    let text = format!(
        "the harmonic extension of 1 at vertex {}, 0 at the others of {set:?}, is {value} at vertex {}",
        set[source], inside[at]
    );
    let statement = Statement::Overshoot {
        set: set.to_vec(),
        source: set[source],
        at: inside[at],
        value: value.approximate(),
        low,
    };
    Some(Violation { statement, rows: inside, text })
}

fn singular(l: &Dense<Rational>, set: &[usize], inside: Vec<usize>) -> Violation {
    let mut x = vec![Rational::zero(); l.rows()];
    if let Some(kernel) = l.submatrix(&inside, &inside).kernel().into_iter().next() {
        inside.iter().zip(kernel).for_each(|(&i, value)| x[i] = value);
    }
    let x = sparse(&x);
    let support: Vec<usize> = x.iter().map(|(i, _)| *i).collect();
    let text = format!("with values prescribed at {set:?} the values at {support:?} are not determined");
    Violation { statement: Statement::Singular { set: set.to_vec(), x }, rows: inside, text }
}

/// MAX-heat for one implicit Euler step: `(M + tL)⁻¹ M ≥ 0` for a diagonal mass.
pub fn heat(l: &Dense<Rational>, mass: &[Rational], t: &Rational) -> Option<Violation> {
    let n = l.rows();
    let diagonal = |i: usize, j: usize| if i == j { mass[i].clone() } else { Rational::zero() };
    let step = Dense::from_fn(n, n, |i, j| diagonal(i, j) + t.clone() * l.at(i, j).clone());
    let t = t.approximate();
    let lost = |source: usize, at: usize, value: f64, text: String| Violation {
        statement: Statement::HeatLoss { t, source, at, value },
        rows: (0..n).collect(),
        text,
    };
    let Some(solution) = step.solve(&Dense::from_fn(n, n, diagonal)) else {
        return Some(lost(0, 0, 0.0, format!("M + tL is singular at t = {t}")));
    };
    let places = (0..n).flat_map(|at| (0..n).map(move |source| (at, source)));
    let (at, source) = places.into_iter().find(|&(i, j)| solution.at(i, j).cmp_zero() == Ordering::Less)?;
    let value = solution.at(at, source);
    let text = format!("heat 1 at vertex {source} becomes {value} at vertex {at} after the time {t}");
    Some(lost(source, at, value.approximate(), text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Graph;
    use crate::experiment::world::graphs::laplacian;

    /// A path 0 – 1 – 2 – 3 with the chord 0 – 2 of the given weight.
    fn path_with_chord(weight: f64) -> Dense<Rational> {
        let edges = [[0, 1], [1, 2], [2, 3], [0, 2]];
        laplacian(&Graph::weighted(4, &edges, &[1.0, 1.0, 1.0, weight]).unwrap())
    }

    #[test]
    fn a_path_is_interpolated_linearly() {
        let h = extension(&path_with_chord(0.0), &[0, 3]).unwrap();
        let third = Rational::from_parts(1.into(), 3u8.into());
        assert_eq!(*h.at(0, 1), third);
        assert_eq!(*h.at(1, 0), third);
        assert_eq!(global(&path_with_chord(0.0), &[0, 3]), None);
    }

    #[test]
    fn a_negative_chord_is_found_by_every_form() {
        // At vertex 2: weights 1, 1 and −3/4, diagonal 5/4, both neighbours of 1 prescribed.
        let l = path_with_chord(-0.75);
        assert!(matches!(local(&l, 2).unwrap().statement, Statement::BothSigns { i: 2, positive: 1, negative: 0 }));
        let found = global(&l, &[0, 1, 3]).unwrap().statement;
        assert!(matches!(found, Statement::Overshoot { at: 2, source: 0, low: true, value, .. } if value == -0.6));
        let unit = vec![Rational::ONE; 4];
        let soon = Rational::from_parts(1.into(), 64u8.into());
        assert!(heat(&l, &unit, &soon).is_some());
        assert_eq!(heat(&path_with_chord(0.75), &unit, &soon), None);
    }

    #[test]
    fn a_negative_weight_may_be_outvoted() {
        // Between 0 and 2 there is −1/4 directly and 1/2 by way of 1: the conductance is positive, and so is H.
        let l = path_with_chord(-0.25);
        assert!(local(&l, 2).is_some());
        assert_eq!(global(&l, &[0, 3]), None);
    }

    #[test]
    fn an_unreached_component_makes_the_problem_singular() {
        let l = laplacian(&Graph::new(4, &[[0, 1], [2, 3]]).unwrap());
        let found = global(&l, &[0]).unwrap().statement;
        assert_eq!(found, Statement::Singular { set: vec![0], x: vec![(2, 1.0), (3, 1.0)] });
        assert!(matches!(
            local(&laplacian(&Graph::new(1, &[]).unwrap()), 0).unwrap().statement,
            Statement::NoWeight { i: 0 }
        ));
    }
}
