//! The instructor's console beside a run: where it is served, and the live view that it shows.

mod args;
mod coder;
mod replayed;
mod serve;
mod told;
mod watchers;

pub use args::ConsoleArgs;
pub use coder::{CLOSE_UP_EVERY, Coder, RawPicture, VIEW_FPS, VIEW_SIDE, Viewpoint};
pub use replayed::Live;
pub use serve::{Console, Serving, invitation, listen_address, start, student};
pub use told::{Attempts, Evaluation, readings};
pub use watchers::{WatchReport, Watchers};
