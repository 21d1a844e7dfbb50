//! The instructor's console beside a run: where it is served, and the live view that it shows.

mod coder;
mod replayed;
mod serve;
mod told;
#[cfg(feature = "session")]
mod watchers;

pub use coder::{Coder, RawPicture, VIEW_FPS, VIEW_SIDE};
pub use replayed::Live;
pub use serve::{Console, Serving, hub_address, invitation, start, student};
#[cfg(feature = "session")]
pub(crate) use told::{incidents, readings};
#[cfg(feature = "session")]
pub use watchers::{WatchReport, Watchers};
