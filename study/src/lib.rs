//! The study: measurements of solver and renderer, as subcommands.

pub mod bench;
pub mod calorimeter;
pub mod cli;
pub mod column;
pub mod command;
pub mod extremes;
pub mod fidelity;
mod liquid;
pub mod merge;
pub mod trade;
