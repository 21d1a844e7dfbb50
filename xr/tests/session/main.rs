//! The OpenXR session against Monado, with a small client that draws two colours.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod client;
mod hands;
mod life;
mod loss;
mod rules;
