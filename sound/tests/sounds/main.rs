//! What is heard of events, against formulas and published figures.
#![allow(clippy::unwrap_used, clippy::panic)]

mod boiling;
mod captions;
mod extremes;
mod measure;
mod opus;
mod place;
mod ringing;
mod silence;
