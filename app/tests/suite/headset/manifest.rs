//! The file that names the runtime, beside OpenXR's own loader.

use std::fs;
use std::process::Command;

use vitriol_tests::mock;

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
