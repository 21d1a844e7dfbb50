//! The experiment: a scene on a device, driven by poses, and what is kept of it.
//! Below program and study: it parses no command line.

mod camera;
mod clock;
mod console;
pub mod device;
mod experiment;
mod failure;
mod film;
mod laboratory;
mod legend;
mod observer;
pub mod output;
pub mod page;
mod rank;
mod run;
mod sample;
pub mod scenery;
pub mod scenes;
pub mod stage;
pub mod switches;
pub mod track;
pub mod units;

pub use camera::{Camera, Colour, Shot};
pub use clock::{SimulatedTime, Span};
pub use console::{Format, emit, escaped, in_a_line};
pub use device::DeviceStatement;
pub use experiment::{Counters, Experiment, Outcome, Taken};
pub use failure::{Blame, Cause, Failure};
pub use film::{Film, FilmError};
pub use laboratory::{Setup, on_device, prepare};
pub use observer::{FILM_FPS, FILM_SIZE, Observations, Observer};
pub use rank::Ranks;
pub use run::run;
pub use sample::{HeatSample, LedgerSample, MassByPlace, Sample};
pub use scenes::Scenes;
