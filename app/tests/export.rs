//! What `vitriol export` writes, read by the programs that it is written for.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_tests::readers::Readers;

const SCENE: &str = "acid-into-water";

fn vitriol(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_vitriol"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// What it prints with `--json`.
fn object(folder: &Path, arguments: &[&str]) -> Value {
    let mut arguments = arguments.to_vec();
    arguments.push("--json");
    let output = vitriol(folder, &arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

fn texts(value: &Value) -> Vec<&str> {
    let texts = value.as_array().unwrap().iter();
    texts.map(|text| text.as_str().unwrap()).collect()
}

/// PyVista, Arrow, Rerun and Khronos's validator read all formats of one run, and what they find is what there is: the
/// scene's volumes, the glass of its flasks, as many moments as were asked for, each format's numbers the others'.
#[test]
fn other_programs_read_what_is_there() {
    let Some(readers) = Readers::find("exports") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let run = ["two-flasks", "--scene", SCENE, "--preset", "fast"];
    let replayed = object(
        here,
        &[
            &["replay"],
            &run[..],
            &["--seconds", "0.1", "--no-video", "--out", "run"],
        ]
        .concat(),
    );
    object(here, &["pages", "--out", "pages"]);
    let exported = object(
        here,
        &[
            "export",
            "run",
            "--format",
            "vtk,ply,gltf,csv,parquet,mcap",
            "--rate",
            "20",
            "--out",
            "out",
        ],
    );
    // The run's folder says what it was, to the bit.
    assert_eq!(exported["same_state"], true);
    assert_eq!(exported["state_hash"], replayed["state_hash"]);
    assert_eq!(exported["moments"], 3);

    let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/readers");
    let out = here.join("out").display().to_string();
    let report = here.join("run/report.json").display().to_string();
    let schema = here.join("pages/report.schema.json").display().to_string();
    let found = readers.python(&scripts.join("read.py"), &[&out, &report, &schema]);
    let found: Value = serde_json::from_str(&found).unwrap();

    let scene = Scene::builtin(SCENE).unwrap().with_preset(Preset::Fast);
    let particles = &found["particles"];
    assert_eq!(particles["count"], replayed["fluid_particles"]);
    assert_eq!(particles["cells"], particles["count"]);
    let times = numbers(&particles["times"]);
    // The first state at or after each, in steps of 1/90 s.
    let expected = [0.0, 5.0 / 90.0, 9.0 / 90.0];
    assert!(
        times
            .iter()
            .zip(expected)
            .all(|(time, due)| (time - due).abs() < 1e-9),
        "{times:?}"
    );
    assert_eq!(times.len(), 3);
    assert!((number(&particles["own_time"]) - times[2]).abs() < 1e-12);
    assert_eq!(particles["series_times"], particles["times"]);
    assert_eq!(
        texts(&particles["names"]),
        [
            "acid [kg/kg]",
            "flask [number]",
            "id [1]",
            "mass [kg]",
            "temperature [degC]",
            "velocity [m/s]",
            "volume [m3]",
        ]
    );
    // 100 mL of water and 100 mL of acid, cold: nothing has been poured yet.
    let table = vitriol_sim::chemistry::table::SolutionTable::new();
    let (mut volume, mut mass, mut heat) = (0.0, 0.0, 0.0);
    for liquid in &scene.liquids {
        let count = scene.particle_count(liquid) as f64;
        let density = table
            .at(liquid.acid_fraction)
            .density_at(liquid.temperature);
        let filled = count * scene.scale.spacing.powi(3);
        volume += filled;
        mass += filled * density;
        heat += filled * density * liquid.temperature;
    }
    // Sums of f32, and what evaporates in 0.1 s.
    assert!((number(&particles["mass_kg"]) / mass - 1.0).abs() < 1e-4);
    assert!((number(&particles["volume_m3"]) / volume - 1.0).abs() < 1e-3);
    let warmed = number(&particles["temperature_mean"]) - heat / mass;
    assert!(warmed.abs() < 0.1, "{warmed} K");

    let surfaces = &found["surfaces"];
    // The level set of liquid that is still settling: 2 % are a third of a particle's layer on each surface.
    let liquid = number(&surfaces["liquid_m3"]) / volume - 1.0;
    assert!(liquid.abs() < 0.03, "{liquid}");
    let glass: f64 = scene
        .flasks
        .iter()
        .map(|flask| flask.profile.glass_volume())
        .sum();
    let error = number(&surfaces["glass_m3"]) / glass - 1.0;
    assert!(error.abs() < 0.005, "{error}");
    assert_eq!(surfaces["unit_normals"], true);
    assert!((number(&surfaces["table_height"]) - scene.table.unwrap().top).abs() < 1e-6);
    assert_eq!(
        texts(&surfaces["cameras"]),
        ["tripod", "left eye", "right eye"]
    );

    let tables = &found["tables"];
    assert_eq!(tables["same"], true, "CSV and Parquet differ: {tables}");
    assert_eq!(numbers(&tables["times"]).len(), 2);
    for sum in numbers(&tables["mass_kg"]) {
        assert!((sum / mass - 1.0).abs() < 1e-3, "{sum} kg");
    }
    assert!(
        texts(&tables["head"])
            .iter()
            .all(|name| name.ends_with(']'))
    );

    let recording = &found["recording"];
    assert_eq!(recording["check"], 0);
    assert_eq!(recording["clouds"], 3);
    assert_eq!(recording["same_points"], true);
    // At 30 a second from the first step on: at 1/90, 3/90, 6/90 and 9/90 s.
    assert_eq!(recording["film"], 4);
    // Annex B begins with a start code and the sequence's parameters.
    assert_eq!(recording["film_begins"], "0000000167");
    let frames = texts(&recording["frames"]);
    for name in ["view", "left_grip", "right_grip", "flask_0", "flask_1"] {
        assert!(frames.contains(&name), "{frames:?}");
    }
    // Nine steps, and the end.
    assert_eq!(recording["inputs"], 10);
    assert_eq!(found["report_is_valid"], true);

    let moments = ["000000", "000001", "000002"];
    for moment in moments {
        let file = here
            .join(format!("out/scene-{moment}.glb"))
            .display()
            .to_string();
        let said = readers.node(&scripts.join("validate.js"), &[&file]);
        let said: Value = serde_json::from_str(&said).unwrap();
        let issues = &said["issues"];
        for kind in ["numErrors", "numWarnings", "numInfos", "numHints"] {
            assert_eq!(issues[kind], 0, "{issues}");
        }
        assert_eq!(said["info"]["drawCallCount"], 5);
    }

    // The recording is a track too, and replays to the recorded state.
    let again = object(
        here,
        &[
            "replay",
            "out/recording.mcap",
            "--no-video",
            "--out",
            "again",
        ],
    );
    assert_eq!(again["state_hash"], replayed["state_hash"]);
    assert_eq!(again["recording"]["same_state"], true);
}

/// Tables of a run's folder come from its report, without a device, and say what it says; a track's are simulated.
#[test]
fn tables_of_a_run_are_its_report() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    object(
        here,
        &[
            "replay",
            "hands-off",
            "--scene",
            "beaker",
            "--preset",
            "fast",
            "--seconds",
            "0.02",
            "--no-video",
            "--out",
            "run",
        ],
    );
    let done = object(
        here,
        &["export", "run", "--format", "csv", "--out", "tables"],
    );
    assert!(done["state_hash"].is_null(), "nothing was simulated");
    object(
        here,
        &[
            "export",
            "hands-off",
            "--scene",
            "beaker",
            "--preset",
            "fast",
            "--seconds",
            "0.02",
            "--format",
            "csv",
            "--out",
            "simulated",
        ],
    );
    let read = |file: &str| fs::read_to_string(here.join(file)).unwrap();
    assert_eq!(
        read("tables/measurements.csv"),
        read("simulated/measurements.csv")
    );
    let report: Value = serde_json::from_str(&read("run/report.json")).unwrap();
    let last = report["series"].as_array().unwrap().last().unwrap();
    let table = read("tables/measurements.csv");
    let row: Vec<&str> = table.lines().last().unwrap().split(',').collect();
    assert_eq!(row[0].parse::<f64>().unwrap(), number(&last["t_s"]));
    assert!(
        row.contains(
            &number(&last["mass_kg"]["flasks"]["beaker"])
                .to_string()
                .as_str()
        ),
        "{row:?}"
    );
}

/// What cannot be exported is refused in a word, and nothing is left.
#[test]
fn what_cannot_be_exported_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::create_dir(here.join("empty")).unwrap();
    fs::create_dir(here.join("odd")).unwrap();
    fs::write(here.join("odd/report.json"), "{}").unwrap();
    fs::create_dir(here.join("later")).unwrap();
    fs::write(here.join("later/report.json"), "{\"layout\": 2}").unwrap();
    // A report from anyone does not make the program open a file: neither its text nor whether it is there is told.
    fs::write(here.join("secret.toml"), "password = 1").unwrap();
    object(
        here,
        &[
            "replay",
            "hands-off",
            "--scene",
            "beaker",
            "--preset",
            "fast",
            "--seconds",
            "0.01",
            "--no-video",
            "--out",
            "theirs",
        ],
    );
    let report = fs::read_to_string(here.join("theirs/report.json")).unwrap();
    let report = report.replace("\"scene\": \"beaker\"", "\"scene\": \"secret.toml\"");
    fs::write(here.join("theirs/report.json"), report).unwrap();
    for (arguments, part) in [
        (&["export", "hands-off", "--format", "stl"][..], "vtk"),
        (&["export", "empty", "--format", "csv"], "report.json"),
        (&["export", "odd", "--format", "csv"], "no report"),
        (&["export", "later", "--format", "csv"], "the layout 2"),
        (
            &["export", "theirs", "--format", "vtk"],
            "name it with --scene",
        ),
        (
            &[
                "export",
                "hands-off",
                "--scene",
                "beaker",
                "--format",
                "csv",
                "--at",
                "0.1",
            ],
            "leave csv",
        ),
        (
            &[
                "export",
                "hands-off",
                "--scene",
                "beaker",
                "--format",
                "vtk",
                "--at",
                "1e3",
            ],
            "ends at",
        ),
        (
            &["export", "hands-off", "--format", "csv", "--from", "1e6"],
            "ends at",
        ),
        (
            &[
                "export",
                "hands-off",
                "--format",
                "vtk",
                "--at",
                "1",
                "--seconds",
                "2",
            ],
            "cannot be used",
        ),
    ] {
        let output = vitriol(here, &[arguments, &["--out", "out"]].concat());
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.contains(part), "{arguments:?}: {message}");
        assert!(!here.join("out").exists(), "{arguments:?}");
    }
}

