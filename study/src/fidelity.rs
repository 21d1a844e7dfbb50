//! The picture against the truth: the renderer's picture in screen space compared with the surface of Yu and Turk, marched on the CPU.

pub mod judge;
pub mod report;
pub mod screen;
pub mod sheet;
pub mod states;
pub mod views;
