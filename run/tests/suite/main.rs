//! Film, sound and subtitles of a run, and the run on a device.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod device;
mod film;
mod mp4;
mod recording;
mod sound;
mod subtitles;
