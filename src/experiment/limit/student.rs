//! Quantiles of Student's distribution, for the confidence interval of a slope.
//!
//! # Definition
//! `A(t | ν) = P(|T| ≤ t)` for ν degrees of freedom is a finite sum in `θ = atan(t/√ν)` \[abramowitz-stegun1964\], 26.7.3 and 26.7.4:
//! ```text
//! ν = 1:     2θ/π
//! ν odd:     2/π [θ + sin θ (cos θ + 2/3 cos³θ + … + (2·4···(ν−3))/(3·5···(ν−2)) cos^(ν−2) θ)]
//! ν even:    sin θ [1 + 1/2 cos²θ + (1·3)/(2·4) cos⁴θ + … + (1·3···(ν−3))/(2·4···(ν−2)) cos^(ν−2) θ]
//! ```

use super::bessel::bisect;

/// `P(|T| ≤ t)` for `freedom ≥ 1` degrees of freedom.
pub fn within(t: f64, freedom: usize) -> f64 {
    let theta = (t / (freedom as f64).sqrt()).atan();
    let (sine, cosine) = theta.sin_cos();
    let odd = freedom % 2 == 1;
    // The first term is cos θ or 1; each next one has cos²θ more and the factor k/(k + 1).
    let (mut term, mut sum, mut k) = if odd { (cosine, cosine, 2) } else { (1.0, 1.0, 1) };
    while k + 2 < freedom {
        term *= cosine * cosine * k as f64 / (k + 1) as f64;
        sum += term;
        k += 2;
    }
    match (odd, freedom) {
        (true, 1) => std::f64::consts::FRAC_2_PI * theta,
        (true, _) => std::f64::consts::FRAC_2_PI * (theta + sine * sum),
        (false, _) => sine * sum,
    }
}

/// The t with `P(|T| ≤ t) = 0.95`, by bisection; `None` without a degree of freedom.
pub fn quantile(freedom: usize) -> Option<f64> {
    (freedom > 0).then(|| bisect(|t| within(t, freedom) - 0.95, [0.0, 1e3]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz and Stegun, table 26.10, column 0.95.
    #[test]
    fn the_quantiles_are_those_of_the_handbook() {
        let table = [(1, 12.706), (2, 4.303), (3, 3.182), (4, 2.776), (5, 2.571), (6, 2.447), (7, 2.365), (8, 2.306)];
        for (freedom, t) in table.into_iter().chain([(10, 2.228), (15, 2.131), (20, 2.086), (30, 2.042), (120, 1.980)])
        {
            let found = quantile(freedom).unwrap();
            assert!((found - t).abs() < 6e-4, "{freedom}: {found}");
        }
        assert_eq!(quantile(0), None);
    }
}
