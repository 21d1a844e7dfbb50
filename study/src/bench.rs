//! The benchmark: times of solver and picture, pass by pass.

pub mod features;
pub mod frame;
pub mod peer;
pub mod picture;
pub mod report;
pub mod rest;
pub mod scaling;
mod scaling_plot;
pub mod solver;
