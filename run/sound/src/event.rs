//! Events that make a sound, in the stage's metres and SI units.

use glam::Vec3;

use crate::bubble::Bubble;

/// An event that makes a sound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Its time, seconds of the clock by which a film or a display shows things.
    pub time: f64,
    /// Number of its source: a vessel, a hand, a place on the bench. Events of one number are heard from one place, and each moves that
    /// place.
    pub emitter: u32,
    /// Its place, metres of the stage.
    pub position: Vec3,
    /// Its sound.
    pub sound: Sound,
}

/// The kinds of sounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sound {
    /// A stream enters a liquid.
    Pour(Pour),
    /// A liquid boils.
    Bubbles(Bubbles),
    /// One bubble is made.
    Bubble(Bubble),
    /// Two bodies meet.
    Strike(Strike),
    /// A glass breaks.
    Break(Glass),
    /// Drops hit something solid.
    Drops(Drops),
    /// Acid is on a glove: a cue that is no sound of nature. Its strength is from 0 to 1.
    Sizzle(f32),
}

/// A stream that enters a liquid, from its event on until the next one of its emitter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pour {
    /// Volume that enters, m³/s.
    pub flow: f32,
    /// Speed at the surface, m/s.
    pub speed: f32,
    /// Density of the liquid that receives it, kg/m³.
    pub density: f32,
    /// Seconds after which it ends without another event. Two display frames bridge one that is late.
    pub lasts: f32,
}

/// Bubbles of a boil, from its event on until the next one of its emitter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bubbles {
    /// Bubbles that leave the wall, 1/s.
    pub departures: f32,
    /// Bubbles that collapse in the liquid, 1/s.
    pub collapses: f32,
    /// Bubbles that burst at the surface, 1/s.
    pub bursts: f32,
    /// Their mean radius, metres.
    pub radius: f32,
    /// How far the liquid is below its boiling point, kelvin.
    pub subcooling: f32,
    /// Their mean depth below the surface, metres.
    pub depth: f32,
    /// Density of the liquid, kg/m³.
    pub density: f32,
    /// Seconds after which it ends without another event.
    pub lasts: f32,
}

/// A blow between two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strike {
    /// Momentum that one body gave to the other, N·s.
    pub impulse: f32,
    /// Both bodies.
    pub bodies: [Body; 2],
}

/// A body that can be struck.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// A vessel.
    Glass(Glass),
    /// The table, of wood.
    Bench,
    /// A body that does not ring: a glove, rubber.
    Dull,
}

/// A vessel of glass, taken for a cylinder with a bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glass {
    /// Radius of its widest circle, metres.
    pub radius: f32,
    /// Thickness of its wall, metres.
    pub wall: f32,
    /// Height, metres.
    pub height: f32,
    /// Height of the liquid in it over its own, from 0 to 1.
    pub filled: f32,
    /// Density of that liquid, kg/m³.
    pub density: f32,
    /// Whether a hand holds it, which damps most of its ring.
    pub held: bool,
}

/// Drops that hit something solid at about the same time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drops {
    /// Number of drops.
    pub count: u32,
    /// Diameter of one drop, metres.
    pub diameter: f32,
    /// Speed, m/s.
    pub speed: f32,
    /// The surface that they hit.
    pub onto: Onto,
}

/// A surface that drops hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Onto {
    /// Something hard and dry.
    Bench,
    /// A puddle, in which some drops leave a bubble.
    Wet,
}

impl Event {
    /// Whether all of its numbers are finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.time.is_finite() && self.position.is_finite() && self.sound.is_finite()
    }
}

impl Sound {
    fn is_finite(&self) -> bool {
        let all = |numbers: &[f32]| numbers.iter().all(|number| number.is_finite());
        match self {
            Self::Pour(it) => all(&[it.flow, it.speed, it.density, it.lasts]),
            Self::Bubbles(it) => all(&[
                it.departures,
                it.collapses,
                it.bursts,
                it.radius,
                it.subcooling,
                it.depth,
                it.density,
                it.lasts,
            ]),
            Self::Bubble(it) => all(&[it.radius, it.depth, it.density]),
            Self::Strike(it) => it.impulse.is_finite() && it.bodies.iter().all(Body::is_finite),
            Self::Break(it) => it.is_finite(),
            Self::Drops(it) => all(&[it.diameter, it.speed]),
            Self::Sizzle(strength) => strength.is_finite(),
        }
    }
}

impl Body {
    fn is_finite(&self) -> bool {
        match self {
            Self::Glass(glass) => glass.is_finite(),
            Self::Bench | Self::Dull => true,
        }
    }
}

impl Glass {
    fn is_finite(&self) -> bool {
        let numbers = [
            self.radius,
            self.wall,
            self.height,
            self.filled,
            self.density,
        ];
        numbers.iter().all(|number| number.is_finite())
    }
}
