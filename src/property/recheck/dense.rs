//! A dense approximate inverse with a bound on its defect.

use super::solve::System;
use super::terms::U;

/// `R ≈ A⁻¹`, row by row, with `‖I − RA‖∞ ≤ defect < 1`.
pub(super) struct Inverse {
    n: usize,
    values: Vec<f64>,
    /// The bound ρ on `‖I − RA‖∞`.
    pub defect: f64,
}

/// Inverts by Gauss–Jordan elimination with row pivoting and verifies the result; `None` unless `ρ < ½`.
pub(super) fn invert(system: &System) -> Option<Inverse> {
    let n = system.rows.len();
    let width = 2 * n;
    let mut a = vec![0.0; n * width];
    for (i, row) in system.rows.iter().enumerate() {
        row.iter().for_each(|&(j, v, _)| a[i * width + j] = v);
        a[i * width + n + i] = 1.0;
    }
    for k in 0..n {
        let pivot = (k..n).max_by(|&p, &q| a[p * width + k].abs().total_cmp(&a[q * width + k].abs()))?;
        if a[pivot * width + k] == 0.0 {
            return None;
        }
        if pivot != k {
            (0..width).for_each(|j| a.swap(k * width + j, pivot * width + j));
        }
        let scale = 1.0 / a[k * width + k];
        a[k * width + k..(k + 1) * width].iter_mut().for_each(|v| *v *= scale);
        let row = a[k * width + k..(k + 1) * width].to_vec();
        for i in (0..n).filter(|&i| i != k) {
            let factor = a[i * width + k];
            if factor != 0.0 {
                a[i * width + k..(i + 1) * width].iter_mut().zip(&row).for_each(|(v, r)| *v -= factor * r);
            }
        }
    }
    let values: Vec<f64> = (0..n).flat_map(|i| a[i * width + n..(i + 1) * width].to_vec()).collect();
    let defect = defect(&values, system);
    (defect < 0.5).then_some(Inverse { n, values, defect })
}

/// A bound on `‖I − RA‖∞`: every entry is a sum of at most n + 1 products.
fn defect(values: &[f64], system: &System) -> f64 {
    let n = system.rows.len();
    let mut worst = 0.0_f64;
    let mut product = vec![0.0; n];
    for i in 0..n {
        product.iter_mut().for_each(|p| *p = 0.0);
        product[i] = 1.0;
        let (mut scale, mut radius) = (1.0, 0.0);
        for (k, row) in system.rows.iter().enumerate() {
            let r = values[i * n + k];
            for &(j, v, e) in row {
                product[j] -= r * v;
                scale += (r * v).abs();
                radius += r.abs() * e;
            }
        }
        let sum: f64 = product.iter().map(|p| p.abs()).sum();
        let bound = sum + (n as f64 + 4.0) * U * scale + radius;
        if bound.is_nan() {
            return f64::INFINITY;
        }
        worst = worst.max(bound * (1.0 + (n as f64 + 4.0) * U));
    }
    worst
}

impl Inverse {
    /// `R b`.
    pub fn mul(&self, b: &[f64]) -> Vec<f64> {
        self.rows().map(|r| r.iter().zip(b).map(|(r, b)| r * b).sum()).collect()
    }

    /// An upper bound on `|R| b` for non-negative b.
    pub fn mul_magnitudes(&self, b: &[f64]) -> Vec<f64> {
        let slack = 1.0 + (self.n as f64 + 4.0) * U;
        self.rows().map(|r| r.iter().zip(b).map(|(r, b)| r.abs() * b).sum::<f64>() * slack).collect()
    }

    fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks(self.n.max(1))
    }
}
