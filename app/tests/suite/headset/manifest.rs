//! The file that names the runtime, beside OpenXR's own loader.

use std::fs;
use std::process::Command;

use vitriol_tests::mock::{self, Change};

use crate::cli::runtime::each_fault_has_its_own_message;

/// The loader says nothing of a file that leads nowhere. One that leads to a runtime by a path of its own folder is taken, in the
/// user's folder of settings.
#[test]
fn a_manifest_is_checked_before_the_loader_reads_it() {
    let name = "headset::manifest::a_manifest_is_checked_before_the_loader_reads_it";
    let Some(mock) = mock::enter(name, &[]) else {
        return;
    };
    each_fault_has_its_own_message();

    let manifest = std::env::var_os("XR_RUNTIME_JSON").unwrap();
    let manifest = fs::read_to_string(manifest).unwrap();
    let mut manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    let library = manifest["runtime"]["library_path"].take();
    let settings = mock.folder().join("settings");
    let folder = settings.join("openxr/1");
    fs::create_dir_all(&folder).unwrap();
    fs::copy(library.as_str().unwrap(), folder.join("mock.so")).unwrap();
    manifest["runtime"]["library_path"] = "./mock.so".into();
    let file = folder.join("active_runtime.json");
    fs::write(file, manifest.to_string()).unwrap();
    let doctor = Command::new(env!("CARGO_BIN_EXE_vitriol"))
        .arg("doctor")
        .env_remove("XR_RUNTIME_JSON")
        .env("XDG_CONFIG_HOME", settings)
        .output()
        .unwrap();
    let said = String::from_utf8(doctor.stdout).unwrap();
    assert!(said.contains("[ok] OpenXR runtime: "), "{said}");
}

/// XR_ERROR_RUNTIME_UNAVAILABLE
const UNAVAILABLE: i32 = -51;

/// Of a runtime that is off the loader prints lines of its own, before this program's message. They are left out, unless the user has said
/// what the loader prints.
#[test]
fn a_runtime_that_is_off_is_told_by_one_message() {
    let name = "headset::manifest::a_runtime_that_is_off_is_told_by_one_message";
    let Some(mock) = mock::enter(name, &[]) else {
        return;
    };
    let program = |arguments: &[&str], debug: Option<&str>| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_vitriol"));
        command.args(arguments).env_remove("XR_LOADER_DEBUG");
        command.envs(debug.map(|it| ("XR_LOADER_DEBUG", it)));
        let output = command.output().unwrap();
        let [out, errors] =
            [output.stdout, output.stderr].map(|it| String::from_utf8_lossy(&it).into_owned());
        (out, errors)
    };
    let prints = |errors: &str| errors.lines().any(|line| line.starts_with("Error ["));
    let (said, _) = program(&["doctor"], None);
    assert!(said.contains("[ok] OpenXR runtime: "), "{said}");

    mock.say(Change::Refuse {
        call: "xrCreateInstance".to_owned(),
        answer: UNAVAILABLE,
        times: None,
        when: None,
    });
    let (said, errors) = program(&["doctor"], None);
    assert!(said.contains("does not answer"), "{said}");
    assert!(!prints(&errors), "{errors}");
    let vr = ["vr", "--no-console", "--no-mirror"];
    let (_, errors) = program(&vr, None);
    assert!(errors.contains("does not answer"), "{errors}");
    assert!(!prints(&errors), "{errors}");
    let (_, errors) = program(&["doctor"], Some("error"));
    assert!(prints(&errors), "{errors}");
}
