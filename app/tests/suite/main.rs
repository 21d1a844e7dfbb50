//! The program, from its command line to the headset.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[cfg(unix)]
mod bench;
mod cli;
mod compare;
#[cfg(target_os = "linux")]
mod console;
#[cfg(target_os = "linux")]
mod desk;
mod docs;
mod export;
mod foreign;
#[cfg(target_os = "linux")]
mod full_disk;
mod grade;
#[cfg(target_os = "linux")]
mod headset;
mod lesson_film;
mod parts;
mod passes;
mod replay;
mod several;
#[cfg(target_os = "linux")]
mod slurm;
mod vr;

use vitriol_tests::program::Program;

/// The program under test.
const VITRIOL: Program = Program(env!("CARGO_BIN_EXE_vitriol"));
