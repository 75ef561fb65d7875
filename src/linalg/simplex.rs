//! Systems of linear inequalities, decided exactly: the first phase of the simplex method over the rationals.
//!
//! # Definition
//! Either `A x = b` has a solution `x ≥ 0`, or there is a `y` with `yᵀA ≤ 0` and `yᵀb > 0` (Farkas). The method minimises
//! the sum of one artificial variable a row; where the minimum is zero the basic solution is `x`, else the dual one is `y`.
//!
//! # Guarantees
//! Ends with one of the two, whatever the input: while the objective falls the column with the most negative reduced cost
//! enters, during a stall that lasts the first one (Bland's rule), so that it comes to an end.
//!
//! # Numbers
//! The tableau is one of integers over a common denominator, the determinant of the basis, and every division is exact
//! (Edmonds 1967, Bareiss 1968): numbers grow with the logarithm of minors and no faster.
//!
//! # Limitations
//! O(rows · columns) integer products a pivot. Meant for some forty rows, and for what rounding has left open.

use std::cmp::Ordering;

use dashu_int::IBig;

use crate::scalar::{Rational, Scalar};

/// Which of the two alternatives is true.
#[derive(Clone, Debug, PartialEq)]
pub enum Farkas {
    /// `x ≥ 0` with `A x = b`.
    Solution(Vec<Rational>),
    /// `y` with `yᵀA ≤ 0` and `yᵀb > 0`.
    Refutation(Vec<Rational>),
}

/// Decides whether `A x = b` has a solution `x ≥ 0`; A by its rows, all of the same length.
pub fn farkas(rows: &[Vec<Rational>], b: &[Rational]) -> Farkas {
    let columns = rows.first().map_or(0, Vec::len);
    let mut tableau = Tableau::new(rows, b, columns);
    // Bland's rule alone takes far more pivots; it is kept for stalls that last.
    let patience = 2 * (rows.len() + columns);
    let mut stalled = 0;
    while let Some(column) = tableau.entering(stalled > patience) {
        // A column of negative reduced cost has a positive entry: the objective is bounded by zero.
        let Some(row) = tableau.leaving(column) else { break };
        stalled = if tableau.right(row).is_zero() { stalled + 1 } else { 0 };
        tableau.pivot(row, column);
    }
    tableau.answer(columns)
}

/// Decides whether `A x = 0` has a solution `x > 0` (`Solution`), or there is a `y` with `yᵀA ≥ 0`, not all of it zero
/// (`Refutation`): Stiemke's alternative. Every component of the solution is at least 1.
pub fn stiemke(rows: &[Vec<Rational>]) -> Farkas {
    // x = 1 + u with u ≥ 0 and A u = −A 1.
    let b: Vec<Rational> = rows.iter().map(|row| -crate::scalar::sum(row.iter().cloned())).collect();
    match farkas(rows, &b) {
        Farkas::Solution(u) => Farkas::Solution(u.into_iter().map(|u| Rational::ONE + u).collect()),
        Farkas::Refutation(y) => Farkas::Refutation(y.into_iter().map(|y| -y).collect()),
    }
}

/// Decides whether some `x` makes every row of `C x` positive (`Solution`), or some `λ ≥ 0`, not zero, has `Cᵀλ = 0`
/// (`Refutation`): Gordan's alternative.
pub fn gordan(rows: &[Vec<Rational>]) -> Farkas {
    let unknowns = rows.first().map_or(0, Vec::len);
    let mut transposed: Vec<Vec<Rational>> =
        (0..unknowns).map(|k| rows.iter().map(|row| row[k].clone()).collect()).collect();
    transposed.push(vec![Rational::ONE; rows.len()]);
    let mut b = vec![Rational::ZERO; unknowns];
    b.push(Rational::ONE);
    match farkas(&transposed, &b) {
        Farkas::Solution(multipliers) => Farkas::Refutation(multipliers),
        Farkas::Refutation(y) => Farkas::Solution(y.into_iter().take(unknowns).map(|y| -y).collect()),
    }
}

/// Rows `[A | artificial | b]` and the reduced costs below them, all over one positive denominator.
struct Tableau {
    rows: Vec<Vec<IBig>>,
    costs: Vec<IBig>,
    basis: Vec<usize>,
    denominator: IBig,
    /// What each row was multiplied by, sign included.
    scales: Vec<Rational>,
}

