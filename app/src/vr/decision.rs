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
    /// The session's end.
    End,
}
