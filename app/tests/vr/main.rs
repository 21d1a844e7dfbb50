//! Sessions on the stand-in, with the validation layer on, and what their recordings replay to.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;
mod hands;
mod loss;
mod pace;
mod panel;
mod pour;
mod recorder;
mod switches;
