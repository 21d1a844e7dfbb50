//! What the left eye sees, and the glass from close by, for the console: shrunk on the device and coded on a thread of its own. Nothing
//! here waits.

use std::time::Instant;

use vitriol_console::Port;
use vitriol_gpu::{Gpu, Image};
use vitriol_run::Failure;
use vitriol_shaders::Library;

use super::mirror::{LONGEST, Shrink, fit};
use vitriol_live::{CLOSE_UP_EVERY, Coder, RawPicture, VIEW_FPS, VIEW_SIDE, Viewpoint};

/// Display time between two pictures, ns.
const EVERY: i64 = 1_000_000_000 / VIEW_FPS as i64;
/// Width and height of pictures from close by, pixels. Our choice: the glass is 320 pixels high in them.
const CLOSE_UP: [u32; 2] = [640, 480];
/// Display time between two pictures from close by where they do not fit beside frames, ns. Our choice: one frame in 216 pays for
/// one where a headset shows 72 a second.
const CLOSE_UP_RESTS: i64 = 3_000_000_000;

/// Sends the left eye's picture, and the glass from close by, to the console while somebody looks.
pub struct View {
    shrink: Shrink,
    close_up: Shrink,
    turns: Turns,
    coder: Coder,
    /// When it began: a runtime that is found again has another clock.
    began: Instant,
}

impl View {
    /// Of pictures of `eye` pixels an eye, for who looks at that port's student.
    ///
    /// # Errors
    /// An error of the device.
    pub fn new(gpu: &Gpu, library: &Library, eye: [u32; 2], port: &Port) -> Result<Self, Failure> {
        Ok(Self {
            shrink: Shrink::new(gpu, library, eye, LONGEST)?,
            close_up: Shrink::new(gpu, library, close_up_of(eye), CLOSE_UP[0])?,
            turns: Turns::default(),
            coder: Coder::new(port)?,
            began: Instant::now(),
        })
    }

    /// Goes on with another device.
    ///
    /// # Errors
    /// An error of the device.
    pub fn move_to(&mut self, gpu: &Gpu, library: &Library, eye: [u32; 2]) -> Result<(), Failure> {
        self.shrink = Shrink::new(gpu, library, eye, LONGEST)?;
        self.close_up = Shrink::new(gpu, library, close_up_of(eye), CLOSE_UP[0])?;
        self.turns = Turns::default();
        Ok(())
    }

    /// Takes the first `drawn` pixels of the picture that is shown at `time` (ns), if it is time for one and somebody looks. To be
    /// called between frames, behind the picture.
    ///
    /// # Errors
    /// An error of the device.
    pub fn take(&mut self, picture: &Image, drawn: [u32; 2], time: i64) -> Result<(), Failure> {
        if !self.coder.is_wanted(Viewpoint::Student) {
            return Ok(());
        }
        self.shrink
            .begin((picture, None), drawn, [VIEW_SIDE; 2], (time, EVERY))
    }

    /// Whether a picture from close by is to be drawn behind the one that is shown at `time` (ns), where that many display periods were
    /// without a frame so far, and it `yields` to the headset's frames, or not: the time since the last one, s.
    pub fn close_up_is_due(&mut self, time: i64, missed: u64, yields: bool) -> Option<f64> {
        if !self.coder.is_wanted(Viewpoint::CloseUp) {
            return None;
        }
        self.turns.take(time, missed, yields)
    }

    /// Takes the first `drawn` pixels of a picture from close by. To be called behind it.
    ///
    /// # Errors
    /// An error of the device.
    pub fn take_close_up(&mut self, picture: &Image, drawn: [u32; 2]) -> Result<(), Failure> {
        // `Turns` paces it.
        self.close_up
            .begin((picture, None), drawn, CLOSE_UP, (0, 0))
    }

    /// Hands over what the device is done with.
    ///
    /// # Errors
    /// An error of the device.
    pub fn hand_over(&mut self) -> Result<(), Failure> {
        for (shrink, from) in [
            (&mut self.close_up, Viewpoint::CloseUp),
            (&mut self.shrink, Viewpoint::Student),
        ] {
            while let Some(shrunk) = shrink.done()? {
                let time_us = u64::try_from(self.began.elapsed().as_micros()).unwrap_or(u64::MAX);
                self.coder.give(RawPicture::from(shrunk), from, time_us);
            }
        }
        Ok(())
    }
}

/// Width and height of pictures from close by that are drawn in images of `eye` pixels.
pub fn close_up_of(eye: [u32; 2]) -> [u32; 2] {
    fit(CLOSE_UP, [0, 1].map(|side| CLOSE_UP[side].min(eye[side])))
}

/// When pictures from close by are drawn.
#[derive(Debug, Default)]
struct Turns {
    /// Display time of the last one, ns.
    last: Option<i64>,
    /// Display periods that were without a frame by then.
    missed: u64,
}

impl Turns {
    /// Whether one is due, see [`View::close_up_is_due`], and then taken as drawn.
    fn take(&mut self, time: i64, missed: u64, yields: bool) -> Option<f64> {
        let every = match yields || missed != self.missed {
            true => CLOSE_UP_RESTS,
            false => CLOSE_UP_EVERY.as_nanos() as i64,
        };
        let passed = self.last.map(|last| time.saturating_sub(last));
        // A runtime that is found again has another clock.
        if passed.is_some_and(|passed| (0..every).contains(&passed)) {
            return None;
        }
        (self.last, self.missed) = (Some(time), missed);
        Some(passed.map_or(f64::INFINITY, |passed| 1e-9 * passed.max(0) as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number of pictures in so many frames of 90 Hz from that time (ns) on, by which `missed` display periods were without a frame.
    fn drawn(turns: &mut Turns, from: i64, frames: i64, missed: impl Fn(i64) -> u64) -> usize {
        let period = 11_111_111;
        let taken =
            (0..frames).filter_map(|frame| turns.take(from + frame * period, missed(frame), false));
        taken.count()
    }

    /// By hand: in 9 s, or 810 frames, 43 pictures where all frames fit, since the first frame that is 200 ms after another is the 19th;
    /// and 3 where some are missed, since the first that is 3 s after another is the 271st. It is as before as soon as none is missed.
    #[test]
    fn pictures_from_close_by_give_way_to_frames() {
        let mut turns = Turns::default();
        let nine_seconds = 810;
        let later = |n: i64| n * 10_000_000_000;
        let fits = drawn(&mut turns, 0, nine_seconds, |_| 0);
        assert_eq!(fits, 43);
        let misses = drawn(&mut turns, later(1), nine_seconds, |frame| frame as u64);
        assert_eq!(misses, 3);
        let fits = drawn(&mut turns, later(2), nine_seconds, |_| 810);
        assert_eq!(fits, 43);
        assert!(turns.take(later(4), 810, true).is_some());
        assert!(turns.take(later(4) + 1_000_000_000, 810, true).is_none());
        let after = turns.take(later(4) + 3_000_000_000, 810, true);
        assert_eq!(after, Some(3.0));
        // Another clock.
        assert_eq!(turns.take(5, 810, false), Some(0.0));
    }

    /// By hand: as high as 240 pixels the picture is 320 wide. No picture is larger than its image.
    #[test]
    fn a_picture_from_close_by_fits_its_image() {
        for (eye, drawn) in [
            ([2064, 2208], [640, 480]),
            ([1280, 240], [320, 240]),
            ([320, 720], [320, 240]),
        ] {
            assert_eq!(close_up_of(eye), drawn, "{eye:?}");
        }
    }
}
