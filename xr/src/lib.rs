//! Sources of poses of head and hands.
//!
//! A pose track replayed from a file ([`track`]) is a [`PoseSource`]: for each simulation step, at that step's own simulation time, it
//! returns the poses of the head and the hands, and how far the hands squeeze. A live OpenXR session ([`OpenXr`]) is a [`Headset`]: its
//! display frames come at times of their own, and the loop above makes the steps' frames from them. This crate does not depend on what the
//! poses act on.
//!
//! Poses are in the stage frame: Y up, metres, -Z ahead; OpenXR's STAGE reference space with
//! the floor at y = 0 where the runtime knows it.

mod around;
#[cfg(feature = "openxr")]
mod entry;
pub mod files;
mod frame;
mod headset;
#[cfg(feature = "openxr")]
mod manifest;
mod pose;
#[cfg(feature = "openxr")]
pub mod probe;
#[cfg(feature = "openxr")]
mod session;
mod source;
pub mod track;

pub use around::{Around, Kind, Line, Pointed, Thing};
#[cfg(feature = "openxr")]
pub use entry::quiet_loader;
pub use frame::{Fov, FrameInfo, Hand, PoseFrame, SessionState, Side, Switch};
pub use headset::{
    Headset, HeadsetError, HeadsetFrame, Inset, InsetTargets, Joints, Pause, Shown, Targets, Turn,
    View, depth_extent,
};
pub use pose::Pose;
#[cfg(feature = "openxr")]
pub use session::{OpenXr, OpenXrOptions};
pub use source::{PoseSource, SourceError};
