//! Errors of starting a console.

use std::net::SocketAddr;
use std::path::PathBuf;

use crate::auth::NoRandomness;

/// Why a hub, or a student's connection to one, could not be started.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The program cannot listen on the address.
    #[error("the console cannot listen on {address}: {cause}; give another address or port")]
    Listen {
        /// The address.
        address: SocketAddr,
        /// The system's error.
        cause: std::io::Error,
    },
    /// A thread could not be started.
    #[error("the console's thread cannot be started: {0}; end other programs and start again")]
    Thread(std::io::Error),
    /// The certificate's file could not be read or written.
    #[error("the console's {what}, {path}, cannot be {done}: {cause}; make its folder writable, or delete the file", path = path.display())]
    File {
        /// Its purpose.
        what: &'static str,
        /// Its path.
        path: PathBuf,
        /// `read` or `written`.
        done: &'static str,
        /// The system's error.
        cause: std::io::Error,
    },
    /// A file holds something else.
    #[error("{path} holds no {what}; delete it, and a new one is made", path = path.display())]
    Damaged {
        /// Its purpose.
        what: &'static str,
        /// Its path.
        path: PathBuf,
    },
    /// No certificate could be made.
    #[error("no certificate can be made for the console: {0}; this is a fault of the program")]
    Certificate(#[from] rcgen::Error),
    /// TLS refuses the certificate.
    #[error("TLS refuses the console's certificate: {0}; delete its file, and a new one is made")]
    Tls(#[from] rustls::Error),
    /// The system returned no randomness.
    #[error(transparent)]
    NoRandomness(#[from] NoRandomness),
}
