//! The liquids that are compared: built-in scenes and tracks, run through the solver to stated times.

use glam::DVec3;
use vitriol_gpu::Gpu;
use vitriol_run::glassware::Glassware;
use vitriol_run::{Blame, Failure, Liquid, Span, stage, track};
use vitriol_shaders::Library;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_sim::world::{StepInput, World};
use vitriol_xr::PoseSource;
use vitriol_xr::track::TrackSource;

/// Description of a state.
#[derive(Clone, Copy, Debug)]
pub struct StateSpec {
    /// Its name.
    pub name: &'static str,
    /// Built-in scene.
    pub scene: &'static str,
    /// Built-in track that moves it.
    pub track: &'static str,
    /// Simulated time, s.
    pub seconds: f64,
    /// The point that the views look at, stage, real metres.
    pub target: [f32; 3],
    /// Half the height of the views there, metres.
    pub reach: f32,
}

/// A beaker at rest, a pour in its middle, and water on acid that boils. The
/// track closes its hand on the flask after 0.8 s, pours from 2.8 s to 5.2 s
/// and lets the flask drain.
pub const STATES: [StateSpec; 3] = [
    StateSpec {
        name: "still",
        scene: "two-flasks",
        track: "two-flasks",
        seconds: 0.5,
        target: [-0.12, 0.79, -0.40],
        reach: 0.06,
    },
    StateSpec {
        name: "pouring",
        scene: "two-flasks",
        track: "two-flasks",
        seconds: 4.2,
        target: [0.085, 0.85, -0.40],
        reach: 0.12,
    },
    StateSpec {
        name: "boiling",
        scene: "water-into-acid",
        track: "two-flasks",
        seconds: 5.2,
        target: [0.11, 0.84, -0.40],
        reach: 0.11,
    },
];

/// A liquid at one moment, on the device and on the host.
pub struct State {
    /// Its description.
    pub spec: StateSpec,
    /// The world; its device holds what the renderer draws.
    pub world: World,
    /// The particles' positions, stage, scene's unit.
    pub positions: Vec<DVec3>,
    /// Their volumes, scene's unit cubed.
    pub volumes: Vec<f64>,
    /// The solids around them.
    pub glassware: Glassware,
}

/// Runs the states' scenes under `preset`.
///
/// # Errors
/// The error of scene, track or device.
pub fn run(gpu: &Gpu, library: &Library, preset: Preset) -> Result<Vec<State>, Failure> {
    let of = |&spec: &StateSpec| {
        let scene = Scene::builtin(spec.scene).input()?.with_preset(preset);
        let track = track::load(spec.track)?;
        let seed = track.metadata.seed;
        let mut source = TrackSource::new(track);
        let mut world = World::new(gpu, library, &scene, seed).other()?;
        let span = Span::covering(spec.seconds, scene.scale.frame_time);
        for step in 0..span.steps {
            let time = step as f64 * span.frame_time;
            let Some(frame) = source.next(step, time).other()? else {
                break;
            };
            let hands = stage::input(&frame, &scene).hands;
            world.step(&StepInput::of_hands(hands)).other()?;
        }
        State::new(spec, world)
    };
    STATES.iter().map(of).collect()
}

impl State {
    /// The liquid of a world as it is now; waits for the device.
    ///
    /// # Errors
    /// The device's error.
    pub fn new(spec: StateSpec, world: World) -> Result<Self, Failure> {
        let scene = world.scene();
        let state = world.solver().snapshot().other()?;
        let Liquid {
            positions,
            volumes,
            members,
        } = Liquid::of(scene, &state);
        let glassware = Glassware::new(scene, world.poses(), positions.clone(), members);
        Ok(Self {
            spec,
            volumes,
            positions,
            glassware,
            world,
        })
    }
}
