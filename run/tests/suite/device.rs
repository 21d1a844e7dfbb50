//! The experiment itself on a device, behind the loop, with the validation layer on.

mod breaks;
mod camera;
mod common;
mod reload;
mod run;
mod switched;
mod tools;
