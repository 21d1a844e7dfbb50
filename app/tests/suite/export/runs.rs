//! Runs and tracks: where their numbers come from, at what size, and what is left of one that is stopped.

use std::fs;
use std::process::Command;

use serde_json::Value;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_tests::editors::encodings;
use vitriol_tests::program::words;

use crate::VITRIOL;
use crate::export::number;

/// Tables of a run's folder come from its report, without a device, and say what it says; a track's are simulated.
#[test]
fn tables_of_a_run_are_its_report() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    VITRIOL.object(
        here,
        "replay hands-off --scene beaker --preset fast --seconds 0.02 --no-video --out run",
    );
    let done = VITRIOL.object(here, "export run --format csv --out tables");
    assert!(done["state_hash"].is_null(), "nothing was simulated");
    VITRIOL.object(
        here,
        "export hands-off --scene beaker --preset fast --seconds 0.02 --format csv --out simulated",
    );
    let read = |file: &str| fs::read_to_string(here.join(file)).unwrap();
    assert_eq!(
        read("tables/measurements.csv"),
        read("simulated/measurements.csv")
    );
    // As `>` in PowerShell and Windows' editors write it.
    let plain = read("run/report.json");
    for (number, bytes) in encodings(&plain).into_iter().enumerate() {
        fs::write(here.join("run/report.json"), bytes).unwrap();
        VITRIOL.object(
            here,
            &format!("export run --format csv --out again-{number}"),
        );
        assert_eq!(
            read(&format!("again-{number}/measurements.csv")),
            read("tables/measurements.csv")
        );
    }
    let report: Value = serde_json::from_str(&plain).unwrap();
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

/// A scene that is drawn at a twentieth of its size, with another solver than its preset's: what is exported has the density of
/// the real liquid, and its recording replays with that solver.
#[test]
fn a_scaled_scene_is_exported_at_its_real_size() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let exported = VITRIOL.object(
        here,
        "export hands-off --scene single-dilution --preset fast --solver 4x3 --seconds 0.04 --format vtk,mcap --rate 1 --out out",
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
    let (masses, volumes) = (array("\"mass_kg\""), array("\"volume_m3\""));
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
    let again = VITRIOL.object(here, "replay out/recording.mcap --no-video --out again");
    assert_eq!(again["state_hash"], exported["state_hash"]);
    assert_eq!(again["solver"]["substeps"], 4);
    assert_eq!(again["recording"]["same_state"], true);
}

/// Sends Ctrl-C's signal once there is a file: the program ends with a word, and takes away what it began.
#[cfg(unix)]
#[test]
fn an_export_that_is_stopped_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let mut child = Command::new(env!("CARGO_BIN_EXE_vitriol"))
        .args(words(
            "export hands-off --scene beaker --preset fast --format vtk,mcap,csv --out out",
        ))
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
