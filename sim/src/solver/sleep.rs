//! Liquid that sleeps: passes over particles leave it out. The device decides at each frame's start (`shaders/wgsl/sim/sleep.wgsl`).

use super::spec::SolverSpec;
use super::steam::ROOM_TEMPERATURE;
use super::transfer::read;
use super::wall_heat;
use super::{Solver, SolverError, lanes};
use crate::parameters::Parameters;
use crate::pose::Pose;
use glam::Quat;
use serde::{Deserialize, Serialize};
use vitriol_gpu::{Pass, Recorder};
use vitriol_shaders::layout::FlaskSleep;

/// Words of `sleep` before those of flasks: the number of particles that are awake is the first.
pub(super) const HEAD: usize = 2;

/// Words of a flask in `flask_sleeps`.
const FLASK_WORDS: usize = size_of::<FlaskSleep>() / 4;

/// What the word of a flask in `sleep` is more than while its liquid settles, by the number of frames left, as in `common/liquid/sleep_words.wgsl`.
const SETTLES: u32 = 256;

/// Where in `awake_args` the size of a dispatch in workgroups of 64 is, bytes.
const IN_64: u64 = 16;

/// Time for which nothing may happen before liquid sleeps, s. Chosen: half a period of the slosh in a beaker of 80 mm is 0.15 s.
const CALM_TIME: f64 = 0.2;

/// Height to which slow liquid would rise, in spacings. Chosen: 0.05 mm at `fast`, where a surface at rest has particles of
/// up to 0.026 m/s and this makes 0.030.
const RISE: f64 = 0.016;

/// Root mean square of the speeds of liquid at rest, over the speed of a slow particle. Chosen: 160 mL that slosh in a beaker of 80 mm rise by
/// 0.6 mm at the wall then, by their energy (v² = 0.35 g A²/H of the first mode of a round tank).
const UNREST: f64 = 0.2;

/// Way of a flask in a frame from which on it counts as a leap, in spacings. Chosen: 8.7 mm at `fast`. Liquid of elsewhere keeps that and the
/// support radius, and what gravity adds in a frame, from a flask whose liquid sleeps: 15.7 mm.
const LEAP: f64 = 3.0;

/// How far a flask may drift, in spacings, and turn, as a length of quaternions (0.1°). Chosen, well below what moves liquid.
const DRIFT: f64 = 0.04;
const TURN: f64 = 1e-3;

/// Difference from the room up to which liquid counts as at its temperature, K. Still air and glass take 12 W/(m² K): a beaker of
/// 160 mL loses 0.25 W, and would cool by 0.04 K in a minute.
const WARM: f64 = 1.0;

/// Difference of acid fractions up to which liquid is even. At 98 % so much water sets 1 J/g free, 0.7 K.
const EVEN: f64 = 1e-3;

/// The part of a state that tells which liquid sleeps; empty where none may.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct SleepState {
    /// Number of particles that are awake, number of those that the last frame sorted, and a word of each flask: whether its liquid sleeps or
    /// settles.
    pub(super) sleep: Vec<u32>,
    /// The words of `FlaskSleep` of each flask.
    pub(super) flasks: Vec<[u32; FLASK_WORDS]>,
    /// `wall_push` by slot, where there are loads: that of liquid that sleeps stays what it was.
    pub(super) pushes: Vec<[f32; 4]>,
}

impl SleepState {
    /// All liquid is awake, and what stands in flasks settles.
    pub(super) fn start(spec: &SolverSpec<'_>) -> Self {
        let (count, flasks) = (spec.particles.len(), spec.flasks.len());
        if !is_on(&spec.parameters, flasks) {
            return Self::default();
        }
        let settles = match spec.at_rest {
            true => SETTLES + 1 + calm_frames(&spec.parameters),
            false => 0,
        };
        let mut sleep = vec![settles; HEAD + flasks];
        sleep[..HEAD].copy_from_slice(&[count as u32, 0]);
        Self {
            sleep,
            flasks: vec![[0; FLASK_WORDS]; flasks],
            pushes: vec![[0.0; 4]; if spec.loads { count } else { 0 }],
        }
    }
}

/// Frames of `CALM_TIME`.
fn calm_frames(p: &Parameters) -> u32 {
    (CALM_TIME / p.frame_time).ceil() as u32
}

