//! The program, as a user starts it.

use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::vr::common::scene;
use vitriol_tests::screen;

/// `vitriol desk` in a small scene and a small window.
fn desk(scene: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vitriol"));
    command
        .args(["desk", "--no-console", "--sound", "none", "--fixed"])
        .args(["--preset", "fast", "--size", "160x120", "--scene"])
        .arg(scene)
        .stdin(Stdio::null());
    command
}

/// The same where there is no screen.
fn without_a_screen(scene: &Path, arguments: &[&str]) -> Output {
    let mut command = desk(scene);
    let command = command.args(arguments);
    let command = command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command.output().unwrap()
}

/// One error, which names the screen and a remedy, and the exit code of what is missing at the machine.
#[test]
fn without_a_screen_it_says_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let recording = folder.path().join("none.mcap");
    let keep = ["--record", recording.to_str().unwrap()];
    for format in [&[][..], &["--json"]] {
        let output = without_a_screen(&scene, &[&keep[..], format].concat());
        let log = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{log}");
        assert!(output.stdout.is_empty());
        let told = log.lines().filter(|line| line.contains("DISPLAY"));
        assert_eq!(told.count(), 1, "{log}");
        // It is the last word, and with JSON the only one.
        let last = log.lines().next_back().unwrap();
        let says = ["DISPLAY", "screen"].iter().all(|it| last.contains(it));
        assert!(says, "{log}");
        assert!(format.is_empty() || log.lines().count() == 1, "{log}");
        // A session that never was leaves no file.
        assert!(!recording.exists());
    }
}

/// A recording that cannot be made is refused before a device or a window is opened: here the screen would be missed first.
#[test]
fn a_recording_is_refused_before_a_window_opens() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let there = folder.path().join("there.mcap");
    std::fs::write(&there, "").unwrap();
    let nowhere = folder.path().join("nowhere").join("new.mcap");
    for (file, code, cause) in [
        (&there, 2, "there.mcap: exists"),
        (&nowhere, 1, "new.mcap: cannot create"),
    ] {
        let output = without_a_screen(&scene, &["--record", file.to_str().unwrap()]);
        let log = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{log}");
        assert!(output.stdout.is_empty());
        assert!(log.contains(cause) && !log.contains("DISPLAY"), "{log}");
        assert_eq!(log.lines().count(), 1, "{log}");
    }
    // What was there is as it was.
    assert_eq!(std::fs::read(&there).unwrap(), b"");
}

mod long {
    use super::*;

    #[test]
    fn frames_are_measured_in_a_window() {
        let Some(screen) = screen::enter("desk::program::long::frames_are_measured_in_a_window")
        else {
            return;
        };
        let folder = tempfile::tempdir().unwrap();
        let recording = folder.path().join("desk.mcap");
        let keep = ["--record", recording.to_str().unwrap()];
        screen.watch();
        let mut command = desk(&scene(folder.path()));
        let output = command.args(["--frames", "5", "--json"]).args(keep);
        let output = output.output().unwrap();
        let log = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{log}");
        assert!(screen.opened() > 0);
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(report["frames"], 5, "{report}");
        assert_eq!(report["lost_particles"], 0, "{report}");
        assert!(report["steps"].as_u64() > Some(0), "{report}");
        assert_eq!(report["attempts"].as_array().map(Vec::len), Some(1));
        // What it kept is a track to the end.
        let track = vitriol_xr::track::load(recording.to_str().unwrap()).unwrap();
        assert!(!track.recovered);
    }
}
