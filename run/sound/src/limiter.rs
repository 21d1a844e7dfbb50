//! Keeps the output below full scale.

/// Loudest sample that passes unchanged.
const CEILING: f32 = 0.9;

/// Part of the gain's reduction that remains after a sample: half is gone after 0.1 s.
const RELEASE: f32 = 0.999_856;

/// Turns both channels down at once where one of them is too loud, and slowly up again.
#[derive(Debug, Default)]
pub(crate) struct Limiter {
    peak: f32,
}

impl Limiter {
    /// The sample, no greater than the ceiling in either channel; 0 for NaN.
    pub(crate) fn limit(&mut self, sample: [f32; 2]) -> [f32; 2] {
        let sample = sample.map(|it| {
            if it.is_finite() {
                it.clamp(-1e6, 1e6)
            } else {
                0.0
            }
        });
        let loudest = sample[0].abs().max(sample[1].abs());
        self.peak = loudest.max(self.peak * RELEASE);
        if self.peak <= CEILING {
            // Below the ceiling the limiter has no memory.
            self.peak = 0.0;
            return sample;
        }
        let gain = CEILING / self.peak;
        sample.map(|it| (it * gain).clamp(-CEILING, CEILING))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_exceeds_full_scale_and_what_is_quiet_stays() {
        let mut limiter = Limiter::default();
        assert_eq!(limiter.limit([0.5, -0.25]), [0.5, -0.25]);
        for sample in [3.0, 1e30, f32::MAX, f32::INFINITY, f32::NAN, -4.0] {
            let limited = limiter.limit([sample, 0.1]);
            assert!(
                limited.iter().all(|it| it.abs() <= 0.9),
                "{sample}: {limited:?}"
            );
        }
        for _ in 0..10 * 48_000 {
            limiter.limit([0.0; 2]);
        }
        assert_eq!(limiter.limit([0.5, -0.25]), [0.5, -0.25]);
    }
}
