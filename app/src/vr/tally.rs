//! What a session's frames took.

use std::collections::VecDeque;

use serde::Serialize;
use vitriol_experiment::{Blame, Failure, Ranks};
use vitriol_gpu::Ticket;

/// Median, 95th and 99th percentile and the greatest of what was measured, each a value that was.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Median.
    pub p50: f64,
    /// 95th percentile.
    pub p95: f64,
    /// 99th percentile.
    pub p99: f64,
    /// The greatest.
    pub max: f64,
}

impl Spread {
    /// Of values by nearest rank; `None` of none.
    pub fn of(values: &[f64]) -> Option<Self> {
        let ranks = Ranks::of(values);
        Some(Self {
            p50: ranks.at(0.5)?,
            p95: ranks.at(0.95)?,
            p99: ranks.at(0.99)?,
            max: ranks.at(1.0)?,
        })
    }
}

/// Times of frames.
#[derive(Default)]
pub struct Tally {
    /// Processor time from a frame's begin to its end, ms.
    pub cpu_ms: Vec<f64>,
    /// From the eyes' location to the submission of the picture, ms.
    pub pose_age_ms: Vec<f64>,
    /// From the hands' poses that the flasks in the picture follow to the picture's display time,
    /// simulation steps.
    pub delay_steps: Vec<f64>,
    /// A frame's work on the device on the solver's queue, ms: its steps and the picture's part that
    /// reads them.
    pub solve_ms: Vec<f64>,
    /// The picture's, ms.
    pub picture_ms: Vec<f64>,
    /// Whether anything is kept: a session that nobody measures would only grow by it.
    counts: bool,
    /// Whether submissions are timed for what is kept, or for who follows.
    timed: bool,
    pending: VecDeque<Submitted>,
    loads: Vec<Load>,
}

/// A frame's submissions.
pub struct Submitted {
    /// Its steps'.
    pub steps: Vec<Ticket>,
    /// That of the picture's part behind them.
    pub shapes: Ticket,
    /// That of its other part.
    pub picture: Ticket,
    /// As the frame loop counts its settings.
    pub stamp: u64,
}

/// What a frame took on the device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Its steps.
    pub steps: usize,
    /// Their time, ms.
    pub solve_ms: f64,
    /// The picture's, ms.
    pub picture_ms: f64,
    /// As the frame loop counts its settings.
    pub stamp: u64,
}

impl Tally {
    /// One that keeps times if it `counts`, and asks the device for its own if they are to be `timed`, which
    /// takes one that was opened for it. Their [`Load`]s are there until they are taken.
    pub fn new(counts: bool, timed: bool) -> Self {
        Self {
            counts,
            timed,
            ..Self::default()
        }
    }

    /// Takes a frame's processor time, ms.
    pub fn frame(&mut self, cpu_ms: f64) {
        if self.counts {
            self.cpu_ms.push(cpu_ms);
        }
    }

    /// Takes a picture's age of the eyes' pose (ms) and delay of the flasks (steps).
    pub fn picture(&mut self, pose_age_ms: f64, delay_steps: f64) {
        if self.counts {
            self.pose_age_ms.push(pose_age_ms);
            self.delay_steps.push(delay_steps);
        }
    }

    /// Takes a frame's submissions.
    pub fn submitted(&mut self, submitted: Submitted) {
        if self.timed {
            self.pending.push_back(submitted);
        }
    }

    /// What the frames took whose times were taken since the last call.
    pub fn loads(&mut self) -> Vec<Load> {
        std::mem::take(&mut self.loads)
    }

    /// Takes the times of frames that are done; does not wait.
    ///
    /// # Errors
    /// What the device says.
    pub fn collect(&mut self) -> Result<(), Failure> {
        while let Some(frame) = self.pending.front() {
            if !frame.picture.is_done().other()? {
                break;
            }
            let mut solve_ms = 0.0;
            for ticket in &frame.steps {
                solve_ms += total(ticket)?;
            }
            let (shapes, picture) = (total(&frame.shapes)?, total(&frame.picture)?);
            if self.counts {
                self.solve_ms.push(solve_ms + shapes);
                self.picture_ms.push(picture);
            }
            self.loads.push(Load {
                steps: frame.steps.len(),
                solve_ms,
                picture_ms: shapes + picture,
                stamp: frame.stamp,
            });
            self.pending.pop_front();
        }
        Ok(())
    }

    /// Forgets what was measured so far: it was the warming up.
    pub fn restart(&mut self) {
        *self = Self::new(self.counts, self.timed);
    }
}

/// A submission's time on the device, ms.
fn total(ticket: &Ticket) -> Result<f64, Failure> {
    let timings = ticket.timings().other()?;
    Ok(timings.last().map_or(0.0, |total| 1e-6 * total.nanoseconds))
}

/// What the process holds of the machine, where the system says so.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Holdings {
    /// Memory in use, bytes.
    pub memory: u64,
    /// Open files and the like.
    pub handles: u64,
}

impl Holdings {
    /// Now; `None` where the system has no `/proc`.
    pub fn now() -> Option<Self> {
        let status = std::fs::read_to_string("/proc/self/status").ok()?;
        let line = status
            .lines()
            .find_map(|line| line.strip_prefix("VmRSS:"))?;
        let kilobytes: u64 = line.trim().trim_end_matches(" kB").parse().ok()?;
        let handles = std::fs::read_dir("/proc/self/fd").ok()?.count() as u64;
        Some(Self {
            memory: 1024 * kilobytes,
            handles,
        })
    }
}
