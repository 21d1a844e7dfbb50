//! Vitriol, the program: the parts of the binary `vitriol`, open to its tests.

mod budget;
pub mod calorimeter;
mod camera;
pub mod cli;
pub mod column;
pub mod command;
pub mod console;
mod device;
pub mod experiment;
pub mod extremes;
pub mod failure;
pub mod fidelity;
pub mod film;
mod legend;
mod measure;
pub mod output;
mod rank;
pub mod recorder;
pub mod replay;
pub mod report;
mod statement;
pub mod trade;
pub mod vr;
