//! From events to samples for two ears.

use glam::Vec3;

use crate::RATE;
use crate::emitter::Emitter;
use crate::event::Event;
use crate::head::BLOCK;
use crate::limiter::Limiter;
use crate::listener::Listener;
use crate::pool::Pool;

/// Most places at once. An event of a further one is heard from the nearest.
const PLACES: usize = 16;

/// Most events that wait for their time. More are dropped.
const WAITING: usize = 8192;

/// Farthest ahead that an event may lie, seconds.
const AHEAD: f64 = 3600.0;

/// Turns events into sound.
///
/// Its only clock is the number of samples that were rendered: a film pushes the events of a frame and renders the frame's time, a device
/// renders the samples that it needs. The same events, listeners and seed give the same bits, however many samples each call asks for, if
/// each event is there 64 samples before its time. An event with a number that is not finite is ignored.
#[derive(Debug)]
pub struct Mixer {
    seed: u64,
    /// Number of samples that were made. Those not yet returned are the end of `block`.
    made: u64,
    block: [[f32; 2]; BLOCK],
    given: usize,
    listener: Listener,
    /// Events with their sample, those of one sample in the order in which they came.
    waiting: Vec<(u64, Event)>,
    places: [Option<Emitter>; PLACES],
    pool: Pool,
    limiter: Limiter,
}

impl Mixer {
    /// A silent mixer, with a seed for its random numbers.
    pub fn new(seed: u64) -> Self {
        Self {
            seed,
            made: 0,
            block: [[0.0; 2]; BLOCK],
            given: BLOCK,
            listener: Listener::default(),
            waiting: Vec::new(),
            places: std::array::from_fn(|_| None),
            pool: Pool::default(),
            limiter: Limiter::default(),
        }
    }

    /// Seconds that were rendered: the time of the next sample.
    pub fn time(&self) -> f64 {
        (self.made - (BLOCK - self.given) as u64) as f64 / f64::from(RATE)
    }

    /// Lets an event sound at its time, or now if that is past.
    pub fn push(&mut self, event: Event) {
        let sample = event.time * f64::from(RATE);
        let far = self.time() + AHEAD;
        if !event.is_finite() || event.time > far || self.waiting.len() >= WAITING {
            return;
        }
        let sample = sample.max(0.0).round() as u64;
        let at = self.waiting.partition_point(|(other, _)| *other <= sample);
        self.waiting.insert(at, (sample, event));
    }

    /// Moves the head. It goes there in some 20 ms, so that nothing clicks. A pose with a number that is not finite is
    /// ignored.
    pub fn listen(&mut self, listener: Listener) {
        if listener.is_sound() {
            self.listener = listener;
        }
    }

    /// Voices that sound or are about to.
    pub fn voices(&self) -> usize {
        self.pool.len()
    }

    /// Writes the next samples, left and right, each from -0.9 to 0.9.
    pub fn render(&mut self, out: &mut [[f32; 2]]) {
        let mut rest = out;
        while !rest.is_empty() {
            if self.given == BLOCK {
                self.make();
                self.given = 0;
            }
            let count = rest.len().min(BLOCK - self.given);
            let (now, later) = rest.split_at_mut(count);
            now.copy_from_slice(&self.block[self.given..self.given + count]);
            self.given += count;
            rest = later;
        }
    }

    /// Makes the next block.
    fn make(&mut self) {
        let now = self.made;
        self.made += BLOCK as u64;
        let due = self.waiting.partition_point(|(at, _)| *at < self.made);
        for (at, event) in self.waiting.drain(..due).collect::<Vec<_>>() {
            let wait = at.saturating_sub(now) as f64 / f64::from(RATE);
            let slot = self.slot(&event, now);
            let pool = &mut self.pool;
            if let Some(place) = &mut self.places[slot] {
                place.take(&event, now, wait, |voice| pool.add(slot, voice));
            }
        }
        let mut block = [[0.0; 2]; BLOCK];
        for (slot, place) in self.places.iter_mut().enumerate() {
            let (pool, listener) = (&mut self.pool, &self.listener);
            place.take_if(|place| !place.render(slot, now, pool, listener, &mut block));
        }
        self.block = block.map(|sample| self.limiter.limit(sample));
    }

    /// Index of an event's emitter, which is made if it is new.
    fn slot(&mut self, event: &Event, now: u64) -> usize {
        let of = |place: &Option<Emitter>| place.as_ref().is_some_and(|it| it.id == event.emitter);
        if let Some(slot) = self.places.iter().position(of) {
            return slot;
        }
        if let Some(slot) = self.places.iter().position(Option::is_none) {
            self.places[slot] = Some(Emitter::new(event, self.seed, now, &self.listener));
            return slot;
        }
        let far = |place: &Option<Emitter>| {
            let position = place.as_ref().map_or(Vec3::ZERO, |it| it.position);
            let [x, y, z] = (position - event.position).to_array();
            x * x + y * y + z * z
        };
        let all = self.places.iter().map(far).enumerate();
        all.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |it| it.0)
    }
}
