//! A swirl: a held flask goes round on a circle, upright, as a person mixes what is in it.

use std::f32::consts::TAU;

use glam::Vec3;

/// Radius of the circle, m, and turns a second: those of the track `layer-and-swirl`. Its acceleration, 4.9 m/s², is more than
/// `motion::ACCELERATION` allows a hand that carries: the lesson needs this swirl, so the circle is added to the limited motion.
const RADIUS: f32 = 0.02;
const TURNS: f32 = 2.5;
/// Time in which the circle opens and closes, s.
const EASES: f32 = 0.5;

/// The circle that is added to where a flask is held.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Swirl {
    /// It is asked for.
    pub wanted: bool,
    /// How far the circle is open, 0 to 1, before it is eased.
    open: f32,
    /// Turns so far.
    turns: f32,
}

impl Swirl {
    /// Whether it goes round, or is about to.
    pub fn is_on(&self) -> bool {
        self.wanted || self.open > 0.0
    }

    /// Goes on for `h` seconds: the circle opens where it `may`.
    pub fn step(&mut self, may: bool, h: f32) {
        let way = if self.wanted && may { h } else { -h };
        self.open = (self.open + way / EASES).clamp(0.0, 1.0);
        self.turns = match self.open > 0.0 {
            true => (self.turns + TURNS * h).fract(),
            false => 0.0,
        };
    }

    /// The radius now, m.
    pub fn radius(&self) -> f32 {
        RADIUS * self.open * self.open * (3.0 - 2.0 * self.open)
    }

    /// How much more room aside it needs, m.
    pub fn room(&self) -> f32 {
        if self.is_on() { RADIUS } else { 0.0 }
    }

    /// What is added to the place, m.
    pub fn offset(&self) -> Vec3 {
        let (sin, cos) = (TAU * self.turns).sin_cos();
        self.radius() * Vec3::new(cos, 0.0, -sin)
    }
}
