//! The picture as a whole, on a device with the validation layer.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod ellipsoids;
mod extent;
mod glass;
mod golden;
mod hands;
mod liquid;
mod rig;
mod scene;
mod spheres;
mod steam;
mod surface;
