//! The mirror: what the left eye sees, in a window on the computer; and the window of a desk, which has no other picture.
//!
//! The window is filled by softbuffer and not by a swapchain, for three reasons. The runtime chooses the device, and the
//! screen may hang on another. A lost device is made anew, and the window stays. A swapchain that waits for the screen's
//! refresh would hold up the headset's queue.

mod shrink;
mod window;

use vitriol_gpu::{Gpu, Image};
use vitriol_run::Failure;
use vitriol_shaders::Library;

pub use self::shrink::{LONGEST, Shrink, Shrunk, fit};
use self::window::Say;
pub(crate) use self::window::{Display, Extent, Opening};
pub use self::window::{Window, names_screen};
use super::info::Info;

/// Shows the left eye's picture in a window on the computer, 30 times a second of display time; at a desk, whose only picture that is, as
/// often as one comes.
pub struct Mirror {
    window: Window,
    shrink: Shrink,
    title: String,
}

impl Mirror {
    /// In `window`, for pictures of `eye` pixels an eye.
    ///
    /// # Errors
    /// An error of the device.
    pub fn new(
        gpu: &Gpu,
        library: &Library,
        eye: [u32; 2],
        window: Window,
    ) -> Result<Self, Failure> {
        Ok(Self {
            shrink: Shrink::new(gpu, library, eye, window.longest)?,
            window,
            title: String::new(),
        })
    }

    /// Goes on with another device.
    ///
    /// # Errors
    /// As for [`Mirror::new`].
    pub fn move_to(&mut self, gpu: &Gpu, library: &Library, eye: [u32; 2]) -> Result<(), Failure> {
        self.shrink = Shrink::new(gpu, library, eye, self.window.longest)?;
        Ok(())
    }

    /// Takes the first `drawn` pixels of the picture that is shown at `time` (ns, the runtime's clock),
    /// if it is time for one. To be called between frames, behind the picture.
    ///
    /// # Errors
    /// An error of the device.
    pub fn take(&mut self, picture: &Image, drawn: [u32; 2], time: i64) -> Result<(), Failure> {
        let Some(extent) = self.window.extent() else {
            return Ok(());
        };
        let pace = (time, self.window.every);
        self.shrink.begin(picture, drawn, extent, pace)
    }

    /// Hands over what the device is done with; does not wait.
    ///
    /// # Errors
    /// An error of the device.
    pub fn hand_over(&mut self) -> Result<(), Failure> {
        while let Some(shrunk) = self.shrink.done()? {
            self.window.say(Say::Picture(shrunk));
        }
        Ok(())
    }

    /// Puts scene and state into the window's title; `instead` is why the headset shows nothing, if it does not.
    pub fn entitle(&mut self, info: &Info, instead: Option<&str>) {
        let title = title(info, instead);
        if self.title != title {
            self.window.say(Say::Title(title.clone()));
            self.title = title;
        }
    }
}

fn title(info: &Info, instead: Option<&str>) -> String {
    let mut title = format!("Vitriol: {}", info.title);
    if let Some(coming) = &info.coming {
        title += &format!(", setting up {coming} …");
    }
    match (instead, info.slow) {
        (Some(instead), _) => title += &format!(", {instead}"),
        (None, Some(per_cent)) => title += &format!(", slow motion: {per_cent} % of real time"),
        (None, None) => {}
    }
    if let Some(seconds) = info.recording {
        title += &format!(", recording, {} min {:02} s", seconds / 60, seconds % 60);
    }
    title
}
