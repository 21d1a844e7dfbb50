//! `vitriol desk`: a session in a window on a screen without a monitor, with pointer and keys by XTEST.
//!
//! Each step of a user waits for what the step before it has led to, and not for a time: a software driver takes up to half a second a frame.

mod common;
mod drag;
mod hold;
mod label;
mod layer;
mod loss;
mod panel;
mod pour;
mod program;
mod seen;
mod taken;
mod window;
