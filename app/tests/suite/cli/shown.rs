//! What the program tells of itself: tracks, lessons, scenes, the computer, its manual.

use std::collections::BTreeSet;
use std::fs;

use vitriol_lesson::{Language, Texts};

use super::{VITRIOL, text};

#[test]
fn built_in_tracks_are_listed() {
    let folder = tempfile::tempdir().unwrap();
    let list = VITRIOL.object(folder.path(), "track --list");
    let tracks = list["tracks"].as_array().unwrap();
    let two_flasks = tracks.iter().find(|t| t["track"] == "two-flasks").unwrap();
    assert!(two_flasks["duration_s"].as_f64().unwrap() >= 8.0, "{list}");
    assert!(tracks.len() >= 3);
}

/// The lessons are listed, shown in each language and as a file to begin with; a spoiled one gets one message with file, field and what
/// would be right.
#[test]
fn lessons_are_listed_shown_and_checked() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let all = VITRIOL.object(here, "lesson");
    let names: Vec<_> = all["lessons"].as_array().unwrap().iter().collect();
    assert!(names.len() >= 3 && names.iter().any(|it| it["name"] == "dilute"));
    let titles: BTreeSet<String> = ["en", "de", "es", "zh"]
        .map(|language| {
            let told = VITRIOL.object(here, &format!("lesson dilute --language {language}"));
            assert_eq!(told["points"], 100);
            told["title"].as_str().unwrap().to_owned()
        })
        .into();
    assert_eq!(titles.len(), 4, "{titles:?}");
    // The lesson of the wrong order asks for it, so the score has no cap for it.
    for (lesson, caps) in [("dilute", 3), ("wrong-order", 2)] {
        let told = VITRIOL.object(here, &format!("lesson {lesson}"));
        assert_eq!(told["caps"].as_array().unwrap().len(), caps, "{told}");
    }

    let own = VITRIOL.run(here, "lesson dilute --toml");
    let own = text(&own.stdout);
    let file = here.join("own.toml");
    fs::write(&file, own).unwrap();
    assert_eq!(VITRIOL.object(here, "lesson own.toml")["points"], 100);
    fs::write(&file, own.replace("into = \"target\"", "into = \"vase\"")).unwrap();
    // The panel's language needs no lesson; a track that is not there is refused for itself alone.
    VITRIOL.refuses_each(
        here,
        "
lesson own.toml => own.toml; step 4, condition.poured.into; target
vr --no-console --stand-in two-flasks --lesson own.toml => own.toml; step 4, condition.poured.into; target
vr --no-console --stand-in two-flasks --lesson dilute --mode examination => examination; guided
lesson nowhere => nowhere; dilute
vr --no-console --stand-in nowhere --language de => nowhere; two-flasks
vr --no-console --stand-in nowhere --language fr => fr; en, de, es, zh
",
    );
}

/// A window needs a screen. An empty name is none, as winit takes it.
#[cfg(target_os = "linux")]
#[test]
fn doctor_says_whether_there_is_a_screen() {
    for (display, there) in [(None, false), (Some(""), false), (Some(":9"), true)] {
        let mut doctor = std::process::Command::new(env!("CARGO_BIN_EXE_vitriol"));
        doctor.args(["doctor", "--json"]).env_remove("DISPLAY");
        doctor.env_remove("WAYLAND_DISPLAY");
        doctor.envs(display.map(|it| ("DISPLAY", it)));
        let found: serde_json::Value =
            serde_json::from_slice(&doctor.output().unwrap().stdout).unwrap();
        assert_eq!(found["screen"], there, "{display:?}");
    }
}

/// What `--sound` may name, or why nothing can be; without a server it answers as well.
#[cfg(target_os = "linux")]
#[test]
fn doctor_lists_sound_outputs() {
    let folder = tempfile::tempdir().unwrap();
    let nowhere = format!("unix:{}", folder.path().join("no-server").display());
    let mut doctor = std::process::Command::new(env!("CARGO_BIN_EXE_vitriol"));
    doctor
        .args(["doctor", "--json"])
        .env("PULSE_SERVER", nowhere);
    let found: serde_json::Value =
        serde_json::from_slice(&doctor.output().unwrap().stdout).unwrap();
    assert_eq!(found["sound"]["outputs"], serde_json::json!([]));
    let cause = found["sound"]["cause"].as_str().unwrap();
    assert!(cause.contains("sound server"), "{cause}");
}

