//! The report of a run: `report.json` for programs, `report.html` for people.

mod curves;
mod happened;
mod html;
mod model;
mod plot;

#[cfg(feature = "class")]
pub use happened::{outcome, told_page};
pub use model::{
    AskedStatement, FilmStatement, InstructorStatement, LAYOUT, RecordingStatement, Report,
    SceneStatement, SolverStatement,
};
