//! What is said over sockets: page and hub, student's program and hub. JSON, each message bounded in length before it
//! is read and in its parts while it is.

use serde::{Deserialize, Serialize};

use crate::bounded::{List, Text};
use crate::command::{Command, Order};
use crate::picture::Codec;
use crate::port::ORDERS;
use crate::student::{NAME, SENTENCE, State, Student};

/// The version of what student's program and hub say to each other. Another one is refused.
pub const PROTOCOL: u32 = 1;
/// Bytes of a message from a page. The longest that it can mean is a message of [`MESSAGE`](crate::MESSAGE) characters,
/// each escaped as 12 bytes.
pub const MOST_FROM_PAGE: usize = 4 << 10;
/// Bytes of a text from a student's program. A state whose every field is as long as it can be has less.
pub const MOST_STATE: usize = 256 << 10;

/// From a page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "say", rename_all = "kebab-case", deny_unknown_fields)]
pub(crate) enum FromPage {
    /// Show this student's state and pictures from now on.
    Open {
        /// Who.
        student: u32,
    },
    /// Show none.
    Close {},
    /// Send pictures of this kind, or none: the mirror is hidden.
    Pictures {
        /// Which.
        codec: Option<Codec>,
    },
    /// A picture was lost or could not be decoded: go on with a key frame.
    Lost {},
    /// A wish.
    Order {
        /// The page's own number of it.
        echo: u32,
        /// For whom.
        student: u32,
        /// What.
        command: Command,
    },
    /// A new code, for another browser.
    Invite {},
}

/// To a page.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "say", rename_all = "kebab-case")]
pub(crate) enum ToPage {
    /// All students at a glance.
    Class {
        /// In the order of their coming.
        students: Vec<Brief>,
    },
    /// From here on, state and pictures are of this student.
    Opened {
        /// Who.
        student: u32,
        /// What it is.
        is: Student,
    },
    /// How the opened student is.
    State {
        /// Who.
        student: u32,
        /// How.
        state: Box<State>,
    },
    /// An order went to the student.
    Ordered {
        /// The page's own number.
        echo: u32,
        /// The hub's number, which a state names as done.
        number: u64,
    },
    /// An order or a message was refused.
    Refused {
        /// The page's own number, if it is an order.
        echo: Option<u32>,
        /// Why.
        why: &'static str,
    },
    /// A new code.
    Invited {
        /// The address with it.
        address: String,
        /// It alone.
        code: String,
        /// The address as a QR code: rows of `#` and blanks.
        rows: Vec<String>,
    },
}

/// A student at a glance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Brief {
    /// The hub's number.
    pub student: u32,
    /// Name.
    pub name: Text<NAME>,
    /// Whether its program is connected.
    pub here: bool,
    /// The scene's title.
    pub scene: Text<NAME>,
    /// The step of the procedure: number and of how many.
    pub step: Option<[u16; 2]>,
    /// The hottest liquid, °C.
    pub hottest_c: Option<f64>,
    /// How much went wrong.
    pub incidents: u32,
    /// The last of it.
    pub last: Option<Text<SENTENCE>>,
    /// Whether simulated time is held.
    pub paused: bool,
}

impl Brief {
    /// Of a student in this state.
    pub fn new(student: u32, name: Text<NAME>, here: bool, state: Option<&State>) -> Self {
        let hottest = |state: &State| {
            let flasks = state.readings.flasks.iter();
            flasks.filter_map(|flask| flask.hottest_c).reduce(f64::max)
        };
        Self {
            student,
            name,
            here,
            scene: state.map(|state| state.scene.clone()).unwrap_or_default(),
            step: state
                .and_then(|state| state.step.as_ref())
                .map(|step| [step.number, step.of]),
            // A tenth is what is read, and a class that stays as it is is not sent again.
            hottest_c: state
                .and_then(hottest)
                .map(|hottest| (10.0 * hottest).round() / 10.0),
            incidents: state.map_or(0, |state| state.incidents_so_far),
            last: state
                .and_then(|state| state.incidents.last())
                .map(|incident| incident.text.clone()),
            paused: state.is_some_and(|state| state.controls.paused),
        }
    }
}

/// From a student's program, beside pictures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "say", rename_all = "kebab-case", deny_unknown_fields)]
pub(crate) enum FromStudent {
    /// The first message.
    Hello {
        /// [`PROTOCOL`].
        protocol: u32,
        /// Drawn by the program when it starts: with it, one that was cut off is known again.
        instance: Text<NAME>,
        /// What it is.
        student: Student,
    },
    /// How it is.
    State {
        /// How.
        state: Box<State>,
    },
}

/// To a student's program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "say", rename_all = "kebab-case", deny_unknown_fields)]
pub(crate) enum ToStudent {
    /// Orders, oldest first.
    Orders {
        /// What to do.
        orders: List<Order, ORDERS>,
    },
    /// Which pictures someone looks at.
    Wanted {
        /// H.264.
        h264: bool,
        /// JPEG.
        jpeg: bool,
        /// The next one of H.264 is to be a key frame.
        key: bool,
    },
}

/// What an untrusted text says.
///
/// # Errors
/// `None` of anything else than such a message.
pub(crate) fn read<'a, T: Deserialize<'a>>(text: &'a str, most: usize) -> Option<T> {
    if text.len() > most {
        return None;
    }
    serde_json::from_str(text).ok()
}
