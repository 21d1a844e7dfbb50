//! A recorder killed in mid-write.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use vitriol_tests::program::own_name;
use vitriol_xr::track::{Existing, Track, TrackWriter};

const FILE: &str = "VITRIOL_TEST_KILLED_TRACK";

/// Runs this test again, as a child that writes to `file` and kills itself, and returns the track that can be read
/// from the file.
fn killed() -> Track {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("killed.mcap");
    let status = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", &own_name(), "--include-ignored"])
        .env(FILE, &file)
        .output()
        .unwrap()
        .status;
    assert!(!status.success(), "the child was to be killed");
    let track = Track::open(&file).unwrap();
    assert!(track.recovered);
    track
}

fn writer(file: impl AsRef<Path>) -> TrackWriter {
    TrackWriter::create(file.as_ref(), &super::metadata(), Existing::Refuse).unwrap()
}

#[test]
fn at_most_a_second_of_the_track_is_lost() {
    // 33.3 s at 90 Hz, written as fast as it goes.
    const FRAMES: u64 = 2997;
    if let Some(file) = std::env::var_os(FILE) {
        let track = super::track(FRAMES);
        let mut writer = writer(Path::new(&file));
        for (frame, flasks) in track.frames.iter().zip(&track.stage_from_flasks) {
            writer.write(frame, flasks).unwrap();
        }
        // No destructor runs, nothing is flushed.
        std::process::abort();
    }
    let track = killed();
    let whole = super::track(FRAMES);
    let kept = track.frames.len();
    assert_eq!(track.metadata, whole.metadata);
    assert_eq!(track.frames, whole.frames[..kept]);
    assert_eq!(track.stage_from_flasks, whole.stage_from_flasks[..kept]);
    let lost = whole.duration() - track.duration();
    assert!((0.0..1.0).contains(&lost), "{lost} s lost");
}

#[test]
fn at_most_a_second_of_the_clock_is_lost() {
    // Slow motion: 1 ms of the track takes 100 ms. Of 1.5 s the last second may be lost.
    if let Some(file) = std::env::var_os(FILE) {
        let mut writer = writer(Path::new(&file));
        for step in 0..15 {
            let mut frame = super::frame(step);
            frame.time_ns = step as i64 * 1_000_000;
            writer.write(&frame, &[]).unwrap();
            std::thread::sleep(Duration::from_millis(100));
        }
        std::process::abort();
    }
    let track = killed();
    assert!(track.frames.len() >= 5, "{} of 15", track.frames.len());
}