impl Tableau {
    fn new(rows: &[Vec<Rational>], b: &[Rational], columns: usize) -> Self {
        let (mut table, mut scales) = (Vec::with_capacity(rows.len()), Vec::with_capacity(rows.len()));
        for (k, (row, right)) in rows.iter().zip(b).enumerate() {
            let (mut integers, scale) = integers(row, right);
            let last = integers.split_off(columns);
            integers.extend((0..rows.len()).map(|j| if j == k { IBig::ONE } else { IBig::ZERO }));
            integers.extend(last);
            table.push(integers);
            scales.push(scale);
        }
        let width = columns + rows.len() + 1;
        let artificial = columns..columns + rows.len();
        let cost = |j: usize| match artificial.contains(&j) {
            true => IBig::ZERO,
            false => -table.iter().fold(IBig::ZERO, |sum, row| sum + &row[j]),
        };
        let costs = (0..width).map(cost).collect();
        Tableau { rows: table, costs, basis: artificial.collect(), denominator: IBig::ONE, scales }
    }

    fn right(&self, row: usize) -> &IBig {
        &self.rows[row][self.costs.len() - 1]
    }

    /// The column that enters: of the most negative reduced cost, or the first of a negative one.
    fn entering(&self, first: bool) -> Option<usize> {
        let structural = self.costs.len() - 1 - self.rows.len();
        let mut negative = (0..structural).filter(|&j| self.costs[j].cmp_zero_sign() == Ordering::Less);
        if first { negative.next() } else { negative.min_by(|&i, &j| self.costs[i].cmp(&self.costs[j])) }
    }

    /// The row that leaves: of the smallest quotient, of several the one with the first basic variable.
    fn leaving(&self, column: usize) -> Option<usize> {
        let positive = (0..self.rows.len()).filter(|&i| self.rows[i][column].cmp_zero_sign() == Ordering::Greater);
        positive.min_by(|&i, &k| {
            let (left, right) = (self.right(i) * &self.rows[k][column], self.right(k) * &self.rows[i][column]);
            left.cmp(&right).then(self.basis[i].cmp(&self.basis[k]))
        })
    }

    fn pivot(&mut self, at: usize, column: usize) {
        let row = std::mem::take(&mut self.rows[at]);
        let pivot = row[column].clone();
        for other in self.rows.iter_mut().chain([&mut self.costs]).filter(|other| !other.is_empty()) {
            let factor = std::mem::take(&mut other[column]);
            for (j, (value, p)) in other.iter_mut().zip(&row).enumerate() {
                if j == column || (value.is_zero() && (factor.is_zero() || p.is_zero())) {
                    continue;
                }
                let mut product = &*value * &pivot;
                if !factor.is_zero() && !p.is_zero() {
                    product -= &factor * p;
                }
                *value = product / &self.denominator;
            }
        }
        self.rows[at] = row;
        self.basis[at] = column;
        self.denominator = pivot;
    }

    fn answer(self, columns: usize) -> Farkas {
        let over = |x: &IBig| Rational::from(x.clone()) / Rational::from(self.denominator.clone());
        // The cell below the right-hand sides is minus the objective.
        if self.costs.last().is_none_or(|cost| cost.is_zero()) {
            let mut x = vec![Rational::ZERO; columns];
            for (row, &variable) in self.basis.iter().enumerate().filter(|(_, v)| **v < columns) {
                x[variable] = over(self.right(row)).reduced();
            }
            return Farkas::Solution(x);
        }
        let dual = |(k, scale): (usize, &Rational)| (Rational::ONE - over(&self.costs[columns + k])) * scale.clone();
        Farkas::Refutation(self.scales.iter().enumerate().map(|s| dual(s).reduced()).collect())
    }
}

trait Sign {
    fn cmp_zero_sign(&self) -> Ordering;
}

impl Sign for IBig {
    fn cmp_zero_sign(&self) -> Ordering {
        self.cmp(&IBig::ZERO)
    }
}

/// A row and its right-hand side as integers, the latter not negative, and what they were multiplied by.
fn integers(row: &[Rational], right: &Rational) -> (Vec<IBig>, Rational) {
    let all = || row.iter().chain([right]);
    let mut common = IBig::ONE;
    for value in all().filter(|v| v.cmp_zero() != Ordering::Equal) {
        let denominator = IBig::from(value.clone().reduced().into_parts().1);
        let step = &denominator / gcd(common.clone(), denominator.clone());
        common *= step;
    }
    let common = if right.cmp_zero() == Ordering::Less { -common } else { common };
    let scale = Rational::from(common);
    let whole = |v: &Rational| (v.clone() * scale.clone()).reduced().into_parts().0;
    (all().map(whole).collect(), scale.clone())
}

