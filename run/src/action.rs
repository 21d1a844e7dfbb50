//! What is done to a run beside moving hands: the console, the panel, keys and tracks give the same actions.

use vitriol_sim::scene::PictureFilter;

/// What is done before the step that comes next. A track spells it as a switch (`track/spelling.rs`).
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// The scene of that name is brought up.
    Scene(String),
    /// The scene of that name begins anew; the present one without a name. A track names it.
    Start(Option<String>),
    /// Substeps of a step, and iterations of each, from now on.
    Solver([u32; 2]),
    /// Whether glass breaks from now on, also in scenes that follow.
    Glass(bool),
    /// Seen from the bench the hands leap, and what they hold goes with them. The text is where the bench stands in the room from now
    /// on (`stage_from_scene`: position, m, and angle about Y, rad); a replay needs no place.
    Leap(String),
    /// Each side of a session's pictures over the display's, from now on. A replay's film is drawn as it is asked for.
    Resolution(f64),
    /// Likewise the filter of the liquid's surface.
    Filter(PictureFilter),
    /// Likewise whether pictures are sharp about the lenses' axes alone.
    Foveation(bool),
    /// The boiling's coefficient k_v from now on.
    Intensity(f64),
    /// Whether simulated time is held. No step is taken meanwhile.
    Pause(bool),
    /// Simulated seconds a second from now on. Steps are as long as ever.
    Speed(f64),
    /// Whether boiling is muted, for ears and hands.
    Mute(bool),
    /// What an instructor writes to the student; an empty text takes it away.
    Message(String),
    /// The hint of the lesson's step of that id; without one of a step that is open. A track names it.
    Hint(Option<String>),
    /// That step is left out; without an id the one that is open. A track names it.
    Skip(Option<String>),
    /// The answer of that number, counted from 1, to the question of the lesson's step of that id; without one of the question that is
    /// open. A track names it.
    Answer {
        /// The step.
        step: Option<String>,
        /// The answer's number.
        answer: u8,
    },
    /// The student is done with the lesson.
    Finish,
}

impl Action {
    /// The scene that it brings up from its start; `None` of an action that brings up none.
    pub fn brings_up(&self) -> Option<&str> {
        match self {
            Self::Scene(name) | Self::Start(Some(name)) => Some(name),
            _ => None,
        }
    }

    /// Whether it is an instructor's, which reports name.
    pub fn is_instructors(&self) -> bool {
        use Action::{Intensity, Message, Mute, Pause, Speed};
        matches!(
            self,
            Intensity(_) | Pause(_) | Speed(_) | Mute(_) | Message(_)
        )
    }

    /// Whether it is of a lesson.
    pub fn is_of_lesson(&self) -> bool {
        matches!(
            self,
            Self::Hint(_) | Self::Skip(_) | Self::Answer { .. } | Self::Finish
        )
    }
}
