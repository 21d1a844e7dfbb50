//! The binary from outside: exit codes, one message, pure JSON.

mod bounds;
mod editors;
mod own;
#[cfg(target_os = "linux")]
pub mod runtime;
mod shown;
#[cfg(unix)]
mod unseen;

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::VITRIOL;
use vitriol_lesson::Attempt;
use vitriol_record::{Keeping, Scored, Session, keep};

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// Fails with that code, one line on standard error that holds `parts`, and
/// nothing on standard output.
fn refuses(folder: &Path, arguments: &[&str], code: i32, parts: &[&str]) {
    for json in [false, true] {
        let mut arguments = arguments.to_vec();
        if json {
            arguments.push("--json");
        }
        let output = VITRIOL.run(folder, &arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
        assert_eq!(text(&output.stdout), "", "{arguments:?}");
        for part in parts {
            assert!(message.contains(part), "{arguments:?}: {message}");
        }
        for noise in ["panicked", "Error {", "Some(", "source:"] {
            assert!(!message.contains(noise), "{arguments:?}: {message}");
        }
    }
}

/// Succeeds, and standard output is one JSON object and nothing else.
fn object(folder: &Path, arguments: &[&str]) -> serde_json::Value {
    let value: serde_json::Value = serde_json::from_str(&VITRIOL.json(folder, arguments)).unwrap();
    assert!(value.is_object(), "{value}");
    value
}

#[test]
fn help_names_every_subcommand_and_its_options() {
    let folder = tempfile::tempdir().unwrap();
    let help = |arguments: &[&str]| {
        let output = VITRIOL.run(folder.path(), arguments);
        assert!(output.status.success(), "{arguments:?}");
        text(&output.stdout).to_owned()
    };
    let all = help(&["--help"]);
    for (command, options) in [
        (
            "replay",
            &[
                "--scene",
                "--preset",
                "--seconds",
                "--seed",
                "--device",
                "--out",
                "--no-video",
                "--camera",
                "--colour",
            ][..],
        ),
        (
            "vr",
            &[
                "--scene",
                "--preset",
                "--seed",
                "--posture",
                "--grip",
                "--record",
                "--frames",
                "--stand-in",
                "--size",
                "--rate",
            ],
        ),
        (
            "desk",
            &[
                "--scene",
                "--lesson",
                "--preset",
                "--grip",
                "--record",
                "--no-hints",
                "--size",
                "--full-screen",
                "--fov",
                "--scale",
                "--device",
            ],
        ),
        ("track", &["--output", "--list"]),
        ("scenes", &[]),
        (
            "bench",
            &[
                "--scene",
                "--paper",
                "--frames",
                "--against",
                "--scaling",
                "--most",
                "--device",
            ],
        ),
        ("fidelity", &["--out", "--quick", "--preset", "--device"]),
        ("fig5", &["--out", "--device"]),
        ("dam-break", &["--out", "--preset", "--device"]),
        (
            "calorimeter",
            &[
                "--water-ml",
                "--acid-ml",
                "--acid-percent",
                "--water-c",
                "--acid-c",
                "--order",
                "--chemistry",
                "--preset",
                "--seed",
                "--device",
            ],
        ),
        (
            "grade",
            &[
                "--scene", "--preset", "--jobs", "--out", "--verify", "--device", "--class",
            ],
        ),
        ("forget", &["--class"]),
        ("doctor", &[]),
    ] {
        assert!(all.contains(command), "{all}");
        let own = help(&[command, "--help"]);
        for option in options.iter().chain(&["--json"]) {
            assert!(own.contains(option), "{command}: {own}");
        }
    }
}

#[test]
fn bad_arguments_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refuses = |arguments: &[&str], parts: &[&str]| refuses(folder.path(), arguments, 2, parts);
    refuses(&[], &["Usage"]);
    refuses(&["pour"], &["pour"]);
    refuses(&["replay"], &["TRACK"]);
    refuses(&["replay", "x", "--preset", "best"], &["best", "balanced"]);
    for seconds in [
        "--seconds=0",
        "--seconds=-1",
        "--seconds=nan",
        "--seconds=inf",
    ] {
        refuses(&["replay", "x", seconds], &["above 0"]);
    }
    refuses(&["replay", "x", "--seed=-1"], &["--seed"]);
    refuses(
        &["replay", "two-flasks", "--colour", "acid"],
        &["--colour acid", "two-flasks models no heat"],
    );
    refuses(&["replay", "nowhere.mcap"], &["nowhere.mcap", "two-flasks"]);
    refuses(&["bench", "--frames", "0"], &["--frames"]);
    refuses(&["bench", "--paper", "--scene", "x"], &["--paper"]);
    let calorimeter = |more: &[&str], parts: &[&str]| {
        let amounts = ["calorimeter", "--water-ml", "10", "--acid-ml", "10"];
        refuses(&[&amounts, more].concat(), parts);
    };
    refuses(&["calorimeter", "--water-ml", "10"], &["--acid-ml"]);
    for (water, acid, part) in [
        ("0", "0", "0 mL in all"),
        ("-1", "10", "--water-ml -1"),
        ("10", "nan", "--acid-ml NaN"),
        ("1e30", "1", "1000000000"),
    ] {
        let amounts = ["calorimeter", "--water-ml", water, "--acid-ml", acid];
        refuses(&amounts, &[part]);
    }
    calorimeter(&["--acid-percent", "101"], &["--acid-percent 101"]);
    calorimeter(&["--water-c", "101"], &["--water-c 101", "100 °C"]);
    calorimeter(&["--acid-c", "-1"], &["--acid-c -1", "333 °C"]);
    calorimeter(&["--chemistry", "paper"], &["paper", "physical"]);
    calorimeter(&["--order", "both"], &["both", "water-first"]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_calorimeter_of_one_liquid_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let told = object(
        folder.path(),
        &[
            "calorimeter",
            "--preset",
            "fast",
            "--water-ml",
            "0",
            "--acid-ml",
            "50",
            "--acid-percent",
            "30",
            "--acid-c",
            "60",
        ],
    );
    let number = |key: &str| told[key].as_f64().unwrap();
    // f32 of what went in.
    assert!((number("final_c") - 60.0).abs() < 1e-3, "{told}");
    assert!((number("mass_percent") - 30.0).abs() < 1e-4, "{told}");
    // 1.191 g/mL at 60 °C (the table of densities).
    assert!((number("mass_g") - 59.55).abs() < 0.01, "{told}");
    for key in [
        "evaporated_g",
        "time_to_even_s",
        "peak_superheat_k",
        "mass_drift",
        "acid_drift",
        "enthalpy_drift",
        "lost_particles",
    ] {
        assert_eq!(number(key), 0.0, "{key}: {told}");
    }
}

#[test]
fn keyframes_become_a_track_and_are_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let keyframes = "name = \"wave\"\nscene = \"two-flasks\"\nduration = 1.0\n\
        [[head]]\nt = 0.0\nposition = [0.0, 1.2, 0.0]\n";
    fs::write(here.join("wave.toml"), keyframes).unwrap();
    let done = object(here, &["track", "wave.toml", "-o", "wave.mcap"]);
    let info = object(here, &["track", "wave.mcap"]);
    assert_eq!(info["frames"], done["frames"]);
    assert_eq!(info["scene"], "two-flasks");
    assert_eq!(info["recovered"], false);
    assert!(
        (info["duration_s"].as_f64().unwrap() - 1.0).abs() < 1.0 / 90.0,
        "{info}"
    );

    let before = fs::read(here.join("wave.mcap")).unwrap();
    refuses(
        here,
        &["track", "wave.toml", "-o", "wave.mcap"],
        2,
        &["wave.mcap", "exists", "take that one away"],
    );
    assert_eq!(fs::read(here.join("wave.mcap")).unwrap(), before);

    fs::write(
        here.join("typo.toml"),
        keyframes.replace("duration", "durration"),
    )
    .unwrap();
    refuses(
        here,
        &["track", "typo.toml", "-o", "typo.mcap"],
        2,
        &["typo.toml", "duration"],
    );
    fs::write(here.join("cut.mcap"), &before[..40]).unwrap();
    refuses(here, &["track", "cut.mcap"], 2, &["cut.mcap"]);
    refuses(here, &["replay", "cut.mcap"], 2, &["cut.mcap"]);
    assert!(!here.join("typo.mcap").exists() && !here.join("out").exists());
}