fn gcd(mut a: IBig, mut b: IBig) -> IBig {
    while !b.is_zero() {
        (a, b) = (b.clone(), a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stream::Stream;

    fn whole(x: i64) -> Rational {
        Rational::from(IBig::from(x))
    }

    fn random(stream: &mut Stream, rows: usize, columns: usize) -> Vec<Vec<Rational>> {
        let row = |s: &mut Stream| {
            (0..columns).map(|_| whole(s.below(7) as i64 - 3) / whole(1 + s.below(3) as i64)).collect()
        };
        (0..rows).map(|_| row(stream)).collect()
    }

    fn times(a: &[Vec<Rational>], x: &[Rational]) -> Vec<Rational> {
        a.iter().map(|row| crate::scalar::sum(row.iter().zip(x).map(|(a, x)| a.clone() * x.clone()))).collect()
    }

    fn transposed(a: &[Vec<Rational>], y: &[Rational]) -> Vec<Rational> {
        let column = |j: usize| crate::scalar::sum(a.iter().zip(y).map(|(row, y)| row[j].clone() * y.clone()));
        (0..a[0].len()).map(column).collect()
    }

    fn sign(x: &Rational) -> Ordering {
        x.cmp_zero()
    }

    #[test]
    fn each_of_the_alternatives_of_farkas_occurs_and_is_what_it_says() {
        let mut stream = Stream::new(3, "simplex");
        let mut seen = [0, 0];
        for k in 0..400 {
            let (rows, columns) = (1 + k % 5, 1 + k % 7);
            let a = random(&mut stream, rows, columns);
            let b: Vec<Rational> = (0..rows).map(|_| whole(stream.below(5) as i64 - 2)).collect();
            match farkas(&a, &b) {
                Farkas::Solution(x) => {
                    assert!(x.iter().all(|x| sign(x).is_ge()) && times(&a, &x) == b);
                    seen[0] += 1;
                }
                Farkas::Refutation(y) => {
                    assert!(transposed(&a, &y).iter().all(|v| sign(v).is_le()));
                    let product = crate::scalar::sum(y.iter().zip(&b).map(|(y, b)| y.clone() * b.clone()));
                    assert!(sign(&product).is_gt());
                    seen[1] += 1;
                }
            }
        }
        assert!(seen.iter().all(|n| *n > 50), "{seen:?}");
    }

    #[test]
    fn each_of_the_alternatives_of_stiemke_and_of_gordan_is_what_it_says() {
        let mut stream = Stream::new(4, "simplex");
        let mut seen = [0; 4];
        for k in 0..400 {
            let a = random(&mut stream, 1 + k % 3, 2 + k % 6);
            match stiemke(&a) {
                Farkas::Solution(x) => {
                    assert!(x.iter().all(|x| *x >= Rational::ONE));
                    assert!(times(&a, &x).iter().all(|v| sign(v).is_eq()));
                    seen[0] += 1;
                }
                Farkas::Refutation(y) => {
                    let g = transposed(&a, &y);
                    assert!(g.iter().all(|v| sign(v).is_ge()) && g.iter().any(|v| sign(v).is_gt()));
                    seen[1] += 1;
                }
            }
            let c = random(&mut stream, 2 + k % 6, 1 + k % 3);
            match gordan(&c) {
                Farkas::Solution(x) => {
                    assert!(times(&c, &x).iter().all(|v| sign(v).is_gt()));
                    seen[2] += 1;
                }
                Farkas::Refutation(multipliers) => {
                    assert!(multipliers.iter().all(|v| sign(v).is_ge()) && multipliers.iter().any(|v| sign(v).is_gt()));
                    assert!(transposed(&c, &multipliers).iter().all(|v| sign(v).is_eq()));
                    seen[3] += 1;
                }
            }
        }
        assert!(seen.iter().all(|n| *n > 20), "{seen:?}");
    }

    #[test]
    fn the_cycle_of_beale_is_left() {
        // Beale 1955, as a system: the columns cycle under the rule of the most negative cost without a rule for stalls.
        let q = |n: i64, d: i64| whole(n) / whole(d);
        let a = vec![
            vec![q(1, 4), q(-60, 1), q(-1, 25), q(9, 1), q(1, 1), q(0, 1), q(0, 1)],
            vec![q(1, 2), q(-90, 1), q(-1, 50), q(3, 1), q(0, 1), q(1, 1), q(0, 1)],
            vec![q(0, 1), q(0, 1), q(1, 1), q(0, 1), q(0, 1), q(0, 1), q(1, 1)],
        ];
        let Farkas::Solution(x) = farkas(&a, &[q(0, 1), q(0, 1), q(1, 1)]) else { panic!("x₇ = 1 solves it") };
        assert_eq!(times(&a, &x), [q(0, 1), q(0, 1), q(1, 1)]);
    }
}
