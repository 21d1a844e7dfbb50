//! The report of a run: `report.json` for programs, `report.html` for people.

mod curves;
mod html;
mod model;
mod plot;
pub mod units;

pub use html::STYLE;
pub use model::{
    Counters, DeviceStatement, FilmStatement, HeatSample, LedgerSample, MassByPlace, Report,
    Sample, SceneStatement, SolverStatement,
};
pub use plot::CURVE_COLOURS;
