//! Why there is no console.

use std::net::SocketAddr;
use std::path::PathBuf;

use crate::auth::NoRandomness;

/// See the module.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The address cannot be listened on.
    #[error("the console cannot listen on {address}: {cause}; give another address or port")]
    Listen {
        /// Which.
        address: SocketAddr,
        /// What the system says.
        cause: std::io::Error,
    },
    /// A thread could not be started.
    #[error("the console's thread cannot be started: {0}; end other programs and start again")]
    Thread(std::io::Error),
    /// The certificate's file could not be read or written.
    #[error("the console's {what}, {path}, cannot be {done}: {cause}; make its folder writable, or delete the file", path = path.display())]
    File {
        /// What it is.
        what: &'static str,
        /// Where.
        path: PathBuf,
        /// `read` or `written`.
        done: &'static str,
        /// What the system says.
        cause: std::io::Error,
    },
    /// A file holds something else.
    #[error("{path} holds no {what}; delete it, and a new one is made", path = path.display())]
    Damaged {
        /// What it should be.
        what: &'static str,
        /// Where.
        path: PathBuf,
    },
    /// No certificate could be made.
    #[error("no certificate can be made for the console: {0}; this is a fault of the program")]
    Certificate(#[from] rcgen::Error),
    /// TLS refuses the certificate.
    #[error("TLS refuses the console's certificate: {0}; delete its file, and a new one is made")]
    Tls(#[from] rustls::Error),
    /// See [`NoRandomness`].
    #[error(transparent)]
    NoRandomness(#[from] NoRandomness),
}
