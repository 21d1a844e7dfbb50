//! Algorithm 1 in f64 on the CPU, to be read beside the paper and to compare
//! the GPU's passes with; nothing here is optimised for speed.
//!
//! What it leaves out of the paper's listing, and why: lines 6–8 predict the
//! whole frame for a neighbour search that serves all substeps, which at
//! real size is stale after one (a fall of 10 cm passes 4.7 h in 1/60 s), so
//! neighbours are found in each substep; line 11 reorders particles for the
//! cache.

mod algorithm;
pub mod boiling;
pub mod chemistry;
pub mod density;
pub mod dilution;
mod eddies;
pub mod forces;
pub mod measure;
mod motion;
pub mod neighbours;
pub mod placement;
mod reaction;
mod state;
pub mod surface;
pub mod surroundings;
mod viscosity;
pub mod visibility;
pub mod wall_heat;

#[cfg(test)]
mod tests;

pub use state::Reference;
