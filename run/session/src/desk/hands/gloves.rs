//! A hand pulls the other one's glove off: it closes on nothing beside the other palm, and goes away from there while it is closed
//! (`bodies::wear`).

use glam::Vec3;
use vitriol_xr::{Around, Kind, Pose, Side, Thing};

use super::Hands;
use super::hand::State;
use super::pointing::{beside, nearest, orientation, outwards};
use super::press::CLEAR;

/// How far beside the other palm the ray may pass to pick the glove, m.
const PICKED: f32 = 0.05;
/// From the other palm to where the hand closes, m: beside it, and within the 0.12 m at which a glove is taken hold of.
const BESIDE: f32 = 0.05;
/// How far it goes, m: with `BESIDE` more than the 0.22 m at which the glove is off.
pub(super) const OFF: f32 = 0.28;
/// How long it stays closed before it goes, s: some steps of the simulation, in which it takes hold.
pub(super) const CLOSES: f32 = 0.2;

/// How far a glove is pulled off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pull {
    /// The hand goes to the other one, if that is `clear` of all that a hand could take there; else both go to rest.
    Goes { clear: bool },
    /// It has closed, so many seconds ago.
    Closes(f32),
    /// It goes away, closed.
    Leaves,
}

impl Pull {
    /// Whether the hand is closed.
    pub fn is_closed(self) -> bool {
        !matches!(self, Self::Goes { .. })
    }
}

impl Hands {
    /// Whether the active hand can pull the other one's glove off.
    pub(super) fn can_pull(&self, around: &Around) -> bool {
        let other = other(self.active) as usize;
        let free = self.movers.iter().all(|it| it.is_free());
        free && around.gloves[other] && around.holds[other].is_none()
    }

    /// Whether that thing is the box of gloves, and the active hand wears one: it would close there for nothing.
    pub(super) fn has_what_is_in(&self, around: &Around, thing: usize) -> bool {
        let is_box = |thing: &Thing| thing.kind == Kind::Gloves;
        around.gloves[self.active as usize] && around.things.get(thing).is_some_and(is_box)
    }

    /// Whether the pointer is on a glove that can be pulled off.
    pub(super) fn is_on_glove(&self, around: &Around) -> bool {
        let palm = self.movers[other(self.active) as usize].pose().position;
        self.can_pull(around) && beside(self.controls.ray, palm) < PICKED
    }

    /// The pose of the hand whose glove would be pulled off.
    pub(super) fn gloved(&self) -> Pose {
        self.movers[other(self.active) as usize].pose()
    }

    /// Where a hand that pulls a glove off goes.
    pub(super) fn pull(&mut self, around: &Around) {
        let (side, other) = (self.active, other(self.active));
        let State::Pulling(Pull::Goes { .. }) = self.movers[side as usize].state else {
            return;
        };
        if !(around.gloves[other as usize] && self.movers[other as usize].is_free()) {
            self.movers[side as usize].state = State::Free;
            return;
        }
        let out = outwards(side, self.controls.right);
        let at = self.gloved().position + BESIDE * out;
        let clear = nearest(around, at, None) > CLEAR;
        if clear {
            self.movers[side as usize].target = Pose::new(at, orientation(side, Vec3::Y, out));
        } else {
            for side in Side::BOTH {
                self.movers[side as usize].target.position = self.rests(side, around);
            }
        }
        self.movers[side as usize].state = State::Pulling(Pull::Goes { clear });
    }
}

/// The other hand.
pub(super) fn other(side: Side) -> Side {
    match side {
        Side::Left => Side::Right,
        Side::Right => Side::Left,
    }
}
