//! Sounds and outputs.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[cfg(all(feature = "output", target_os = "linux"))]
mod output;
mod sounds;
