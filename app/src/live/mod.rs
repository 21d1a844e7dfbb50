//! The instructor's console beside a run: where it is served, and the live view that it shows.

mod coder;
mod replayed;
mod serve;
mod told;
mod watchers;

pub use coder::{Coder, Picture, VIEW_FPS, VIEW_SIDE};
pub use replayed::Live;
pub use serve::{Console, Serving, hub_address, invitation, start, student};
pub(crate) use told::{incidents, readings};
pub use watchers::{WatchReport, Watchers};
