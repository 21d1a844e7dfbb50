//! The lesson: finds in the particles what a student did in an attempt, and what went wrong.
//!
//! A [`Finder`] observes the simulation and emits [`Event`]s, which a session records as they come; a replay finds the same events again.
//! An [`Attempt`] collects them: report, summary, table and score are made from it. A [`Lesson`] states what is to be done, and a
//! [`Procedure`] judges whether it was.

mod attempt;
mod boiling;
mod caps;
mod contact;
mod event;
mod finder;
mod glass;
mod language;
mod limits;
mod mixing;
pub mod procedure;
mod rubric;
mod score;
pub mod skin;
mod table;
mod texts;
mod time;
mod units;
mod words;

pub use attempt::Attempt;
pub use boiling::{Boiling, BoilingFigure};
pub use caps::{Caps, Danger};
pub use contact::ContactTexts;
pub use event::{
    Cause, Content, Contents, Ending, Event, Hottest, Incident, Pour, Skin, Surface, What,
};
pub use finder::{Dipped, Finder, Seen, Stream};
pub use glass::{Glass, Glassware, Holding, Place};
pub use language::{Language, LanguageError};
pub use limits::Limits;
pub use mixing::layered;
pub use procedure::{Fault, Lesson, LessonError, Mode, Procedure, SceneFacts, Sight};
pub use rubric::{Ramp, Rubric, RubricError};
pub use score::{Cap, Criterion, Evidence, LeftOut, Score, ScoreLine};
pub use table::{SPREADSHEET_MARK, TableError, incidents_csv, spreadsheet_text};
pub use texts::{
    CurveTexts, FaultTexts, FigureTexts, PlotTexts, ReportTexts, Template, Texts, TextsError,
};
pub use time::whole_nanoseconds;
pub use words::{Sentence, Tone, sentences};
