//! `vitriol bench --against`: another program that solves as many particles at rest, asked in turn with ours.
//! A peer gets what is compared as arguments, and prints one JSON object as the last line of its standard output.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus};

use serde::Deserialize;
use thiserror::Error;
use vitriol_run::{Failure, in_a_line};

/// Most characters of a peer's output that a message repeats.
const LONGEST: usize = 300;

/// Another program, or a script in Python.
#[derive(Debug, Clone)]
pub struct Peer(PathBuf);

/// The problem that a peer is to solve, SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// Fluid particles.
    pub particles: u64,
    /// Substeps in a frame.
    pub substeps: u32,
    /// Iterations in a substep.
    pub iterations: u32,
    /// Distance of particles at rest, m; half of the support radius.
    pub spacing: f64,
    /// Depth of the liquid, m.
    pub depth: f64,
    /// Simulated time of a frame, s.
    pub frame_time: f64,
    /// Gravity, m/s².
    pub gravity: f64,
    /// XSPH's coefficient in a substep.
    pub viscosity: f64,
    /// Frames to measure.
    pub frames: u32,
    /// Whether to solve on the processor, as ours does.
    pub on_processor: bool,
}

/// The result that a peer prints. Other keys are for people.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Answer {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// The device that it ran on.
    pub device: String,
    /// Particles that it solved.
    pub particles: u64,
    /// A frame's share of several that are queued, for each measurement, ms.
    pub times_ms: Vec<f64>,
    /// Mean over particles of max(0, ρ/ρ₀ − 1) at the end.
    pub density_error_mean: f64,
    /// 99th percentile over particles of max(0, ρ/ρ₀ − 1) at the end.
    pub density_error_p99: f64,
}

/// Why a peer gave no result.
#[derive(Debug, Error)]
pub enum PeerError {
    /// It could not be started.
    #[error(
        "{program} cannot be started: {cause}; give the path of a program, or of a .py file, which needs python3"
    )]
    NotThere {
        /// The program.
        program: String,
        /// The system's error.
        cause: io::Error,
    },
    /// It ended with an error.
    #[error("{program} ended with {status}: {said}; see to that, or try it alone: {command}")]
    Failed {
        /// The program.
        program: String,
        /// Its exit status.
        status: ExitStatus,
        /// The last line of its output.
        said: String,
        /// Its command line.
        command: String,
    },
    /// It ended without an error, and its output could not be parsed.
    #[error(
        "{program} printed no result: {cause}; its last line has to be a JSON object like that of study/peers/peer.py, and \
         was: {said}"
    )]
    NoResult {
        /// The program.
        program: String,
        /// The parser's error.
        cause: serde_json::Error,
        /// The last line.
        said: String,
    },
    /// Its result cannot be compared.
    #[error("{program} has {what}, which cannot be compared; mend what it prints")]
    Incomparable {
        /// The program.
        program: String,
        /// The difference.
        what: String,
    },
}

impl From<PeerError> for Failure {
    fn from(error: PeerError) -> Self {
        match error {
            PeerError::NotThere { .. } => Self::Input(error.into()),
            _ => Self::Other(error.into()),
        }
    }
}

impl Asked {
    /// The peer's command-line arguments.
    pub fn arguments(&self) -> Vec<String> {
        let arch = if self.on_processor { "cpu" } else { "gpu" };
        [
            ("--particles", self.particles.to_string()),
            ("--substeps", self.substeps.to_string()),
            ("--iterations", self.iterations.to_string()),
            ("--spacing", self.spacing.to_string()),
            ("--depth", self.depth.to_string()),
            ("--frame-time", self.frame_time.to_string()),
            ("--gravity", self.gravity.to_string()),
            ("--viscosity", self.viscosity.to_string()),
            ("--frames", self.frames.to_string()),
            ("--arch", arch.to_owned()),
        ]
        .into_iter()
        .flat_map(|(name, value)| [name.to_owned(), value])
        .collect()
    }
}

impl Peer {
    /// The program at a path; one that ends in `.py` is run by python3.
    pub fn new(path: &Path) -> Self {
        Self(path.to_owned())
    }

    /// Runs it, and waits for its end.
    ///
    /// # Errors
    /// [`PeerError`].
    pub fn ask(&self, asked: &Asked) -> Result<Answer, PeerError> {
        let program = self.0.display().to_string();
        let not_there = |cause| PeerError::NotThere {
            program: program.clone(),
            cause,
        };
        let mut command = if self.0.extension().is_some_and(|end| end == "py") {
            // Python's own message has no remedy.
            self.0.metadata().map_err(not_there)?;
            let mut python = Command::new("python3");
            python.arg(&self.0);
            python
        } else {
            Command::new(&self.0)
        };
        command.args(asked.arguments());
        let output = command.output().map_err(not_there)?;
        let printed = String::from_utf8_lossy(&output.stdout);
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr);
            return Err(PeerError::Failed {
                program,
                status: output.status,
                said: last_line(&said),
                command: in_a_line(&format!(
                    "{} {}",
                    self.0.display(),
                    asked.arguments().join(" ")
                )),
            });
        }
        let last = printed.trim_end().lines().last().unwrap_or_default();
        let answer: Answer = serde_json::from_str(last).map_err(|cause| PeerError::NoResult {
            program: program.clone(),
            cause,
            said: last_line(last),
        })?;
        match answer.problem(asked) {
            Some(what) => Err(PeerError::Incomparable { program, what }),
            None => Ok(answer),
        }
    }
}

impl Answer {
    fn problem(&self, asked: &Asked) -> Option<String> {
        if self.particles != asked.particles {
            return Some(format!(
                "{} particles where {} were asked for",
                self.particles, asked.particles
            ));
        }
        if self.times_ms.is_empty() || !self.times_ms.iter().all(|time| *time > 0.0) {
            return Some("no times, or some that are not above 0".to_owned());
        }
        None
    }
}

/// The last line of a program's output; of a long one the end.
fn last_line(said: &str) -> String {
    let last = said.trim_end().lines().last().unwrap_or("nothing");
    let skipped = last.chars().count().saturating_sub(LONGEST);
    in_a_line(&last.chars().skip(skipped).collect::<String>())
}
