//! The hub against real browsers and against clients that behave as no browser would.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[cfg(target_os = "linux")]
mod cards;
#[cfg(target_os = "linux")]
mod class;
mod client;
#[cfg(target_os = "linux")]
mod close_up;
mod crowd;
#[cfg(target_os = "linux")]
mod distant;
#[cfg(target_os = "linux")]
mod instructor;
#[cfg(target_os = "linux")]
mod look;
#[cfg(target_os = "linux")]
mod page;
#[cfg(target_os = "linux")]
mod proxy;
mod security;
mod student;
#[cfg(target_os = "linux")]
mod zoom;