/// Several tracks in one call: a folder each, one that fails stops no other, progress as JSON lines that end with the last
/// step.
#[test]
fn several_tracks_are_replayed_in_one_call() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("broken.mcap"), "no track").unwrap();
    let output = vitriol(
        here,
        &[
            "replay",
            "hands-off",
            "broken.mcap",
            "hands-off",
            "--scene",
            "beaker",
            "--preset",
            "fast",
            "--seconds",
            "0.03",
            "--no-video",
            "--out",
            "runs",
            "--json",
        ],
    );
    assert_eq!(output.status.code(), Some(2));
    let done: Value = serde_json::from_slice(&output.stdout).unwrap();
    let runs = done["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 3);
    assert_eq!(runs[0]["state_hash"], runs[2]["state_hash"]);
    assert!(runs[1]["error"].as_str().unwrap().contains("broken.mcap"));
    for name in ["hands-off", "hands-off-2"] {
        assert!(here.join("runs").join(name).join("report.json").exists());
    }
    assert!(!here.join("runs/broken").exists());
    let lines = String::from_utf8(output.stderr).unwrap();
    let lines: Vec<Value> = lines
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let progress: Vec<&Value> = lines
        .iter()
        .map(|line| &line["progress"])
        .filter(|said| !said.is_null())
        .collect();
    let last = progress.last().unwrap();
    assert_eq!(
        (&last["step"], &last["steps"]),
        (&Value::from(3), &Value::from(3))
    );
    assert_eq!(last["run"], "hands-off");
    assert!(
        lines.last().unwrap()["error"]
            .as_str()
            .unwrap()
            .contains("broken.mcap")
    );
}

