//! Recovery of a world after its device is lost.

use vitriol_gpu::{Gpu, QueueKind};
use vitriol_shaders::Library;
use vitriol_sim::bodies::Hand;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::{Kept, StepInput, World};
use vitriol_tests::gpu;

const AWAY: StepInput = StepInput::of_hands([Hand::ABSENT; 2]);

/// `beaker` with twice its spacing and half its water.
fn world(gpu: &Gpu) -> World {
    let mut scene = Scene::builtin("beaker").unwrap();
    scene.scale.spacing *= 2.0;
    scene.solver.substeps = 5;
    for liquid in &mut scene.liquids {
        liquid.volume = 110e-6;
    }
    World::new(gpu, &Library::embedded(), &scene, 1).unwrap()
}

fn steps(world: &mut World, count: u32) {
    for _ in 0..count {
        world.step(&AWAY).unwrap();
    }
}

/// The state as it is now, as a session keeps it.
fn kept(world: &World) -> Kept {
    // All steps are done.
    world.snapshot().unwrap();
    let gpu = world.gpu();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let record = world.record_state(&mut rec).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    record.kept().unwrap()
}

/// State of another world after it was revived from this one's lifeline.
fn revived(gpu: &Gpu, world: &World) -> World {
    let mut other = self::world(gpu);
    other.revive(world.lifeline().unwrap()).unwrap();
    other
}

fn hash(world: &World) -> u64 {
    world.snapshot().unwrap().solver.hash()
}

/// A state that was on its way to the host when another took its place is ignored, though nothing was done between the two.
#[test]
fn a_state_from_before_another_was_taken_up_is_left_alone() {
    let gpu = gpu::device();
    let mut world = world(&gpu);
    world.follow();
    let start = world.snapshot().unwrap();
    steps(&mut world, 3);
    let late = kept(&world);
    world.restore(&start).unwrap();
    world.keep(late);
    steps(&mut world, 1);
    assert_eq!(world.steps(), 1);
    let back = revived(&gpu, &world);
    assert_eq!((back.steps(), hash(&back)), (1, hash(&world)));

    // States recorded from then on are taken up, and drop the acts before them.
    let next = kept(&world);
    steps(&mut world, 2);
    world.keep(next);
    assert_eq!(world.lifeline().unwrap().steps(), 2);
    let back = revived(&gpu, &world);
    assert_eq!((back.steps(), hash(&back)), (3, hash(&world)));
}
