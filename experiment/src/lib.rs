//! The experiment: a scene on a device, driven by poses, and what is kept of it.
//! Below program and study: it parses no command line.

mod camera;
mod clock;
mod console;
pub mod device;
mod experiment;
mod failure;
mod film;
pub mod glassware;
mod h264;
pub mod hands;
pub mod interrupt;
mod laboratory;
mod legend;
mod moment;
mod observer;
pub mod output;
pub mod page;
pub mod particles;
pub mod progress;
mod rank;
mod run;
mod sample;
pub mod scenery;
pub mod scenes;
pub mod stage;
pub mod switches;
pub mod track;
pub mod units;

pub use camera::{Camera, Colour, EYES_APART, HEAD_FIELD, Shot, tripod};
pub use clock::{SimulatedTime, Span};
pub use console::{Format, emit, error_line, escaped, in_a_line};
pub use device::DeviceStatement;
pub use experiment::{Counters, Experiment, Outcome, Taken};
pub use failure::{Blame, Cause, Failure};
pub use film::{Film, FilmError};
pub use h264::{Coded, H264};
pub use laboratory::{Laboratory, Setup, on_device, prepare};
pub use moment::{Moment, Watch};
pub use observer::{FILM_FPS, FILM_SIZE, Observations, Observer, sample_is_due};
pub use progress::Progress;
pub use rank::Ranks;
pub use run::run;
pub use sample::{HeatSample, LedgerSample, MassByPlace, Sample};
pub use scenes::Scenes;
