//! The rate of the desk's frames.

use vitriol_gpu::vk;

/// Lowest and highest rate of a display that is believed, Hz.
const RATES: [f64; 2] = [20.0, 1000.0];
/// The rate of a display that reports none, Hz: that of most.
const USUAL: f64 = 60.0;
/// Highest rate of frames, Hz: a scene has 90 steps a second, and a frame without a step shows nothing that was not there before.
const MOST: f64 = 90.0;
/// Lowest rate of frames that is offered, Hz: 30, and half of a display's 59.94. Below, motion is seen as jerks.
const LEAST: f64 = 29.9;

/// The rate of frames at a display of `reported` mHz, Hz: its own, or a whole part of it.
pub fn rate(reported: Option<u32>) -> f64 {
    let told = reported.map(|reported| 1e-3 * f64::from(reported));
    let of_display = told.filter(|rate| (RATES[0]..RATES[1]).contains(rate));
    let rate = of_display.unwrap_or(USUAL);
    // A display that reports 90.1 Hz means 90.
    rate / (rate / (MOST + 1.0)).ceil()
}

/// The rates from which a governor may choose on a device of that `kind`, Hz: `rate` (Hz) and whole parts of it, so that each frame is
/// shown for as long as any other. At half the rate the panel's text stays sharp, with a third of the pixels it does not. Our choice: only
/// an integrated GPU is taken to need that. A discrete one rarely does, and a software driver does not get to 30 frames.
pub fn rates(rate: f64, kind: vk::PhysicalDeviceType) -> Vec<f32> {
    if kind != vk::PhysicalDeviceType::INTEGRATED_GPU {
        return Vec::new();
    }
    // A fourth of MOST is below LEAST.
    let parts = [1.0, 2.0, 3.0].map(|part| rate / part);
    let offered = parts.into_iter().filter(|&part| part >= LEAST);
    offered.map(|part| part as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rates::{Rates, Taken};
    use vk::PhysicalDeviceType as Kind;

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

    #[test]
    fn an_integrated_gpu_may_show_half_as_many() {
        let offered = |rate: f64| rates(rate, Kind::INTEGRATED_GPU);
        assert_eq!(offered(60.0), [60.0, 30.0]);
        assert_eq!(offered(90.0), [90.0, 45.0, 30.0]);
        // 25 and 12 are too few.
        assert_eq!(offered(50.0), [50.0]);
        assert!(offered(24.0).is_empty());
        assert_eq!(offered(59.94).len(), 2);
        for kind in [Kind::DISCRETE_GPU, Kind::VIRTUAL_GPU, Kind::CPU] {
            assert!(rates(60.0, kind).is_empty(), "{kind:?}");
        }
    }

    /// On an integrated GPU a step takes 7.5 ms at the most and a picture of 1280 x 720 16.2 ms, as counted in
    /// docs/measurements/performance.md.
    #[test]
    fn a_weak_gpu_shows_half_as_many_frames() {
        let taken = Taken {
            step: 7.5,
            picture: 16.2,
            frame_time: 1.0 / 90.0,
        };
        let lower = |kind| Rates::new(&rates(60.0, kind), 60.0).lower(&taken);
        assert_eq!(lower(Kind::INTEGRATED_GPU), Some(30.0));
        assert_eq!(lower(Kind::DISCRETE_GPU), None);
    }
}
