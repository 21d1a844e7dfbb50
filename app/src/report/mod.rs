//! The report of a run: `report.json` for programs, `report.html` for people.

mod curves;
mod html;
mod model;
mod plot;

pub use model::{FilmStatement, RecordingStatement, Report, SceneStatement, SolverStatement};
