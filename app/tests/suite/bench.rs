//! `vitriol bench` beside other programs, and over the number of particles.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Output};

use crate::VITRIOL;
use serde_json::Value;
use vitriol_tests::program::words;

/// What a peer prints that is well.
const ANSWER: &str = r#"{"name": "Fake", "version": "1.2", "device": "none", "particles": 300, "times_ms": [2000.0, 4000.0, 3000.0], "density_error_mean": 0.25, "density_error_p99": 0.5}"#;

/// A scene of 300 particles, and its depth: 0.1 m wide, in a world of 0.05 m.
const SCENE: &str = r#"
name = "few"
description = "Few particles at rest."
model = []

[scale]
spacing = 0.05
support_ratio = 2.0
frame_time = 0.02
gravity = 9.5
rest_density = 1000.0
length_scale = 0.05
boundary_spacing_ratio = 0.5

[solver]
substeps = 4
iterations = 3
relaxation = "jacobi"
omega = 0.35
carry_rate = 0.0
v_max = 20.0
boundary = "map"
viscosity = 0.3

[floor]
height = 0.0

[[flask]]
name = "tray"
points = [[0.0, 0.25], [1.0, 0.25]]
wall = 0.1
density = 2230.0
position = [0.0, 0.0, 0.0]
fixed = true

[[liquid]]
flask = "tray"
particles = 300
temperature = 20.0
acid_fraction = 0.0
"#;

fn program(folder: &Path, name: &str, body: &str) {
    let path = folder.join(name);
    fs::write(&path, format!("#!/bin/sh\n{body}\n")).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
}

/// `vitriol bench` of [`SCENE`] in the folder, where programs of the folder are found first.
fn bench(folder: &Path, more: &str) -> Output {
    fs::write(folder.join("few.toml"), SCENE).unwrap();
    let path = std::env::var("PATH").unwrap_or_default();
    let line = format!("bench --scene few.toml --frames 8 {more}");
    let mut command = Command::new(VITRIOL.0);
    command.args(words(&line)).current_dir(folder);
    let path = format!("{}:{path}", folder.display());
    command.env("PATH", path).output().unwrap()
}

fn object(output: &Output) -> Value {
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

/// It is asked in turn with ours for the same, and the row has its times over ours.
#[test]
fn a_peer_is_asked_for_the_same_and_compared() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let body = format!("echo \"$@\" >> asked\necho warming up\necho '{ANSWER}'");
    program(here, "peer.sh", &body);
    let found = object(&bench(here, "--against ./peer.sh --json"));
    let row = &found["rows"][0];

    let asked = fs::read_to_string(here.join("asked")).unwrap();
    let asked: Vec<&str> = asked.lines().collect();
    assert_eq!(asked.len(), 2, "ours, peer, ours, peer: {asked:?}");
    assert_eq!(asked[0], asked[1]);
    let given: Vec<&str> = asked[0].split(' ').collect();
    let value = |name: &str| {
        let at = given.iter().position(|word| *word == name);
        given[at.unwrap_or_else(|| panic!("{name}: {given:?}")) + 1]
    };
    for (name, expected) in [
        ("--particles", "300"),
        ("--substeps", "4"),
        ("--iterations", "3"),
        ("--spacing", "0.05"),
        ("--frame-time", "0.02"),
        ("--gravity", "9.5"),
        ("--frames", "8"),
    ] {
        assert_eq!(value(name), expected, "{name}");
    }
    assert!(["cpu", "gpu"].contains(&value("--arch")));
    // 300 · 0.05³ m³ over π · 0.25² m²; the map's outline rounds the bottom's edge.
    let depth: f64 = value("--depth").parse().unwrap();
    assert!((depth - 0.191).abs() < 0.002, "{depth}");
    // 0.3 in each reference time: less in a substep of 5 ms than in the paper's of 5.6 ms.
    let viscosity: f64 = value("--viscosity").parse().unwrap();
    assert!((0.25..0.3).contains(&viscosity), "{viscosity}");

    let peer = &row["peers"][0];
    assert_eq!(peer["name"], "Fake");
    assert_eq!(peer["version"], "1.2");
    assert_eq!(peer["device"], "none");
    assert_eq!(number(&peer["total"]["median_ms"]), 3000.0);
    assert_eq!(number(&peer["total"]["p95_ms"]), 4000.0);
    assert_eq!(peer["range_ms"], serde_json::json!([2000.0, 4000.0]));
    assert_eq!(number(&peer["density_error_mean"]), 0.25);
    assert_eq!(number(&peer["density_error_p99"]), 0.5);
    let ratio = 3000.0 / number(&row["total"]["median_ms"]);
    assert!(
        (number(&peer["ratio"]) - ratio).abs() < 1e-9 * ratio,
        "{peer}"
    );
    assert_eq!(peer["ratios"].as_array().unwrap().len(), 2);
}

