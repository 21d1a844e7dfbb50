//! The reader of scenes: any text is a scene or a message, never a crash.
#![no_main]

use libfuzzer_sys::fuzz_target;
use vitriol_sim::scene::{Preset, Scene};

fuzz_target!(|text: &str| {
    let Ok(scene) = Scene::parse(text, "fuzz.toml") else {
        return;
    };
    for preset in [Preset::Fast, Preset::Balanced, Preset::Reference] {
        let scene = scene.with_preset(preset);
        let count: usize = scene.liquids.iter().map(|l| scene.particle_count(l)).sum();
        // What is accepted can be filled; a large one takes its time.
        if count < 20_000 {
            let start = scene.start(Some(1)).expect("an accepted scene fits its flasks");
            assert_eq!(start.len(), count);
            assert!(start.iter().all(|particle| particle.position.is_finite()));
        }
    }
});
