//! Sound from a simulation's own numbers.
//!
//! An [`Event`] says what happened: liquid enters liquid, bubbles collapse, glass meets the bench. The [`Mixer`] lets each
//! bubble and each mode of a glass ring, and places them around the [`Listener`]'s head. The same events give the same
//! bits on every machine. An [`Ear`] says which captions describe what is audible.
//! An [`Output`] plays it, [`Opus`] encodes it for a film.
//!
//! Nothing here knows a simulation or a headset. Places are in the stage's metres (Y up, -Z ahead), all else is SI.
//!
//! Sound pressure is in units of full scale: 1 is the loudest that an output plays. What a sound has at one metre was
//! chosen by ear's measure, not calibrated (`docs/measurements/sound.md`).

mod boil;
mod bubble;
mod drops;
mod ear;
mod emitter;
mod event;
mod glass;
mod head;
mod limiter;
mod listener;
mod mixer;
mod opus;
#[cfg(feature = "output")]
mod output;
mod pool;
mod pour;
mod random;
mod strike;
mod voice;

pub use bubble::Bubble;
pub use ear::{Caption, Ear};
pub use event::{Body, Bubbles, Drops, Event, Glass, Onto, Pour, Sound, Strike};
pub use listener::Listener;
pub use mixer::Mixer;
pub use opus::{OPUS_DELAY, OPUS_PACKET, Opus, OpusError};
#[cfg(feature = "output")]
pub use output::{Device, DeviceName, Output, OutputError, State, devices};

/// Samples a second of everything here, Hz.
pub const RATE: u32 = 48_000;
