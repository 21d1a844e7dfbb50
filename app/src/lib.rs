//! Vitriol, the program: the parts of the binary `vitriol`, open to its tests.

mod budget;
pub mod cli;
pub mod command;
pub mod live;
pub mod report;
pub mod vr;
