//! Numbers as text, read strictly: the whole word or nothing.
//!
//! `1,5` is not 1, `0x1p0` is not 0, `1e400` is not infinity, `1e-400` is not zero. What is refused comes back with advice.

/// What to do about a word that is no number.
pub(super) type Advice = &'static str;

/// What to do where a number is missing.
const TOO_SHORT: Advice = "complete the line";

/// A finite decimal number, correctly rounded to `f64`.
pub(super) fn finite(word: &[u8]) -> Result<f64, Advice> {
    let value: f64 = decimal(word)?;
    check_range(word, value.is_infinite(), value == 0.0, "its magnitude is beyond the largest double, about 1.8e308")?;
    Ok(value)
}

/// A finite decimal number, correctly rounded to `f32` (once, not by way of `f64`).
pub(super) fn finite_single(word: &[u8]) -> Result<f32, Advice> {
    let value: f32 = decimal(word)?;
    check_range(word, value.is_infinite(), value == 0.0, "its magnitude is beyond the largest float, about 3.4e38")?;
    Ok(value)
}

/// `nan`, `inf` or `infinity` in any case and with any sign, as C, SciPy, Julia and MATLAB print them.
pub(super) fn special(word: &[u8]) -> Option<f64> {
    let (sign, name) = match word {
        [b'-', rest @ ..] => (-1.0, rest),
        [b'+', rest @ ..] => (1.0, rest),
        _ => (1.0, word),
    };
    let name = name.to_ascii_lowercase();
    // The C library of Windows prints "-nan(ind)".
    let detailed_nan = name.starts_with(b"nan(") && name.ends_with(b")");
    match name.as_slice() {
        b"inf" | b"infinity" => Some(f64::INFINITY.copysign(sign)),
        name if name == b"nan" || detailed_nan => Some(f64::NAN.copysign(sign)),
        _ => None,
    }
}

/// A whole number without point or exponent.
pub(super) fn whole(word: &[u8]) -> Result<i64, Advice> {
    let digits = word.strip_prefix(b"-").or_else(|| word.strip_prefix(b"+")).unwrap_or(word);
    let written =
        std::str::from_utf8(word).ok().filter(|_| !digits.is_empty() && digits.iter().all(u8::is_ascii_digit));
    match written {
        Some(text) => text.parse().map_err(|_| "it is beyond the range of 64-bit integers"),
        None if word.is_empty() => Err(TOO_SHORT),
        None if finite(word).is_ok() => Err("write it without point and exponent"),
        None => Err("a whole number is written in decimal digits only"),
    }
}

fn decimal<T: std::str::FromStr>(word: &[u8]) -> Result<T, Advice> {
    // The standard library also knows "inf" and "nan"; letters other than the exponent's are kept from it.
    let alphabet = |b: &u8| b.is_ascii_digit() || b"+-.eE".contains(b);
    std::str::from_utf8(word)
        .ok()
        .filter(|_| word.iter().all(alphabet))
        .and_then(|text| text.parse().ok())
        .ok_or_else(|| advice(word))
}

fn check_range(word: &[u8], overflow: bool, zero: bool, too_large: Advice) -> Result<(), Advice> {
    let mantissa = word.iter().take_while(|b| !b.eq_ignore_ascii_case(&b'e'));
    if overflow {
        Err(too_large)
    } else if zero && mantissa.into_iter().any(|b| (b'1'..=b'9').contains(b)) {
        Err("it is too small and would be read as zero; write 0 or rescale")
    } else {
        Ok(())
    }
}

fn advice(word: &[u8]) -> Advice {
    let lower = word.to_ascii_lowercase();
    let bare = lower.strip_prefix(b"-").or_else(|| lower.strip_prefix(b"+")).unwrap_or(&lower);
    if word.is_empty() {
        TOO_SHORT
    } else if lower.contains(&b',') {
        "write decimals with a point, and blanks between numbers"
    } else if lower.contains(&b';') {
        "separate numbers with blanks"
    } else if bare.starts_with(b"0x") {
        "write it in decimal, not hexadecimal, notation"
    } else if special(word).is_some() {
        "only finite numbers are admitted here"
    } else if bare.first().is_some_and(u8::is_ascii_digit) && bare.contains(&b'd') {
        "write the exponent with e, as in 1.5e-3"
    } else {
        "a number is written like -1.5e-3"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_read_whole_and_correctly_rounded() {
        for (word, value) in [("1", 1.0), ("-0", -0.0), ("+.5", 0.5), ("2.", 2.0), ("1E-3", 1e-3), ("4e-320", 4e-320)] {
            assert_eq!(finite(word.as_bytes()).map(f64::to_bits), Ok(f64::to_bits(value)), "{word}");
        }
        // 1 + 2⁻²⁴ is halfway between two floats, a little more is above: through f64 it would round twice and go down.
        assert_eq!(finite_single(b"1.000000059604644775390626"), Ok(1.0 + f32::EPSILON));
    }

    #[test]
    fn what_c_would_read_in_part_is_refused() {
        for word in [
            "1,5", "0x1p0", "1e", "1.0.0", "1_000", "--1", "1e5x", "", ".", "e5", "nan", "inf", "1d5", "½", "1e400",
            "1e-400",
        ] {
            assert!(finite(word.as_bytes()).is_err(), "{word}");
        }
        for word in ["1.0", "1e3", "0x1", "", "-", "1 2", "9223372036854775808"] {
            assert!(whole(word.as_bytes()).is_err(), "{word}");
        }
        assert!(finite(b"\xff\xfe").is_err() && whole(b"\xff").is_err());
    }

    #[test]
    fn not_a_number_and_infinity_are_known_in_every_dialect() {
        for word in ["nan", "NaN", "-nan", "+NAN", "-nan(ind)"] {
            assert!(special(word.as_bytes()).is_some_and(f64::is_nan), "{word}");
        }
        assert!(special(b"-nan").is_some_and(f64::is_sign_negative));
        assert_eq!(special(b"inf"), Some(f64::INFINITY));
        assert_eq!(special(b"-Infinity"), Some(f64::NEG_INFINITY));
        assert_eq!(special(b"nano"), None);
    }
}
