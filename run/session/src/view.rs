//! What the left eye sees, for the console: shrunk on the device and coded on a thread of its own. Nothing here waits.

use std::time::Instant;

use vitriol_console::Port;
use vitriol_gpu::{Gpu, Image};
use vitriol_run::Failure;
use vitriol_shaders::Library;

use super::mirror::{LONGEST, Shrink};
use vitriol_live::{Coder, RawPicture, VIEW_FPS, VIEW_SIDE};

/// Display time between two pictures, ns.
const EVERY: i64 = 1_000_000_000 / VIEW_FPS as i64;

/// Sends the left eye's picture to the console while somebody looks.
pub struct View {
    shrink: Shrink,
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
        Ok(())
    }

    /// Takes the first `drawn` pixels of the picture that is shown at `time` (ns), if it is time for one and somebody looks. To be
    /// called between frames, behind the picture.
    ///
    /// # Errors
    /// An error of the device.
    pub fn take(&mut self, picture: &Image, drawn: [u32; 2], time: i64) -> Result<(), Failure> {
        if !self.coder.is_wanted() {
            return Ok(());
        }
        self.shrink
            .begin(picture, drawn, [VIEW_SIDE; 2], (time, EVERY))
    }

    /// Hands over what the device is done with.
    ///
    /// # Errors
    /// An error of the device.
    pub fn hand_over(&mut self) -> Result<(), Failure> {
        while let Some(shrunk) = self.shrink.done()? {
            let time_us = u64::try_from(self.began.elapsed().as_micros()).unwrap_or(u64::MAX);
            self.coder.give(RawPicture::from(shrunk), time_us);
        }
        Ok(())
    }
}
