//! The benchmark: times of solver and picture, pass by pass.

pub mod features;
pub mod frame;
pub mod picture;
pub mod report;
pub mod solver;
mod tally;
