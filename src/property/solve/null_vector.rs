//! Vectors near the kernel of a matrix that are not locally constant.

use crate::linalg::factor::Ldlt;

/// Steps of the inverse iteration: from a generic start the first one already gains the ratio of the two eigenvalues that
/// are to be told apart.
const STEPS: usize = 12;

/// Inverse iteration with a factorisation of `S + τ diag(s)` on the given rows, kept orthogonal in `diag(s)` to the indicators of
/// the components; zero on the other rows.
pub(crate) fn by_iteration(factor: &Ldlt, scales: &[f64], rows: &[usize], components: &[usize]) -> Option<Vec<f64>> {
    let component: Vec<usize> = rows.iter().map(|&i| components[i]).collect();
    // Any start with all frequencies in it: a quadratic residue pattern has no structure of the mesh.
    let mut x: Vec<f64> = (0..rows.len()).map(|k| ((k * k + 7 * k + 1) % 101) as f64 / 101.0 - 0.5).collect();
    for _ in 0..STEPS {
        without_means(&mut x, scales, &component);
        let mut column = [x.iter().zip(scales).map(|(x, s)| x * s).collect::<Vec<f64>>()];
        factor.solve(&mut column);
        let [y] = column;
        let size = y.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        x = y.iter().map(|v| v / size).collect();
    }
    without_means(&mut x, scales, &component);
    let mut full = vec![0.0; components.len()];
    rows.iter().zip(&x).for_each(|(&i, &v)| full[i] = v);
    Some(full)
}

/// The vector of a space that varies most on some component, relative to its length.
pub(crate) fn farthest_from_constants(space: &[Vec<f64>], components: &[usize]) -> Option<Vec<f64>> {
    let spread = |x: &[f64]| widest(x, components).map_or(0.0, |(_, _, spread)| spread);
    space.iter().max_by(|a, b| spread(a).total_cmp(&spread(b))).map(|x| {
        let mut x = x.clone();
        without_means(&mut x, &vec![1.0; components.len()], components);
        x
    })
}

/// The two vertices of one component whose values differ most, the larger first, and by how much; `None` if the vector is
/// locally constant.
pub(crate) fn widest(x: &[f64], components: &[usize]) -> Option<(usize, usize, f64)> {
    let count = components.iter().max().map_or(0, |m| m + 1);
    let mut range: Vec<Option<(usize, usize)>> = vec![None; count];
    for (i, &c) in components.iter().enumerate() {
        let (high, low) = range[c].unwrap_or((i, i));
        range[c] = Some((if x[i] > x[high] { i } else { high }, if x[i] < x[low] { i } else { low }));
    }
    let found = range.into_iter().flatten().map(|(a, b)| (a, b, x[a] - x[b]));
    found.max_by(|p, q| p.2.total_cmp(&q.2)).filter(|&(_, _, spread)| spread > 0.0)
}

/// Subtracts the weighted mean over each component.
fn without_means(x: &mut [f64], weights: &[f64], component: &[usize]) {
    let count = component.iter().max().map_or(0, |m| m + 1);
    let (mut sum, mut total) = (vec![0.0; count], vec![0.0; count]);
    for (i, &c) in component.iter().enumerate() {
        sum[c] += weights[i] * x[i];
        total[c] += weights[i];
    }
    x.iter_mut().zip(component).for_each(|(x, &c)| *x -= sum[c] / total[c]);
}
