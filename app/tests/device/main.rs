//! What runs on a device: the experiment itself, behind the loop, with the
//! validation layer on.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod calorimeter;
mod camera;
mod common;
mod dam_break;
mod extremes;
mod fidelity;
mod fig5;
mod passes;
mod reload;
mod trade;
