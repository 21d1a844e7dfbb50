//! Pose tracks and a live session.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[cfg(all(feature = "openxr", target_os = "linux"))]
mod session;
mod track;
