//! The reader of recorded tracks: any bytes are a track or a message.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::Path;
use vitriol_xr::PoseSource;
use vitriol_xr::track::{Track, TrackSource};

fuzz_target!(|bytes: &[u8]| {
    let Ok(track) = Track::parse(bytes, Path::new("fuzz.mcap")) else {
        return;
    };
    let mut source = TrackSource::new(track);
    for step in 0..100 {
        let played = source.next(step, step as f64 / 90.0);
        assert!(played.is_ok(), "{played:?}");
    }
});
