//! Harnesses that several tests share. A harness panics where its own resources fail: it is test code.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

pub mod browser;
pub mod devtools;
pub mod editors;
pub mod gpu;
mod installed;
pub mod list;
#[cfg(target_os = "linux")]
pub mod mock;
#[cfg(target_os = "linux")]
pub mod monado;
pub mod program;
pub mod ralph;
pub mod random;
pub mod readers;
#[cfg(target_os = "linux")]
mod rig;
#[cfg(target_os = "linux")]
pub mod screen;
#[cfg(target_os = "linux")]
pub mod slurm;
pub mod wait;
