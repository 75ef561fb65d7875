//! Rank from below: orthogonal triangularisation with column pivoting.

use super::terms::U;

/// A bound from below on the `rank`-th largest singular value of a dense square matrix, given by rows.
///
/// `AP = QR` by Householder reflections; `σ_rank(R) ≥ σ_min(R₁₁)` for the leading block, and `σ_min(R₁₁) ≥ (1 − ρ)/‖X‖` for an
/// approximate inverse X with `‖I − R₁₁X‖ ≤ ρ`. The reflections move A by at most `12 n² u ‖A‖` (Frobenius norms).
pub(super) fn singular_value_from_below(a: &[Vec<f64>], rank: usize) -> f64 {
    let n = a.len();
    let mut columns: Vec<Vec<f64>> = (0..n).map(|j| a.iter().map(|row| row[j]).collect()).collect();
    let size = norm(columns.iter().flatten());
    for k in 0..rank.min(n) {
        let rest = |c: &Vec<f64>| norm(c[k..].iter());
        let best = (k..n).max_by(|&p, &q| rest(&columns[p]).total_cmp(&rest(&columns[q]))).unwrap_or(k);
        columns.swap(k, best);
        reflect(&mut columns, k);
    }
    let inverse = inverse(&columns, rank);
    let defect = defect(&columns, &inverse);
    let n = n as f64;
    (1.0 - defect) / norm(inverse.iter().flatten()) * (1.0 - n * n * U) - 12.0 * n * n * U * size
}

fn norm<'a>(x: impl Iterator<Item = &'a f64>) -> f64 {
    x.map(|v| v * v).sum::<f64>().sqrt()
}

/// Zeroes column k below the diagonal, in all columns from k on.
fn reflect(columns: &mut [Vec<f64>], k: usize) {
    let length = norm(columns[k][k..].iter());
    if length == 0.0 {
        return;
    }
    let mut v = columns[k][k..].to_vec();
    v[0] += length.copysign(v[0]);
    let square: f64 = v.iter().map(|x| x * x).sum();
    for column in &mut columns[k..] {
        let factor = 2.0 * v.iter().zip(&column[k..]).map(|(v, c)| v * c).sum::<f64>() / square;
        column[k..].iter_mut().zip(&v).for_each(|(c, v)| *c -= factor * v);
    }
    columns[k][k + 1..].iter_mut().for_each(|c| *c = 0.0);
}

/// The inverse of the leading block of the upper triangle, by columns.
fn inverse(columns: &[Vec<f64>], rank: usize) -> Vec<Vec<f64>> {
    (0..rank)
        .map(|j| {
            let mut x = vec![0.0; j + 1];
            for i in (0..=j).rev() {
                let known: f64 = (i + 1..=j).map(|k| columns[k][i] * x[k]).sum();
                x[i] = (f64::from(u8::from(i == j)) - known) / columns[i][i];
            }
            x
        })
        .collect()
}

/// A bound on `‖I − R₁₁X‖` in the Frobenius norm.
fn defect(columns: &[Vec<f64>], inverse: &[Vec<f64>]) -> f64 {
    let (mut sum, mut slack) = (0.0, 0.0);
    for (j, x) in inverse.iter().enumerate() {
        let row = |i: usize| (i..=j).map(move |k| columns[k][i] * x[k]);
        for (i, products) in (0..=j).map(|i| (i, row(i))) {
            let entry = products.clone().sum::<f64>() - f64::from(u8::from(i == j));
            let bound = (j as f64 + 4.0) * U * (1.0 + products.map(f64::abs).sum::<f64>());
            sum += entry * entry;
            slack += bound * bound;
        }
    }
    let total = f64::sqrt(sum) + f64::sqrt(slack);
    if total.is_nan() { f64::INFINITY } else { total }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_lies_below_the_singular_values_of_a_cycle_and_not_far() {
        // Directed cycle minus identity: singular values |e^{2πik/n} − 1| = 2 sin(πk/n).
        let n = 12;
        let a: Vec<Vec<f64>> = (0..n)
            .map(|i| (0..n).map(|j| f64::from(i32::from(i == j) - i32::from((i + 1) % n == j))).collect())
            .collect();
        let exact = 2.0 * (std::f64::consts::PI / n as f64).sin();
        let found = singular_value_from_below(&a, n - 1);
        assert!(found > 0.0 && found <= exact && found > exact / 20.0, "{found} {exact}");
        assert!(singular_value_from_below(&a, n) <= 1e-13);
    }
}
