//! A pour, seen through OpenXR.

use vitriol_tests::monado;

use crate::drive::{self, Driver};
use crate::program::{self, Program};

#[test]
fn a_driven_pour_is_seen_recorded_and_replayed() {
    let Some(rig) = monado::enter("pour::a_driven_pour_is_seen_recorded_and_replayed") else {
        return;
    };
    let scene = program::scene(rig.folder());
    let recording = rig.folder().join("pour.mcap");
    let driver = Driver::start(&rig, drive::track(), 0.5);
    let program = Program::start(&[
        "--scene",
        scene.to_str().unwrap(),
        "--record",
        recording.to_str().unwrap(),
        "--frames",
        "200",
    ]);
    program.says("Focused");
    driver.go();
    let report = program.end();
    eprintln!("{report:#}");
    std::fs::copy(&recording, "/tmp/rig/pour.mcap").unwrap();
    std::fs::copy(&scene, "/tmp/rig/small.toml").unwrap();
}
