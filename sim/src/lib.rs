//! The simulation: scenes as data, vessels, the particle solver.

pub mod bodies;
pub mod chemistry;
pub mod fill;
pub mod flask;
pub mod kernel;
pub mod measure;
pub mod parameters;
pub mod pose;
pub mod reference;
pub mod scene;
pub mod solver;
pub mod surface_tension;
pub mod world;
