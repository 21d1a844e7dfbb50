//! Description of a student's program, and its state in a frame.
//!
//! SI units, temperatures in °C. A value that is not modelled or not known is `None`, JSON's `null`; NaN is written as `null` too.

use serde::{Deserialize, Serialize};

use crate::bounded::{List, MESSAGE, Text};

/// Characters of a sentence that is shown.
pub const SENTENCE: usize = 200;
/// Characters of a name.
pub const NAME: usize = 64;

/// Description of a student's program. It stays as it is while the program runs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Student {
    /// Its name in the class: the student's name, or the computer's.
    pub name: Text<NAME>,
    /// The program's version.
    pub version: Text<NAME>,
    /// The scenes that can be started.
    pub choices: List<Choice, 16>,
    /// Range in which k_v can be set; `None` where it cannot.
    pub k_v: Option<Range>,
    /// Whether it replays a recording, of which nothing can be changed.
    pub replays: bool,
    /// Whether it makes pictures of the glass from close by. Programs before version 5 of the messages do not say so, and make none.
    #[serde(default)]
    pub close_up: bool,
}

/// A scene that can be started.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// Its title for people.
    pub title: Text<NAME>,
    /// Its kind.
    pub kind: Kind,
    /// Index in [`Student::choices`] of the scene that shows the other order; `None` where there is none.
    pub counterpart: Option<u8>,
}

/// The operation that a scene teaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The correct operation.
    Correct,
    /// The incorrect one.
    Incorrect,
    /// Something else.
    Other,
}

/// From `least` to `most`, both included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// The least.
    pub least: f64,
    /// The most.
    pub most: f64,
}

/// State of a student's program in a frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct State {
    /// Frames so far.
    pub frame: u64,
    /// Simulated time of the run, s.
    pub time_s: Option<f64>,
    /// The scene's title.
    pub scene: Text<NAME>,
    /// Its index in [`Student::choices`]; `None` where it is none of them.
    pub choice: Option<u8>,
    /// The scene that is being prepared to follow it; `None` where none is.
    pub coming: Option<Coming>,
    /// Number of the present attempt, from 1; 0 before the first.
    pub attempt: u32,
    /// Whether the student has taken something in a hand in this attempt, so that another scene would lose work.
    pub worked: bool,
    /// Number of the last [`Order`](crate::Order) that has taken effect in this frame, or was refused; 0 before the first.
    pub done: u64,
    /// The controls.
    pub controls: Controls,
    /// The present step of the procedure; `None` where there is none.
    pub step: Option<Step>,
    /// The points so far; `None` where nothing is judged yet, and of a program that does not send them.
    #[serde(default)]
    pub points: Option<Points>,
    /// The last hints that were given.
    pub hints: List<Said, 16>,
    /// Measured values.
    pub readings: Readings,
    /// The last incidents, and before them grave ones of the present attempt.
    pub incidents: List<Incident, 32>,
    /// Number of incidents of the present attempt.
    pub incidents_of_attempt: u32,
    /// Number of incidents in all.
    pub incidents_so_far: u32,
    /// Number of those in which someone would have been hurt.
    pub grave_so_far: u32,
    /// The file that the session is recorded in, on the student's computer; `None` where nothing is recorded.
    pub recording: Option<Text<SENTENCE>>,
    /// Times of frames.
    pub frames: Frames,
}

/// A scene that is being prepared.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coming {
    /// Its title.
    pub scene: Text<NAME>,
    /// Its index in [`Student::choices`]; `None` where it is none of them.
    pub choice: Option<u8>,
}

/// State of the controls in a frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Controls {
    /// The boiling's coefficient; `None` in a scene without boiling.
    pub k_v: Option<f64>,
    /// Whether simulated time is held.
    pub paused: bool,
    /// Simulated seconds a second, 1 at full speed.
    pub rate: f64,
    /// Whether the boiling is muted.
    pub spared: bool,
    /// The message that is shown to the student; empty where none is.
    pub message: Text<MESSAGE>,
    /// Whether the session is over.
    pub ended: bool,
}

impl Default for Controls {
    fn default() -> Self {
        Self {
            k_v: None,
            paused: false,
            rate: 1.0,
            spared: false,
            message: Text::default(),
            ended: false,
        }
    }
}

/// A step of the procedure.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// Its number, from 1.
    pub number: u16,
    /// Number of steps.
    pub of: u16,
    /// The instruction.
    pub title: Text<SENTENCE>,
}

/// Points of the present attempt so far: the lesson's, or the program's own where there is no lesson.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Points {
    /// Points earned.
    pub earned: u32,
    /// Points that can be earned.
    pub of: u32,
}

/// A sentence and its time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Said {
    /// Simulated time of the run, s.
    pub t_s: Option<f64>,
    /// The sentence.
    pub text: Text<SENTENCE>,
}

/// An incident: something that went wrong.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Incident {
    /// When it began, simulated time of the run, s.
    pub t_s: Option<f64>,
    /// What happened, in a sentence.
    pub text: Text<SENTENCE>,
    /// Whether someone would have been hurt.
    pub grave: bool,
    /// Number of the attempt that it belongs to, from 1.
    pub attempt: u32,
    /// Title of that attempt's scene.
    pub scene: Text<NAME>,
}

/// Measured values.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Readings {
    /// The flasks.
    pub flasks: List<Flask, 8>,
    /// By how much the hottest liquid is above its boiling point, K.
    pub superheat_k: Option<f64>,
    /// Share of vapour in the liquid's volume, 0 to 1.
    pub void_fraction: Option<f64>,
    /// Volume on the bench, m³.
    pub bench_m3: Option<f64>,
    /// Volume on the floor, m³.
    pub floor_m3: Option<f64>,
}

/// Contents of a flask.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Flask {
    /// Its name.
    pub name: Text<NAME>,
    /// Volume, m³.
    pub volume_m3: Option<f64>,
    /// Mean temperature, °C.
    pub mean_c: Option<f64>,
    /// Temperature of the hottest particle, °C.
    pub hottest_c: Option<f64>,
}

/// Times of the frames of the last second.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Frames {
    /// Mean time of a frame, s.
    pub mean_s: Option<f64>,
    /// Longest time of a frame, s.
    pub worst_s: Option<f64>,
    /// The display's period, s.
    pub period_s: Option<f64>,
    /// Display periods without a frame, of the whole session.
    pub missed: u64,
}
