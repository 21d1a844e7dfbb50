//! Requests to a Learning Record Store (xAPI 1.0.3, Communication, 2.1), and the meaning of its answers.

use std::io::Read;
use std::sync::Arc;
use std::time::Duration;

use serde_json::Value;
use ureq::http::Response;
use ureq::tls::{RootCerts, TlsConfig};
use ureq::{Agent, Body};
use uuid::Uuid;

use super::Lrs;
use super::endpoint::RIGHT;

/// The version that requests name: every store of 1.0 accepts it.
const VERSION: &str = "1.0.3";

/// Most bytes of an answer that are read. Our choice: the identifiers of a batch take 2 kB, one statement a few.
const MOST: u64 = 1 << 20;

/// Most characters of its message that are passed on. Our choice.
const SAID: usize = 300;

/// Meaning of an answer for the statements that were sent.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Answer {
    /// They are stored.
    Stored,
    /// A different statement with one of these identifiers is stored already.
    Conflict(String),
    /// The store does not accept these statements.
    Refused(String),
    /// The store accepts no statements of ours.
    Denied(String),
    /// The store is unreachable or busy, with the pause after which it wants another request.
    Away(String, Option<Duration>),
}

pub(super) struct Client<'a> {
    agent: Agent,
    lrs: &'a Lrs,
}

impl<'a> Client<'a> {
    pub(super) fn new(lrs: &'a Lrs) -> Self {
        let provider = Arc::new(rustls::crypto::ring::default_provider());
        let tls = TlsConfig::builder()
            .root_certs(RootCerts::PlatformVerifier)
            .unversioned_rustls_crypto_provider(provider)
            .build();
        let mut config = Agent::config_builder()
            .tls_config(tls)
            .https_only(!lrs.endpoint.is_plain())
            // A redirect would send the token and the pseudonyms elsewhere.
            .max_redirects(0)
            .max_redirects_will_error(false)
            .http_status_as_error(false)
            .timeout_global(Some(lrs.patience.answer));
        if lrs.endpoint.is_plain() {
            // A proxy would read data that may not leave this machine.
            config = config.proxy(None);
        }
        Self {
            agent: config.build().into(),
            lrs,
        }
    }

    /// Stores statements, all or none.
    pub(super) fn store(&self, statements: &str) -> Answer {
        let address = self.lrs.endpoint.statements();
        let request = self
            .agent
            .post(address.as_str())
            .header("Authorization", self.lrs.token.header())
            .header("X-Experience-API-Version", VERSION)
            .header("Content-Type", "application/json");
        match request.send(statements) {
            Ok(mut answer) => meaning(&address, &mut answer, |said| {
                // A page of another server has the status 200 as well.
                matches!(serde_json::from_str(said), Ok(Value::Array(_)))
            }),
            Err(error) => away(&address, &error),
        }
    }

    /// The statement of that identifier; `None` where there is none.
    pub(super) fn find(&self, id: Uuid) -> Result<Option<Value>, Answer> {
        let address = format!("{}?statementId={id}", self.lrs.endpoint.statements());
        let request = self
            .agent
            .get(address.as_str())
            .header("Authorization", self.lrs.token.header())
            .header("X-Experience-API-Version", VERSION);
        let mut answer = match request.call() {
            Ok(answer) => answer,
            Err(error) => return Err(away(&address, &error)),
        };
        if answer.status() == 404 {
            return Ok(None);
        }
        let mut found = Value::Null;
        let meaning = meaning(&address, &mut answer, |said| {
            match serde_json::from_str(said) {
                Ok(value @ Value::Object(_)) => {
                    found = value;
                    true
                }
                _ => false,
            }
        });
        match meaning {
            Answer::Stored => Ok(Some(found)),
            other => Err(other),
        }
    }
}

/// No answer came from that address.
fn away(address: &str, error: &ureq::Error) -> Answer {
    Answer::Away(
        format!("{address}: {error}; is its server running, and is the address right?"),
        None,
    )
}

/// What an answer of that address means, which each message names with the status.
fn meaning(
    address: &str,
    answer: &mut Response<Body>,
    is_right: impl FnOnce(&str) -> bool,
) -> Answer {
    let mut said = Vec::new();
    // An answer that is cut off by the end of a connection fails the checks below.
    let _ = answer
        .body_mut()
        .as_reader()
        .take(MOST)
        .read_to_end(&mut said);
    let said = String::from_utf8_lossy(&said);
    let status = answer.status();
    let shown: String = said.chars().take(SAID).collect();
    let of = format!("{address} answers {status}");
    let text = format!("{of}: {}", shown.trim());
    match status.as_u16() {
        204 => Answer::Stored,
        200 if is_right(&said) => Answer::Stored,
        200..=299 => Answer::Denied(format!(
            "{of}, but not as a Learning Record Store does; {RIGHT}"
        )),
        300..=399 => {
            let to = answer
                .headers()
                .get("location")
                .and_then(|to| to.to_str().ok());
            let to = to.unwrap_or("nowhere");
            Answer::Denied(format!(
                "{of}: it sends on to {to}, which is not followed; give that address if it is right"
            ))
        }
        408 | 425 | 429 | 500..=599 => {
            let after = answer
                .headers()
                .get("retry-after")
                .and_then(|after| after.to_str().ok());
            let after = after
                .and_then(|after| after.trim().parse().ok())
                .map(Duration::from_secs);
            Answer::Away(text, after)
        }
        401 | 403 | 407 => Answer::Denied(format!(
            "{text}; is the token of this store, and may it write statements?"
        )),
        404 | 405 | 410 => Answer::Denied(format!("{text}; {RIGHT}")),
        409 => Answer::Conflict(text),
        _ => Answer::Refused(text),
    }
}
