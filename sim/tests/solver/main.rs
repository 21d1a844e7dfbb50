//! The GPU solver against truth from outside it: the f64 reference, formulas,
//! brute force and the flask's geometry; on any device, the software driver
//! included, with the validation layer watching.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod against_reference;
mod breaks;
mod brink;
mod bundles;
mod carry;
mod census;
mod chaos;
mod chemistry;
mod common;
mod crowds;
mod effort;
mod forces;
mod handle;
mod intensity;
mod landed;
mod leaning_glass;
mod lifeline;
mod limits;
mod lip;
mod loads;
mod loop_turns;
mod measured;
mod neighbours;
mod nozzle;
mod open_space;
mod pane;
mod passes;
mod random_glass;
mod repeat;
mod rest;
mod sessile;
mod sleep;
mod solids;
mod stream;
mod tension;
mod walls;
