//! What a session's frames took.

use std::collections::VecDeque;

use serde::Serialize;
use vitriol_gpu::{LockWaits, Ticket, Waits};

use vitriol_run::{Blame, Failure, Spread};

/// Times of frames.
#[derive(Default)]
pub struct Tally {
    /// Processor time from a frame's begin to its end, ms.
    pub cpu_ms: Vec<f64>,
    /// Of these, frames with nothing beside them.
    pub alone: Frames,
    /// Frames while a bench or a picture was built on another thread.
    pub building: Frames,
    /// From the eyes' location to the submission of the picture, ms.
    pub pose_age_ms: Vec<f64>,
    /// From the time of the hands' poses that the flasks in the picture follow to the picture's display time,
    /// simulation steps.
    pub delay_steps: Vec<f64>,
    /// The delay of [`Tally::delay_steps`] in display periods.
    pub delay_frames: Vec<f64>,
    /// A frame's work on the device on the solver's queue, ms: its steps and the picture's part that
    /// reads them.
    pub solve_ms: Vec<f64>,
    /// The picture's, ms.
    pub picture_ms: Vec<f64>,
    /// That of the last picture from close by that the device is done with, ms; 0 before there is one.
    pub close_up_ms: f64,
    /// One that is under way.
    close_up: Option<Ticket>,
    /// Whether times are kept. In a session that nobody measures they would only fill memory.
    counts: bool,
    /// Whether the device's times are asked for, to be kept or for a governor.
    timed: bool,
    pending: VecDeque<Submitted>,
    loads: Vec<FrameLoad>,
}

/// Frames of one kind: with something beside them, or alone.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    /// Processor time from begin to end of each, ms.
    pub cpu_ms: Vec<f64>,
    /// What all of them waited for other threads between begin and end.
    pub waits: LockWaits,
}

/// The times and waits of [`Frames`] as `vitriol vr --json` prints them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FramesReport {
    /// How many.
    pub frames: u64,
    /// Processor time from begin to end, ms.
    pub cpu_ms: Spread,
    /// Waits for a queue that another thread was submitting to.
    pub queue_lock: WaitsReport,
    /// Waits for device memory that another thread was allocating or freeing.
    pub memory_lock: WaitsReport,
}

/// Waits of a frame's thread for others.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WaitsReport {
    /// How many in all frames.
    pub waits: u64,
    /// All of them, ms.
    pub total_ms: f64,
    /// The longest, ms.
    pub longest_ms: f64,
}

impl Frames {
    /// The report of these frames; `None` where there were none.
    pub fn report(&self) -> Option<FramesReport> {
        Some(FramesReport {
            frames: self.cpu_ms.len() as u64,
            cpu_ms: Spread::of(&self.cpu_ms)?,
            queue_lock: WaitsReport::of(&self.waits.queue),
            memory_lock: WaitsReport::of(&self.waits.memory),
        })
    }
}

impl WaitsReport {
    fn of(waits: &Waits) -> Self {
        Self {
            waits: waits.count,
            total_ms: 1e3 * waits.total.as_secs_f64(),
            longest_ms: 1e3 * waits.longest.as_secs_f64(),
        }
    }
}

/// A frame's submissions.
pub struct Submitted {
    /// Those of its steps.
    pub steps: Vec<Ticket>,
    /// That of the picture's part that reads the particles, behind the steps.
    pub shapes: Ticket,
    /// That of the rest of the picture.
    pub picture: Ticket,
    /// Counts the changes of solver and picture before it: frames with the same stamp had the same work.
    pub stamp: u64,
}

/// What a frame took on the device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameLoad {
    /// Its steps.
    pub steps: usize,
    /// Their time, ms.
    pub solve_ms: f64,
    /// The picture's, ms.
    pub picture_ms: f64,
    /// Counts the changes of solver and picture before it: frames with the same stamp had the same work.
    pub stamp: u64,
}

impl Tally {
    /// Keeps times if it `counts`, and asks the device for its own if submissions are `timed`. The device must have
    /// been opened with timestamps for that.
    pub fn new(counts: bool, timed: bool) -> Self {
        Self {
            counts,
            timed,
            ..Self::default()
        }
    }

    /// Takes a frame's processor time (ms) and what it waited for other threads, while something was `built` by one of
    /// them or not.
    pub fn frame(&mut self, cpu_ms: f64, waits: &LockWaits, built: bool) {
        if self.counts {
            self.cpu_ms.push(cpu_ms);
            let frames = if built {
                &mut self.building
            } else {
                &mut self.alone
            };
            frames.cpu_ms.push(cpu_ms);
            frames.waits.add(waits);
        }
    }

    /// Takes a picture's age of the eyes' pose (ms) and delay of the flasks (steps), of which a display period has so many.
    pub fn picture(&mut self, pose_age_ms: f64, delay_steps: f64, steps_a_frame: f64) {
        if self.counts {
            self.pose_age_ms.push(pose_age_ms);
            self.delay_steps.push(delay_steps);
            self.delay_frames.push(delay_steps / steps_a_frame);
        }
    }

    /// Takes a frame's submissions, whose times [`Tally::collect`] reads once they are done.
    pub fn submitted(&mut self, submitted: Submitted) {
        if self.timed {
            self.pending.push_back(submitted);
        }
    }

    /// Takes the submission of a picture from close by, whose time [`Tally::collect`] reads once it is done.
    pub fn close_up(&mut self, picture: Ticket) {
        self.close_up = self.timed.then_some(picture);
    }

    /// What the frames took that were collected since the last call.
    pub fn loads(&mut self) -> Vec<FrameLoad> {
        std::mem::take(&mut self.loads)
    }

    /// Collects the device's times of frames that are done; does not wait.
    ///
    /// # Errors
    /// An error of the device.
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
            self.loads.push(FrameLoad {
                steps: frame.steps.len(),
                solve_ms,
                picture_ms: shapes + picture,
                stamp: frame.stamp,
            });
            self.pending.pop_front();
        }
        if let Some(picture) = &self.close_up
            && picture.is_done().other()?
        {
            self.close_up_ms = total(picture)?;
            self.close_up = None;
        }
        Ok(())
    }

    /// Forgets all measurements so far.
    pub fn restart(&mut self) {
        *self = Self::new(self.counts, self.timed);
    }
}

/// A submission's time on the device, ms.
fn total(ticket: &Ticket) -> Result<f64, Failure> {
    let timings = ticket.timings().other()?;
    Ok(timings.last().map_or(0.0, |total| 1e-6 * total.nanoseconds))
}

/// What the process holds of the machine, where the system reports it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Holdings {
    /// Memory in use, bytes.
    pub memory: u64,
    /// Open files and the like.
    pub handles: u64,
}

impl Holdings {
    /// Now; `None` where the system is not Linux.
    pub fn now() -> Option<Self> {
        // Wine shows a Linux machine's `/proc` too, but its server opens the files: `self` is the server there, and not this process.
        if !cfg!(target_os = "linux") {
            return None;
        }
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
