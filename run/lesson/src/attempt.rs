//! An attempt, collected from its events.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::event::{Contents, Ending, Event, Incident, Pour};
use crate::glass::Glassware;

/// What a student did from the start of a scene to its end, or to the next start.
#[derive(Clone, Debug, Default, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Attempt {
    /// When it began, simulated time of the run, s.
    pub begun_s: f64,
    /// Name of the scene.
    pub scene: String,
    /// What each flask held at the start.
    pub contents: Contents,
    /// What each flask is, as texts name it; empty in reports and recordings of older versions.
    #[serde(default, skip_serializing_if = "Glassware::is_empty")]
    pub glass: Glassware,
    /// Pours, in order of the time at which their first liquid arrived.
    pub pours: Vec<Pour>,
    /// Incidents, in order of the time at which they began.
    pub incidents: Vec<Incident>,
    /// How it ended; `None` where the recording breaks off before the end.
    pub ending: Option<Ending>,
}

impl Attempt {
    /// Groups `events` into attempts, in order. Each [`Event::Begun`] starts one; events before the first are dropped.
    pub fn all(events: impl IntoIterator<Item = Event>) -> Vec<Self> {
        let mut attempts: Vec<Self> = Vec::new();
        for event in events {
            if let Event::Begun {
                t_s,
                scene,
                contents,
                glass,
            } = event
            {
                attempts.push(Self {
                    begun_s: t_s,
                    scene,
                    contents,
                    glass,
                    pours: Vec::new(),
                    incidents: Vec::new(),
                    ending: None,
                });
                continue;
            }
            let Some(attempt) = attempts.last_mut() else {
                continue;
            };
            match event {
                Event::Poured(pour) => attempt.pours.push(pour),
                Event::Incident(incident) => attempt.incidents.push(incident),
                Event::Ended(ending) => attempt.ending = Some(ending),
                Event::Begun { .. } => {}
            }
        }
        for attempt in &mut attempts {
            // An event is emitted when it is over, so a long one comes after a short one that began later.
            attempt.pours.sort_by(|a, b| a.t_s.total_cmp(&b.t_s));
            attempt.incidents.sort_by(|a, b| a.t_s.total_cmp(&b.t_s));
        }
        attempts
    }
}
