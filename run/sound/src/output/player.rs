//! The audio thread's mixer and messages.

use std::sync::mpsc::Receiver;

use super::clock::Clock;
use crate::event::Event;
use crate::listener::Listener;
use crate::mixer::Mixer;

/// A message to the audio thread.
#[derive(Debug)]
pub(super) enum Message {
    Frame(Listener, Vec<Event>),
    Volume(f32),
}

/// Fills buffers with the mixer's samples.
#[derive(Debug)]
pub(super) struct Player {
    mixer: Mixer,
    messages: Receiver<Message>,
    clock: Clock,
}

impl Player {
    pub(super) fn new(mixer: Mixer, messages: Receiver<Message>) -> Self {
        Self {
            mixer,
            messages,
            clock: Clock::default(),
        }
    }

    /// Takes in all waiting messages and renders the next samples.
    pub(super) fn fill(&mut self, out: &mut [[f32; 2]]) {
        while let Ok(message) = self.messages.try_recv() {
            match message {
                Message::Frame(listener, events) => self.take(listener, events),
                Message::Volume(volume) => self.mixer.set_volume(volume),
            }
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
