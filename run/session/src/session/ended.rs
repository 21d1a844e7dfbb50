//! The proof that no frame is open.

use vitriol_run::Failure;
use vitriol_xr::{Headset, Shown};

use crate::blame::blame;

/// No frame is open. Between a frame's begin and its end nothing may wait for the device, since the runtime
/// waits for the frame; so what may wait asks for one of these.
pub(super) struct NoFrameOpen(());

impl NoFrameOpen {
    /// Ends the frame, with what is shown or empty.
    pub fn by_ending(headset: &mut dyn Headset, shown: Option<&Shown>) -> Result<Self, Failure> {
        headset.end(shown).map_err(blame)?;
        Ok(Self(()))
    }

    /// In a turn that has begun none: the headset is off, lost or found again, or the session is over.
    pub fn in_a_turn_without() -> Self {
        Self(())
    }
}
