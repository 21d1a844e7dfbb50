//! A replay before it runs: its track, scene, preset, solver and length, all checked.

use vitriol_experiment::{Blame, Failure, Scenes, Span, device, track};
use vitriol_sim::scene::{Preset, Scene};
use vitriol_xr::track::{Track, limits};

use crate::budget;
use crate::command::recorded::{
    changes_scene, differences, is_recording, own_solver, preset_of, scene_of, whole,
};

/// What is asked for.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ask<'a> {
    /// The track, by name or file.
    pub track: &'a str,
    /// A scene in place of the track's.
    pub scene: Option<&'a str>,
    /// A preset in place of the recorded one.
    pub preset: Option<Preset>,
    /// In place of a preset's milliseconds of a frame.
    pub budget_ms: Option<f64>,
    /// In place of a preset substeps and iterations.
    pub solver: Option<[u32; 2]>,
    /// Simulated seconds in place of the whole track.
    pub seconds: Option<f64>,
    /// A seed in place of the track's.
    pub seed: Option<u64>,
    /// A device in place of the best.
    pub device: Option<&'a str>,
    /// What is whole of a track will do.
    pub accept_truncated: bool,
}

impl Ask<'_> {
    /// Options that ask for something else than was recorded.
    pub fn otherwise(&self, track: &Track) -> Vec<&'static str> {
        let metadata = &track.metadata;
        let recorded = track_preset(track);
        let options = [
            ("--seconds", self.seconds.is_some()),
            (
                "--seed",
                self.seed.is_some_and(|seed| seed != metadata.seed),
            ),
            ("--solver", self.solver.is_some()),
            ("--budget-ms", self.budget_ms.is_some()),
            ("--accept-truncated", self.accept_truncated),
            (
                "--preset",
                self.preset
                    .is_some_and(|asked| Some(asked.name()) != recorded),
            ),
        ];
        let given = options.into_iter().filter(|(_, given)| *given);
        given.map(|(option, _)| option).collect()
    }
}

fn track_preset(track: &Track) -> Option<&str> {
    let parameters = &track.metadata.parameters;
    parameters.get(track::PRESET).map(String::as_str)
}

/// What is to run.
#[derive(Debug)]
pub struct Plan {
    /// The track, without what is replaced.
    pub track: Track,
    /// Scenes that it may bring up.
    pub scenes: Scenes,
    /// The scene's name at the start, and the scene with preset and solver.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// Its preset.
    pub preset: Preset,
    /// Substeps and iterations in place of the preset's.
    pub chosen: Option<[u32; 2]>,
    /// Seed.
    pub seed: u64,
    /// Steps.
    pub span: Span,
}

impl Plan {
    /// Loads and checks what is asked for, and says where its bits may differ from what was recorded.
    ///
    /// # Errors
    /// [`Failure::Input`] for bad track, scene or option, [`Failure::NoDevice`], [`Failure::Other`].
    pub fn new(ask: &Ask<'_>) -> Result<Self, Failure> {
        let track = track::load(ask.track)?;
        let mut track = whole(ask.track, track, ask.accept_truncated)?;
        let mut scenes = Scenes::default();
        let name = scene_of(&mut scenes, ask.track, ask.scene, &track)?;
        let asked = ask.solver.is_some() || ask.budget_ms.is_some();
        if asked && changes_scene(&track) {
            // The scenes that it changes to have presets of their own.
            return Err(
                "--solver and --budget-ms are for one scene, and the track changes it; \
                        choose a --preset"
                    .to_owned(),
            )
            .input();
        }
        if own_solver((asked, ask.preset), (&name, &scenes), &mut track) {
            tracing::warn!(
                "the track's own changes of substeps and iterations are left out: it is replayed as asked for"
            );
        }
        let preset = preset_of(ask.preset, &track);
        let scene = scenes.get(&name)?.with_preset(preset);
        if is_recording(&track.metadata) {
            let asked = ask.otherwise(&track);
            for difference in differences(&track.metadata, (&name, &scenes), None, &asked) {
                tracing::warn!("bits may differ: {difference}");
            }
        }
        let gpu = || device::open(ask.device);
        let chosen = budget::chosen(ask.solver, ask.budget_ms, &scene, gpu)?;
        let scene = chosen.map_or_else(|| scene.clone(), |effort| scene.with_effort(effort));
        let span = Span::covering(
            ask.seconds.unwrap_or_else(|| track.duration()),
            scene.scale.frame_time,
        );
        if span.steps > limits::FRAMES as u64 {
            return Err(format!(
                "{} steps of {} s are more than a run of {} takes; give fewer --seconds",
                span.steps,
                scene.scale.frame_time,
                limits::FRAMES
            ))
            .input();
        }
        Ok(Self {
            seed: ask.seed.unwrap_or(track.metadata.seed),
            track,
            scenes,
            name,
            scene,
            preset,
            chosen,
            span,
        })
    }
}
