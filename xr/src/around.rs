//! The bench as a headset needs it that has no hands of its own: it puts them by a pointer, and draws lines that help to aim.

use glam::Vec3;

use crate::{Pose, Side};

/// Bodies at the bench, for a headset that puts hands by a pointer. Lengths in real metres, poses in the headset's stage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Around {
    /// Counts the benches: it changes with each scene that is brought up, and then indices are of other things.
    pub scene: u64,
    /// Simulated seconds a second of display time: 1, less where the instructor slows time, 0 where time is held.
    pub pace: f32,
    /// Most simulated time that a frame takes, s; 0 before the first frame.
    pub longest: f32,
    /// Height of the table's top, m.
    pub table: f32,
    /// The flasks in the scene's order, and the tools behind them.
    pub things: Vec<Thing>,
    /// By hand ([`Side`] is the index), the index in [`Around::things`] of what it holds.
    pub holds: [Option<usize>; 2],
    /// By hand, whether it wears a glove.
    pub gloves: [bool; 2],
    /// The panel: pose of its middle (+Z is its face's normal), width and height, m.
    pub panel: (Pose, [f32; 2]),
}

impl Around {
    /// Simulated time in the next frame, s, after `passed` seconds of display time. On a machine that is too slow it is less than that: it
    /// shows slow motion.
    pub fn simulated(&self, passed: f32) -> f32 {
        (self.pace * passed).min(self.longest)
    }
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
    /// What it is.
    pub kind: Kind,
    /// Whether a hand can close on it: it is not fixed, not broken and not worn. A box of gloves stays where it is, and a hand that closes
    /// in it has a glove on.
    pub grips: bool,
}

impl Thing {
    /// Whether it is a flask, that can be poured from; a tool is none.
    pub fn is_flask(&self) -> bool {
        self.kind == Kind::Flask
    }
}

/// What a thing is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It holds liquid, and can be poured from.
    Flask,
    /// A stirring rod or a thermometer: dipped by its foot.
    Rod,
    /// It takes up the liquid that it lies on.
    Cloth,
    /// Worn by letting go of them before the eyes.
    Goggles,
    /// A box of gloves: a hand that closes in it has one on.
    Gloves,
    /// The sash of a fume hood: it goes up and down only.
    Sash,
}

/// What a pointer is at, where a press does something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pointed {
    /// The thing of that index in [`Around::things`], which a hand would take.
    Thing(usize),
    /// The glove on that hand, which the other one would pull off.
    Glove(Side),
    /// The panel.
    Panel,
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames of a slow machine take the most that there is, at whatever pace, and none while time is held.
    #[test]
    fn a_frame_simulates_what_passed_at_its_pace() {
        let around = |pace: f32| Around {
            pace,
            longest: 0.05,
            ..Around::default()
        };
        for (pace, passed, expected) in [
            (1.0, 0.02, 0.02),
            (0.25, 0.02, 0.005),
            (1.0, 0.5, 0.05),
            (0.25, 0.5, 0.05),
            (0.0, 0.5, 0.0),
        ] {
            // Rounding of single precision.
            let off = around(pace).simulated(passed) - expected;
            assert!(off.abs() < 1e-7, "{pace} {passed}");
        }
    }
}
