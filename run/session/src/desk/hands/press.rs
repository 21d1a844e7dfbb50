//! A click on the panel: a pull of a hand's trigger that the panel takes for one.
//!
//! The panel presses nothing for a hand that begins to point with its trigger pulled, so the hand points for some frames before it
//! pulls. A trigger closes the hand, too: it is pulled where the hand can take nothing, or by a hand that holds something already. Until it
//! is over, the hand points at where it was clicked, wherever the pointer goes.

use vitriol_xr::Side;

use super::pointing::Ray;

/// Frames for which the hand points before, pulls at least, and points after.
const BEFORE: u32 = 2;
const PULLS: u32 = 3;
const AFTER: u32 = 2;
/// How long it waits for the hand to be clear of all glass, s.
const WAITS: f32 = 3.0;
/// Distance from all that a hand can take, m, that is clear: more than a hand reaches.
pub(super) const CLEAR: f32 = 0.08;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    Points,
    Pulls,
    Ends,
}

/// One click.
#[derive(Clone, Copy, Debug)]
pub(super) struct Press {
    /// The pointer's ray as it was clicked.
    pub ray: Ray,
    /// The hand that pulls, and whether it holds something.
    pub side: Side,
    pub holds: bool,
    stage: Stage,
    frames: u32,
    waited: f32,
}

impl Press {
    /// A click by that hand, which holds something or nothing.
    pub fn new(ray: Ray, side: Side, holds: bool) -> Self {
        Self {
            ray,
            side,
            holds,
            stage: Stage::Points,
            frames: 0,
            waited: 0.0,
        }
    }

    /// It in the next frame, after `dt` seconds, with the button `down`; `None` where it is over.
    pub fn after(mut self, clear: bool, down: bool, dt: f32) -> Option<Self> {
        self.frames += 1;
        self.waited += dt;
        let stage = match self.stage {
            Stage::Points if clear && self.frames > BEFORE => Stage::Pulls,
            Stage::Points if self.waited > WAITS => return None,
            Stage::Pulls if !down && self.frames > PULLS => Stage::Ends,
            Stage::Ends if self.frames > AFTER => return None,
            stage => stage,
        };
        if stage != self.stage {
            (self.stage, self.frames) = (stage, 0);
        }
        Some(self)
    }

    /// How far the trigger of that hand is pulled, 0 to 1.
    pub fn trigger(&self, side: Side) -> f32 {
        let pulls = self.stage == Stage::Pulls && side == self.side;
        f32::from(u8::from(pulls))
    }
}
