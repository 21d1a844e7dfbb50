//! Guided procedures: lessons of steps that the simulation judges.
//!
//! A [`Lesson`] is read from a TOML file (`run/lesson/lessons`) and checked against the properties of its scene ([`SceneFacts`]). A
//! [`Procedure`] goes through it: it takes in [`Sight`]s and the finder's events, and returns [`Progress`].

mod condition;
mod error;
mod file;
mod fits;
mod judge;
mod keeping;
mod mode;
mod progress;
mod read;
mod record;
mod retold;
mod sight;
mod source;
mod template;
#[cfg(test)]
mod tests;
mod verdict;
mod watch;
mod words;

pub use condition::{
    Answered, Condition, Cool, HandName, Holds, Keep, Kind, Liquid, MOST_ANSWERS, Measured,
    OfFlask, Poured, Rinsed, SashAtMost, SashIs, SpiltAtMost, Stirred, TemperatureIs, Wiped, Worn,
};
pub use error::{Fault, LessonError};
pub use file::{Lesson, Rule, Step};
pub use judge::Procedure;
pub use mode::{Mode, ModeError};
pub use progress::{Gear, Progress, State, Status, StepState, Verdict, VerdictLine, Why};
pub use retold::Became;
pub use sight::{Dip, FlaskFacts, FlaskSight, SceneFacts, Sight};
pub use words::{LessonTexts, StepTexts};
