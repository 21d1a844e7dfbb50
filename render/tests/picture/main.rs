//! The picture as a whole, on a device with the validation layer.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod ellipsoids;
mod extent;
mod glass;
mod goggles;
mod golden;
mod hands;
mod laboratory;
mod lanes;
mod liquid;
mod pane;
mod panel;
mod rig;
mod scene;
mod shards;
mod sign;
mod spheres;
mod steam;
mod surface;
mod wall;
