//! The table of incidents, read by another reader than its writer: Python's own module.

use std::io::Write;
use std::process::{Command, Stdio};

use serde_json::Value;
use vitriol_lesson::{Cause, incidents_csv};

use crate::said::attempts;

/// The rows by column, as Python's `csv` reads them; `None` where there is no Python.
fn read(csv: &[u8]) -> Option<Vec<Value>> {
    let program = "import csv, io, json, sys\n\
        text = io.TextIOWrapper(sys.stdin.buffer, encoding='utf-8-sig', newline='')\n\
        print(json.dumps(list(csv.DictReader(text, strict=True))))";
    let python = Command::new("python3")
        .args(["-c", program])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn();
    let Ok(mut python) = python else {
        assert_ne!(
            std::env::var("CI").as_deref(),
            Ok("true"),
            "no python3 is installed: this test needs it"
        );
        eprintln!("NOT TESTED: no python3 is installed");
        return None;
    };
    python.stdin.take().unwrap().write_all(csv).unwrap();
    let output = python.wait_with_output().unwrap();
    assert!(output.status.success());
    Some(serde_json::from_slice(&output.stdout).unwrap())
}

#[test]
fn a_spreadsheet_reads_what_happened() {
    let mut attempts = attempts();
    // A scene's author may call a flask what he likes.
    let named = "=HYPERLINK(\"http://example.org\",\"1,2\")\n";
    attempts[1].incidents[0].cause = Cause::Splashing {
        flask: named.into(),
    };
    attempts[1].scene = "@SUM(1+1)*cmd|' /C calc'!A0".into();
    let csv = incidents_csv(&attempts).unwrap();
    // By the mark Excel knows its encoding; Python's reader takes it off.
    assert!(csv.starts_with(b"\xef\xbb\xbfattempt,scene,"));
    let Some(rows) = read(&csv) else { return };

    let incidents = attempts.iter().flat_map(|it| &it.incidents);
    assert_eq!(rows.len(), incidents.clone().count());
    for (row, incident) in rows.iter().zip(incidents) {
        // The names of report.json.
        let json = serde_json::to_value(incident).unwrap();
        assert_eq!(row["kind"], json["what"]["kind"]);
        assert_eq!(row["cause"], json["cause"]["cause"]);
        let number = |column: &str| row[column].as_str().unwrap().parse::<f64>().ok();
        assert_eq!(number("time [s]"), json["t_s"].as_f64());
        let volume = json["what"]["volume_m3"].as_f64();
        assert_eq!(number("volume [mL]").is_some(), volume.is_some());
        if let (Some(ml), Some(m3)) = (number("volume [mL]"), volume) {
            assert!((ml * 1e-6 - m3).abs() < 1e-12, "{row}");
        }
        assert_eq!(
            number("temperature [degC]"),
            json["what"]["temperature_c"].as_f64()
        );
        assert_eq!(number("z [m]"), json["place_m"][2].as_f64());
        let place = json["what"].get("skin").or(json["what"].get("surface"));
        assert_eq!(row["where"], *place.unwrap_or(&"".into()));
    }
    let first = &rows[0];
    assert_eq!(
        (&first["attempt"], &first["scene"]),
        (&"1".into(), &"water-into-acid".into())
    );
    assert_eq!(
        (&first["acid [%]"], &first["flask"]),
        (&"96.4".into(), &"target".into())
    );
    let last = rows.last().unwrap();
    assert_eq!(last["attempt"], "2");
    assert_eq!(last["flask of the cause"], format!("'{named}"));
    assert!(last["scene"].as_str().unwrap().starts_with("'@SUM"));
    for row in &rows {
        for (column, cell) in row.as_object().unwrap() {
            let cell = cell.as_str().unwrap();
            let runs = cell.starts_with(['=', '+', '-', '@']);
            assert!(!runs || cell.parse::<f64>().is_ok(), "{column}: {cell}");
        }
    }
}

#[test]
fn without_incidents_there_is_a_header_alone() {
    let csv = String::from_utf8(incidents_csv(&[]).unwrap()).unwrap();
    assert_eq!(csv.lines().count(), 1);
    assert!(csv.starts_with("\u{feff}attempt,"), "{csv}");
    assert!(csv.ends_with("\r\n"));
}
