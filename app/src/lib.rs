//! Vitriol, the program: the parts of the binary `vitriol`, open to its tests.

mod budget;
pub mod choices;
pub mod cli;
pub mod command;
#[cfg(feature = "class")]
pub mod live;
pub mod report;
pub mod texts;
#[cfg(feature = "session")]
pub mod vr;
