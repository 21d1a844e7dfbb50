#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
//! Truth here is mechanics in closed form: free fall, parabola, tipping angle,
//! rolling without slip, and exact equality where a hand or a snapshot is concerned.

mod coupled;
mod free;
mod held;
mod sash;
mod setup;
mod shards;
mod strikes;
mod worn;

use glam::{Quat, Vec2, Vec3};

use super::{Bodies, BodiesSpec, BodySpec, Hand, Load, RELEASE_SPEED_MAX, RELEASE_SPIN_MAX, Table};
use crate::pose::Pose;

const STEP: f32 = 1.0 / 90.0;
const G: f32 = 9.81;
const RADIUS: f32 = 0.035;
const HEIGHT: f32 = 0.095;
const GLASS: f32 = 0.1;
const TABLE_TOP: f32 = 0.75;
const NO_HANDS: [Hand; 2] = [Hand::ABSENT; 2];

/// A 250 mL beaker of low form: 70 mm wide, 95 mm high (ISO 3819).
fn beaker(stage_from_flask: Pose) -> BodySpec {
    BodySpec {
        outline: vec![[0.0, 0.0], [RADIUS, 0.0], [RADIUS, HEIGHT]],
        glass_mass: GLASS,
        stage_from_flask,
        fixed: false,
    }
}

/// A 250 mL Erlenmeyer flask: 85 mm base, 34 mm neck, 145 mm high (ISO 1773).
fn erlenmeyer(stage_from_flask: Pose) -> BodySpec {
    BodySpec {
        outline: vec![
            [0.0, 0.0],
            [0.0400, 0.0],
            [0.0425, 0.004],
            [0.0420, 0.010],
            [0.0170, 0.105],
            [0.0170, 0.140],
            [0.0200, 0.145],
        ],
        glass_mass: GLASS,
        stage_from_flask,
        fixed: false,
    }
}

/// Flasks on a large table.
fn on_table(flasks: Vec<BodySpec>) -> BodiesSpec {
    BodiesSpec {
        gravity: Vec3::new(0.0, -G, 0.0),
        step: STEP,
        length_scale: 1.0,
        table: Some(Table {
            top: TABLE_TOP,
            centre: Vec2::ZERO,
            size: Vec2::new(4.0, 4.0),
        }),
        floor: 0.0,
        flasks,
        tools: Vec::new(),
        worn: super::Worn::default(),
    }
}

fn world(flasks: Vec<BodySpec>) -> Bodies {
    Bodies::new(&on_table(flasks)).unwrap()
}

/// A world twenty times as large, in which a beaker begins so high (m, at real size) over the floor: masses go with the third power of
/// length, speeds with the first.
fn twenty_times(height: f32) -> Bodies {
    let mut flask = beaker(Pose::from_position(Vec3::Y * (20.0 * height)));
    (flask.outline.iter_mut().flatten()).for_each(|it| *it *= 20.0);
    flask.glass_mass *= 8000.0;
    Bodies::new(&BodiesSpec {
        gravity: Vec3::new(0.0, -20.0 * G, 0.0),
        length_scale: 20.0,
        table: None,
        ..on_table(vec![flask])
    })
    .unwrap()
}

fn above_table(height: f32) -> Pose {
    Pose::from_position(Vec3::new(0.1, TABLE_TOP + height, -0.2))
}

fn run(bodies: &mut Bodies, seconds: f32, load: Load) {
    for _ in 0..(seconds / STEP).round() as usize {
        bodies.step(&NO_HANDS, &[load; 2]);
    }
}

/// The flask's axis, stage frame.
fn axis(pose: Pose) -> Vec3 {
    pose.transform_vector(Vec3::Y)
}

/// A closed right hand at a pose, the left absent.
fn gripping(stage_from_grip: Pose) -> [Hand; 2] {
    [Hand::ABSENT, hand(stage_from_grip, 1.0)]
}

fn hand(stage_from_grip: Pose, squeeze: f32) -> Hand {
    Hand {
        stage_from_grip,
        squeeze,
        present: true,
    }
}

/// `pose` turned by `angle` about a level edge-on axis (z) through its origin.
fn tilted(pose: Pose, angle: f32) -> Pose {
    Pose::new(pose.position, Quat::from_rotation_z(angle))
}
