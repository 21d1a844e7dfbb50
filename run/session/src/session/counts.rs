//! What a session counts: its frames, those that were missed, and what they took.

use vitriol_xr::FrameInfo;

use crate::tally::{Holdings, Tally};

/// Frames before those that count: more than a second, in which a driver compiles what it has put off.
pub const WARM_UP: u64 = 120;

/// Counts frames and display periods without one.
#[derive(Default)]
pub(super) struct Counts {
    /// Frames, those of the warm-up included.
    pub frames: u64,
    /// Display periods without a frame, of those that count.
    pub skipped: u64,
    /// What the frames that count took.
    pub tally: Tally,
    /// What the process held when counting began.
    pub began_with: Option<Holdings>,
    /// Display time of the frame before, ns; `None` where the headset showed nothing since.
    before: Option<i64>,
}

impl Counts {
    /// None yet.
    pub fn new(tally: Tally) -> Self {
        Self {
            tally,
            ..Self::default()
        }
    }

    /// A frame has begun; whether display periods went by without one since the frame before.
    pub fn begin(&mut self, info: &FrameInfo) -> bool {
        self.frames += 1;
        if self.is_first() {
            self.tally.restart();
            self.skipped = 0;
            self.began_with = Holdings::now();
        }
        let mut skipped = 0;
        let before = self.before.replace(info.xr_time);
        if let (Some(before), true) = (before, info.period_ns > 0) {
            let passed = info.xr_time.saturating_sub(before) as f64;
            let periods = (passed / info.period_ns as f64).round();
            skipped = (periods - 1.0).max(0.0) as u64;
        }
        self.skipped += skipped;
        skipped > 0
    }

    /// Whether the present frame is the first that counts.
    pub fn is_first(&self) -> bool {
        self.frames == WARM_UP + 1
    }

    /// The headset shows nothing: what passes until the next frame is not missed.
    pub fn pause(&mut self) {
        self.before = None;
    }
}

#[cfg(test)]
mod tests {
    use vitriol_gpu::LockWaits;

    use super::*;

    /// A display of 90 Hz, rounded to nanoseconds.
    const PERIOD: i64 = 11_111_111;

    fn at(period: i64) -> FrameInfo {
        FrameInfo {
            xr_time: 7_000 + period * PERIOD,
            period_ns: PERIOD,
            ..FrameInfo::default()
        }
    }

    fn counts() -> Counts {
        Counts::new(Tally::new(true, false))
    }

    #[test]
    fn periods_without_a_frame_are_missed() {
        let mut counts = counts();
        // Whenever the first comes, nothing is missed before it. Then the periods 6, 8 and 9.
        let missed = [5, 7, 10, 11].map(|period| counts.begin(&at(period)));
        assert_eq!(missed, [false, true, true, false]);
        assert_eq!((counts.frames, counts.skipped), (4, 3));
        // Nobody would have seen those that pass while the headset is off.
        counts.pause();
        assert!(!counts.begin(&at(100)));
        // A runtime that names no period misses none.
        let unknown = FrameInfo {
            period_ns: 0,
            ..at(200)
        };
        assert!(!counts.begin(&unknown));
        assert_eq!(counts.skipped, 3);
    }

    #[test]
    fn counting_begins_after_the_warm_up() {
        let mut counts = counts();
        // Every other period is missed, and each frame takes 1 ms.
        for frame in 1..=WARM_UP as i64 {
            counts.begin(&at(2 * frame));
            assert!(!counts.is_first());
            counts.tally.frame(1.0, &LockWaits::default(), false);
        }
        assert_eq!(counts.skipped, WARM_UP - 1);
        assert!(!counts.begin(&at(2 * WARM_UP as i64 + 1)));
        assert!(counts.is_first());
        assert_eq!((counts.frames, counts.skipped), (WARM_UP + 1, 0));
        assert!(counts.tally.cpu_ms.is_empty());
    }
}
