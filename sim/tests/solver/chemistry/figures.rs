//! What the paper's figures show, as far as the suite has time for it.

use vitriol_shaders::Library;
use vitriol_sim::bodies::Hand;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::{StepInput, World};
use vitriol_tests::gpu;

/// Kinetic energy of the soup (J) after `frames`, at k_v.
fn soup(intensity: f64, frames: usize) -> f64 {
    let mut scene = Scene::load("tomato-soup").unwrap();
    scene.paper.as_mut().unwrap().k_v = Some(intensity);
    let device = gpu::device();
    let mut world = World::new(&device, &Library::watching(), &scene, 1).unwrap();
    let idle = StepInput {
        hands: [Hand::ABSENT; 2],
    };
    for _ in 0..frames {
        world.step(&idle).unwrap();
    }
    world.measure().unwrap().kinetic_energy
}

/// Fig. 7: the surface is still at k_v = 0, simmers at 0.75 and boils at 0.9.
/// After 3 s it has 5, 273 and 375 J; in four thirds of a second the filling
/// has settled enough for ten times what it has without boiling.
#[test]
fn soup_moves_the_more_the_stronger_it_boils() {
    let energies = [0.0, 0.75, 0.9].map(|intensity| soup(intensity, 80));
    assert!(
        energies[1] > 10.0 * energies[0] && energies[2] > energies[1],
        "{energies:?} J"
    );
}
