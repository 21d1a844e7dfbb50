//! Sends statements in the outbox to a Learning Record Store. Nothing is sent except by [`send`], which runs only at somebody's request.

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
    /// Its address.
    pub endpoint: Endpoint,
    /// The sender's credentials.
    pub token: Token,
    /// How long to wait for it.
    pub patience: Patience,
}

/// How long to wait for a Learning Record Store.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patience {
    /// Number of requests in all.
    pub tries: u32,
    /// The pause after the first; each further one is twice as long.
    pub pause: Duration,
    /// The longest pause, also of those that the store asks for.
    pub longest: Duration,
    /// Longest time for an answer.
    pub answer: Duration,
}

/// Our choice: half a minute of pauses is enough for a server that restarts, and somebody waits for the result.
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
