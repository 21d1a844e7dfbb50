//! The reader of recorded tracks: any bytes are a track or a message.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::Path;
use vitriol_xr::track::Track;

fuzz_target!(|bytes: &[u8]| {
    let _ = Track::parse(bytes, Path::new("fuzz.mcap"));
});
