//! The bench as a headset needs it that has no hands of its own: it puts them by a pointer, and draws lines that help to aim.

use glam::Vec3;

use crate::Pose;

/// Bodies at the bench, for a headset that puts hands by a pointer. Lengths in real metres, poses in the headset's stage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Around {
    /// Height of the table's top, m.
    pub table: f32,
    /// The flasks in the scene's order, and the tools behind them.
    pub things: Vec<Thing>,
    /// By hand ([`Side`](crate::Side) is the index), the index in [`Around::things`] of what it holds.
    pub holds: [Option<usize>; 2],
    /// The panel: pose of its middle (+Z is its face's normal), width and height, m.
    pub panel: (Pose, [f32; 2]),
}

/// A flask or a tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// stage_from_thing; the origin is the middle of the foot, and +Y is the axis of the flask or of the tool's cylinder.
    pub pose: Pose,
    /// Largest outer radius, m.
    pub radius: f32,
    /// Outer radius at the rim, m.
    pub rim: f32,
    /// Height from the foot to the rim, m.
    pub height: f32,
    /// Whether it is a flask, that can be poured from; a tool is none.
    pub flask: bool,
    /// Whether a hand can close on it: it is not fixed, not broken and not worn. A box of gloves stays where it is, and a hand that closes
    /// in it has a glove on.
    pub grips: bool,
    /// How it may be moved.
    pub moves: Moves,
}

/// How a thing may be moved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Moves {
    /// As the hand that holds it.
    #[default]
    Freely,
    /// Up and down only, as a sash.
    UpAndDown,
}

/// A line to be drawn with the picture, e.g. where a pour would fall. In the headset's stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// One end, m.
    pub from: Vec3,
    /// The other end, m.
    pub to: Vec3,
    /// Half its thickness, m.
    pub radius: f32,
}
