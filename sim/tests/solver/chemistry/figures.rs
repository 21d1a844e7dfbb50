//! The scenes of the paper's figures, as far as the suite has time for them.

use crate::common::steps;
use vitriol_shaders::Library;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::World;
use vitriol_tests::gpu;

/// Kinetic energy of the soup (J) after 80 frames, at k_v, of particles so many times as wide.
fn soup(intensity: f64, coarser: f64) -> f64 {
    let mut scene = Scene::builtin("tomato-soup").unwrap();
    scene.paper.as_mut().unwrap().k_v = Some(intensity);
    scene.scale.spacing *= coarser;
    let device = gpu::device();
    let mut world = World::new(&device, &Library::watching(), &scene, 1).unwrap();
    steps(&mut world, 80);
    world.measure().unwrap().kinetic_energy
}

/// Fig. 7: the surface is still at k_v = 0, simmers at 0.75 and boils at 0.9.
/// After 3 s it has 5, 273 and 375 J; in four thirds of a second the filling
/// has settled enough for ten times what it has without boiling.
fn moves_the_more_the_stronger_it_boils(coarser: f64) {
    let energies = [0.0, 0.75, 0.9].map(|intensity| soup(intensity, coarser));
    assert!(
        energies[1] > 10.0 * energies[0] && energies[2] > energies[1],
        "{energies:?} J"
    );
}

/// A third of the particles.
#[test]
fn coarse_soup_moves_the_more_the_stronger_it_boils() {
    moves_the_more_the_stronger_it_boils(1.5);
}

mod long {
    use super::*;

    #[test]
    fn soup_moves_the_more_the_stronger_it_boils() {
        moves_the_more_the_stronger_it_boils(1.0);
    }

    /// Fig. 6: water into water stays as it is, acid into water boils, water into acid boils more.
    #[test]
    fn figure_6_has_its_order() {
        let device = gpu::device();
        let mut scene = Scene::builtin("triple-dilution").unwrap();
        // Half of the particles, each of twice the heat capacity: the tubes stay four of them wide.
        let coarser = 1.26_f64;
        scene.scale.spacing *= coarser;
        scene.paper.as_mut().unwrap().k_d = Some(0.017 / coarser.powi(3));
        let mut world = World::new(&device, &Library::watching(), &scene, 1).unwrap();
        let flasks = ["water-to-water", "acid-to-water", "water-to-acid"].map(|name| {
            scene
                .flasks
                .iter()
                .position(|flask| flask.name == name)
                .unwrap()
        });
        let mut boiling = [0; 3];
        let mut hottest = [f64::NEG_INFINITY; 3];
        // 2.7 s: from a second on the two that boil differ by a factor of two and more.
        for _ in 0..16 {
            steps(&mut world, 10);
            let heat = world.measure().unwrap().heat.unwrap();
            let superheat = heat.superheat.unwrap();
            for (k, &flask) in flasks.iter().enumerate() {
                boiling[k] += superheat.in_flasks.get(flask).copied().unwrap_or(0);
                let [_, most] = heat.temperatures_in_flasks[flask];
                hottest[k] = hottest[k].max(most);
            }
        }
        let [none, some, more] = boiling;
        assert_eq!(none, 0, "{boiling:?} {hottest:?}");
        assert!((hottest[0] - 20.0).abs() < 1e-3, "{hottest:?}");
        assert!(
            some > 0 && more as f64 > 1.5 * some as f64,
            "{boiling:?} {hottest:?}"
        );
    }
}
