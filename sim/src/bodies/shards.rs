//! Glass that breaks: the blow from which on a flask breaks, and its shards.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3, Vec3Swizzles};
use rapier3d::math::Pose as Pose3;
use rapier3d::prelude::{
    ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, SharedShape,
};
use serde::{Deserialize, Serialize};

use super::body::Body;
use super::build::surface;
use super::solid::{self, Piece as Part};
use super::spec::Velocity;
use super::units::Units;
use crate::pose::Pose;

/// Closing speed of a blow from which on a flask breaks, m/s at real size: that of a fall from half a metre. Plates of common glass of
/// 5 mm broke under 100 g of bronze from 0.5 m, bore 0.4 m, and in a frame broke by their own fall from 0.6 m (Barff, "Glass and
/// Silicates", in Bevan's "British Manufacturing Industries", 1876). A beaker's wall is thinner and round; we found no figure for one.
pub const BREAKS_AT: f32 = 3.1;

/// Shards of a flask: its base, and its wall in three.
pub const SHARDS: u32 = 4;

/// Share of a flask's height up to which the base goes. Our choice.
pub const BASE_SHARE: f32 = 0.35;

/// Speed at which shards separate, m/s at real size, beside the flask's own. Our choice: shards of a beaker that is dropped from a table
/// lie within about half a metre.
const APART: f32 = 0.5;

/// Directions about the axis in which a shard of the wall has corners: chords 20° long are within 0.5 mm of a beaker's wall.
const CORNERS: usize = 7;

/// Position of a broken flask, m: far enough below all floors that nothing there meets anything in the room, and near enough that single
/// precision resolves a tenth of a millimetre there.
pub const NOWHERE: Vec3 = Vec3::new(0.0, -1000.0, 0.0);

/// Whether this is the pose of a broken flask ([`NOWHERE`]).
pub fn is_nowhere(stage_from_flask: &Pose) -> bool {
    stage_from_flask.position.y <= 0.5 * NOWHERE.y
}

/// A flask that broke in the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Break {
    /// Which.
    pub flask: usize,
    /// Its pose when it broke.
    pub stage_from_flask: Pose,
}

/// A piece of a flask's glass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shard {
    /// Index of its flask.
    pub flask: usize,
    /// Which of its [`SHARDS`]: 0 is the base, then come those of the wall, each a third of a turn further from +X to +Z.
    pub piece: u32,
    /// Pose of the flask's frame, as this piece carries it along.
    pub stage_from_flask: Pose,
}

/// Flasks that broke, and their shards: part of the bodies' state.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Breakage {
    /// Whether glass breaks.
    pub on: bool,
    /// Flasks that were struck too hard in the last step: they break as the next one begins.
    pub struck: Vec<usize>,
    /// By flask.
    pub broken: Vec<bool>,
    shards: Vec<(usize, u32, RigidBodyHandle)>,
}

impl Breakage {
    pub fn of(flasks: usize) -> Self {
        Self {
            on: false,
            struck: Vec::new(),
            broken: vec![false; flasks],
            shards: Vec::new(),
        }
    }

    /// Whether it is of so many flasks.
    pub fn is_of(&self, flasks: usize) -> bool {
        self.broken.len() == flasks && self.struck.iter().all(|flask| *flask < flasks)
    }

    /// The shards where they are.
    pub fn shards(&self, rapier: &PhysicsWorld, units: Units) -> Vec<Shard> {
        let shard = |&(flask, piece, body): &(usize, u32, RigidBodyHandle)| {
            let body = rapier.bodies.get(body)?;
            Some(Shard {
                flask,
                piece,
                stage_from_flask: units.pose_to_si(body.translation(), *body.rotation()),
            })
        };
        self.shards.iter().filter_map(shard).collect()
    }