/// A script in Python is python3's; several peers are a block each, and all is in the text.
#[test]
fn a_script_is_run_by_python_and_the_text_has_all_peers() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    program(
        here,
        "python3",
        &format!("echo \"$1\" >> scripts\necho '{ANSWER}'"),
    );
    fs::write(here.join("one.py"), "no program of its own").unwrap();
    let other = ANSWER.replace("Fake", "Other");
    program(here, "other.sh", &format!("echo '{other}'"));
    let output = bench(here, "--against one.py --against ./other.sh");
    let text = String::from_utf8(output.stdout).unwrap();
    for part in [
        "against Fake 1.2 on none",
        "against Other 1.2 on none",
        "3000.000   4000.000   (2000.000 to 4000.000)",
        "density error: mean 25",
        "of ours",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let scripts = fs::read_to_string(here.join("scripts")).unwrap();
    assert_eq!(scripts, "one.py\none.py\n");
}

/// Each failure says what is wrong and what to do, in a line, with nothing on standard output.
#[test]
fn a_peer_that_fails_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    program(
        here,
        "ends.sh",
        "echo first >&2\necho no card here >&2\nexit 7",
    );
    program(here, "silent.sh", "exit 0");
    program(here, "chatty.sh", "echo all went well");
    let fewer = ANSWER.replace("\"particles\": 300", "\"particles\": 299");
    program(here, "fewer.sh", &format!("echo '{fewer}'"));
    let none = ANSWER.replace("[2000.0, 4000.0, 3000.0]", "[]");
    program(here, "none.sh", &format!("echo '{none}'"));
    let zero = ANSWER.replace("4000.0", "0.0");
    program(here, "zero.sh", &format!("echo '{zero}'"));
    fs::write(here.join("locked.sh"), "").unwrap();
    for (against, code, parts) in [
        (
            "./nowhere",
            2,
            &["./nowhere cannot be started", "give the path"][..],
        ),
        ("nowhere.py", 2, &["nowhere.py cannot be started", ".py"]),
        ("./locked.sh", 2, &["./locked.sh cannot be started"]),
        (
            "./ends.sh",
            1,
            &[
                "./ends.sh ended with exit status: 7",
                "no card here",
                "--particles 300",
            ],
        ),
        (
            "./silent.sh",
            1,
            &["./silent.sh printed no result", "study/peers/peer.py"],
        ),
        (
            "./chatty.sh",
            1,
            &["./chatty.sh printed no result", "all went well"],
        ),
        (
            "./fewer.sh",
            1,
            &["299 particles where 300 were asked for", "mend"],
        ),
        ("./none.sh", 1, &["no times"]),
        ("./zero.sh", 1, &["not above 0"]),
    ] {
        let output = bench(here, &format!("--against {against}"));
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{against}: {said}");
        assert_eq!(String::from_utf8(output.stdout).unwrap(), "", "{against}");
        assert!(!said.contains("first"), "{said}");
        for part in parts {
            assert!(said.contains(part), "{against}: {said}");
        }
    }
}

/// Blocks of more and more particles, a table and a figure that has a point for each, and a peer's beside them.
#[test]
fn time_over_particles_is_measured_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    // Answers with as many particles as it is asked for.
    let answer = ANSWER.replace("\"particles\": 300", "\"particles\": '$2'");
    program(here, "peer.sh", &format!("echo '{answer}'"));
    let line = "bench --scaling figure.svg --most 4000 --frames 8";
    let found = VITRIOL.object(here, &format!("{line} --against ./peer.sh"));
    let scaling = &found["scaling"];
    assert_eq!(
        (&scaling["substeps"], &scaling["iterations"]),
        (&Value::from(3), &Value::from(2))
    );
    assert_eq!(found["rows"], serde_json::json!([]));
    assert!(scaling["skipped"].is_null());
    let rows = scaling["rows"].as_array().unwrap();
    let counts: Vec<&Value> = rows.iter().map(|row| &row["fluid_particles"]).collect();
    assert_eq!(counts, [1000, 4000]);
    for row in rows {
        let of_one = number(&row["particle_iteration_ns"]);
        let whole = of_one * 1e-6 * 6.0 * number(&row["fluid_particles"]);
        let median = number(&row["total"]["median_ms"]);
        assert!((whole - median).abs() < 1e-9 * median, "{row}");
        // At rest, by 3 × 2: some per cent, as a million of them have.
        assert!(number(&row["density_error_p99"]) < 0.2, "{row}");
        assert_eq!(number(&row["peers"][0]["total"]["median_ms"]), 3000.0);
    }
    let svg = fs::read_to_string(here.join("figure.svg")).unwrap();
    for part in ["ms a frame", "particles", "Vitriol", "Fake", "1000"] {
        assert!(
            svg.replace('\u{202f}', "").contains(part),
            "{part}: {svg:.2000}"
        );
    }
    // A circle for each row, of ours and of the peer.
    assert_eq!(svg.matches("<circle").count(), 4, "{svg:.2000}");

    VITRIOL.refuses(here, line, &["figure.svg"]);
}

/// What cannot be had together is refused before anything is measured.
#[test]
fn what_does_not_go_together_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    VITRIOL.refuses_each(
        folder.path(),
        "
bench --against x --render => --against <PROGRAM>; --render
bench --against x --features => --against <PROGRAM>; --features
bench --scaling x.svg --paper => --scaling <FILE.svg>; --paper
bench --scaling x.svg --scene beaker => --scaling <FILE.svg>; --scene
bench --most 4000 => --scaling; required
bench --scaling x.svg --most 999 => --most; 999
",
    );
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
