//! What the user can ask a session for: by a button, a key of the computer, the panel or, as an instructor, the console.

use vitriol_run::Action;

/// A request of the user to the session.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// Does an action in the run.
    Act(Action),
    /// Moves the bench before the user.
    Recentre,
    /// Shows the summary of the attempt on the panel, or hides it.
    Summary,
    /// Ends the session.
    End,
    /// Ends the session as [`Decision::End`] does, but only where it is asked for again within five seconds: a key is soon pressed by
    /// mistake.
    AskEnd,
}

impl Decision {
    /// Whether it undoes what the user did, so that it takes a [`hold`](super::hold).
    pub fn loses_work(&self) -> bool {
        use Action::{Finish, Scene, Skip, Start};
        matches!(self, Self::Act(Scene(_) | Start(_) | Skip(_) | Finish))
    }
}
