//! Times as they are written.

/// A time in seconds, rounded to whole nanoseconds, the unit of times in a recording.
///
/// A scene's step may be a number such as 0.011111111111111 s. 108 of these are 1.199999999999988 s, and who reads a table expects 1.2 s.
pub fn whole_nanoseconds(seconds: f64) -> f64 {
    // The quotient of two whole numbers is the number next to the decimal one, so it has nine decimals at most. Without the sign of -0.
    (seconds * 1e9).round() / 1e9 + 0.0
}

#[cfg(test)]
mod tests {
    use super::whole_nanoseconds;

    #[test]
    fn a_time_has_nine_decimals_at_most() {
        let written = |seconds| whole_nanoseconds(seconds).to_string();
        assert_eq!(written(108.0 * 0.011111111111111), "1.2");
        assert_eq!(written(0.1 + 0.2), "0.3");
        assert_eq!(written(1.0 / 3.0), "0.333333333");
        // Near the longest recording's end.
        assert_eq!(written(10_800.0 - 1.0 / 90.0), "10799.988888889");
        assert_eq!(written(-1e-12), "0");
    }
}