    /// Replaces a flask at `pose`, which moves at `velocity`, by its shards, which go on as it went. One whose outline has none is
    /// just gone.
    pub fn shatter(
        &mut self,
        rapier: &mut PhysicsWorld,
        index: usize,
        flask: &Body,
        (pose, velocity): (Pose, Velocity),
        units: Units,
    ) {
        let Some(body) = rapier.bodies.get_mut(flask.body) else {
            return;
        };
        body.set_enabled(false);
        self.broken[index] = true;
        let apart = units.length_scale() * APART;
        for piece in 0..SHARDS {
            let parts = parts(&flask.outline, piece, units);
            let Some(middle) = middle(&parts) else {
                continue;
            };
            let centre = pose.orientation * units.to_si(middle);
            let aside = centre.reject_from_normalized(pose.orientation * Vec3::Y);
            // The base is on the axis, apart from rounding, and has no direction to separate in.
            let outward = match piece {
                0 => Vec3::ZERO,
                _ => apart * aside.normalize_or_zero(),
            };
            let linear = velocity.linear + velocity.angular.cross(centre) + outward;
            let builder = RigidBodyBuilder::dynamic()
                .ccd_enabled(true)
                .pose(units.pose(pose))
                .linvel(units.vector(linear))
                .angvel(velocity.angular);
            let body = rapier.insert_body(builder);
            let mass = flask.glass.mass() / (SHARDS as usize * parts.len()) as f32;
            for (shape, flask_from_part) in parts {
                let collider = surface(ColliderBuilder::new(shape)).mass(mass);
                rapier.insert_collider(collider.position(flask_from_part), Some(body));
            }
            self.shards.push((index, piece, body));
        }
    }
}

/// A shard's colliding shape in the flask's frame, in rapier's unit; nothing where it encloses nothing.
fn parts(outline: &[[f32; 2]], piece: u32, units: Units) -> Vec<Part> {
    let top = outline.last().map_or(0.0, |it| it[1]);
    let base = BASE_SHARE * top;
    let (from, to) = if piece == 0 { (0.0, base) } else { (base, top) };
    let within = outline.iter().filter(|it| it[1] >= from && it[1] < to);
    let mut points: Vec<Vec2> = within.map(|&it| Vec2::from(it)).collect();
    if piece != 0 {
        points.insert(0, at_height(outline, from));
    }
    points.push(at_height(outline, to));
    for point in &mut points {
        *point = point.map(|metres| units.length(metres));
    }
    if piece == 0 {
        // As the flask stood, so does its base.
        return solid::pieces(&points).unwrap_or_default();
    }
    let third = TAU / (SHARDS - 1) as f32;
    let corner = |n: usize| {
        // glam's trigonometry is libm's here, the same on every platform; std's is not.
        let share = n as f32 / (CORNERS - 1) as f32;
        Vec2::from_angle(third * ((piece - 1) as f32 + share))
    };
    let around = |point: &Vec2| {
        let Vec2 { x, y } = *point;
        std::array::from_fn::<_, CORNERS, _>(|n| (x * corner(n)).extend(y).xzy())
    };
    let corners: Vec<Vec3> = points.iter().flat_map(around).collect();
    let hull = SharedShape::convex_hull(&corners);
    hull.map(|hull| (hull, Pose3::IDENTITY))
        .into_iter()
        .collect()
}

/// Middle of a shard in the flask's frame, in rapier's unit; `None` where it has no parts.
fn middle(parts: &[Part]) -> Option<Vec3> {
    let middles = parts
        .iter()
        .map(|(shape, at)| shape.compute_aabb(at).center());
    (!parts.is_empty()).then(|| middles.sum::<Vec3>() / parts.len() as f32)
}

/// Radius and height of the outline at a height.
fn at_height(outline: &[[f32; 2]], height: f32) -> Vec2 {
    let above = outline.iter().rposition(|it| it[1] <= height).unwrap_or(0);
    let [radius, low] = outline.get(above).copied().unwrap_or_default();
    let [next, high] = outline.get(above + 1).copied().unwrap_or([radius, low]);
    let share = (height - low) / (high - low).max(f32::MIN_POSITIVE);
    Vec2::new(radius + share.clamp(0.0, 1.0) * (next - radius), height)
}
