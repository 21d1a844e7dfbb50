//! Tracks that come from others, opened by the program: what they may reach, and what is said of them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::VITRIOL;
use vitriol_sim::scene::Scene;
use vitriol_xr::Switch;
use vitriol_xr::track::{Existing, Track, load, save};

/// Everything that was printed.
fn said(output: &Output) -> String {
    let bytes = [&output.stdout[..], &output.stderr].concat();
    String::from_utf8(bytes).unwrap()
}

/// Three frames of a track of still hands, changed, as `name` in `folder`.
fn foreign(folder: &Path, name: &str, change: impl FnOnce(&mut Track)) {
    let mut track = load("hands-off").unwrap();
    track.frames.truncate(3);
    track.stage_from_flasks.truncate(3);
    change(&mut track);
    save(&track, &folder.join(name), Existing::Replace).unwrap();
}

/// Commands that open a track.
fn opens(track: &str) -> [String; 2] {
    [
        format!("replay {track} --no-video"),
        format!("picture {track} --at 0.02 -o x.png"),
    ]
}

/// The paths that a track could name are files, so that only whether they are looked up decides.
#[test]
fn a_track_reaches_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("secret"), "the first line\n").unwrap();
    fs::write(
        here.join("mine.toml"),
        Scene::builtin_text("beaker").unwrap(),
    )
    .unwrap();
    let secret = here.join("secret").to_str().unwrap().to_owned();
    for scene in [secret.as_str(), "mine.toml", "/dev/zero", "../secret"] {
        foreign(here, "named.mcap", |track| {
            track.metadata.scene = scene.into();
        });
        foreign(here, "switched.mcap", |track| {
            track.metadata.scene = "beaker".into();
            track.frames[0].scenario.push(Switch {
                key: "scene".into(),
                value: scene.into(),
            });
        });
        for track in ["named.mcap", "switched.mcap"] {
            for line in opens(track) {
                let output = VITRIOL.run(here, &line);
                let said = said(&output);
                assert_eq!(output.status.code(), Some(2), "{line} {scene}: {said}");
                assert!(said.contains("does not carry"), "{said}");
                assert!(!said.contains("the first line"), "{said}");
            }
        }
    }
    // The user may name it.
    foreign(here, "named.mcap", |track| {
        track.metadata.scene = "mine.toml".into();
    });
    let output = VITRIOL.run(here, "replay named.mcap --no-video --scene mine.toml");
    assert!(output.status.success(), "{}", said(&output));
}

#[test]
fn what_a_track_carries_is_held_to_what_any_scene_is() {
    let folder = tempfile::tempdir().unwrap();
    let text = Scene::builtin_text("beaker").unwrap();
    let fine = text.replacen("spacing = 0.0025 ", "spacing = 0.00001 ", 1);
    assert_ne!(fine, text);
    foreign(folder.path(), "x.mcap", |track| {
        track.metadata.scene = "mine.toml".into();
        track.metadata.scenes.insert("mine.toml".into(), fine);
    });
    let output = VITRIOL.run(folder.path(), "replay x.mcap");
    let said = said(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    let part = "the track's scene \"mine.toml\": scale.spacing";
    assert!(said.contains(part), "{said}");
}

/// Opening a pipe would wait for ever, and reading `/dev/zero` would fill the memory.
#[cfg(unix)]
#[test]
fn folders_pipes_and_devices_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::create_dir(here.join("folder")).unwrap();
    for pipe in ["pipe.mcap", "pipe.toml"] {
        let made = Command::new("mkfifo").arg(here.join(pipe)).status();
        assert!(made.unwrap().success());
    }
    for (file, kind) in [
        ("folder", "a folder"),
        ("pipe.mcap", "a pipe"),
        ("pipe.toml", "a pipe"),
        ("/dev/zero", "a pipe or device"),
    ] {
        for line in [
            "track",
            "replay",
            "replay two-flasks --scene",
            "bench --scene",
        ] {
            VITRIOL.refuses(here, &format!("{line} {file}"), &[kind]);
        }
    }
}

