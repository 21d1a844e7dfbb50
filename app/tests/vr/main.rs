//! Sessions on the stand-in, with the validation layer on, and what their recordings replay to.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;
mod hands;
mod leap;
mod loss;
#[cfg(target_os = "linux")]
mod mirror;
mod pace;
mod panel;
mod pour;
mod recording;
mod rules;
mod switches;
