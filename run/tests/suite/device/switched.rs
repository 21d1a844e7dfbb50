//! A scene that follows another in a replay: what is shown of a run is of its own scene.

use glam::Quat;
use vitriol_gpu::Gpu;
use vitriol_run::{Experiment, Scenes, Setup, on_device};
use vitriol_sim::scene::{Preset, Scene};
use vitriol_tests::gpu;
use vitriol_xr::{Pose, Switch};

use crate::device::common::{BEFORE, frame};

/// Steps after which the water of the overturned beaker lies on the bench.
const FELL: u64 = 45;

/// A beaker with 40 mL of water that hangs upside down over the bench, as a scene's text.
fn overturned() -> String {
    let mut scene = Scene::builtin_text("beaker").unwrap().to_owned();
    for (from, to) in [
        ("spacing = 0.0025", "spacing = 0.005"),
        ("particles = 13894", "volume_ml = 40.0"),
        (
            "position = [0.0, 0.75, -0.40]\nfixed = false",
            "position = [0.0, 0.95, -0.40]\nrotation = [0.0, 0.0, 180.0]\nfixed = true",
        ),
    ] {
        assert!(scene.contains(from), "{from}");
        scene = scene.replacen(from, to, 1);
    }
    scene
}

fn experiment(gpu: &Gpu, scenes: &Scenes) -> Box<dyn Experiment> {
    let scene = scenes.get("over.toml").unwrap();
    let setup = Setup::without_pictures(&scene, ("over.toml", scenes), Preset::Balanced, 1);
    on_device(gpu, &setup).unwrap()
}

/// The scene that follows has another length scale and lies there clean: 8,000 times what was spilt before it is not on its bench, nor
/// does a flask of it hold what one held before.
#[test]
fn what_was_spilt_is_of_the_scene_before() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("over.toml");
    std::fs::write(&file, overturned()).unwrap();
    let mut scenes = Scenes::default();
    scenes.open(file.to_str().unwrap()).unwrap();
    let gpu = gpu::device();
    let mut experiment = experiment(&gpu, &scenes);
    for n in 0..FELL {
        let frame = frame(n, Pose::new(BEFORE, Quat::IDENTITY));
        experiment.step(&frame).unwrap();
    }
    let before = experiment.glimpse().unwrap();
    assert!(before.spilt[0] > 5e-6, "{:?}", before.spilt);
    let mut switched = frame(FELL, Pose::new(BEFORE, Quat::IDENTITY));
    switched.scenario.push(Switch {
        key: "scene".into(),
        value: "single-dilution".into(),
    });
    experiment.step(&switched).unwrap();
    let after = experiment.glimpse().unwrap();
    assert_eq!(after.scene.1, Some("single-dilution"));
    assert_eq!((after.spilt, after.flasks), ([0.0; 2], &[][..]));
}