/// T of the room, °C.
fn room(p: &Parameters) -> f64 {
    wall_heat::losses(p.chemistry.as_ref()).map_or(ROOM_TEMPERATURE, |losses| losses.ambient)
}

/// Whether liquid of a scene with so many flasks may sleep. Not over a plate, which heats on.
pub(super) fn is_on(p: &Parameters, flasks: usize) -> bool {
    p.sleep && flasks > 0 && p.heaters.iter().all(|&watts| watts == 0.0)
}

/// Whether the words of `sleep` stay what they are while nothing moves: no particle is awake, none was sorted, and each flask's liquid sleeps,
/// that of empty ones too.
pub(super) fn is_settled(words: &[u32]) -> bool {
    matches!(words, [0, 0, flasks @ ..] if flasks.iter().all(|&sleeps| sleeps == 1))
}

/// Where a flask was when the device last counted it as moved.
pub(super) fn pose(noted: &FlaskSleep) -> Pose {
    let orientation = Quat::from_array(noted.orientation);
    Pose {
        position: noted.position.into(),
        orientation,
    }
}

/// How far a flask may drift (m) and turn, as a length of quaternions, while it counts as unmoved.
pub(super) fn unmoved(p: &Parameters) -> [f64; 2] {
    [DRIFT * p.spacing, TURN]
}

/// Words of `sleep`, `awake_args` and `flask_sleeps`.
pub(super) fn words(p: &Parameters, flasks: usize) -> [u64; 3] {
    if is_on(p, flasks) {
        [HEAD + flasks, 8, FLASK_WORDS * flasks].map(|words| words as u64)
    } else {
        [0; 3]
    }
}

/// Constants of its shaders.
pub(super) fn constants(spec: &SolverSpec<'_>) -> Vec<(&'static str, f64)> {
    let p = &spec.parameters;
    if !is_on(p, spec.flasks.len()) {
        return Vec::new();
    }
    let d = p.spacing;
    let [drift, turn] = unmoved(p);
    let gravity = glam::DVec3::from(p.gravity).length();
    vec![
        ("SLEEP", 1.0),
        ("CALM_FRAMES", calm_frames(p).into()),
        ("SLOW", (2.0 * gravity * RISE * d).sqrt()),
        ("UNREST", UNREST),
        ("LEAP", LEAP * d),
        (
            "CLEARANCE",
            LEAP * d + p.support_radius + gravity * p.frame_time.powi(2),
        ),
        ("STILL", drift),
        ("UPRIGHT", turn),
        ("ROOM", room(p)),
        ("WARM", WARM),
        ("EVEN", EVEN),
        ("VARIED", EVEN * EVEN),
    ]
}

impl Solver {
    /// Records which liquid sleeps from now on.
    pub(super) fn record_sleep(&self, rec: &mut Recorder) -> Result<(), SolverError> {
        if let Some([sleep, _]) = &self.pipelines.sleep {
            self.pass(rec, sleep)
                .constants(&self.step(self.parameters.substeps - 1))
                .workgroups([1, 1, 1])?;
        }
        Ok(())
    }

    /// Ends a pass in which all lanes of each particle that does not sleep take part.
    pub(super) fn over_awake(&self, pass: Pass<'_>) -> Result<(), SolverError> {
        if !is_on(&self.parameters, self.flasks) {
            return Ok(pass.invocations(self.count * self.lanes)?);
        }
        let in_64 = pass.workgroup_size() == 64;
        Ok(pass.indirect(&self.buffers.awake_args, if in_64 { IN_64 } else { 0 })?)
    }

    /// `awake_args` of a state, as `sim/cell_scan.wgsl` writes them.
    pub(super) fn awake_args(&self, state: &SleepState) -> Vec<u32> {
        let Some(&awake) = state.sleep.first() else {
            return Vec::new();
        };
        let groups = |of: u32| (awake * self.lanes).div_ceil(of).max(1);
        let group = lanes::group(&self.gpu, self.lanes);
        vec![groups(group), 1, 1, 0, groups(64), 1, 1, 0]
    }

    /// Number of particles that were awake in the last frame; waits for the device.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device fails.
    pub fn awake(&self) -> Result<u32, SolverError> {
        if !is_on(&self.parameters, self.flasks) {
            return Ok(self.count);
        }
        let words = read::<u32>(&self.gpu, &self.buffers.sleep, HEAD)?;
        Ok(words.first().copied().unwrap_or(self.count))
    }
}
