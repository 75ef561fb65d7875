//! Numbers for a reader: four significant digits, a proper minus sign, powers of ten written out.

/// A number with four significant digits: `−0.31`, `101.2`, `1.2×10⁻⁷`.
pub fn number(x: f64) -> String {
    if x.is_nan() {
        return "NaN".into();
    }
    if x.is_infinite() {
        return if x > 0.0 { "∞".into() } else { "−∞".into() };
    }
    if x == 0.0 {
        return "0".into();
    }
    let scientific = format!("{:.3e}", x.abs());
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let power: i32 = exponent.parse().unwrap_or(0);
    let digits = if (-3..5).contains(&power) {
        trimmed(&format!("{:.*}", (3 - power).max(0) as usize, x.abs()))
    } else {
        format!("{}×10{}", trimmed(mantissa), superscript(power))
    };
    if x < 0.0 { format!("−{digits}") } else { digits }
}

/// An angle in degrees with one decimal.
pub fn degrees(x: f64) -> String {
    format!("{x:.1}°").replace('-', "−")
}

/// A count with its digits in groups of three from five digits on.
pub fn count(n: usize) -> String {
    let digits = n.to_string();
    if digits.len() < 5 {
        return digits;
    }
    let first = digits.len() % 3;
    let group = |(k, c): (usize, char)| if k > 0 && k % 3 == first { vec!['\u{202f}', c] } else { vec![c] };
    digits.chars().enumerate().flat_map(group).collect()
}

/// Seconds in the unit that suits them.
pub fn seconds(s: f64) -> String {
    match s {
        s if s < 1e-3 => format!("{:.0} µs", s * 1e6),
        s if s < 1.0 => format!("{:.0} ms", s * 1e3),
        s if s < 120.0 => format!("{s:.1} s"),
        s => format!("{:.1} min", s / 60.0),
    }
}

/// An integer as a superscript.
pub fn superscript(power: i32) -> String {
    let digit = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => c.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(c),
    };
    power.to_string().chars().map(digit).collect()
}

fn trimmed(digits: &str) -> String {
    match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.').to_string(),
        false => digits.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_four_significant_digits_and_a_real_minus() {
        let cases = [
            (-0.31, "−0.31"),
            (101.24, "101.2"),
            (0.0, "0"),
            (1.2e-7, "1.2×10⁻⁷"),
            (-123456.0, "−1.235×10⁵"),
            (9999.96, "10000"),
            (0.00123456, "0.001235"),
            (f64::NEG_INFINITY, "−∞"),
        ];
        for (x, expected) in cases {
            assert_eq!(number(x), expected, "{x:e}");
        }
    }

    #[test]
    fn counts_are_grouped_from_five_digits_on() {
        assert_eq!(
            (count(1043), count(70041), count(1234567)),
            ("1043".into(), "70\u{202f}041".into(), "1\u{202f}234\u{202f}567".into())
        );
    }
}
