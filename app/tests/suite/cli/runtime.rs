//! What is said of an OpenXR runtime's file that leads to no runtime. No loader is needed: it is found before one is asked.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use super::text;

/// Such files: a name, the content, and the part of the message that no other has.
const FAULTS: [(&str, Option<&str>, &str); 9] = [
    (
        "missing",
        None,
        "is not there: install the runtime that it belongs to",
    ),
    ("empty", Some(""), "is empty"),
    (
        "cut",
        Some(r#"{"file_format_version": "1.0.0", "runt"#),
        "breaks off",
    ),
    ("words", Some("a runtime"), "is no JSON"),
    ("bare", Some("{}"), "names no library"),
    (
        "old",
        Some(r#"{"file_format_version": "0.9.0", "runtime": {"library_path": "libc.so.6"}}"#),
        "lacks the file_format_version 1.0.0",
    ),
    (
        "gone",
        Some(r#"{"file_format_version": "1.0.0", "runtime": {"library_path": "./gone.so"}}"#),
        "gone.so, which is not there",
    ),
    (
        "text",
        Some(r#"{"file_format_version": "1.0.0", "runtime": {"library_path": "./text.json"}}"#),
        "text.json, which cannot be loaded",
    ),
    (
        "other",
        Some(r#"{"file_format_version": "1.0.0", "runtime": {"library_path": "libc.so.6"}}"#),
        "libc.so.6, which is no OpenXR runtime",
    ),
];

/// The program with the runtime of that file.
fn with(manifest: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vitriol"));
    let command = command.args(arguments).env("XR_RUNTIME_JSON", manifest);
    command.output().unwrap()
}

/// `vitriol doctor` and `vitriol vr` say of each of [`FAULTS`] which it is, and neither the loader nor the console says anything before.
pub fn each_fault_has_its_own_message() {
    let folder = tempfile::tempdir().unwrap();
    for (name, content, _) in FAULTS {
        let manifest = folder.path().join(name).with_extension("json");
        if let Some(content) = content {
            fs::write(&manifest, content).unwrap();
        }
        let tells = |message: &str| {
            assert!(message.contains(manifest.to_str().unwrap()), "{message}");
            assert!(message.contains("in XR_RUNTIME_JSON"), "{message}");
            for (other, _, of_other) in FAULTS {
                let said = message.contains(of_other);
                assert_eq!(said, other == name, "{other} of {name}: {message}");
            }
        };

        let doctor = with(&manifest, &["doctor", "--json"]);
        let errors = text(&doctor.stderr);
        assert!(doctor.status.success(), "{errors}");
        assert!(!errors.contains("OpenXR"), "{errors}");
        let of_loader = |line: &str| line.starts_with("Error [");
        assert!(!errors.lines().any(of_loader), "{errors}");
        let found: serde_json::Value = serde_json::from_slice(&doctor.stdout).unwrap();
        assert_eq!(found["openxr"]["runtime"], serde_json::Value::Null);
        assert_eq!(found["can_enter_vr"], false);
        let missing = found["missing"].as_array().unwrap().iter();
        let mut missing = missing.filter_map(|it| it.as_str());
        tells(missing.find(|it| it.contains("runtime's file")).unwrap());

        for arguments in [&["vr"][..], &["vr", "--json"]] {
            let vr = with(&manifest, arguments);
            let message = text(&vr.stderr);
            assert_eq!(vr.status.code(), Some(3), "{message}");
            assert_eq!(message.lines().count(), 1, "{message}");
            tells(message);
        }
    }
}

#[test]
fn a_runtimes_file_is_told_what_is_wrong_with_it() {
    each_fault_has_its_own_message();
}

/// The recording is looked for before the runtime is.
#[test]
fn a_recording_that_is_there_is_told_before_a_runtime_that_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let there = folder.path().join("there.mcap");
    fs::write(&there, "").unwrap();
    let missing = folder.path().join("missing.json");
    let vr = with(&missing, &["vr", "--record", there.to_str().unwrap()]);
    let message = text(&vr.stderr);
    assert_eq!(vr.status.code(), Some(2), "{message}");
    assert!(message.contains("there.mcap: exists"), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
}

/// Where nothing names a runtime, that is said; an empty variable names none.
#[test]
fn no_runtime_is_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let system = ["/etc/xdg", "/usr/local/etc", "/etc"];
    if system
        .iter()
        .any(|it| Path::new(it).join("openxr").exists())
    {
        eprintln!("NOT TESTED: this machine has a runtime");
        return;
    }
    let vr = Command::new(env!("CARGO_BIN_EXE_vitriol"))
        .arg("vr")
        .env("XR_RUNTIME_JSON", "")
        .env("XDG_CONFIG_HOME", folder.path())
        .output()
        .unwrap();
    let message = text(&vr.stderr);
    assert_eq!(vr.status.code(), Some(3), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(message.contains("No OpenXR runtime is chosen"), "{message}");
}
