//! The experiment itself on a device, behind the loop, with the validation layer on.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod breaks;
mod camera;
mod common;
mod reload;
mod tools;
