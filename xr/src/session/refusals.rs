//! Calls of a frame that the runtime refused: each is logged once, and the session goes on.

use std::collections::BTreeSet;

use super::convert::CallFailure;
use crate::HeadsetError;

/// Frames in a row with a refused call after which the session is made anew: two thirds of a second at 90 Hz.
const MOST: u32 = 60;

/// Calls of a session with an inset that a runtime may refuse because of the inset.
const OF_VIEWS: [&str; 6] = [
    "xrBeginSession",
    "xrLocateViews",
    "xrAcquireSwapchainImage",
    "xrWaitSwapchainImage",
    "xrReleaseSwapchainImage",
    "xrEndFrame",
];

/// Refused calls of one session, and whether they have become too many.
#[derive(Debug, Default)]
pub(super) struct Refusals {
    said: BTreeSet<&'static str>,
    /// Frames in a row that had a refused call.
    row: u32,
    in_frame: bool,
    /// The call that was refused too often for this session to go on.
    gave_up: Option<&'static str>,
}

impl Refusals {
    /// `None` where the call was refused: the frame goes on without its result. A loss is returned, and so are refusals in more than
    /// [`MOST`] frames in a row, as a loss.
    pub(super) fn bear<T>(
        &mut self,
        result: Result<T, CallFailure>,
    ) -> Result<Option<T>, CallFailure> {
        match result {
            Ok(value) => Ok(Some(value)),
            Err(CallFailure::Fatal(HeadsetError::Refused { call, cause })) => {
                if self.said.insert(call) {
                    tracing::warn!(call, cause, "refused by the runtime; the session goes on");
                }
                self.row += u32::from(!std::mem::replace(&mut self.in_frame, true));
                if self.row > MOST {
                    return Err(self.give_up(call, &cause));
                }
                Ok(None)
            }
            Err(failure) => Err(failure),
        }
    }

    /// Gives up this session, since `call` is always refused: it is to be made anew.
    pub(super) fn give_up(&mut self, call: &'static str, cause: &str) -> CallFailure {
        self.gave_up = Some(call);
        CallFailure::Lost(format!("{call} is always refused: {cause}"))
    }

    /// Whether this session ended because of a call that depends on the number of views. Others would be refused without an inset as well.
    pub(super) fn gave_up_on_views(&self) -> bool {
        self.gave_up.is_some_and(|call| OF_VIEWS.contains(&call))
    }

    /// Begins a frame.
    pub(super) fn begin(&mut self) {
        if !std::mem::take(&mut self.in_frame) {
            self.row = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    fn refused() -> Result<(), CallFailure> {
        Err(super::super::convert::refused(
            "xrSyncActions",
            "no".to_owned(),
        ))
    }

    #[test]
    fn refusals_are_borne_unless_they_do_not_end() {
        let mut refusals = Refusals::default();
        for frame in 0..10 * MOST {
            refusals.begin();
            assert!(matches!(refusals.bear(Ok(7)), Ok(Some(7))));
            // Two in a frame are one frame; every third has none.
            if frame % 3 != 0 {
                assert!(matches!(refusals.bear(refused()), Ok(None)));
                assert!(matches!(refusals.bear(refused()), Ok(None)));
            }
        }
        let lost = (0..2 * MOST).find(|_| {
            refusals.begin();
            matches!(refusals.bear(refused()), Err(CallFailure::Lost(_)))
        });
        // The last of the frames before had a refused call, too.
        assert!(
            lost.is_some_and(|lost| lost.abs_diff(MOST) <= 2),
            "{lost:?}"
        );
        let lost = refusals.bear::<()>(Err(CallFailure::Lost("gone".into())));
        assert!(matches!(lost, Err(CallFailure::Lost(_))));
    }
}
