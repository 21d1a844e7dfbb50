//! Times: a state has the same in all formats, so that what one lacks can be looked up in another.

use std::collections::BTreeMap;
use std::fs;

use serde_json::Value;

use crate::VITRIOL;
use crate::export::number;

/// A time that was written, which has nine decimals at most: a sum of steps such as 0.033333333333333 s has none of another format's.
fn nanoseconds(seconds: f64) -> u64 {
    let whole = (seconds * 1e9).round();
    assert_eq!(seconds, whole / 1e9);
    whole as u64
}

/// The number between two texts of a file, the first of which comes but once.
fn between(file: &[u8], before: &str, after: &str) -> f64 {
    let text = String::from_utf8_lossy(file);
    let rest = text.split_once(before).unwrap().1;
    rest.split_once(after).unwrap().0.parse().unwrap()
}

#[test]
fn a_state_has_one_time_in_all_formats() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    VITRIOL.object(
        here,
        "replay hands-off --scene beaker --preset fast --seconds 0.04 --no-video --out run",
    );
    let exported = VITRIOL.object(
        here,
        "export run --format vtk,ply,gltf,csv,mcap --rate 30 --out out",
    );
    let read = |name: &str| fs::read(here.join(name)).unwrap();
    let json = |bytes: &[u8]| -> Value { serde_json::from_slice(bytes).unwrap() };

    let recording = read("out/recording.mcap");
    let mut times: BTreeMap<String, Vec<u64>> = BTreeMap::new();
    for message in mcap::MessageStream::new(&recording).unwrap() {
        let message = message.unwrap();
        let of_topic = times.entry(message.channel.topic.clone()).or_default();
        of_topic.push(message.log_time);
    }

    let series = json(&read("out/particles.vtu.series"));
    let mut moments = Vec::new();
    for (moment, entry) in series["files"].as_array().unwrap().iter().enumerate() {
        let time = nanoseconds(number(&entry["time"]));
        moments.push(time);
        let name = |what: &str, ending: &str| format!("out/{what}-{moment:06}.{ending}");
        let grid = read(&name("particles", "vtu"));
        let surface = read(&name("air-liquid", "ply"));
        let cameras = json(&read(&name("cameras", "json")));
        let scene = read(&name("scene", "glb"));
        // The length of the JSON, and where it begins.
        let length = u32::from_le_bytes(scene[12..16].try_into().unwrap()) as usize;
        let scene = json(&scene[20..20 + length]);
        let found = [
            between(&grid, "NumberOfTuples=\"1\" format=\"ascii\">", "<"),
            between(&surface, "comment air-liquid, m, at ", " s\n"),
            number(&cameras["time_s"]),
            number(&scene["scenes"][0]["extras"]["time_s"]),
        ];
        assert_eq!(found.map(nanoseconds), [time; 4], "moment {moment}");
    }
    assert_eq!(exported["moments"], moments.len());
    // That before the first step, and at least one after some.
    assert!(moments[0] == 0 && moments.len() > 1, "{moments:?}");
    assert_eq!(times["/particles"], moments);

    let table = String::from_utf8(read("out/measurements.csv")).unwrap();
    let rows = table.lines().skip(1);
    let rows: Vec<u64> = rows
        .map(|row| nanoseconds(row.split(',').next().unwrap().parse().unwrap()))
        .collect();
    let report = json(&read("run/report.json"));
    let series = report["series"].as_array().unwrap().iter();
    let samples: Vec<u64> = series.map(|s| nanoseconds(number(&s["t_s"]))).collect();
    assert_eq!(rows, samples);
    assert_eq!(times["/measurements"], samples);

    // Glass and pictures are those of states too. The first picture is of the first step's end.
    let flasks = &times["/flasks"];
    assert_eq!((flasks[0], times["/film"][0]), (0, flasks[1]));
    let of_states = moments.iter().chain(&samples).chain(&times["/film"]);
    for time in of_states {
        assert!(flasks.contains(time), "{time} ns of {flasks:?}");
    }
}
