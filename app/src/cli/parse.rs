//! Values of arguments, read.

/// Two whole numbers above zero, such as a picture's sides.
pub(crate) fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x').map(|(w, h)| [w.parse(), h.parse()]);
    match sides {
        Some([Ok(width), Ok(height)]) if width > 0 && height > 0 => Ok([width, height]),
        _ => Err("give two whole numbers above 0 with an x between them, such as 960x540".into()),
    }
}

/// Frames a second.
pub(super) fn rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(rate) if (1.0..=1000.0).contains(&rate) => Ok(rate),
        _ => Err("give a rate of 1 to 1000 frames a second, such as 90".into()),
    }
}

/// A finite number above zero.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("give a number above 0, such as 2.5".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_numbers_above_zero() {
        assert_eq!(size("960x540"), Ok([960, 540]));
        for wrong in ["960", "960x", "0x540", "960,540", "-1x2", "axb"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn positive_numbers_are_finite() {
        assert_eq!(positive("2.5"), Ok(2.5));
        for wrong in ["0", "-1", "NaN", "inf", "2,5"] {
            assert!(positive(wrong).is_err(), "{wrong}");
        }
    }
}
