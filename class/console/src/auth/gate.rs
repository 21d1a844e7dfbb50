//! Codes that are still valid, sessions that were opened with one, and addresses that have to wait.

use std::collections::VecDeque;
use std::net::IpAddr;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use super::code::{Code, NoRandomness, Secret};
use super::lockout::Lockout;
use crate::lock;

/// Codes that are valid at a time; a further one makes the oldest void.
const CODES: usize = 4;
/// Sessions at a time; a further one ends the oldest.
const SESSIONS: usize = 32;

/// Number of a session.
pub(crate) type SessionId = u64;

/// Why a browser or a student's program may not come in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Refusal {
    /// The code is wrong, or was used before.
    Wrong,
    /// Too many codes were wrong: the time to wait.
    Wait(Duration),
    /// The system returned no randomness.
    NoRandomness,
}

#[derive(Default)]
struct Inner {
    codes: VecDeque<Code>,
    sessions: VecDeque<(SessionId, Secret)>,
    opened: SessionId,
    lockout: Lockout,
}

/// Admits browsers by code, then by session, and students' programs by key.
pub(crate) struct Gate {
    inner: Mutex<Inner>,
    /// The key of the students' programs.
    key: Secret,
}

impl Gate {
    /// A gate without any code yet.
    pub fn new(key: Secret) -> Self {
        Self {
            inner: Mutex::default(),
            key,
        }
    }

    /// Makes a new code, which is valid from now on.
    pub fn invite(&self) -> Result<Code, NoRandomness> {
        let code = Code::new()?;
        let mut inner = lock(&self.inner);
        if inner.codes.len() >= CODES {
            inner.codes.pop_front();
        }
        inner.codes.push_back(code.clone());
        Ok(code)
    }

    /// How many codes are valid.
    pub fn codes(&self) -> usize {
        lock(&self.inner).codes.len()
    }

    /// Exchanges a code for a session, whose cookie's value it returns.
    pub fn enter(&self, typed: &str, from: IpAddr, now: Instant) -> Result<Secret, Refusal> {
        let inner = &mut *lock(&self.inner);
        // A right code does not help an address that has to wait, or the wait would stop nobody.
        if let Some(wait) = inner.lockout.wait(from, now) {
            return Err(Refusal::Wait(wait));
        }
        // Compares all of them, so that the time does not depend on which it is.
        let mut good = None;
        for (at, code) in inner.codes.iter().enumerate() {
            if code.is(typed) {
                good = Some(at);
            }
        }
        let Some(at) = good else {
            inner.lockout.failed(from, now);
            return Err(Refusal::Wrong);
        };
        let secret = Secret::new().map_err(|_| Refusal::NoRandomness)?;
        inner.codes.remove(at);
        inner.lockout.passed(from);
        if inner.sessions.len() >= SESSIONS {
            inner.sessions.pop_front();
        }
        inner.opened += 1;
        inner.sessions.push_back((inner.opened, secret.clone()));
        Ok(secret)
    }

    /// The session whose cookie has the value `said`.
    pub fn session(&self, said: &str) -> Option<SessionId> {
        let mut found = None;
        for (session, secret) in &lock(&self.inner).sessions {
            if secret.is(said) {
                found = Some(*session);
            }
        }
        found
    }

    /// Whether a session is open still.
    pub fn is_open(&self, session: SessionId) -> bool {
        let inner = lock(&self.inner);
        inner.sessions.iter().any(|(open, _)| *open == session)
    }

    /// Ends a session.
    pub fn leave(&self, session: SessionId) {
        lock(&self.inner)
            .sessions
            .retain(|(open, _)| *open != session);
    }

    /// Checks a student's program: whether `said` is the key.
    pub fn admit(&self, said: &str, from: IpAddr, now: Instant) -> Result<(), Refusal> {
        let inner = &mut *lock(&self.inner);
        if let Some(wait) = inner.lockout.wait(from, now) {
            return Err(Refusal::Wait(wait));
        }
        if self.key.is(said) {
            return Ok(());
        }
        inner.lockout.failed(from, now);
        Err(Refusal::Wrong)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const HERE: IpAddr = IpAddr::V4(std::net::Ipv4Addr::new(192, 0, 2, 1));

    fn gate() -> Gate {
        Gate::new(Secret::new().unwrap())
    }

    #[test]
    fn a_code_is_good_for_one_use() {
        let (gate, now) = (gate(), Instant::now());
        let code = gate.invite().unwrap().shown();
        let other = gate.invite().unwrap().shown();
        let cookie = gate.enter(&code, HERE, now).unwrap();
        assert_eq!(gate.enter(&code, HERE, now).err(), Some(Refusal::Wrong));
        let session = gate.session(cookie.text()).unwrap();
        assert_eq!(gate.session(&code), None);
        assert!(gate.enter(&other, HERE, now).is_ok());
        assert_eq!(gate.codes(), 0);
        gate.leave(session);
        assert_eq!(gate.session(cookie.text()), None);
        assert!(!gate.is_open(session));
    }

    #[test]
    fn where_one_has_to_wait_the_right_code_does_not_help() {
        let (gate, now) = (gate(), Instant::now());
        let code = gate.invite().unwrap().shown();
        for _ in 0..5 {
            assert_eq!(gate.enter("no", HERE, now).err(), Some(Refusal::Wrong));
        }
        assert!(matches!(
            gate.enter(&code, HERE, now),
            Err(Refusal::Wait(_))
        ));
        let key = gate.key.text();
        assert!(matches!(gate.admit(key, HERE, now), Err(Refusal::Wait(_))));
        let elsewhere = "192.0.2.2".parse().unwrap();
        assert!(gate.enter(&code, elsewhere, now).is_ok());
    }

    #[test]
    fn codes_and_sessions_are_bounded() {
        let (gate, now) = (gate(), Instant::now());
        let first = gate.invite().unwrap().shown();
        for _ in 0..CODES {
            gate.invite().unwrap();
        }
        assert_eq!(gate.codes(), CODES);
        assert_eq!(gate.enter(&first, HERE, now).err(), Some(Refusal::Wrong));
        let mut cookies = Vec::new();
        for _ in 0..=SESSIONS {
            let code = gate.invite().unwrap().shown();
            cookies.push(gate.enter(&code, HERE, now).unwrap());
        }
        assert_eq!(gate.session(cookies[0].text()), None);
        assert!(gate.session(cookies[1].text()).is_some());
    }

    #[test]
    fn a_program_needs_the_key() {
        let (gate, now) = (gate(), Instant::now());
        assert_eq!(gate.admit(gate.key.text(), HERE, now), Ok(()));
        assert_eq!(gate.admit("", HERE, now), Err(Refusal::Wrong));
    }
}
