//! What the user can ask a session for: by a button, a key of the computer or the panel.

/// What the user wants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Decision {
    /// This scene from its start.
    Scene(String),
    /// The present scene from its start.
    Start,
    /// The bench before the user.
    Recentre,
    /// What happened, or the panel as it was.
    Summary,
    /// Something of the lesson that is gone through.
    Lesson(Act),
    /// The session's end.
    End,
    /// The same, if it is asked for twice: a key is soon pressed by mistake.
    AskEnd,
}

/// What can be asked for in a lesson.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Act {
    /// The hint of a step that is open.
    Hint,
    /// The step that is open is left out.
    Skip,
    /// All is done.
    Finish,
}

impl Decision {
    /// Whether it undoes what the user did, so that it takes a [`hold`](super::hold).
    pub fn loses_work(&self) -> bool {
        matches!(
            self,
            Self::Scene(_) | Self::Start | Self::Lesson(Act::Skip | Act::Finish)
        )
    }
}
