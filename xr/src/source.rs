//! The interface that a live session and a recorded track share.

use crate::PoseFrame;

/// Source of a simulation step's poses.
pub trait PoseSource: Send {
    /// The user's input at simulation time `time` (s, the step's own time, not decreasing from call to call), for the step with index
    /// `step`. `None`: the source has ended, and stays ended.
    ///
    /// The frame carries `step`; its [`scenario`](PoseFrame::scenario) holds each switch
    /// once, in the first frame at or after the switch. A hand that is not valid, and any
    /// pose within a gap of the source, holds the last pose that was known.
    ///
    /// # Errors
    /// [`SourceError`] where the source cannot answer for that time.
    fn next(&mut self, step: u64, time: f64) -> Result<Option<PoseFrame>, SourceError>;
}

/// Why a source has no pose to give.
#[derive(Debug, thiserror::Error, PartialEq)]
#[non_exhaustive]
pub enum SourceError {
    /// The time asked for is not finite, or negative.
    #[error(
        "simulation step {step} asked for poses at {time} s; a simulation time is finite and \
         not negative"
    )]
    Time {
        /// The step that asked.
        step: u64,
        /// The time that it asked for, s.
        time: f64,
    },
}
