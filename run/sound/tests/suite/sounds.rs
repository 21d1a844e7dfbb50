//! Sounds of events, against formulas and published figures.

mod boiling;
mod captions;
mod extremes;
mod measure;
mod opus;
mod place;
mod ringing;
mod silence;