#[test]
fn who_is_forgotten_is_in_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    // Windows has no such variable: what it would find there is not a test's.
    let forget = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_vitriol"));
        command
            .current_dir(here)
            .env("XDG_DATA_HOME", here.join("data"));
        command.arg("forget").args(arguments).output().unwrap()
    };
    let attempt = Attempt {
        scene: "water-into-acid".into(),
        ..Attempt::default()
    };
    let attempts = [attempt].map(|attempt| Scored {
        attempt,
        score: None,
    });
    let class = here.join("data/vitriol/class.sqlite");
    for name in ["Zebra-Quagga", "Otter"] {
        let pseudonym = name.parse().unwrap();
        let kept = keep(&Keeping {
            class: &class,
            pseudonym: &pseudonym,
            session: Session::now(),
            lesson: None,
            source: Some(Path::new("pour.mcap")),
            attempts: &attempts,
            out: Some(&here.join(name)),
            lrs: None,
        });
        assert_eq!(kept.unwrap().new, 1);
    }

    refuses(here, &["forget"], 2, &["PSEUDONYM"]);
    refuses(here, &["forget", "ada@example.org"], 2, &["e-mail", "p07"]);
    let typo = ["forget", "Otter", "--class", "typo.sqlite"];
    refuses(here, &typo, 2, &["typo.sqlite", "no such file"]);
    fs::write(here.join("text"), "no table").unwrap();
    let other = ["forget", "Otter", "--class", "text"];
    refuses(here, &other, 2, &["text", "not a class's file"]);

    #[cfg(unix)]
    {
        let output = forget(&["Zebra-Quagga", "--json"]);
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(told["attempts"], 1, "{told}");
        assert_eq!(told["files"].as_array().unwrap().len(), 1, "{told}");
        assert!(
            told["recordings"][0]
                .as_str()
                .unwrap()
                .ends_with("pour.mcap")
        );
        assert!(!here.join("Zebra-Quagga/statements.jsonl").exists());
        assert!(here.join("Otter/statements.jsonl").exists());
        let class = fs::read(&class).unwrap();
        let holds = |name: &str| {
            class
                .windows(name.len())
                .any(|part| part == name.as_bytes())
        };
        assert!(holds("Otter") && !holds("Zebra-Quagga"));
        let again = forget(&["Zebra-Quagga"]);
        assert!(text(&again.stdout).starts_with("Nothing is kept of Zebra-Quagga"));
        // Where nobody was ever kept, nothing is made.
        fs::remove_dir_all(here.join("data")).unwrap();
        assert!(forget(&["Otter"]).status.success());
        assert!(!here.join("data").exists());
    }
}

