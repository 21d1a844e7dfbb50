//! A replay before it runs: its track, scene, preset, solver and length, all checked.

use vitriol_lesson::Language;
use vitriol_run::track::key;
use vitriol_run::{Action, Blame, Failure, Scenes, Setup, Span, device, track};
use vitriol_sim::scene::{Preset, Scene};
use vitriol_xr::Switch;
use vitriol_xr::track::{Track, limits};

use crate::command::recorded::{
    changes_scene, differences, is_recording, own_solver, preset_of, scene_of, whole,
};
use vitriol_run::budget;

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
    /// Glass breaks from the start.
    pub breakable: bool,
    /// What is whole of a track will do.
    pub accept_truncated: bool,
    /// Language of what is wrong with a track.
    pub language: Language,
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
            ("--breakable", self.breakable && !breaks_glass(track)),
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

/// Whether the track's own glass breaks, from its first step to its last.
fn breaks_glass(track: &Track) -> bool {
    let first = track.frames.first();
    let mut from_start = first.into_iter().flat_map(|frame| &frame.scenario);
    let mut all = track.frames.iter().flat_map(|frame| &frame.scenario);
    let breaks = Action::Glass(true).switch();
    from_start.any(is_of_glass) && all.all(|switch| !is_of_glass(switch) || *switch == breaks)
}

fn is_of_glass(switch: &Switch) -> bool {
    switch.key == key::GLASS
}

/// What is to run.
#[derive(Debug)]
pub struct ReplayPlan {
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

impl ReplayPlan {
    /// Loads and checks what is asked for, and says where its bits may differ from what was recorded.
    ///
    /// # Errors
    /// [`Failure::Input`] for bad track, scene or option, [`Failure::NoDevice`], [`Failure::Other`].
    pub fn new(ask: &Ask<'_>) -> Result<Self, Failure> {
        Self::of(ask, track::load(ask.track)?)
    }

    /// Checks what is asked for as [`ReplayPlan::new`] does, for a track that is loaded already.
    ///
    /// # Errors
    /// As for [`ReplayPlan::new`].
    pub fn of(ask: &Ask<'_>, track: Track) -> Result<Self, Failure> {
        let mut track = whole(ask.track, track, ask.accept_truncated, ask.language)?;
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
        let breakable = ask.breakable && !breaks_glass(&track);
        if breakable {
            for frame in &mut track.frames {
                frame.scenario.retain(|switch| !is_of_glass(switch));
            }
        }
        let preset = preset_of(ask.preset, &track);
        let scene = scenes.get(&name)?.with_preset(preset);
        if is_recording(&track.metadata) {
            let asked = ask.otherwise(&track);
            for difference in differences(&track.metadata, (&name, &scenes), None, &asked) {
                tracing::warn!("bits may differ: {difference}");
            }
        }
        // Only now, since it is no part of what was recorded.
        if let Some(first) = track.frames.first_mut().filter(|_| breakable) {
            first.scenario.insert(0, Action::Glass(true).switch());
        }
        let gpu = || device::open(ask.device);
        let chosen = budget::chosen(ask.solver, ask.budget_ms, &scene, gpu)?;
        let scene = chosen.map_or_else(|| scene.clone(), |effort| scene.with_effort(effort));
        let seconds = ask.seconds.unwrap_or_else(|| track.duration());
        let (step, most) = (scene.scale.frame_time, limits::FRAMES);
        let span = Span::covering(seconds, step);
        if span.steps > most as u64 {
            return Err(format!(
                "{} s are more than a run of {most} steps of {step} s takes, which is {:.0} s; give less with --seconds or --at",
                given(seconds),
                most as f64 * step
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

    /// The setup of its experiment on `device`: without pictures, with the built-in shaders.
    pub fn setup<'a>(&'a self, device: Option<&'a str>) -> Setup<'a> {
        let name = (self.name.as_str(), &self.scenes);
        Setup {
            device,
            ..Setup::without_pictures(&self.scene, name, self.preset, self.seed)
        }
    }

    /// Whether a moment at `seconds` is before the end of a run that lasts `whole` seconds, give or take a step: after it hands would only
    /// be held.
    ///
    /// # Errors
    /// [`Failure::Input`] for a later moment.
    pub fn reaches(&self, seconds: f64, whole: f64) -> Result<(), Failure> {
        if seconds > whole + self.scene.scale.frame_time {
            return Err(format!(
                "the run ends at {whole:.3} s, before the first moment at {} s; take an earlier one",
                given(seconds)
            ))
            .input();
        }
        Ok(())
    }
}

/// Seconds as they were given, without hundreds of zeros.
fn given(seconds: f64) -> String {
    match seconds < 1e9 {
        true => seconds.to_string(),
        false => format!("{seconds:e}"),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Glass breaks from the first step on where that is asked for, whatever switches the track has for it later, and else as the track's
    /// switches set it.
    #[test]
    fn glass_breaks_as_asked_for_or_as_recorded() {
        let switches = |track: &str, breakable| {
            let ask = Ask {
                track,
                breakable,
                ..Ask::default()
            };
            let plan = ReplayPlan::new(&ask).unwrap();
            let switches = plan.track.frames.iter().enumerate().flat_map(|(n, frame)| {
                let glass = frame.scenario.iter().filter(|it| is_of_glass(it));
                glass.map(move |it| (n, it.value.clone()))
            });
            switches.collect::<Vec<_>>()
        };
        let breaks = [(0, "breaks".to_owned())];
        assert_eq!(switches("two-flasks", false), []);
        assert_eq!(switches("two-flasks", true), breaks);
        assert_eq!(switches("dropped", false), breaks);
        assert_eq!(switches("dropped", true), breaks);

        let mut track = track::load("dropped").unwrap();
        assert!(breaks_glass(&track));
        let holds = Action::Glass(false).switch();
        track.frames[9].scenario.push(holds.clone());
        assert!(!breaks_glass(&track));
        track.frames[9].scenario.clear();
        track.frames[0].scenario = vec![holds];
        assert!(!breaks_glass(&track));
    }
}
