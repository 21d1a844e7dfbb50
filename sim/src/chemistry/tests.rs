#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
//! Truth from outside: the source tables, handbook values, the pair sums
//! that the paper's equations are meant to give.

mod air;
mod enthalpy;
mod evaporation;
mod model;
mod pairs;
mod phases;
mod segregation;
mod wall_heat;
