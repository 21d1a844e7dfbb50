//! What the order of pouring decides at real size; the factors are in docs/measurements/chemistry.md.

use vitriol_experiment::track;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_study::trade::boil;
use vitriol_tests::gpu;

/// Water poured into acid throws liquid out of the beaker and makes more steam than the same
/// volumes the other way round. Ten times is asked for; ten seeds of each have 38 times at least.
#[test]
fn water_into_acid_throws_and_acid_into_water_does_not() {
    let device = gpu::device();
    let track = track::load("two-flasks").unwrap();
    let [wrong, right] = ["water-into-acid", "acid-into-water"].map(|name| {
        let scene = Scene::builtin(name).unwrap().with_preset(Preset::Fast);
        // The pour begins at 4.2 s, and a second and a half later (5.7 s) most has been thrown.
        boil(&device, &scene, &track, 6.0, 1).unwrap().0
    });
    assert!(
        wrong.thrown > 1.0 && wrong.thrown > 10.0 * right.thrown,
        "{wrong:?} {right:?}"
    );
    assert!(wrong.steam > right.steam, "{wrong:?} {right:?}");
    // Above the mixing line's 9 K, for liquid is not mixed below a particle's size, and below the 24 K that
    // lamellae of these feeds come to (`sim/src/chemistry/tests/segregation.rs`).
    for boiled in [wrong, right] {
        assert!((11.0..25.0).contains(&boiled.superheat), "{boiled:?}");
        assert!(boiled.closure < 1e-4, "{boiled:?}");
    }
}
