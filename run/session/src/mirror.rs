//! The mirror: what the left eye sees, in a window on the computer; and the window of a desk, which has no other picture.
//!
//! The window is filled by softbuffer and not by a swapchain, for three reasons. The runtime chooses the device, and the
//! screen may hang on another. A lost device is made anew, and the window stays. A swapchain that waits for the screen's
//! refresh would hold up the headset's queue.

mod label;
mod letters;
mod over;
mod shrink;
mod strip;
mod window;

use vitriol_gpu::{Gpu, Image};
use vitriol_run::Failure;
use vitriol_run::texts::PanelTexts;
use vitriol_shaders::Library;

pub(crate) use self::label::Said as Label;
pub use self::shrink::{LONGEST, Layer, Shrink, Shrunk, fit};
use self::strip::Said;
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
    /// What the strip of a desk's window says, and its label.
    said: Said,
    label: Option<Label>,
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
            said: Said::default(),
            label: None,
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
    /// if it is time for one; with the panel under it where the window is to sample that. To be called between frames, behind the picture.
    ///
    /// # Errors
    /// An error of the device.
    pub fn take(
        &mut self,
        picture: (&Image, Option<Layer<'_>>),
        drawn: [u32; 2],
        time: i64,
    ) -> Result<(), Failure> {
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

    /// Names in a desk's window what the pointer is at, or nothing.
    pub(crate) fn label(&mut self, label: Option<Label>) {
        if self.label != label {
            self.window.say(Say::Label(label.clone()));
            self.label = label;
        }
    }

    /// Puts scene and state into the window's title, and at a desk into the window's strip; `instead` is why the headset shows nothing, if
    /// it does not.
    pub fn entitle(&mut self, info: &Info, words: &PanelTexts, instead: Option<&str>) {
        let title = title(info, words, instead);
        if self.title != title {
            self.window.say(Say::Title(title.clone()));
            self.title = title;
        }
        if !info.pointer {
            return;
        }
        let said = Said::of(info, words);
        if self.said != said {
            self.window.say(Say::Strip(said.clone()));
            self.said = said;
        }
    }
}

fn title(info: &Info, words: &PanelTexts, instead: Option<&str>) -> String {
    let coming = info.coming.as_ref().map(|scene| words.coming(scene));
    let slow = info.slow.map(|per_cent| words.slow(per_cent));
    let recording = info.recording.map(|seconds| words.recording(seconds));
    let parts = [
        Some(format!("Vitriol: {}", info.title)),
        coming,
        instead.map(str::to_owned).or(slow),
        info.told.paused.clone(),
        recording,
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    parts.join(", ")
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_lesson::Language;
    use vitriol_run::texts::Texts;

    #[test]
    fn a_title_says_a_pause_in_the_sessions_language() {
        let texts = Texts::of(Language::De).unwrap();
        let mut info = Info {
            title: "Säure in Wasser".into(),
            slow: Some(25),
            recording: Some(66),
            ..Info::default()
        };
        let said = "Vitriol: Säure in Wasser, Zeitlupe: 25 % der Echtzeit, Aufnahme, 1 min 06 s";
        assert_eq!(title(&info, &texts.panel, None), said);
        info.told.paused = Some(texts.instructor.held);
        info.slow = None;
        let said =
            "Vitriol: Säure in Wasser, Von deiner Lehrkraft angehalten, Aufnahme, 1 min 06 s";
        assert_eq!(title(&info, &texts.panel, None), said);
    }
}
