//! The audio thread's mixer and the display frames that it takes in.

use std::sync::mpsc::Receiver;

use super::clock::Clock;
use crate::event::Event;
use crate::listener::Listener;
use crate::mixer::Mixer;

/// Fills buffers with the mixer's samples.
#[derive(Debug)]
pub(super) struct Player {
    mixer: Mixer,
    frames: Receiver<(Listener, Vec<Event>)>,
    clock: Clock,
}

impl Player {
    pub(super) fn new(mixer: Mixer, frames: Receiver<(Listener, Vec<Event>)>) -> Self {
        Self {
            mixer,
            frames,
            clock: Clock::default(),
        }
    }

    /// Takes in all waiting frames and renders the next samples.
    pub(super) fn fill(&mut self, out: &mut [[f32; 2]]) {
        while let Ok((listener, events)) = self.frames.try_recv() {
            self.take(listener, events);
        }
        self.mixer.render(out);
    }

    fn take(&mut self, listener: Listener, events: Vec<Event>) {
        self.mixer.listen(listener);
        let now = self.mixer.time();
        for mut event in events.into_iter().filter(|it| it.time.is_finite()) {
            event.time = self.clock.sounds_at(event.time, now);
            self.mixer.push(event);
        }
    }
}
