//! The inverse of a small dense matrix by elimination with pivoting: the second way for MAX.

pub fn inverse(a: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let n = a.len();
    let unit = |i: usize| (0..n).map(move |j| f64::from(u8::from(i == j)));
    let mut rows: Vec<Vec<f64>> = (0..n).map(|i| a[i].iter().copied().chain(unit(i)).collect()).collect();
    for k in 0..n {
        let best = (k..n).max_by(|&p, &q| rows[p][k].abs().total_cmp(&rows[q][k].abs())).unwrap();
        rows.swap(k, best);
        let pivot = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = if i == k { 1.0 - 1.0 / pivot[k] } else { row[k] / pivot[k] };
            row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= factor * p);
        }
    }
    rows.into_iter().map(|row| row[n..].to_vec()).collect()
}
