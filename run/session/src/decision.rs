//! What the user can ask a session for: by a button, a key of the computer, the panel or, as an instructor, the console.

use vitriol_run::Action;

/// What the user wants.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// Something that is done to the run.
    Act(Action),
    /// The bench before the user.
    Recentre,
    /// What happened, or the panel as it was.
    Summary,
    /// The session's end.
    End,
    /// The same, if it is asked for twice: a key is soon pressed by mistake.
    AskEnd,
}

impl Decision {
    /// Whether it undoes what the user did, so that it takes a [`hold`](super::hold).
    pub fn loses_work(&self) -> bool {
        use Action::{Finish, Scene, Skip, Start};
        matches!(self, Self::Act(Scene(_) | Start(_) | Skip(_) | Finish))
    }
}