#[test]
fn a_tracks_texts_do_not_steer_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let evil = "\u{1b}]0;gone\u{7}\u{1b}[2J\u{202e}x\nseed 7, all is well\r";
    foreign(folder.path(), "x.mcap", |track| {
        track.metadata.scene = evil.into();
        track.metadata.program_version = evil.into();
        let parameters = &mut track.metadata.parameters;
        parameters.insert(evil.into(), evil.into());
        track.outcome.insert(evil.into(), evil.into());
        let scenes = &mut track.metadata.scenes;
        scenes.insert(evil.into(), "name = 3".into());
    });
    let own = Scene::builtin_text("beaker")
        .unwrap()
        .replacen("name = \"beaker\"\n", "name = \"b\"\n", 1)
        .replace("\"beaker\"", "\"\\u001b[2J\\u202ex\\nseed 7\"");
    assert!(own.contains("u001b"));
    foreign(folder.path(), "runs.mcap", |track| {
        track.metadata.scene = evil.into();
        track.metadata.program_version = evil.into();
        let parameters = &mut track.metadata.parameters;
        parameters.remove("track");
        for name in ["device", "driver"] {
            parameters.insert(name.into(), evil.into());
        }
        track.metadata.scenes.insert(evil.into(), own);
    });
    for (line, works) in [
        ("track x.mcap", true),
        ("track x.mcap --json", true),
        ("replay x.mcap", false),
        ("replay runs.mcap --no-video", true),
        ("replay runs.mcap --no-video --json", true),
    ] {
        let output = VITRIOL.run(folder.path(), line);
        let said = said(&output);
        assert_eq!(output.status.success(), works, "{line}: {said}");
        let shown = said.contains(r"\u{1b}[2J\u{202e}x") || said.contains(r"\u001b[2J\u202ex");
        assert!(shown, "{said}");
        let steers = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
        assert!(!said.contains(steers), "{said:?}");
        let forged = said.lines().any(|line| line.starts_with("seed 7"));
        assert!(!forged, "{said}");
    }
}

#[test]
fn missing_steps_are_said_and_not_filled_in() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    foreign(here, "holed.mcap", |track| {
        let whole = load("hands-off").unwrap();
        track.metadata.scene = "beaker".into();
        track.frames = whole.frames[..10].to_vec();
        track.stage_from_flasks = whole.stage_from_flasks[..10].to_vec();
        for _ in 0..3 {
            track.frames.remove(5);
            track.stage_from_flasks.remove(5);
        }
    });
    let replay = "replay holed.mcap --no-video";
    let parts = ["3 steps are missing", "0.0667 s", "--accept-truncated"];
    VITRIOL.refuses(here, replay, &parts);
    assert!(said(&VITRIOL.run(here, "track holed.mcap")).contains("3 steps are missing."));

    let report = VITRIOL.object(here, &format!("{replay} --accept-truncated"));
    let simulated = report["simulated_s"].as_f64().unwrap();
    assert!((simulated - 4.0 / 60.0).abs() < 0.012, "{report}");
    let command = report["command"].as_str().unwrap();
    assert!(command.contains("--accept-truncated"), "{command}");
}

