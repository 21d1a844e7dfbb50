//! Recovery of a world after its device is lost.

use crate::common::{coarse_beaker, steps};
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_shaders::Library;
use vitriol_sim::world::{Kept, World};
use vitriol_tests::gpu;

fn world(gpu: &Gpu) -> World {
    World::new(gpu, &Library::embedded(), &coarse_beaker(110e-6), 1).unwrap()
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
