//! The measurements, in small, on a device with the validation layer on.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod calorimeter;
mod dam_break;
mod extremes;
mod fidelity;
mod fig5;
mod orders;
mod trade;
