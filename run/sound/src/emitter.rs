//! One place that sounds come from: its lasting sounds, one bus for all of its voices, and its way to the head.

use glam::Vec3;

use crate::event::{Bubbles, Event, Pour, Sound};
use crate::head::{BLOCK, Head};
use crate::listener::Listener;
use crate::pool::Pool;
use crate::random::Random;
use crate::voice::{SAMPLE, Voice};
use crate::{RATE, boil, drops, pour, strike};

/// Seconds of a block.
const SECONDS: f64 = BLOCK as f64 * SAMPLE;

/// Blocks after the last voice in which sound still travels to the ears: 10 ms.
const ECHO: u32 = 8;

/// A sound that lasts until a sample.
#[derive(Debug)]
struct Lasting<T> {
    what: T,
    until: u64,
}

impl<T> Lasting<T> {
    fn new(what: T, now: u64, seconds: f32) -> Self {
        let seconds = f64::from(seconds).clamp(0.0, 60.0);
        let until = now + (seconds * f64::from(RATE)) as u64;
        Self { what, until }
    }
}

/// A place that sounds come from.
#[derive(Debug)]
pub(crate) struct Emitter {
    pub(crate) id: u32,
    pub(crate) position: Vec3,
    head: Head,
    random: Random,
    pour: Option<Lasting<Pour>>,
    bubbles: Option<Lasting<Bubbles>>,
    silent: u32,
}

impl Emitter {
    /// An emitter at the place of its first event.
    pub(crate) fn new(event: &Event, seed: u64, now: u64, listener: &Listener) -> Self {
        let (along, distance) = listener.see(event.position);
        Self {
            id: event.emitter,
            position: event.position,
            head: Head::new(along, distance),
            random: Random::new(seed, (u64::from(event.emitter) << 40) ^ now),
            pour: None,
            bubbles: None,
            silent: 0,
        }
    }

    /// Takes in an event `wait` seconds after sample `now`; `add` takes its voices.
    pub(crate) fn take(&mut self, event: &Event, now: u64, wait: f64, mut add: impl FnMut(Voice)) {
        self.position = event.position;
        self.silent = 0;
        let random = &mut self.random;
        let mut add = |mut voice: Voice| {
            voice.wait += (wait / SAMPLE) as u32;
            add(voice);
        };
        match &event.sound {
            Sound::Pour(it) => self.pour = Some(Lasting::new(*it, now, it.lasts)),
            Sound::Bubbles(it) => self.bubbles = Some(Lasting::new(*it, now, it.lasts)),
            Sound::Bubble(it) => add(Voice::after(0.0, it.ring(1.0))),
            Sound::Strike(it) => strike::strike(it, random, add),
            Sound::Break(it) => strike::shatter(it, random, add),
            Sound::Drops(it) => drops::drops(it, random, add),
            Sound::Sizzle(strength) => drops::sizzle(*strength, random, add),
        }
    }

    /// Adds a block to `out`, which begins at sample `now`. Returns whether there is more to come.
    pub(crate) fn render(
        &mut self,
        slot: usize,
        now: u64,
        pool: &mut Pool,
        listener: &Listener,
        out: &mut [[f32; 2]; BLOCK],
    ) -> bool {
        self.pour.take_if(|it| it.until <= now);
        self.bubbles.take_if(|it| it.until <= now);
        if let Some(Lasting { what, .. }) = &self.pour {
            let add = |voice| pool.add(slot, voice);
            pour::pour(what, SECONDS, &mut self.random, add);
        }
        if let Some(Lasting { what, .. }) = &self.bubbles {
            let add = |voice| pool.add(slot, voice);
            boil::boil(what, SECONDS, &mut self.random, add);
        }
        let mut bus = [0.0; BLOCK];
        let sounds = pool.render(slot, &mut bus);
        self.head.add(&bus, listener.see(self.position), out);
        self.silent = if sounds { 0 } else { self.silent + 1 };
        self.silent < ECHO || self.pour.is_some() || self.bubbles.is_some()
    }
}
