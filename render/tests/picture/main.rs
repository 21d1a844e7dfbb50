//! The picture as a whole, on a device with the validation layer.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod bubbles;
mod dew;
mod ellipsoids;
mod extent;
mod fovea;
mod fovea_looks;
mod glass;
mod goggles;
mod golden;
mod half_depth;
mod hands;
mod laboratory;
mod lanes;
mod liquid;
mod meniscus;
mod pane;
mod panel;
mod rig;
mod room_parts;
mod scene;
mod schlieren;
mod shards;
mod sign;
mod spheres;
mod spray;
mod steam;
mod surface;
mod thermometer;
mod under;
mod wall;
