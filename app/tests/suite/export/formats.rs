//! All formats of one run, read by the programs that they are written for.

use std::path::Path;

use serde_json::Value;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_tests::readers::Readers;

use crate::VITRIOL;
use crate::export::number;

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

fn texts(value: &Value) -> Vec<&str> {
    let texts = value.as_array().unwrap().iter();
    texts.map(|text| text.as_str().unwrap()).collect()
}

/// PyVista, meshio, Arrow, Rerun and Khronos's validator read all formats of one run, and what they find is what there is: the
/// scene's volumes, the glass of its flasks, as many moments as were asked for, each format's numbers the others'.
#[test]
fn other_programs_read_what_is_there() {
    let Some(readers) = Readers::find("exports") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let replayed = VITRIOL.object(
        here,
        "replay two-flasks --scene acid-into-water --preset fast --seconds 0.1 --no-video --out run",
    );
    VITRIOL.object(here, "pages --out pages");
    let exported = VITRIOL.object(
        here,
        "export run --format vtk,ply,gltf,csv,parquet,mcap --rate 20 --out out",
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

    let scene = Scene::builtin("acid-into-water")
        .unwrap()
        .with_preset(Preset::Fast);
    let particles = &found["particles"];
    assert_eq!(particles["count"], replayed["fluid_particles"]);
    assert_eq!(particles["cells"], particles["count"]);
    assert_eq!(particles["vertices"], true);
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
            "acid_kg_per_kg",
            "flask",
            "id",
            "mass_kg",
            "temperature_degC",
            "velocity_m_per_s",
            "volume_m3",
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
    let nanoseconds =
        |times: &[f64]| -> Vec<f64> { times.iter().map(|time| (time * 1e9).round()).collect() };
    assert_eq!(numbers(&recording["cloud_times_ns"]), nanoseconds(&times));
    assert_eq!(recording["same_points"], true);
    assert_eq!(recording["colours"], particles["count"]);
    // Between two of our 17 entries the map is straight, and a byte is 1/255.
    let aside = number(&recording["aside_of_plasma"]);
    assert!(aside < 0.02, "{aside}");
    assert_eq!(
        numbers(&recording["measurement_times_ns"]),
        nanoseconds(&numbers(&tables["times"]))
    );
    assert_eq!(recording["measurements_are_the_table"], true);
    // Before the first step, and after each of nine.
    let states: Vec<f64> = (0..=9).map(|step| f64::from(step) / 90.0).collect();
    let flasks = numbers(&recording["flask_times_ns"]);
    assert_eq!(flasks, nanoseconds(&states));
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

    let conversions = &found["conversions"];
    assert_eq!(texts(&conversions["scalars"]).len(), 6);
    for format in ["vtu", "vtk", "ply"] {
        let kept = &conversions["kept"][format];
        assert_eq!(*kept, conversions["scalars"], "{format}");
    }

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
    let again = VITRIOL.object(here, "replay out/recording.mcap --no-video --out again");
    assert_eq!(again["state_hash"], replayed["state_hash"]);
    assert_eq!(again["recording"]["same_state"], true);
}
