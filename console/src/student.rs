//! What a student's program is, and what it tells of each frame.
//!
//! SI units, temperatures in °C. What is not modelled or not known is `None`, which JSON's `null` stands for; a number
//! that is none (NaN) is written as `null` too.

use serde::{Deserialize, Serialize};

use crate::bounded::{List, MESSAGE, Text};

/// Characters of a sentence that is shown.
pub const SENTENCE: usize = 200;
/// Characters of a name.
pub const NAME: usize = 64;

/// What a student's program is. It stays as it is while the program runs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Student {
    /// What the class calls it: the student's name, or the computer's.
    pub name: Text<NAME>,
    /// The program's version.
    pub version: Text<NAME>,
    /// The scenes that can be brought up.
    pub choices: List<Choice, 16>,
    /// In which range k_v can be set; `None` where it cannot.
    pub k_v: Option<Range>,
    /// Whether it replays a recording, of which nothing can be changed.
    pub replays: bool,
}

/// A scene that can be brought up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// For people.
    pub title: Text<NAME>,
    /// What it teaches.
    pub kind: Kind,
}

/// What a scene teaches.
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

/// What a student's program tells of a frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct State {
    /// Frames so far.
    pub frame: u64,
    /// Simulated time of the run, s.
    pub time_s: Option<f64>,
    /// The scene's title.
    pub scene: Text<NAME>,
    /// Its place among [`Student::choices`]; `None` where it is none of them.
    pub choice: Option<u8>,
    /// Number of the last [`Order`](crate::Order) that acts in this frame, or was refused; 0 before the first.
    pub done: u64,
    /// How the controls stand.
    pub controls: Controls,
    /// The step of the procedure; `None` where there is none.
    pub step: Option<Step>,
    /// Hints that were given, the last ones.
    pub hints: List<Said, 16>,
    /// What is measured.
    pub readings: Readings,
    /// What went wrong, the last ones.
    pub incidents: List<Incident, 32>,
    /// How much went wrong in all.
    pub incidents_so_far: u32,
    /// How long frames take.
    pub frames: Frames,
}

/// How the controls stand in a frame.
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
    /// What is shown to the student; empty where nothing is.
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
    /// Which, from 1.
    pub number: u16,
    /// Of how many.
    pub of: u16,
    /// What is to be done.
    pub title: Text<SENTENCE>,
}

/// A sentence and when it was said.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Said {
    /// Simulated time of the run, s.
    pub t_s: Option<f64>,
    /// What.
    pub text: Text<SENTENCE>,
}

/// Something that went wrong.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Incident {
    /// When it began, simulated time of the run, s.
    pub t_s: Option<f64>,
    /// What, in a sentence.
    pub text: Text<SENTENCE>,
    /// Whether someone would have been hurt.
    pub grave: bool,
}

/// What is measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Readings {
    /// By flask.
    pub flasks: List<Flask, 8>,
    /// By how much the hottest liquid is above its boiling point, K.
    pub superheat_k: Option<f64>,
    /// Share of vapour in the liquid's volume, 0 to 1.
    pub void_fraction: Option<f64>,
    /// What lies on the bench, m³.
    pub bench_m3: Option<f64>,
    /// What lies on the floor, m³.
    pub floor_m3: Option<f64>,
}

/// What a flask holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Flask {
    /// Its name.
    pub name: Text<NAME>,
    /// How much, m³.
    pub volume_m3: Option<f64>,
    /// Mean temperature, °C.
    pub mean_c: Option<f64>,
    /// The hottest, °C.
    pub hottest_c: Option<f64>,
}

/// How long frames take, of the last second.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Frames {
    /// On average, s.
    pub mean_s: Option<f64>,
    /// The longest, s.
    pub worst_s: Option<f64>,
    /// The display's period, s.
    pub period_s: Option<f64>,
    /// Display periods without a frame, of the whole session.
    pub missed: u64,
}
