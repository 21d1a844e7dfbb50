//! Inputs of the bodies: the world, its flasks and tools, and each step's hands and loads; and the velocity of flasks.

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::pose::Pose;

/// The surroundings of the flasks.
#[derive(Clone, Debug)]
pub struct BodiesSpec {
    /// Gravity (m/s²), stage axes.
    pub gravity: Vec3,
    /// Length of one simulation step Δt_f (s).
    pub step: f32,
    /// How much larger than real laboratory glass this world is: 1 at real
    /// size. Everything that has a length (reach, contact tolerances, highest
    /// speed of a throw) grows with it.
    pub length_scale: f32,
    /// The table, if there is one.
    pub table: Option<Table>,
    /// Height of the floor (m), stage frame; a half-space that has no end.
    pub floor: f32,
    /// The flasks, in the order in which every per-flask slice of this module
    /// names them.
    pub flasks: Vec<BodySpec>,
    /// Other bodies that a hand can grip, or reach into. They collide with table and floor, but not with glass: a rod that a flask's
    /// solid pushed away could not be dipped.
    pub tools: Vec<ToolSpec>,
    /// Goggles and gloves worn at the start.
    pub worn: Worn,
}

/// Goggles and gloves that the user wears; `None` where the scene has none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Worn {
    /// Whether the goggles are worn.
    pub goggles: Option<bool>,
    /// Whether a glove is on the left and on the right hand.
    pub gloves: Option<[bool; 2]>,
}

/// Kind of a body other than a flask.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// Held and let go.
    Tool,
    /// Worn before the eyes.
    Goggles,
    /// A box of gloves, which stays where it is.
    Gloves,
    /// A bar that a hand slides up and down, with a pane over it. It stays where it is let go of, and it is solid to all but hands.
    Sash {
        /// Least and greatest height of its origin (m).
        heights: [f32; 2],
        /// Height of the pane over the bar's axis, and its thickness (m).
        pane: [f32; 2],
    },
}

/// A body beside the flasks.
#[derive(Clone, Debug)]
pub struct ToolSpec {
    /// Its shape, and where it starts.
    pub body: BodySpec,
    /// Its kind.
    pub role: Role,
}

/// A rectangular table top, level in the stage frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Table {
    /// Height of the upper surface (m).
    pub top: f32,
    /// Centre (x, z) of the upper surface (m).
    pub centre: Vec2,
    /// Full extent along x and z (m).
    pub size: Vec2,
}

/// One flask.
#[derive(Clone, Debug)]
pub struct BodySpec {
    /// Outer surface as a polyline of [radius, height] (m) from the centre of
    /// the base, [0, 0], to the outer edge of the rim, in the flask's frame: the axis is y
    /// and the origin is the centre of the outer base. Heights never decrease.
    pub outline: Vec<[f32; 2]>,
    /// Mass of the empty glass (kg).
    pub glass_mass: f32,
    /// Where the flask starts.
    pub stage_from_flask: Pose,
    /// Clamped to a stand: neither falls nor can be gripped.
    pub fixed: bool,
}

/// A hand at one simulation step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hand {
    /// The grip pose.
    pub stage_from_grip: Pose,
    /// How far the hand is closed, 0 to 1: the greater of squeeze and trigger.
    pub squeeze: f32,
    /// Whether the hand is tracked. Of a hand that is absent neither the pose
    /// nor the squeeze is read: a body that it holds stays where it was. A pose
    /// that is not [valid](Pose::is_valid) counts as absent, too.
    pub present: bool,
}

impl Hand {
    /// A hand that is not tracked.
    pub const ABSENT: Self = Self {
        stage_from_grip: Pose::IDENTITY,
        squeeze: 0.0,
        present: false,
    };
}

/// Impulse of the liquid on one flask during one simulation step, two steps ago, and the liquid's mass and centre.
///
/// The delay is the caller's: the load passed to the call of
/// [`Bodies::step`](super::Bodies::step) that makes pose n is the one that the
/// liquid exerted while the flask went from pose n − 3 to pose n − 2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// Impulse on the flask over that step (N s), stage axes: the liquid's
    /// weight as far as the flask bears it, and its push.
    pub impulse: Vec3,
    /// Angular impulse over that step (N m s) about the flask's origin, stage axes.
    pub angular_impulse: Vec3,
    /// Mass of the liquid in the flask (kg) at that step.
    pub liquid_mass: f32,
    /// Centre of mass of that liquid (m), flask frame. Not read where the mass is zero.
    pub liquid_centre: Vec3,
}

/// How a flask moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Velocity {
    /// Velocity of the flask's origin, the centre of its base (m/s), stage axes.
    pub linear: Vec3,
    /// Angular velocity (rad/s), stage axes.
    pub angular: Vec3,
}

/// Why a world of bodies could not be made or restored.
#[derive(Debug, Error, PartialEq)]
pub enum BodiesError {
    /// A quantity of [`BodiesSpec`] is out of its range.
    #[error("{what} is {value}: it must be {must}")]
    World {
        /// The quantity.
        what: &'static str,
        /// Its value.
        value: f32,
        /// The valid range, in words.
        must: &'static str,
    },
    /// A quantity of a flask is out of its range.
    #[error("flask {flask}: {what} must be {must}")]
    Flask {
        /// Index of the flask.
        flask: usize,
        /// The quantity.
        what: &'static str,
        /// The valid range, in words.
        must: &'static str,
    },
    /// The bytes are no snapshot of this program version.
    #[error(
        "the bodies' snapshot cannot be read ({0}): take it from the same version of the program, unaltered"
    )]
    Snapshot(String),
    /// The snapshot was taken of another world.
    #[error(
        "the bodies' snapshot holds {found} flasks where the world has {expected}: restore it into the scene it was taken from"
    )]
    OtherWorld {
        /// Flasks in the snapshot.
        found: usize,
        /// Flasks in this world.
        expected: usize,
    },
}
