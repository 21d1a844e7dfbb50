//! The reader of keyframes: any text is a track or a message.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::Path;
use vitriol_xr::track::Keyframes;

fuzz_target!(|text: &str| {
    if let Ok(keyframes) = Keyframes::parse(text, Path::new("fuzz.toml")) {
        let _ = keyframes;
    }
});
