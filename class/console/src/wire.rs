//! Messages on sockets: between page and hub, and between student's program and hub. JSON, each message bounded in length before it is
//! parsed and in its parts while it is.

use serde::{Deserialize, Serialize};

use crate::bounded::{List, Text};
use crate::command::{Command, Order};
use crate::picture::Codec;
use crate::port::ORDERS;
use crate::student::{Choice, NAME, Points, SENTENCE, State, Step, Student};

/// Version of the messages between student's program and hub.
pub const PROTOCOL: u32 = 5;
/// The oldest version that a hub reads. Its states have no points, and its programs make no pictures for cards. Programs of version 4 make
/// no pictures from close to the glass.
pub const OLDEST_PROTOCOL: u32 = 3;
/// Most bytes of a message from a page. The longest valid one is a message of [`MESSAGE`](crate::MESSAGE) characters, each escaped as 12
/// bytes.
pub const MOST_FROM_PAGE: usize = 4 << 10;
/// Most bytes of a text from a student's program. A state in which every field is as long as it can be has fewer.
pub const MOST_STATE: usize = 256 << 10;

/// A message from a page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "say", rename_all = "kebab-case", deny_unknown_fields)]
pub(crate) enum FromPage {
    /// Show this student's state and pictures from now on.
    Open {
        /// The student's number.
        student: u32,
    },
    /// Show no student.
    Close {},
    /// Send pictures of this kind, or none: the mirror is hidden.
    Pictures {
        /// The kind.
        codec: Option<Codec>,
    },
    /// A picture was lost or could not be decoded: go on with a key frame.
    Lost {},
    /// An order.
    Order {
        /// The page's own number of it.
        echo: u32,
        /// The student's number.
        student: u32,
        /// The command.
        command: Command,
    },
    /// An order to each student that is connected and can do it.
    OrderAll {
        /// The page's own number of it.
        echo: u32,
        /// The command.
        command: Command,
    },
    /// Make a new code, for another browser.
    Invite {},
}

/// A message to a page.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "say", rename_all = "kebab-case")]
pub(crate) enum ToPage {
    /// All students at a glance.
    Class {
        /// In the order in which they connected.
        students: Vec<Brief>,
        /// The scenes that all of them offer; none where they differ.
        choices: List<Choice, 16>,
    },
    /// From here on, state and pictures are of this student.
    Opened {
        /// The student's number.
        student: u32,
        /// The student's program.
        is: Student,
    },
    /// A state of the opened student.
    State {
        /// The student's number.
        student: u32,
        /// The state.
        state: Box<State>,
    },
    /// An order went to the student.
    Ordered {
        /// The page's own number of it.
        echo: u32,
        /// The hub's number of it, which a state has once it has taken effect.
        number: u64,
    },
    /// An order to all went to some students.
    OrderedAll {
        /// The page's own number of it.
        echo: u32,
        /// Number of students that it went to.
        given: u32,
        /// Number of students that are connected and cannot do it.
        refused: u32,
    },
    /// An order or a message was refused.
    Refused {
        /// The page's own number, if an order was refused.
        echo: Option<u32>,
        /// The reason.
        why: &'static str,
    },
    /// A new code.
    Invited {
        /// The address that has the code.
        address: String,
        /// The code alone.
        code: String,
        /// The address as a QR code: rows of `#` and blanks.
        rows: Vec<String>,
    },
}

/// A student at a glance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Brief {
    /// The student's number.
    pub student: u32,
    /// The student's name.
    pub name: Text<NAME>,
    /// Whether its program is connected.
    pub here: bool,
    /// The scene's title.
    pub scene: Text<NAME>,
    /// Its index in [`Student::choices`]; `None` where it is none of them.
    pub choice: Option<u8>,
    /// The step of the procedure.
    pub step: Option<Step>,
    /// The points so far.
    pub points: Option<Points>,
    /// Temperature of the hottest particle, °C.
    pub hottest_c: Option<f64>,
    /// Number of incidents of the present attempt.
    pub incidents: u32,
    /// The gravest of them, of equal ones the last.
    pub gravest: Option<Text<SENTENCE>>,
    /// Whether someone would have been hurt by that one.
    pub grave: bool,
    /// Whether simulated time is held.
    pub paused: bool,
}

impl Brief {
    /// A student in this state, at a glance.
    pub fn new(student: u32, name: Text<NAME>, here: bool, state: Option<&State>) -> Self {
        let hottest = |state: &State| {
            let flasks = state.readings.flasks.iter();
            flasks.filter_map(|flask| flask.hottest_c).reduce(f64::max)
        };
        let gravest = state.and_then(|state| {
            let of_attempt = state.incidents.iter();
            let of_attempt = of_attempt.filter(|incident| incident.attempt == state.attempt);
            // Of equal ones this is the last.
            of_attempt.max_by_key(|incident| incident.grave)
        });
        Self {
            student,
            name,
            here,
            scene: state.map(|state| state.scene.clone()).unwrap_or_default(),
            choice: state.and_then(|state| state.choice),
            step: state.and_then(|state| state.step.clone()),
            points: state.and_then(|state| state.points),
            // A tenth is what people read, and an unchanged class is not sent again.
            hottest_c: state
                .and_then(hottest)
                .map(|hottest| (10.0 * hottest).round() / 10.0),
            incidents: state.map_or(0, |state| state.incidents_of_attempt),
            gravest: gravest.map(|incident| incident.text.clone()),
            grave: gravest.is_some_and(|incident| incident.grave),
            paused: state.is_some_and(|state| state.controls.paused),
        }
    }
}

/// A message from a student's program, beside pictures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "say", rename_all = "kebab-case", deny_unknown_fields)]
pub(crate) enum FromStudent {
    /// The first message.
    Hello {
        /// [`PROTOCOL`].
        protocol: u32,
        /// Random number of the program's run: a program whose connection was cut off is recognised by it.
        instance: Text<NAME>,
        /// The program's description.
        student: Student,
    },
    /// A state of the program.
    State {
        /// The state.
        state: Box<State>,
    },
}

/// A message to a student's program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "say", rename_all = "kebab-case", deny_unknown_fields)]
pub(crate) enum ToStudent {
    /// Orders, oldest first.
    Orders {
        /// The orders.
        orders: List<Order, ORDERS>,
    },
    /// Which kinds of pictures some page shows.
    Wanted {
        /// Whether pictures in H.264 are wanted.
        h264: bool,
        /// Whether pictures in JPEG are wanted.
        jpeg: bool,
        /// Whether the next picture in H.264 must be a key frame.
        key: bool,
        /// Whether one picture for a card of the class is wanted. Left out where it is not: programs of [`OLDEST_PROTOCOL`] refuse it.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        card: bool,
        /// Whether pictures of the glass from close by are wanted. Left out where they are not: programs of version 4 refuse it.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        close_up: bool,
    },
}

/// Parses an untrusted text of at most `most` bytes as a message; `None` if it is longer or anything else.
pub(crate) fn read<'a, T: Deserialize<'a>>(text: &'a str, most: usize) -> Option<T> {
    if text.len() > most {
        return None;
    }
    serde_json::from_str(text).ok()
}
