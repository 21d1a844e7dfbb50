//! The crate against a real driver with the validation layer on; the software
//! driver will do.
#![allow(unsafe_code)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod bindings;
mod bundle;
mod common;
mod compute;
mod copy_image;
mod kept;
mod loss;
mod memory;
mod open;
mod queues;
mod raster;
mod timing;
mod validation;
