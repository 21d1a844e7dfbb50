//! A small experiment, and what its pictures show.

use std::sync::Arc;

use glam::Vec3;
use vitriol_gpu::Gpu;
use vitriol_run::{Colour, Experiment, Setup, on_device};
use vitriol_shaders::Library;
use vitriol_sim::scene::{PictureRoom, Preset, Scene};
use vitriol_xr::{Pose, PoseFrame};

/// Width and height of the pictures.
pub const SIZE: (u32, u32) = (320, 180);

/// A beaker on a bench with few particles: base at (0, 0.75, −0.40).
pub fn scene() -> Scene {
    let mut scene = Scene::builtin("beaker").unwrap();
    scene.scale.spacing *= 2.0;
    scene.solver.substeps = 4;
    // Colours are looked for that furniture has, too.
    scene.picture.room = PictureRoom::Bare;
    scene
}

pub fn experiment(gpu: &Gpu, head: Option<Pose>, shaders: Library) -> Box<dyn Experiment> {
    coloured(gpu, head, shaders, Colour::Speed)
}

pub fn coloured(
    gpu: &Gpu,
    head: Option<Pose>,
    shaders: Library,
    colour: Colour,
) -> Box<dyn Experiment> {
    made(gpu, (&scene(), None), head, shaders, colour)
}

fn made(
    gpu: &Gpu,
    (scene, room): (&Scene, Option<PictureRoom>),
    head: Option<Pose>,
    shaders: Library,
    colour: Colour,
) -> Box<dyn Experiment> {
    let setup = Setup {
        scene,
        scene_name: "beaker",
        scenes: &vitriol_run::Scenes::default(),
        preset: Preset::Balanced,
        seed: 1,
        device: None,
        picture: Some(SIZE.into()),
        colours: vec![colour],
        eyes: 1,
        filter: None,
        tint: None,
        room,
        head,
        directed: false,
        look: None,
        language: Default::default(),
        shaders: Arc::new(shaders),
    };
    on_device(gpu, &setup).unwrap()
}

/// Liquid in that scene, in the room that is asked for.
pub fn in_room(gpu: &Gpu, scene: &Scene, room: Option<PictureRoom>) -> Box<dyn Experiment> {
    made(
        gpu,
        (scene, room),
        None,
        Library::embedded(),
        Colour::Liquid,
    )
}

/// A user without hands, whose head is there.
pub fn frame(step: u64, stage_from_view: Pose) -> PoseFrame {
    PoseFrame {
        step,
        time_ns: step as i64 * 11_111_111,
        stage_from_view,
        ..PoseFrame::default()
    }
}

/// Where the liquid is in the picture, pixels from its middle (right, down):
/// the centroid of what is coloured, since room, bench and glass are grey.
pub fn liquid(picture: &[u8]) -> (f64, f64) {
    let (width, height) = SIZE;
    let (mut sum, mut count) = ((0.0, 0.0), 0.0);
    for (index, pixel) in (0u32..).zip(picture.chunks_exact(4)) {
        let channels = [pixel[0], pixel[1], pixel[2]];
        let spread = channels.iter().max().unwrap() - channels.iter().min().unwrap();
        if spread > 60 {
            sum.0 += f64::from(index % width) + 0.5 - 0.5 * f64::from(width);
            sum.1 += f64::from(index / width) + 0.5 - 0.5 * f64::from(height);
            count += 1.0;
        }
    }
    assert!(count > 100.0, "no liquid in the picture");
    (sum.0 / count, sum.1 / count)
}

/// An eye before the liquid's middle.
pub const BEFORE: Vec3 = Vec3::new(0.0, 0.79, 0.2);
