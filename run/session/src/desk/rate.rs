//! The rate of the desk's frames.

/// Lowest and highest rate of a display that is believed, Hz.
const RATES: [f64; 2] = [20.0, 1000.0];
/// The rate of a display that reports none, Hz: that of most.
const USUAL: f64 = 60.0;
/// Highest rate of frames, Hz: a scene has 90 steps a second, and a frame without a step shows nothing that was not there before.
const MOST: f64 = 90.0;

/// The rate of frames at a display of `reported` mHz, Hz: its own, or a whole part of it.
pub fn rate(reported: Option<u32>) -> f64 {
    let told = reported.map(|reported| 1e-3 * f64::from(reported));
    let of_display = told.filter(|rate| (RATES[0]..RATES[1]).contains(rate));
    let rate = of_display.unwrap_or(USUAL);
    // A display that reports 90.1 Hz means 90.
    rate / (rate / (MOST + 1.0)).ceil()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_display_has_its_own_rate_or_a_part_of_it() {
        for (reported, expected) in [
            (None, 60.0),
            (Some(0), 60.0),
            (Some(59_940), 59.94),
            (Some(90_100), 90.1),
            (Some(144_000), 72.0),
            (Some(240_000), 80.0),
        ] {
            assert!((rate(reported) - expected).abs() < 1e-9, "{reported:?}");
        }
    }
}
