//! Captions of audible sounds.

use crate::event::{Body, Event, Sound};
use crate::listener::Listener;
use crate::{boil, drops, pour, strike};

/// A caption. Its words are the panel's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Caption {
    /// Liquid is poured into liquid.
    Pouring,
    /// Bubbles collapse before they reach the surface.
    Simmering,
    /// Bubbles burst at the surface.
    Boiling,
    /// A single bubble or more.
    Bubbling,
    /// Drops fall on something.
    Drops,
    /// A glass is put or falls on the bench.
    GlassOnBench,
    /// Two glasses touch.
    GlassOnGlass,
    /// Something soft touches something.
    Knock,
    /// A glass breaks.
    GlassBreaks,
    /// Acid is on a glove.
    AcidOnGlove,
}

impl Caption {
    /// All captions.
    pub const ALL: [Self; 10] = [
        Self::Pouring,
        Self::Simmering,
        Self::Boiling,
        Self::Bubbling,
        Self::Drops,
        Self::GlassOnBench,
        Self::GlassOnGlass,
        Self::Knock,
        Self::GlassBreaks,
        Self::AcidOnGlove,
    ];

    fn of(sound: &Sound) -> Self {
        match sound {
            Sound::Pour(_) => Self::Pouring,
            Sound::Bubbles(all) if all.bursts > all.collapses => Self::Boiling,
            Sound::Bubbles(_) => Self::Simmering,
            Sound::Bubble(_) => Self::Bubbling,
            Sound::Strike(blow) => match blow.bodies {
                [Body::Glass(_), Body::Glass(_)] => Self::GlassOnGlass,
                [Body::Glass(_), Body::Bench] | [Body::Bench, Body::Glass(_)] => Self::GlassOnBench,
                _ => Self::Knock,
            },
            Sound::Break(_) => Self::GlassBreaks,
            Sound::Drops(_) => Self::Drops,
            Sound::Sizzle(_) => Self::AcidOnGlove,
        }
    }
}

/// Amplitude at the head from which a sound has a caption, in full scale: -60 dB.
const AUDIBLE: f64 = 1e-3;

/// Least time that a caption stays, seconds: two words are read in one second (BBC subtitle guidelines: 160 to 180 words a minute, with a
/// second at least).
const STAYS: f64 = 1.2;

/// Derives captions from events. It depends on the events alone and not on the device, so that a film without sound has the same captions.
#[derive(Clone, Debug, Default)]
pub struct Ear {
    /// By caption, the time until which it stays, s.
    until: [Option<f64>; Caption::ALL.len()],
}

impl Ear {
    /// Takes in an event, as heard from the listener's place. An event with a number that is not finite is ignored.
    pub fn hear(&mut self, event: &Event, listener: &Listener) {
        if !event.is_finite() || !listener.is_sound() {
            return;
        }
        let (at_one_metre, lasts) = match &event.sound {
            Sound::Pour(it) => (pour::level(it), it.lasts),
            Sound::Bubbles(it) => (boil::level(it), it.lasts),
            Sound::Bubble(it) => (crate::bubble::loudness(f64::from(it.radius.max(0.0))), 0.0),
            Sound::Strike(it) => (strike::level(it), 0.0),
            Sound::Break(_) => (strike::BREAK, 0.0),
            Sound::Drops(it) => (drops::level(it), 0.0),
            Sound::Sizzle(strength) => (drops::sizzle_level(*strength), 0.0),
        };
        let (_, distance) = listener.see(event.position);
        if at_one_metre / f64::from(distance) < AUDIBLE {
            return;
        }
        let caption = Caption::of(&event.sound);
        let until = event.time + f64::from(lasts.clamp(0.0, 60.0)).max(STAYS);
        let kept = Caption::ALL.iter().position(|it| *it == caption);
        if let Some(kept) = kept.and_then(|index| self.until.get_mut(index)) {
            *kept = Some(kept.map_or(until, |other| other.max(until)));
        }
    }

    /// Captions at `time`, always in one order.
    pub fn audible(&self, time: f64) -> impl Iterator<Item = Caption> {
        let all = Caption::ALL.into_iter().zip(&self.until);
        all.filter_map(move |(caption, until)| until.filter(|it| *it > time).map(|_| caption))
    }

    /// Removes all captions, as when time begins anew.
    pub fn clear(&mut self) {
        *self = Self::default();
    }
}
