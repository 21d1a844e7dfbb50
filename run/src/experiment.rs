//! The experiment that the loop drives, and the data that the loop reads from it.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vitriol_render::PassPicture;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::Held;
use vitriol_sound::{Event, Listener};
use vitriol_xr::PoseFrame;

use crate::action::Action;
use crate::device::DeviceStatement;
use crate::failure::Failure;
use crate::judging::Judging;
use crate::sample::Sample;

/// What the loop drives: the simulated world, and the picture of it.
pub trait Experiment {
    /// Carries out the frame's switches, and advances by one fixed step with the user's poses at its time.
    ///
    /// # Errors
    /// An error of device or solver; [`Failure::Input`] for a switch to a scene
    /// that is not there.
    fn step(&mut self, frame: &PoseFrame) -> Result<Taken, Failure>;

    /// Measures the state now, which is that at time `t` (s). Waits for the
    /// device.
    ///
    /// # Errors
    /// An error of the device.
    fn sample(&mut self, t: f64) -> Result<Sample, Failure>;

    /// Draws the state now for one of the films, counted as they were asked
    /// for: rows from the top, sRGB-encoded RGBA bytes of the film's size.
    /// Waits for the device.
    ///
    /// # Errors
    /// An error of the device.
    fn picture(&mut self, film: usize) -> Result<&[u8], Failure>;

    /// Draws the state now as it is seen from close to the glass that matters, `elapsed` seconds after the last such picture, as
    /// [`Experiment::picture`] does; `None` where no pictures were asked for.
    ///
    /// # Errors
    /// An error of the device.
    fn close_up(&mut self, _elapsed: f64) -> Result<Option<Vec<u8>>, Failure> {
        Ok(None)
    }

    /// What the state now is worth to a film.
    fn worth(&self) -> Worth {
        Worth::default()
    }

    /// The sounds since the last call, and the place where they are heard; nothing where no pictures were asked for. Waits for the
    /// device.
    ///
    /// # Errors
    /// An error of the device.
    fn heard(&mut self) -> Result<Heard, Failure>;

    /// What each pass of a picture of the liquid leaves behind, now; nothing where
    /// no pictures were asked for. Waits for the device.
    ///
    /// # Errors
    /// An error of the device.
    fn passes(&mut self) -> Result<Vec<PassPicture>, Failure>;

    /// Has a lesson judged over the observations from now on: to be called before the first step, if at all.
    fn judge(&mut self, lesson: Judging);

    /// The state after the last step, for those who watch; `None` where nobody can. Does not wait: what is measured is some steps old.
    fn glimpse(&self) -> Option<Glimpse<'_>> {
        None
    }

    /// Events that would be found if the attempt ended now, beside [`Glimpse::events`].
    fn so_far(&self) -> Vec<vitriol_lesson::Event> {
        Vec::new()
    }

    /// The outcome, and the device that it was found on.
    ///
    /// # Errors
    /// An error of the device while the final state is read.
    fn outcome(&mut self) -> Result<Outcome, Failure>;
}

/// What a state is worth to a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worth {
    /// Whether something happens, so that it is not left out.
    pub shown: bool,
    /// How much there is to see: gas in the liquid and liquid that was spilt, real m³. The film's poster has the most.
    pub interest: f64,
}

impl Default for Worth {
    fn default() -> Self {
        Self {
            shown: true,
            interest: 0.0,
        }
    }
}

/// The state of a run while it goes on, for those who watch.
#[derive(Clone, Copy, Debug)]
pub struct Glimpse<'a> {
    /// The scene, and its name where a switch brought it up.
    pub scene: (&'a Scene, Option<&'a str>),
    /// The liquid in each flask.
    pub flasks: &'a [Held],
    /// Liquid on the bench and on the floor, real m³.
    pub spilt: [f64; 2],
    /// k_v, where there is one.
    pub intensity: Option<f64>,
    /// Events so far.
    pub events: &'a [vitriol_lesson::Event],
    /// Actions of an instructor when it was recorded, each with the run's time, s.
    pub instructions: &'a [(f64, Action)],
}

/// What can be heard at a camera.
#[derive(Clone, Debug, Default)]
pub struct Heard {
    /// Where it is.
    pub listener: Listener,
    /// What happened; times are of the run's clock.
    pub events: Vec<Event>,
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
    /// Events that were found in observations of the liquid, over the whole run.
    pub events: Vec<vitriol_lesson::Event>,
    /// Progress of the lesson that is judged; empty without one.
    pub progress: Vec<vitriol_lesson::procedure::Progress>,
    /// Actions of an instructor, each with the run's time, s.
    pub instructions: Vec<(f64, Action)>,
    /// What was counted.
    pub counters: Counters,
}

/// What was counted over a run.
#[derive(Debug, Clone, PartialEq, Default, JsonSchema, Serialize, Deserialize)]
pub struct Counters {
    /// Substeps done.
    pub substeps: u64,
    /// Times that substeps and iterations changed, as in a session that had to keep pace.
    #[serde(default)]
    pub solver_changes: u64,
    /// Flasks that broke.
    #[serde(default)]
    pub flasks_broken: u64,
    /// Times that the neighbour list was rebuilt.
    pub neighbour_rebuilds: u64,
    /// How often each limiter acted, by its name.
    pub limiters: BTreeMap<String, u64>,
}
