//! Sound from a simulation's own numbers.
//!
//! An [`Event`] describes a happening: liquid enters liquid, bubbles collapse, glass meets the bench. The [`Mixer`] lets each bubble and
//! each mode of a glass ring, and places them around the [`Listener`]'s head. The same events give the same bits on every machine. An
//! [`Ear`] gives the captions of audible sounds. An [`Output`] plays a mixer, [`Opus`] encodes its sound for a film.
//!
//! This crate does not depend on simulation or headset. Places are in the stage's metres (Y up, -Z ahead), everything else is in SI units.
//!
//! Sound pressure is in units of full scale: 1 is the loudest that an output plays. The pressure of a sound at one metre was chosen by
//! ear, not calibrated (`docs/measurements/sound.md`).

mod boil;
mod bubble;
mod drops;
mod ear;
mod emitter;
mod event;
mod head;
mod limiter;
mod listener;
mod mixer;
mod modes;
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

/// Sample rate of everything here, Hz.
pub const RATE: u32 = 48_000;
