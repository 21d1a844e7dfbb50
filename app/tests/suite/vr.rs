//! Sessions on the stand-in, with the validation layer on, and what their recordings replay to.

mod breaks;
mod close_up;
pub mod common;
#[cfg(target_os = "linux")]
mod console;
mod contention;
mod fade;
mod first_minute;
mod foveation;
mod handle;
mod hands;
mod holdings;
mod inset;
mod leap;
mod lesson;
pub mod loss;
#[cfg(target_os = "linux")]
mod mirror;
mod one_hand;
mod pace;
pub mod panel;
pub mod pour;
mod rules;
mod seen;
mod spills;
mod switches;
