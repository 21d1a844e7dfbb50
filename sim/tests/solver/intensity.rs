//! k_v that changes while it boils.

use crate::common::steps;
use vitriol_gpu::Gpu;
use vitriol_shaders::Library;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::{MOST_INTENSITY, World, WorldError};
use vitriol_tests::gpu;

/// A pot of soup that starts above its boiling point, of twice the spacing and few substeps.
fn world(gpu: &Gpu, intensity: f64) -> World {
    let mut scene = Scene::builtin("tomato-soup").unwrap();
    scene.scale.spacing *= 2.0;
    scene.solver.substeps = 4;
    scene.paper.as_mut().unwrap().k_v = Some(intensity);
    World::new(gpu, &Library::watching(), &scene, 1).unwrap()
}

fn hash(world: &World) -> u64 {
    world.snapshot().unwrap().solver.hash()
}

/// From where it is set on, all goes as in a scene that has it from its start.
#[test]
fn it_boils_as_a_scene_with_that_intensity() {
    let gpu = gpu::device();
    let mut set = world(&gpu, 0.75);
    steps(&mut set, 3);
    let state = set.snapshot().unwrap();
    let mut other = world(&gpu, 2.0);
    other.restore(&state).unwrap();
    let mut same = world(&gpu, 0.75);
    same.restore(&state).unwrap();

    set.set_intensity(2.0).unwrap();
    assert_eq!(set.intensity(), Some(2.0));
    assert_eq!(set.scene().paper.as_ref().unwrap().k_v, Some(2.0));
    for world in [&mut set, &mut other, &mut same] {
        steps(world, 3);
    }
    assert_eq!(hash(&set), hash(&other));
    assert_ne!(hash(&set), hash(&same));
}

/// A device that is lost takes the setting with it, and the notes bring it back: those that are kept, and those that a state has let
/// go.
#[test]
fn it_comes_back_after_a_lost_device() {
    let gpu = gpu::device();
    let mut set = world(&gpu, 0.75);
    set.follow();
    steps(&mut set, 1);
    set.set_intensity(2.0).unwrap();
    steps(&mut set, 2);
    let mut back = world(&gpu, 0.75);
    back.revive(set.lifeline().unwrap()).unwrap();
    assert_eq!(hash(&back), hash(&set));

    let state = set.snapshot().unwrap();
    set.restore(&state).unwrap();
    steps(&mut set, 1);
    let mut back = world(&gpu, 0.75);
    back.revive(set.lifeline().unwrap()).unwrap();
    assert_eq!((hash(&back), back.intensity()), (hash(&set), Some(2.0)));
}

#[test]
fn what_cannot_be_set_is_refused_and_changes_nothing() {
    let gpu = gpu::device();
    let mut soup = world(&gpu, 0.75);
    for wrong in [-0.1, MOST_INTENSITY + 0.1, f64::NAN] {
        let refused = soup.set_intensity(wrong);
        assert!(
            matches!(refused, Err(WorldError::Intensity(_))),
            "{wrong}: {refused:?}"
        );
    }
    assert_eq!(soup.intensity(), Some(0.75));
    let mut water = Scene::builtin("beaker").unwrap();
    water.scale.spacing *= 2.0;
    let mut water = World::new(&gpu, &Library::watching(), &water, 1).unwrap();
    assert_eq!(water.intensity(), None);
    let refused = water.set_intensity(1.0).unwrap_err().to_string();
    assert!(refused.contains("no k_v"), "{refused}");
}
