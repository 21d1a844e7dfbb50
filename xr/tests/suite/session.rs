//! The OpenXR session against Monado and against the mock runtime, with a small client that draws two colours.

mod awake;
mod client;
mod hands;
mod inset;
mod inset_gaze;
mod inset_refused;
mod life;
mod loss;
mod lost_device;
mod mock;
mod recentring;
mod refused;
mod rules;
mod tracking;
