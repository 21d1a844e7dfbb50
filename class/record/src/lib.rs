//! The record: attempts of a student that are kept under a [`Pseudonym`].
//!
//! An [`Entry`] is an attempt that is kept. [`xapi`] writes it as statements that other programs for learning read, [`store`] keeps the
//! attempts of a class in one file, and [`lrs`] sends them to a Learning Record Store. [`keep`] does all of that in one call. Nothing here
//! names a person, and nothing leaves the machine except by [`lrs::send`].

mod entry;
#[cfg(test)]
#[path = "../tests/common/example.rs"]
mod example;
mod keep;
pub mod lrs;
mod pseudonym;
pub mod store;
pub mod xapi;

pub use entry::{Cap, Entry, Points, Score, ScoreError, Session};
pub use jiff::Timestamp;
pub use keep::{KeepError, Keeping, Kept, Scored, keep};
pub use pseudonym::{Pseudonym, PseudonymError};
pub use uuid::Uuid;
