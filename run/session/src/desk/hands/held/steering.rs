//! What pointer, wheel and keys ask of a held body.

use glam::{Vec2, Vec3};

use super::super::controls::{Controls, KEYS, REACH, SLOW};
use super::super::motion::{GAIN, Motion, SPIN_CHANGE, SPIN_GAIN};
use super::super::obstacles::level;
use super::super::pointing::{Ray, at_height, plane};
use super::{Held, Kind};

/// Speed of keys that raise, m/s, and how high a body is raised at most over what it clears, m.
const KEYS_RAISE: f32 = 0.15;
const RAISED: f32 = 0.6;
/// A notch of the wheel, m.
const NOTCH: f32 = 0.02;
/// Tilt by keys, rad/s (60° a second), and the most, rad (150°).
const TILTS: f32 = 1.047;
const MOST_TILT: f32 = 2.618;

/// How a pointer drags a body: over which height, m, and how far the body is beside the pointer's place there, m.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Drag {
    height: f32,
    offset: Option<Vec2>,
}

impl Drag {
    /// From `at` in the stage, with the pointer as it is.
    pub fn from(at: Vec3, ray: Ray) -> Self {
        let hit = at_height(ray, at.y);
        Self {
            height: at.y,
            offset: hit.map(|hit| level(at) - hit),
        }
    }

    /// Where the pointer wants the body.
    pub fn to(&self, ray: Ray) -> Option<Vec2> {
        Some(at_height(ray, self.height)? + self.offset?)
    }
}

impl Held {
    /// Takes it up again: the pointer drags it from where it is.
    pub fn engage(&mut self, ray: Ray) {
        self.putting = None;
        self.lays = false;
        let hand = self.motion.pose.position.with_y(self.drag.height);
        self.drag = Drag::from(hand, ray);
    }

    /// It stays where it is, and whatever was asked of it goes on without the user.
    pub fn leave(&mut self) {
        (self.dragged, self.follows) = (false, false);
        self.swirl.wanted = false;
        self.stop();
    }

    /// The pointer drags it.
    pub fn point(&mut self, ray: Ray, away: Vec3, user: Vec2) {
        if self.slides {
            let bar = self.motion.pose.position;
            if let Some(hit) = plane(ray, bar, away) {
                self.slid = hit.y;
            }
            return;
        }
        if self.drag.offset.is_none() {
            self.engage(ray);
        }
        if let Some(to) = self.drag.to(ray) {
            self.aim = user + (to - user).clamp_length_max(REACH);
        }
    }

    /// Takes in the keys that are held, for `h` seconds.
    pub fn control(&mut self, controls: &Controls, user: Vec2, h: f32) {
        let is_put_down = self.putting.is_some();
        self.swirl.wanted = controls.swirl && self.kind == Kind::Flask && !is_put_down;
        if is_put_down {
            return;
        }
        let slow = if controls.slow { SLOW } else { 1.0 };
        let raise = slow * KEYS_RAISE * controls.raise * h;
        if self.slides {
            let walk = slow * KEYS_RAISE * controls.walk[1] * h;
            self.slid += raise + walk;
            return;
        }
        self.lift = (self.lift + raise).min(RAISED);
        let at = self.motion.pose.position;
        let walk = controls.walk[0] * controls.right + controls.walk[1] * controls.away;
        let walk = level(walk).clamp_length_max(1.0);
        if walk != Vec2::ZERO {
            let to = level(at) + walk * (slow * KEYS / GAIN);
            self.aim = user + (to - user).clamp_length_max(REACH);
            self.walking = true;
        } else if self.walking {
            self.stop();
        }
        self.tilt_by(controls, slow);
    }

    /// Takes in what came since the last frame: notches of the wheel (one is `NOTCH`), and tilt by the secondary button, rad.
    pub fn nudge(&mut self, wheel: f32, tilt: f32) {
        if self.slides {
            self.slid += NOTCH * wheel;
            return;
        }
        self.lift = (self.lift + NOTCH * wheel).min(RAISED);
        if self.putting.is_none() {
            self.tilt = (self.tilt + tilt).clamp(-MOST_TILT, MOST_TILT);
        }
    }

    fn tilt_by(&mut self, controls: &Controls, slow: f32) {
        let now = self.tilt_now();
        if self.tilt.abs() < 0.02 && now.abs() < 0.02 {
            self.towards = -controls.away;
        }
        let tilt = if controls.tilt != 0.0 {
            self.turning = true;
            now + slow * TILTS * controls.tilt / SPIN_GAIN
        } else if self.turning {
            // It stops as soon as it can.
            self.turning = false;
            let spin = self.motion.spin.dot(self.towards);
            now + 0.5 * spin * spin.abs() / SPIN_CHANGE
        } else {
            self.tilt
        };
        self.tilt = tilt.clamp(-MOST_TILT, MOST_TILT);
    }

    /// How far it is tilted to the left, rad.
    pub(super) fn tilt_now(&self) -> f32 {
        let up = self.motion.pose.orientation * Vec3::Y;
        up.dot(self.towards.cross(Vec3::Y)).atan2(up.y)
    }

    /// It stays about where it is.
    pub(super) fn stop(&mut self) {
        self.walking = false;
        let Motion { pose, velocity, .. } = &self.motion;
        self.aim = level(pose.position) + 0.08 * level(*velocity);
    }
}
