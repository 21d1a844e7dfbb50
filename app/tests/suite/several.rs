//! Several tracks replayed in one call.

use std::fs;

use crate::VITRIOL;
use serde_json::Value;

/// Several tracks in one call: a folder each, one that fails stops no other, progress as JSON lines that end with the last
/// step.
#[test]
fn several_tracks_are_replayed_in_one_call() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("broken.mcap"), "no track").unwrap();
    let output = VITRIOL.run(here, "replay hands-off broken.mcap hands-off --scene beaker --preset fast --seconds 0.03 --no-video --out runs --json");
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
