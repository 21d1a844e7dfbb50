//! The reader of keyframes: any text is a track or a message.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::Path;
use vitriol_xr::PoseSource;
use vitriol_xr::track::{Keyframes, TrackSource};

fuzz_target!(|text: &str| {
    if let Ok(keyframes) = Keyframes::parse(text, Path::new("fuzz.toml")) {
        // What is accepted can be sampled, and is played.
        let track = keyframes.sample_track();
        let mut source = TrackSource::new(track);
        for step in 0..100 {
            let played = source.next(step, step as f64 / 90.0);
            assert!(played.is_ok(), "{played:?}");
        }
    }
});
