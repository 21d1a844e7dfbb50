//! The one loop for replay and headset: poses in, simulation steps, pictures
//! and samples out, on the simulation's own fixed clock.

use vitriol_render::PassPicture;
use vitriol_xr::{PoseFrame, PoseSource};

use crate::failure::{Blame, Failure};
use crate::recorder::Recorder;
use crate::report::{Counters, DeviceStatement, Sample};

/// What the loop drives: the simulated world, and the picture of it.
pub trait Experiment {
    /// Does what the frame's switches say, and advances by one fixed step with
    /// what the user did at its time.
    ///
    /// # Errors
    /// What device or solver say; [`Failure::Input`] for a switch to a scene
    /// that is not there.
    fn step(&mut self, frame: &PoseFrame) -> Result<Taken, Failure>;

    /// Measures the state now, which is that at time `t` (s). Waits for the
    /// device.
    ///
    /// # Errors
    /// What the device says.
    fn sample(&mut self, t: f64) -> Result<Sample, Failure>;

    /// Draws the state now for one of the films, counted as they were asked
    /// for: rows from the top, sRGB-encoded RGBA bytes of the film's size.
    /// Waits for the device.
    ///
    /// # Errors
    /// What the device says.
    fn picture(&mut self, film: usize) -> Result<&[u8], Failure>;

    /// What each pass of a picture of the liquid leaves behind, now; nothing where
    /// no pictures were asked for. Waits for the device.
    ///
    /// # Errors
    /// What the device says.
    fn passes(&mut self) -> Result<Vec<PassPicture>, Failure>;

    /// What came of it, and on what device.
    ///
    /// # Errors
    /// What the device says while the final state is read.
    fn outcome(&mut self) -> Result<Outcome, Failure>;
}

/// A step that was taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taken {
    /// Its Δt_f, s.
    pub frame_time: f64,
    /// Before it a switch brought up a scene at its start.
    pub anew: bool,
}

/// What an experiment states of itself at its end.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The scene at the end, where a switch brought it up.
    pub scene: Option<String>,
    /// Substeps and iterations at the end.
    pub effort: [u32; 2],
    /// Fluid particles at the start.
    pub fluid_particles: u64,
    /// Most particles that were on the wrong side of a wall in any measurement
    /// of the run (ten a second) or at its end.
    pub lost_particles: u64,
    /// Particles taken out because they turned non-finite.
    pub nan_particles: u64,
    /// Hash of the final state.
    pub state_hash: u64,
    /// Device and driver.
    pub device: DeviceStatement,
    /// What was counted.
    pub counters: Counters,
}

/// How far a run goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Frame time Δt_f, s.
    pub frame_time: f64,
    /// Number of steps.
    pub steps: u64,
    /// What was asked for, s; the steps end at it or after.
    asked: f64,
}

impl Span {
    /// As many whole steps as cover `seconds`.
    pub fn covering(seconds: f64, frame_time: f64) -> Self {
        // A millionth of a step is rounding, and no reason for one more.
        let steps = (seconds / frame_time - 1e-6).ceil().max(1.0);
        Self {
            frame_time,
            steps: steps as u64,
            asked: seconds,
        }
    }

    /// Simulated time, s.
    pub fn seconds(self) -> f64 {
        self.steps as f64 * self.frame_time
    }

    /// Whether the time is up.
    pub fn is_over(self, time: &SimulatedTime) -> bool {
        time.steps() > 0 && time.seconds() >= self.asked - 1e-6 * self.frame_time
    }
}

/// Simulated time, step by step: a whole number of steps after the last
/// change of their length, so that it is the same however often it is asked for.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SimulatedTime {
    base: f64,
    since: u64,
    frame_time: f64,
    steps: u64,
}

impl SimulatedTime {
    /// Steps so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Time at their end, s.
    pub fn seconds(&self) -> f64 {
        self.base + self.since as f64 * self.frame_time
    }

    /// A step of `frame_time` (s) more.
    pub fn advance(&mut self, frame_time: f64) {
        if frame_time != self.frame_time {
            self.base = self.seconds();
            (self.since, self.frame_time) = (0, frame_time);
        }
        self.since += 1;
        self.steps += 1;
    }
}

/// Runs an experiment with the poses of a source. Where the source ends before
/// the span does, its last poses are held. The span's steps are those of the scene
/// at the start; where a switch brings up one with others, the time counts.
///
/// # Errors
/// What source, experiment or film say.
pub fn run(
    source: &mut dyn PoseSource,
    experiment: &mut dyn Experiment,
    span: Span,
    recorder: &mut Recorder,
) -> Result<(), Failure> {
    let mut time = SimulatedTime::default();
    recorder.observe(&time, experiment)?;
    let mut held: Option<PoseFrame> = None;
    while !span.is_over(&time) {
        let step = time.steps();
        match source.next(step, time.seconds()).other()? {
            Some(frame) => held = Some(frame),
            None => {
                if let Some(frame) = &mut held {
                    frame.step = step;
                    // A switch acts once, not again in each held frame.
                    frame.scenario.clear();
                }
            }
        }
        let Some(frame) = &held else {
            return Err("the track has no pose at its start; record it again").input();
        };
        let taken = experiment.step(frame)?;
        if taken.anew {
            recorder.start_over();
        }
        time.advance(taken.frame_time);
        recorder.observe(&time, experiment)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_has_whole_steps() {
        let steps = |seconds, frame_time| Span::covering(seconds, frame_time).steps;
        assert_eq!(steps(8.0, 1.0 / 90.0), 720);
        assert_eq!(steps(8.001, 1.0 / 90.0), 721);
        assert_eq!(steps(1e-9, 1.0 / 90.0), 1);
    }

    #[test]
    fn time_is_whole_steps_of_each_length() {
        let mut time = SimulatedTime::default();
        for _ in 0..900 {
            time.advance(1.0 / 90.0);
        }
        assert_eq!(time.seconds(), 900.0 * (1.0 / 90.0));
        for _ in 0..60 {
            time.advance(1.0 / 60.0);
        }
        assert_eq!(time.seconds(), 900.0 * (1.0 / 90.0) + 60.0 * (1.0 / 60.0));
        assert_eq!(time.steps(), 960);
    }
}