#[test]
fn doctor_says_what_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    let found = VITRIOL.object(folder.path(), "doctor");
    let devices = found["devices"].as_array().unwrap();
    let usable = devices.iter().any(|device| device["usable"] == true);
    assert_eq!(found["can_replay"], usable);
    let missing = found["missing"].as_array().unwrap();
    if found["can_enter_vr"] == false {
        assert!(!missing.is_empty(), "{found}");
    }
    for lack in missing {
        assert!(lack.as_str().unwrap().ends_with('.'), "a sentence: {lack}");
    }
}

#[test]
fn scenes_state_their_scale() {
    let folder = tempfile::tempdir().unwrap();
    let list = VITRIOL.object(folder.path(), "scenes");
    let scenes = list["scenes"].as_array().unwrap();
    let two_flasks = scenes.iter().find(|s| s["name"] == "two-flasks").unwrap();
    assert_eq!(two_flasks["length_scale"], 1.0, "real size");
    assert!((two_flasks["gravity_m_s2"].as_f64().unwrap() - 9.81).abs() < 0.01);
    for scene in scenes {
        for key in [
            "d_m",
            "h_over_d",
            "frame_time_s",
            "gravity_m_s2",
            "length_scale",
        ] {
            assert!(scene[key].as_f64().unwrap() > 0.0, "{key} of {scene}");
        }
        for preset in scene["presets"].as_array().unwrap() {
            for key in ["substeps", "iterations", "omega", "fluid_particles"] {
                assert!(preset[key].as_f64().unwrap() > 0.0, "{key} of {scene}");
            }
        }
    }

    // Titles are in the language that is asked for.
    let list = VITRIOL.object(folder.path(), "scenes --language de");
    let german = Texts::of(Language::De).unwrap();
    for scene in list["scenes"].as_array().unwrap() {
        let name = scene["name"].as_str().unwrap();
        assert_eq!(scene["title"], german.scene(name));
        assert_ne!(scene["title"], name);
    }
    let told = VITRIOL.run(folder.path(), "scenes --language zh");
    let chinese = Texts::of(Language::Zh).unwrap();
    let head = format!("hot-acid: {}\n", chinese.scene("hot-acid"));
    assert!(text(&told.stdout).contains(&head), "{head}");

    let typo = "name = \"x\"\ngravitty = 1\n";
    fs::write(folder.path().join("typo.toml"), typo).unwrap();
    let here = folder.path();
    let line = "replay two-flasks --scene typo.toml --out new";
    VITRIOL.refuses(here, line, &["typo.toml", "gravitty"]);
    let elsewhere = "replay two-flasks --device Voodoo --out new";
    // Without any driver it is the driver that is missing.
    if VITRIOL.object(here, "doctor")["can_replay"] == true {
        VITRIOL.refuses(here, elsewhere, &[]);
    } else {
        assert_eq!(VITRIOL.run(here, elsewhere).status.code(), Some(3));
    }
    assert!(!folder.path().join("new").exists());
}

/// The packages' manual and completions are the command line's own.
#[test]
fn pages_tell_of_each_command() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let pages = VITRIOL.object(here, "pages --out pages");
    let files = pages["files"].as_array().unwrap();
    assert!(files.len() > 15, "{pages}");
    let read = |name: &str| fs::read_to_string(here.join("pages").join(name)).unwrap();
    let replay = read("vitriol-replay.1");
    for part in ["vitriol\\-replay", "accept\\-truncated", "camera"] {
        assert!(replay.contains(part), "{part}: {replay}");
    }
    for completion in ["vitriol", "vitriol.fish", "_vitriol"] {
        assert!(
            read(completion).contains("accept-truncated"),
            "{completion}"
        );
    }
    // Nothing is overwritten.
    VITRIOL.refuses(here, "pages --out pages", &["vitriol.1", "exists"]);
}
