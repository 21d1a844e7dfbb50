//! Vitriol, the program: the parts of the binary `vitriol`, open to its tests.

pub mod cli;
pub mod command;
pub mod report;