/// What is not whole stays so when it is saved again, and steps may be missing at the start as well.
#[test]
fn what_breaks_off_is_not_made_whole() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    foreign(here, "whole.mcap", |track| {
        track.metadata.scene = "beaker".into();
    });
    let bytes = fs::read(here.join("whole.mcap")).unwrap();
    fs::write(here.join("cut.mcap"), &bytes[..bytes.len() - 20]).unwrap();
    let saved = VITRIOL.run(here, "track cut.mcap -o saved.mcap");
    assert!(saved.status.success(), "{}", said(&saved));
    foreign(here, "late.mcap", |track| {
        track.metadata.scene = "beaker".into();
        track.frames.remove(0);
        track.stage_from_flasks.remove(0);
    });
    for (track, says) in [
        ("cut.mcap", "its recorder stopped hard"),
        ("saved.mcap", "its file had no end"),
        (
            "late.mcap",
            "lacks its first step, so that nothing of it can be replayed: it was cut or filtered",
        ),
    ] {
        for line in opens(track) {
            VITRIOL.refuses(here, &line, &[says]);
        }
    }
    // What looks into it says the same: of three steps, two are there.
    let told = said(&VITRIOL.run(here, "track late.mcap"));
    assert!(told.contains("2 frames"), "{told}");
    assert!(
        told.contains("A step is missing.\nIt begins at step 1,"),
        "{told}"
    );
    let info = VITRIOL.object(here, "track late.mcap");
    assert_eq!(info["missing_steps"], 1);
    assert_eq!(info["missing_first_steps"], 1);
    let accepted = "replay saved.mcap --no-video --accept-truncated";
    assert!(VITRIOL.run(here, accepted).status.success());
}

/// A scene whose steps are so short that a run would take for ever, and a track of hours.
#[test]
fn a_run_has_an_end() {
    let folder = tempfile::tempdir().unwrap();
    let text = Scene::builtin_text("beaker").unwrap();
    let from = "frame_time = 0.011111111111111 ";
    assert!(text.contains(from));
    for (time, says) in [
        ("1e-12", "scale.frame_time"),
        (
            "1e-4",
            "more than a run of 1000000 steps of 0.0001 s takes, which is 100 s",
        ),
    ] {
        foreign(folder.path(), "x.mcap", |track| {
            track.metadata.scene = "x.toml".into();
            let short = text.replacen(from, &format!("frame_time = {time} "), 1);
            track.metadata.scenes.insert("x.toml".into(), short);
            track.frames[2].time_ns = 10_000_000_000_000;
        });
        VITRIOL.refuses(folder.path(), "replay x.mcap --no-video", &[says]);
    }
}

mod long {
    use super::*;

    /// A recording of the program's own, by a wearer of a track: its scene's file is gone when it is replayed.
    #[test]
    fn a_recording_stands_alone_and_tells_what_differs() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path();
        let small = Scene::builtin_text("two-flasks")
            .unwrap()
            .replacen("spacing = 0.0025 ", "spacing = 0.006 ", 1)
            .replacen("substeps = 10", "substeps = 4", 1);
        fs::write(here.join("small.toml"), &small).unwrap();
        let session = VITRIOL.object(
            here,
            "vr --stand-in two-flasks --fixed --frames 30 --size 64x64 --scene small.toml --record x.mcap --no-mirror",
        );
        fs::remove_file(here.join("small.toml")).unwrap();

        let same = VITRIOL.object(here, "replay x.mcap --no-video");
        assert_eq!(same["state_hash"], session["state_hash"]);
        let recording = &same["recording"];
        assert_eq!(recording["same_state"], true);
        assert_eq!(recording["device"], session["device"]["name"]);
        assert_eq!(recording["differs"], serde_json::json!([]));
        assert_eq!(same["scene"]["name"], "small.toml");

        // The same name and another text; and as it would come from another program on another machine.
        let other = small.replacen("volume_ml = 150.0", "volume_ml = 100.0", 1);
        assert_ne!(other, small);
        fs::write(here.join("small.toml"), other).unwrap();
        let mut track = Track::open(&here.join("x.mcap")).unwrap();
        track.metadata.program_version = "0.0.9".into();
        let parameters = &mut track.metadata.parameters;
        parameters.insert("device".into(), "Voodoo".into());
        save(&track, &here.join("x.mcap"), Existing::Replace).unwrap();
        let other = VITRIOL.object(here, "replay x.mcap --no-video --scene small.toml --seed 9");
        let recording = &other["recording"];
        assert_eq!(recording["same_state"], false);
        let differs = recording["differs"].to_string();
        let parts = [
            "another text",
            "--seed",
            "version 0.0.9",
            "the device Voodoo",
        ];
        for part in parts {
            assert!(differs.contains(part), "{differs}");
        }
    }
}
