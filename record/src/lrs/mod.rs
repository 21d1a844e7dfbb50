//! Telling a Learning Record Store what is in the outbox. Nothing is sent but by [`send`], which is called when somebody asks.

mod client;
mod endpoint;
mod send;
#[cfg(test)]
mod tests;
mod token;

use std::time::Duration;

pub use endpoint::{Endpoint, EndpointError};
pub use send::{Refused, Sent, send};
pub use token::{Token, TokenError};

/// A Learning Record Store.
#[derive(Clone, Debug)]
pub struct Lrs {
    /// Where it is.
    pub endpoint: Endpoint,
    /// What it knows the sender by.
    pub token: Token,
    /// How long it is waited for.
    pub patience: Patience,
}

/// How long a Learning Record Store is waited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patience {
    /// How often a request is made in all.
    pub tries: u32,
    /// The pause after the first; each further one is twice as long.
    pub pause: Duration,
    /// The longest pause, also of those that it asks for itself.
    pub longest: Duration,
    /// How long an answer may take.
    pub answer: Duration,
}

/// Our choice: half a minute of pauses is enough for a server that starts anew, and somebody waits for it.
impl Default for Patience {
    fn default() -> Self {
        Self {
            tries: 5,
            pause: Duration::from_secs(2),
            longest: Duration::from_secs(16),
            answer: Duration::from_secs(30),
        }
    }
}
