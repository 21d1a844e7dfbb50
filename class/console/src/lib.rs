//! The instructor's console: a web page that shows what students do and directs their programs.
//!
//! A [`Hub`] is the server of the pages. A [`Port`] is a student's end: a loop of frames gives it states and pictures, takes orders from
//! it, and never waits. It leads to a hub in the same process ([`Hub::student`]) or to a distant one ([`Link`]).

mod address;
mod auth;
mod bounded;
mod command;
mod dial;
mod error;
mod hub;
mod identity;
mod invitation;
#[cfg(test)]
mod message_tests;
mod page;
mod picture;
mod pictures;
mod port;
mod pump;
mod student;
mod tls;
mod watcher;
mod wire;

use std::sync::{Mutex, MutexGuard, PoisonError};

pub use address::{HubAddress, NoHubAddress};
pub use auth::NoRandomness;
pub use bounded::{List, MESSAGE, Text};
pub use command::{Command, Order, SLOWEST};
pub use dial::{Link, LinkStatus};
pub use error::Error;
pub use hub::{Config, Hub, HubCounts};
pub use identity::Fingerprint;
pub use invitation::Invitation;
pub use picture::{Codec, EncodedPicture, JpegError, MOST_PICTURE};
pub use port::{ORDERS, PICTURES, Port, Wanted};
pub use student::{
    Choice, Coming, Controls, Flask, Frames, Incident, Kind, NAME, Points, Range, Readings,
    SENTENCE, Said, State, Step, Student,
};
pub use watcher::{Heard, NotServed, Watcher};

/// Locks a mutex, also after a panic: a thread that panicked has left whole values behind, as all of them are exchanged in one go.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
