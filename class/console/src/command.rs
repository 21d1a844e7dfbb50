//! Commands of an instructor to a student's program.

use serde::{Deserialize, Serialize};

use crate::bounded::{MESSAGE, Text};
use crate::student::Student;

/// The slowest motion, simulated seconds a second. Our choice: a drop still falls within seconds.
pub const SLOWEST: f64 = 0.05;

/// A command of the instructor's. It has no path and no name of anything: a scene is one of those that the student's program offers, by
/// its place among them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Command {
    /// Start a scene.
    Scene {
        /// Its index in [`Student::choices`].
        choice: u8,
    },
    /// Set the boiling's coefficient k_v.
    KV {
        /// Within [`Student::k_v`].
        value: f64,
    },
    /// Start the present scene again. (With braces, since serde lets other fields pass in a variant without.)
    Reset {},
    /// Change to the scene that shows the other order of acid and water than the present one: [`Choice::counterpart`](crate::Choice).
    Toggle {},
    /// Hold simulated time, or let it go on.
    Pause {
        /// Whether to hold it.
        on: bool,
    },
    /// How fast simulated time goes.
    SlowMotion {
        /// Simulated seconds a second, [`SLOWEST`] to 1.
        rate: f64,
    },
    /// Spare the student: mute the boiling.
    Spare {
        /// Whether to mute it.
        on: bool,
    },
    /// Show the student a message.
    Message {
        /// The message; an empty one takes it away.
        text: Text<MESSAGE>,
    },
    /// End the session.
    End {},
}

impl Command {
    /// Checks that `student` can do that at all.
    ///
    /// # Errors
    /// The reason why not, for the instructor.
    pub fn check(&self, student: &Student) -> Result<(), &'static str> {
        match self {
            Self::Reset {} | Self::Toggle {} | Self::Spare { .. } | Self::Message { .. }
                if student.replays =>
            {
                Err("a replay does again what was done, and can only be held, slowed and ended")
            }
            Self::Scene { choice } if usize::from(*choice) >= student.choices.len() => {
                Err("there is no such scene: reload the page")
            }
            Self::Toggle {} if student.choices.iter().all(|it| it.counterpart.is_none()) => {
                Err("no scene of this program has another order")
            }
            Self::KV { value } => match student.k_v {
                Some(range) if (range.least..=range.most).contains(value) => Ok(()),
                Some(_) => Err("k_v is out of its range"),
                None => Err("this program has no k_v to set"),
            },
            Self::SlowMotion { rate } if !(SLOWEST..=1.0).contains(rate) => {
                Err("the speed is out of its range")
            }
            _ => Ok(()),
        }
    }
}

/// A numbered command.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Order {
    /// The hub's number of it. A state in which it has taken effect has it in [`State::done`](crate::State::done).
    pub number: u64,
    /// The command.
    pub command: Command,
}
