//! In the headset: the frame loop that feeds the flasks from a live session.
//!
//! `session` is the loop itself, over the face that an OpenXR session and the stand-in share; every
//! other file is one of its parts. `docs/headset.md` says what happens in a frame, and when.

pub mod bench;
pub mod clock;
pub mod governor;
pub mod hands;
pub mod haptics;
pub mod inputs;
pub mod ladder;
pub mod menu;
pub mod mirror;
pub mod panel;
pub mod picture;
pub mod placement;
pub mod record;
pub mod session;
pub mod stand_in;
pub mod tally;
