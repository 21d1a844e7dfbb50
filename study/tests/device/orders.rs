//! What the order of pouring decides at real size; the factors are in docs/measurements/bubbles.md.

use vitriol_experiment::track;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_study::trade::boil;
use vitriol_tests::gpu;

mod long {
    use super::*;

    /// Water poured into acid boils far more than acid into water does, and goes on boiling at the surface. Ten seeds on an H200 differ by
    /// a factor of twelve at the end of the track. By then five times as much has been thrown out too; at 7 s it is still on its way. Acid
    /// in water makes all of its steam while it falls in, by 5.6 s: 25 mg with the order that particles have now. Water on acid makes 73 mg
    /// by 6 s, at which too much of the ratio was chance, and twice that by 7.
    #[test]
    fn water_into_acid_boils_and_acid_into_water_hardly_does() {
        let device = gpu::device();
        let track = track::load("two-flasks").unwrap();
        let [wrong, right] = ["water-into-acid", "acid-into-water"].map(|name| {
            let scene = Scene::builtin(name).unwrap().with_preset(Preset::Fast);
            // The pour begins at 4.2 s.
            boil(&device, &scene, &track, 7.0, 1).unwrap().0
        });
        eprintln!("{wrong:?} {right:?}");
        assert!(wrong.steam > 5.0 * right.steam, "{wrong:?} {right:?}");
        // What bursts throws milligrams: no liquid leaves in bulk.
        for boiled in [wrong, right] {
            assert!(
                boiled.thrown > 0.0 && boiled.thrown < 0.1,
                "{wrong:?} {right:?}"
            );
        }
        // Above the mixing line's 9 K, for liquid is not mixed below a particle's size, and below the 24 K that
        // lamellae of these feeds come to (`sim/src/chemistry/tests/segregation.rs`).
        for boiled in [wrong, right] {
            assert!((11.0..25.0).contains(&boiled.superheat), "{boiled:?}");
            assert!(boiled.closure < 1e-4, "{boiled:?}");
        }
    }
}
