//! Shaders from their sources to SPIR-V and to layouts.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;
mod compile;
mod include;
mod layout;
mod number;
mod reload;
