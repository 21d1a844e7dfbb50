//! Played sound arrives at a real PulseAudio server, and failures there stop nothing.
//!
//! A test starts itself again with the server's socket in its environment, as no test may change its own.

mod broken;
mod dry;
mod played;
mod server;
