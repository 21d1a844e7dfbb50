//! Where poses of head and hands come from.
//!
//! A simulation step asks a [`PoseSource`] where the head and the hands are, and what the
//! hands squeeze, at that step's own simulation time. A pose track replayed from a file
//! ([`track`]) is such a source; a live OpenXR session is the other one, so that the loop
//! above cannot tell them apart. Nothing here knows what the poses act on.
//!
//! Poses are in the stage frame: Y up, metres, the floor at y = 0, the user at the origin
//! looking along -Z (OpenXR's STAGE reference space).

mod frame;
mod headset;
mod pose;
pub mod probe;
mod session;
mod source;
pub mod track;

pub use frame::{Fov, FrameInfo, Hand, PoseFrame, SessionState, Side, Switch};
pub use headset::{Headset, HeadsetError, HeadsetFrame, Shown, Targets, Turn, View};
pub use pose::Pose;
pub use session::{OpenXr, OpenXrOptions};
pub use source::{PoseSource, SourceError};
