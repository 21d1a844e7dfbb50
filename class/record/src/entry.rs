//! An attempt with the data that are kept beside it: whose it is, when it was, and how good.

use jiff::{SignedDuration, Timestamp};
use uuid::Uuid;
use vitriol_lesson::{Attempt, whole_nanoseconds};

use crate::Pseudonym;

/// One attempt as it is kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The attempt's identifier, from which those of its statements follow.
    pub id: Uuid,
    /// The student.
    pub pseudonym: Pseudonym,
    /// When it began, by the wall clock.
    pub begun: Timestamp,
    /// Name of the lesson that it was part of.
    pub lesson: Option<String>,
    /// Where it was read from, such as a recording's path. It stays in the class's file and is in no statement.
    pub source: Option<String>,
    /// Its score; `None` where it was not scored.
    pub score: Option<Score>,
    /// The attempt.
    pub attempt: Attempt,
}

impl Entry {
    /// Wall-clock time at a simulated time of the run, s. Where the simulation is slower than the wall clock, the end of an attempt is
    /// dated too early.
    pub fn time_of(&self, t_s: f64) -> Timestamp {
        later(self.begun, t_s - self.attempt.begun_s)
    }

    /// Simulated duration of the attempt, s; up to its last event where the recording breaks off.
    pub fn duration_s(&self) -> f64 {
        let attempt = &self.attempt;
        let happened = attempt.pours.iter().map(|pour| pour.until_s);
        let happened = happened.chain(attempt.incidents.iter().map(|incident| incident.until_s));
        let end = match &attempt.ending {
            Some(ending) => ending.t_s,
            None => happened.fold(attempt.begun_s, f64::max),
        };
        whole_nanoseconds((end - attempt.begun_s).max(0.0))
    }
}

/// Points of an attempt, from 0 to a most.
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    raw: f64,
    max: f64,
    /// The points by criterion.
    pub points: Vec<Points>,
    /// What caps the points, the lowest cap first.
    pub caps: Vec<Cap>,
}

/// A cap of a score, for a danger that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Cap {
    /// The danger, in a word such as `no-goggles`.
    pub danger: String,
    /// Most points that it leaves.
    pub max: f64,
}

/// Points of one criterion.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    /// The criterion.
    pub criterion: String,
    /// Points given.
    pub raw: f64,
    /// Most points.
    pub max: f64,
}

/// The numbers are no score.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{raw} of {max} points are no score: the most is above 0, and the points are from 0 to it")]
pub struct ScoreError {
    raw: f64,
    max: f64,
}

impl Score {
    /// `raw` points of at most `max`.
    ///
    /// # Errors
    /// [`ScoreError`] where a number is not finite or out of range.
    pub fn new(raw: f64, max: f64) -> Result<Self, ScoreError> {
        if !(max.is_finite() && max > 0.0 && (0.0..=max).contains(&raw)) {
            return Err(ScoreError { raw, max });
        }
        Ok(Self {
            raw,
            max,
            points: Vec::new(),
            caps: Vec::new(),
        })
    }

    /// Points given.
    pub fn raw(&self) -> f64 {
        self.raw
    }

    /// Most points.
    pub fn max(&self) -> f64 {
        self.max
    }

    /// Points given over most points, 0 to 1.
    pub fn scaled(&self) -> f64 {
        self.raw / self.max
    }
}

/// A sitting, which may have several attempts: a recording, or a time in the headset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Session {
    /// Its identifier. A recording that is read again has the same one, so that nothing is kept twice.
    pub id: Uuid,
    /// Wall-clock time at the run's simulated time 0.
    pub begun: Timestamp,
}

impl Session {
    /// A sitting that begins now.
    pub fn now() -> Self {
        Self {
            id: Uuid::new_v4(),
            begun: Timestamp::now(),
        }
    }

    /// The sitting of a recording with this content: the same whenever and wherever it is read.
    pub fn of_recording(content: &[u8], begun: Timestamp) -> Self {
        Self {
            id: Uuid::new_v5(&crate::xapi::OURS, content),
            begun,
        }
    }

    /// Identifier of its attempt of that index.
    pub fn attempt_id(&self, index: usize) -> Uuid {
        Uuid::new_v5(&self.id, format!("attempt/{index}").as_bytes())
    }

    /// Wall-clock time at a simulated time of the run, s.
    pub fn time_of(&self, t_s: f64) -> Timestamp {
        later(self.begun, t_s)
    }
}

/// Adds simulated seconds; a number from a file that gives no valid time is dated to the beginning.
fn later(begun: Timestamp, by_s: f64) -> Timestamp {
    let by = SignedDuration::try_from_secs_f64(by_s).unwrap_or_default();
    begun.checked_add(by).unwrap_or(begun)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::example;

    /// 9.3 - 0.7 is 8.600000000000001.
    #[test]
    fn a_duration_is_of_whole_nanoseconds() {
        let mut attempt = example::attempt();
        attempt.begun_s = 0.7;
        attempt.ending.as_mut().unwrap().t_s = 9.3;
        let entry = Entry {
            id: Uuid::nil(),
            pseudonym: "p07".parse().unwrap(),
            begun: "2026-03-01T08:00:00Z".parse().unwrap(),
            lesson: None,
            source: None,
            score: None,
            attempt,
        };
        assert_eq!(entry.duration_s(), 8.6);
    }

    #[test]
    fn a_score_is_a_part_of_its_most() {
        let score = Score::new(13.0, 20.0).unwrap();
        assert_eq!(
            (score.raw(), score.max(), score.scaled()),
            (13.0, 20.0, 0.65)
        );
        let not = [
            (1.0, 0.0),
            (-1.0, 5.0),
            (6.0, 5.0),
            (f64::NAN, 5.0),
            (1.0, f64::INFINITY),
        ];
        for (raw, max) in not {
            assert!(Score::new(raw, max).is_err(), "{raw} of {max}");
        }
    }

    #[test]
    fn no_time_that_a_file_says_is_too_much() {
        let session = Session {
            id: Uuid::nil(),
            begun: "2026-03-01T08:00:00Z".parse().unwrap(),
        };
        let time = |t_s| session.time_of(t_s).to_string();
        assert_eq!(time(61.5), "2026-03-01T08:01:01.5Z");
        for wild in [f64::NAN, f64::INFINITY, 1e300, -1e18] {
            assert_eq!(time(wild), "2026-03-01T08:00:00Z");
        }
    }
}