#[test]
fn a_replay_watches_the_shaders_that_it_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let shaders = folder.path().join("wgsl/render");
    fs::create_dir_all(&shaders).unwrap();
    fs::write(shaders.join("picture.wgsl"), "fn nonsense(").unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_vitriol"))
        .args(["replay", "two-flasks", "--seconds", "0.001", "--out", "new"])
        .args(["--preset", "fast", "--camera", "head"])
        .current_dir(folder.path())
        .env("VITRIOL_SHADERS", folder.path().join("wgsl"))
        .output()
        .unwrap();
    let message = text(&output.stderr);
    assert!(output.status.success(), "{message}");
    for part in [
        "the built-in render/picture.wgsl is used",
        "picture.wgsl:1:",
    ] {
        assert!(message.contains(part), "{message}");
    }
    let report = fs::read_to_string(folder.path().join("new/report.json")).unwrap();
    assert!(report.contains("--camera head"), "{report}");
}

/// The list, case by case, each by the file that a user would have.
#[test]
fn bad_input_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let scene = fs::read_to_string(repository.join("sim/scenes/two-flasks.toml")).unwrap();
    let own = |points: &str| format!("points = {points}\nwall = 0.001");
    for (from, to, parts) in [
        ("gravity = 9.81", "", &["missing field `gravity`"][..]),
        ("gravity = 9.81", "gravity = nan", &["scale.gravity", "NaN"]),
        (
            "[-0.12, 0.75, -0.40]",
            "[inf, 0.75, -0.40]",
            &["flask[0].position"],
        ),
        (
            "profile = \"beaker-400\"",
            &own("[[0.0, 0.001], [0.06, 0.001]]"),
            &["flask[1].points", "narrower than a particle", "0.0025 m"],
        ),
        (
            "volume_ml = 150.0",
            "volume_ml = 1500.0",
            &["liquid", "1500 mL", "mL fit", "use less"],
        ),
        (
            "spacing = 0.0025 ",
            "spacing = 0.00001 ",
            &["scale.spacing", "larger"],
        ),
        (
            "\"beaker-400\"",
            "\"beaker-401\"",
            &["flask[1].profile", "beaker-400"],
        ),
    ] {
        assert!(scene.contains(from), "{from}");
        fs::write(here.join("bad.toml"), scene.replacen(from, to, 1)).unwrap();
        let arguments = [
            "replay",
            "two-flasks",
            "--scene",
            "bad.toml",
            "--out",
            "new",
        ];
        refuses(here, &arguments, 2, &[&["bad.toml: "], parts].concat());
        assert!(!here.join("new").exists(), "{to}");
    }

    let keyframes = fs::read_to_string(repository.join("xr/tracks/two-flasks.toml")).unwrap();
    for (from, to, parts) in [
        (
            "[0.00, 1.20, 0.00]",
            "[nan, 1.20, 0.00]",
            &["head.position", "NaN"],
        ),
        (
            "{ pitch = -40 }",
            "[0.0, 0.0, 0.0, 1.5]",
            &["line 34", "rotation"],
        ),
        ("t = 2.5", "t = 9.0", &["head.t", "order of time"]),
    ] {
        assert!(keyframes.contains(from), "{from}");
        fs::write(here.join("bad.toml"), keyframes.replacen(from, to, 1)).unwrap();
        refuses(
            here,
            &["track", "bad.toml", "-o", "new.mcap"],
            2,
            &[&["bad.toml:"], &parts[..]].concat(),
        );
        refuses(here, &["replay", "bad.toml", "--out", "new"], 2, parts);
        let left = ["new", "new.mcap"].map(|name| here.join(name).exists());
        assert_eq!(left, [false; 2], "{to}");
    }

    object(here, &["track", "two-flasks", "-o", "whole.mcap"]);
    let whole = fs::read(here.join("whole.mcap")).unwrap();
    let mut flipped = whole.clone();
    flipped[whole.len() / 3] ^= 0x10;
    fs::write(here.join("flipped.mcap"), flipped).unwrap();
    refuses(
        here,
        &["replay", "flipped.mcap", "--out", "new"],
        2,
        &["flipped.mcap", "intact"],
    );
    fs::write(here.join("cut.mcap"), &whole[..whole.len() / 2]).unwrap();
    let parts = ["cut.mcap: breaks off after 4.", "--accept-truncated"];
    refuses(here, &["replay", "cut.mcap", "--out", "new"], 2, &parts);
    refuses(
        here,
        &["replay", ".", "--out", "new"],
        2,
        &[".: is a folder"],
    );
    assert!(!here.join("new").exists());
    // Saved again it can be looked at, and still says that it is not whole.
    let saved = object(here, &["track", "cut.mcap", "-o", "saved.mcap"]);
    let info = object(here, &["track", "saved.mcap"]);
    assert_eq!(info["recovered"], false);
    assert_eq!(info["frames"], saved["frames"]);
    assert_eq!(info["outcome"]["broken_off"], "its file had no end");
}
