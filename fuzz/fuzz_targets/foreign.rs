//! Tracks as another program could write them: whole files of any size up to the limits, whose parts are what changes,
//! so that what lies behind checksums and lengths is reached. Each scene that one carries is parsed and filled.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use std::path::Path;
use vitriol_sim::scene::Scene;
use vitriol_xr::track::{Existing, Track, TrackSource, load, save};
use vitriol_xr::{Pose, PoseSource, Switch};

/// What a file is made of.
#[derive(Arbitrary, Debug)]
struct Recipe {
    scene: String,
    /// Built-in scenes with bytes of theirs changed: which, where, to what.
    changed: Vec<(u8, Vec<(u16, u8)>)>,
    /// Scenes of any text.
    scenes: Vec<(String, String)>,
    parameters: Vec<(String, String)>,
    outcome: Vec<(String, String)>,
    frames: u16,
    flasks: u8,
    switches: Vec<(u16, String, String)>,
    /// Frames that are left out, and steps and times that are moved.
    gone: Vec<u16>,
    moved: Vec<(u16, u32, i64)>,
    profile: String,
    /// Bytes of the file that are changed, and where it ends.
    flipped: Vec<(u32, u8)>,
    cut: Option<u32>,
}

impl Recipe {
    fn track(&self) -> Track {
        let mut track = load("hands-off").expect("a built-in track");
        let first = track.frames[0].clone();
        track.frames = (0..u64::from(self.frames % 500).max(1))
            .map(|step| {
                let mut frame = first.clone();
                (frame.step, frame.time_ns) = (step, step as i64 * 11_111_111);
                frame.hands[0].profile = self.profile.as_str().into();
                frame
            })
            .collect();
        for (at, key, value) in &self.switches {
            if let Some(frame) = track.frames.get_mut(usize::from(*at)) {
                frame.scenario.push(Switch { key: key.clone(), value: value.clone() });
            }
        }
        for (at, step, time_ns) in &self.moved {
            if let Some(frame) = track.frames.get_mut(usize::from(*at)) {
                (frame.step, frame.time_ns) = (u64::from(*step), *time_ns);
            }
        }
        for at in &self.gone {
            if usize::from(*at) < track.frames.len() && track.frames.len() > 1 {
                track.frames.remove(usize::from(*at));
            }
        }
        track.stage_from_flasks = vec![vec![Pose::IDENTITY; usize::from(self.flasks)]; track.frames.len()];
        track.metadata.scene = self.scene.clone();
        track.metadata.parameters.extend(self.parameters.iter().cloned());
        track.metadata.scenes.extend(self.scenes.iter().cloned());
        for (n, (which, bytes)) in self.changed.iter().take(4).enumerate() {
            let names = Scene::builtin_names();
            let name = names[usize::from(*which) % names.len()];
            let mut text = Scene::builtin_text(name).unwrap_or_default().as_bytes().to_vec();
            for (at, byte) in bytes {
                let at = usize::from(*at) % text.len();
                text[at] = *byte & 0x7f;
            }
            let text = String::from_utf8_lossy(&text).into_owned();
            track.metadata.scenes.insert(format!("{n}.toml"), text);
        }
        track.outcome.extend(self.outcome.iter().cloned());
        track
    }
}

fuzz_target!(|recipe: Recipe| {
    let file = std::env::temp_dir().join(format!("vitriol-fuzz-{}.mcap", std::process::id()));
    // What the writer refuses, the reader would.
    if save(&recipe.track(), &file, Existing::Replace).is_err() {
        return;
    }
    let mut bytes = std::fs::read(&file).expect("it was written");
    for (at, byte) in &recipe.flipped {
        let at = *at as usize % bytes.len();
        bytes[at] ^= byte;
    }
    if let Some(cut) = recipe.cut {
        bytes.truncate(cut as usize % bytes.len());
    }
    let Ok(track) = Track::parse(&bytes, Path::new("fuzz.mcap")) else {
        return;
    };
    let _ = track.holes().count();
    for (name, text) in &track.metadata.scenes {
        if let Ok(scene) = Scene::parse(text, name) {
            let count: usize = scene.liquids.iter().map(|l| scene.particle_count(l)).sum();
            if count < 20_000 {
                assert_eq!(scene.start(Some(1)).expect("an accepted scene is filled").len(), count);
            }
        }
    }
    let mut source = TrackSource::new(track.up_to_the_first_hole());
    for step in 0..100 {
        let played = source.next(step, step as f64 / 90.0);
        assert!(played.is_ok(), "{played:?}");
    }
});