/// Sends Ctrl-C's signal once there is a file: the program ends with a word, and takes away what it began.
#[cfg(unix)]
#[test]
fn an_export_that_is_stopped_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let mut child = Command::new(env!("CARGO_BIN_EXE_vitriol"))
        .args([
            "export",
            "hands-off",
            "--scene",
            "beaker",
            "--preset",
            "fast",
            "--format",
            "vtk,mcap,csv",
            "--out",
            "out",
        ])
        .current_dir(here)
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    vitriol_tests::wait::until("a file", || {
        here.join("out/particles-000001.vtu").exists().then_some(())
    });
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    let mut message = String::new();
    std::io::Read::read_to_string(child.stderr.as_mut().unwrap(), &mut message).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(1), "{message}");
    assert!(message.contains("taken away"), "{message}");
    assert!(!here.join("out").exists());
}

/// A scene that is drawn at a twentieth of its size, with another solver than its preset's: what is exported has the density of
/// the real liquid, and its recording replays with that solver.
#[test]
fn a_scaled_scene_is_exported_at_its_real_size() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let exported = object(
        here,
        &[
            "export",
            "hands-off",
            "--scene",
            "single-dilution",
            "--preset",
            "fast",
            "--solver",
            "4x3",
            "--seconds",
            "0.04",
            "--format",
            "vtk,mcap",
            "--rate",
            "1",
            "--out",
            "out",
        ],
    );
    let file = fs::read(here.join("out/particles-000000.vtu")).unwrap();
    let array = |name: &str| -> Vec<f64> {
        let end = file
            .windows(3)
            .position(|bytes| bytes == b"\n_\0" || bytes.starts_with(b"\n_"))
            .unwrap();
        let text = String::from_utf8_lossy(&file[..end]);
        let element = text.lines().find(|line| line.contains(name)).unwrap();
        let offset = element
            .split("offset=\"")
            .nth(1)
            .unwrap()
            .split('"')
            .next()
            .unwrap();
        let at = end + 2 + offset.parse::<usize>().unwrap();
        let length = u64::from_le_bytes(file[at..at + 8].try_into().unwrap()) as usize;
        let values = file[at + 8..at + 8 + length].chunks_exact(8);
        values
            .map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap()))
            .collect()
    };
    let (masses, volumes) = (array("mass [kg]"), array("volume [m3]"));
    let density = masses.iter().sum::<f64>() / volumes.iter().sum::<f64>();
    let scene = Scene::builtin("single-dilution").unwrap();
    assert!(
        (density / scene.scale.rest_density - 1.0).abs() < 1e-6,
        "{density}"
    );
    let d = scene.with_preset(Preset::Fast).scale.spacing * scene.scale.length_scale;
    assert!(
        (volumes[0] / d.powi(3) - 1.0).abs() < 1e-6,
        "{}",
        volumes[0]
    );
    let again = object(
        here,
        &[
            "replay",
            "out/recording.mcap",
            "--no-video",
            "--out",
            "again",
        ],
    );
    assert_eq!(again["state_hash"], exported["state_hash"]);
    assert_eq!(again["solver"]["substeps"], 4);
    assert_eq!(again["recording"]["same_state"], true);
}
