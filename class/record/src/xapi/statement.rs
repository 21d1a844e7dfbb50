//! An attempt as statements: its beginning, its incidents, its end.

use jiff::Timestamp;
use serde::{Serialize, Serializer};
use serde_json::Value;
use uuid::Uuid;

use super::activity::{Activity, Words, english};
use super::incident::{Extensions, Kind, extensions};
use super::vocabulary::{ABANDONED, COMPLETED, INITIALIZED, Key, Verb as Published, home_page};
use crate::Entry;

/// An xAPI statement: actor, verb, object and result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Statement {
    /// Identifier, derived from the attempt: a statement that is made and sent twice is stored once.
    pub id: Uuid,
    actor: Actor,
    verb: Verb,
    object: Activity,
    #[serde(skip_serializing_if = "Option::is_none")]
    result: Option<Outcome>,
    context: Context,
    #[serde(serialize_with = "to_milliseconds")]
    timestamp: Timestamp,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
struct Actor {
    object_type: &'static str,
    account: Account,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
struct Account {
    home_page: String,
    name: String,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Verb {
    id: &'static str,
    display: Words,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Outcome {
    #[serde(skip_serializing_if = "Option::is_none")]
    score: Option<Scored>,
    #[serde(skip_serializing_if = "Option::is_none")]
    completion: Option<bool>,
    duration: String,
    #[serde(skip_serializing_if = "Extensions::is_empty")]
    extensions: Extensions,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Scored {
    scaled: f64,
    raw: f64,
    min: f64,
    max: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
struct Context {
    /// The attempt's identifier.
    registration: Uuid,
    #[serde(skip_serializing_if = "Around::is_empty")]
    context_activities: Around,
    platform: &'static str,
    language: &'static str,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Around {
    #[serde(skip_serializing_if = "Vec::is_empty")]
    parent: Vec<Activity>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    grouping: Vec<Activity>,
}

impl Around {
    fn is_empty(&self) -> bool {
        self.parent.is_empty() && self.grouping.is_empty()
    }
}

/// The statements of an attempt of a student of the class with this identifier, in the order of their times: the first that it
/// began, the last that it ended.
pub fn statements(class: Uuid, entry: &Entry) -> Vec<Statement> {
    let attempt = &entry.attempt;
    let scene = || Activity::scene(&attempt.scene);
    let mut all = Vec::with_capacity(attempt.incidents.len() + 2);
    let mut say = |verb: &Published, object, result, parent: Vec<Activity>, timestamp| {
        let position = all.len();
        all.push(Statement {
            id: Uuid::new_v5(&entry.id, format!("statement/{position}").as_bytes()),
            actor: Actor {
                object_type: "Agent",
                account: Account {
                    home_page: home_page(class),
                    name: entry.pseudonym.to_string(),
                },
            },
            verb: Verb {
                id: verb.0,
                display: english(verb.1),
            },
            object,
            result,
            context: Context {
                registration: entry.id,
                context_activities: Around {
                    parent,
                    grouping: entry.lesson.iter().map(|it| Activity::lesson(it)).collect(),
                },
                platform: "Vitriol",
                language: "en",
            },
            timestamp,
        });
    };
    say(&INITIALIZED, scene(), None, Vec::new(), entry.begun);
    for incident in &attempt.incidents {
        let kind = Kind::of(&incident.what);
        let extensions = extensions(incident);
        let object = kind.activity(&extensions);
        let result = Outcome {
            duration: duration(incident.until_s - incident.t_s),
            extensions,
            ..Outcome::default()
        };
        let time = entry.time_of(incident.t_s);
        say(&kind.verb, object, Some(result), vec![scene()], time);
    }
    let verb = if attempt.ending.is_some() {
        COMPLETED
    } else {
        ABANDONED
    };
    let end = entry.time_of(attempt.begun_s + entry.duration_s());
    say(&verb, scene(), Some(outcome(entry)), Vec::new(), end);
    all
}

/// Result of the attempt.
fn outcome(entry: &Entry) -> Outcome {
    let mut extensions = Extensions::new();
    if let Some(ending) = &entry.attempt.ending {
        let hottest = ending.hottest.as_ref().map(|hottest| hottest.temperature_c);
        let amounts = [
            ("hottest_c", hottest),
            ("bench_m3", Some(ending.bench_m3)),
            ("floor_m3", Some(ending.floor_m3)),
        ];
        for (name, amount) in amounts {
            let amount = amount.filter(|amount| amount.is_finite());
            if let (Some(key), Some(amount)) = (Key::named(name), amount) {
                extensions.insert(key.iri(), amount.into());
            }
        }
    }
    let score = entry.score.as_ref();
    let caps = score.map_or(&[][..], |score| score.caps.as_slice());
    if let [lowest, ..] = caps {
        let dangers: Vec<&str> = caps.iter().map(|cap| cap.danger.as_str()).collect();
        let values: [(&str, Value); 2] =
            [("caps", dangers.into()), ("cap_points", lowest.max.into())];
        for (name, value) in values {
            if let Some(key) = Key::named(name) {
                extensions.insert(key.iri(), value);
            }
        }
    }
    Outcome {
        score: score.map(|score| Scored {
            scaled: score.scaled(),
            raw: score.raw(),
            min: 0.0,
            max: score.max(),
        }),
        completion: Some(entry.attempt.ending.is_some()),
        duration: duration(entry.duration_s()),
        extensions,
    }
}

/// A duration in ISO 8601, to the hundredth of a second that stores compare (1.0.3, Data, 4.6).
fn duration(seconds: f64) -> String {
    let seconds = if seconds.is_finite() {
        seconds.max(0.0)
    } else {
        0.0
    };
    format!("PT{seconds:.2}S")
}

/// A time to the millisecond: a store keeps at least these (1.0.3, Data, 4.5).
fn to_milliseconds<S: Serializer>(time: &Timestamp, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("{time:.3}"))
}
