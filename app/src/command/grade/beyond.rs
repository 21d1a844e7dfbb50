//! In what a simulation differs from a recording by more than the tolerance: as a result keeps it, and in the teacher's words.

use serde::{Deserialize, Serialize};
use vitriol_lesson::procedure::Became;
use vitriol_lesson::{Skin, Surface, What};
use vitriol_run::in_a_line;

use super::wrong::Words;
use crate::report::outcome;

/// A difference. Of two values the first is in the recording, and the second was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Beyond {
    /// How many attempts there are.
    Attempts([usize; 2]),
    /// How often the lesson was begun.
    Lessons([usize; 2]),
    /// Something in an attempt.
    Thing {
        /// The attempt, counted from 1.
        attempt: u32,
        /// What differs.
        thing: Thing,
        /// How it differs.
        values: Values,
    },
}

/// What is compared in an attempt.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Thing {
    /// Pours between two flasks.
    Poured {
        /// The flask that they came from.
        from: String,
        /// The flask that they came to; `None` where they came to none.
        into: Option<String>,
    },
    /// Incidents of one kind in one place.
    Incident {
        /// The kind, as in a recording.
        kind: String,
        /// The place.
        place: Place,
    },
    /// The step of that id.
    Step(String),
    /// The rule of that id.
    Rule(String),
}

/// What tells incidents of one kind apart.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// A flask.
    Flask(String),
    /// A flask that broke.
    Broken(String),
    /// Bench or floor.
    Surface(Surface),
    /// Bare skin.
    Bare(Skin),
    /// What gloves or goggles protected.
    Protected(Skin),
}

/// Two values that differ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Values {
    /// Volumes, m³.
    Volumes([f64; 2]),
    /// How often it happened.
    Counts([usize; 2]),
    /// When it happened, simulated time of the run, s.
    Moments([f64; 2]),
    /// Points.
    Points([u32; 2]),
    /// What became of a step or a rule.
    Outcomes([Became; 2]),
}

impl Beyond {
    /// It in a few words.
    pub fn told(&self, words: &Words) -> String {
        let texts = &words.grades.verified;
        match self {
            Self::Attempts(numbers) => {
                let values = both(numbers.map(|it| it.to_string()), words);
                texts.attempts.fill(&[("values", &values)])
            }
            Self::Lessons(numbers) => {
                let values = both(numbers.map(|it| it.to_string()), words);
                texts.lessons.fill(&[("values", &values)])
            }
            Self::Thing {
                attempt,
                thing,
                values,
            } => {
                let mut what = thing.told(words);
                if matches!(values, Values::Points(_)) {
                    what = texts.points_of.fill(&[("what", &what)]);
                }
                let values = both(values.told(words), words);
                texts.attempt.fill(&[
                    ("number", &attempt.to_string()),
                    ("what", &what),
                    ("values", &values),
                ])
            }
        }
    }
}

impl Thing {
    /// It in a few words. Flasks, steps and rules have their names in their files.
    fn told(&self, words: &Words) -> String {
        let (texts, report) = (&words.grades.verified, &words.texts.report);
        match self {
            Self::Poured { from, into } => {
                let from = in_a_line(from);
                match into.as_deref().map(in_a_line) {
                    Some(into) => (texts.poured).fill(&[("from", &from), ("into", &into)]),
                    None => texts.poured_beside.fill(&[("from", &from)]),
                }
            }
            Self::Incident { kind, place } => {
                format!("{} ({})", words.grades.kind(kind), place.told(words))
            }
            Self::Step(id) => format!("{} {}", report.step, in_a_line(id)),
            Self::Rule(id) => format!("{} {}", report.rule, in_a_line(id)),
        }
    }
}

impl Place {
    /// Where something went wrong, and of how much liquid, m³, where it is one of liquid.
    pub fn of(what: &What) -> (Self, Option<f64>) {
        match what {
            What::WaterIntoAcid {
                flask, volume_m3, ..
            }
            | What::BoiledOver {
                flask, volume_m3, ..
            } => (Self::Flask(flask.clone()), Some(*volume_m3)),
            What::PouredTooFast { flask, .. } | What::Hot { flask, .. } => {
                (Self::Flask(flask.clone()), None)
            }
            What::Spilt {
                surface, volume_m3, ..
            } => (Self::Surface(*surface), Some(*volume_m3)),
            What::OnSkin {
                skin,
                volume_m3,
                protected,
                ..
            } => {
                let place = match protected {
                    true => Self::Protected(*skin),
                    false => Self::Bare(*skin),
                };
                (place, Some(*volume_m3))
            }
            What::Dropped { flask, broke, .. } => {
                let place = match broke {
                    true => Self::Broken(flask.clone()),
                    false => Self::Flask(flask.clone()),
                };
                (place, None)
            }
        }
    }

    fn told(&self, words: &Words) -> String {
        let texts = &words.grades.verified;
        let part = |skin: &Skin| match skin {
            Skin::LeftHand => texts.left_hand.clone(),
            Skin::RightHand => texts.right_hand.clone(),
            Skin::Face => texts.face.clone(),
        };
        match self {
            Self::Flask(name) => in_a_line(name),
            Self::Broken(name) => texts.broken.fill(&[("place", &in_a_line(name))]),
            Self::Surface(Surface::Bench) => texts.bench.clone(),
            Self::Surface(Surface::Floor) => texts.floor.clone(),
            Self::Bare(skin) => part(skin),
            Self::Protected(skin) => texts.protected.fill(&[("place", &part(skin))]),
        }
    }
}

impl Values {
    fn told(&self, words: &Words) -> [String; 2] {
        let at = &words.grades.verified.at;
        match self {
            Self::Volumes(both) => both.map(|it| format!("{} mL", two_decimals(1e6 * it, words))),
            Self::Counts(both) => both.map(|it| it.to_string()),
            Self::Moments(both) => both.map(|it| at.fill(&[("seconds", &two_decimals(it, words))])),
            Self::Points(both) => both.map(|it| it.to_string()),
            Self::Outcomes(both) => both.map(|it| outcome(it, &words.texts).to_string()),
        }
    }
}

/// What is in the recording, and what was found.
fn both([recorded, found]: [String; 2], words: &Words) -> String {
    let holes = [("recorded", &*recorded), ("found", &*found)];
    words.grades.verified.values.fill(&holes)
}

/// A number with two decimals and the mark of the language: a tolerance is a tenth of a second or of a millilitre.
pub fn two_decimals(number: f64, words: &Words) -> String {
    words.texts.with_decimal(&format!("{number:.2}"))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_lesson::Language;

    /// One of each kind, with what is told of it in English and in Spanish.
    #[test]
    fn each_difference_is_told_in_the_language_of_the_call() {
        let thing = |thing, values| Beyond::Thing {
            attempt: 2,
            thing,
            values,
        };
        let incident = |kind: &str, place| Thing::Incident {
            kind: kind.into(),
            place,
        };
        let poured = |into: Option<&str>| Thing::Poured {
            from: "a".into(),
            into: into.map(str::to_owned),
        };
        let cases = [
            (
                Beyond::Attempts([2, 1]),
                "attempts: 2 in the recording, 1 found",
                "intentos: 2 en la grabación, 1 en la simulación",
            ),
            (
                Beyond::Lessons([1, 0]),
                "times that the lesson was begun: 1 in the recording, 0 found",
                "veces que empezó la lección: 1 en la grabación, 0 en la simulación",
            ),
            (
                thing(poured(Some("b")), Values::Volumes([20e-6, 23.5e-6])),
                "attempt 2, poured from a into b: 20.00 mL in the recording, 23.50 mL found",
                "intento 2, vertido de a en b: 20,00 mL en la grabación, 23,50 mL en la simulación",
            ),
            (
                thing(poured(None), Values::Moments([1.0, 1.6])),
                "attempt 2, poured from a outside every vessel: at 1.00 s in the recording, \
                 at 1.60 s found",
                "intento 2, vertido de a fuera de todo recipiente: a los 1,00 s en la grabación, \
                 a los 1,60 s en la simulación",
            ),
            (
                thing(
                    incident("dropped", Place::Broken("a".into())),
                    Values::Counts([1, 0]),
                ),
                "attempt 2, dropped (a, broken): 1 in the recording, 0 found",
                "intento 2, caído (a, con rotura): 1 en la grabación, 0 en la simulación",
            ),
            (
                thing(
                    incident("on-skin", Place::Protected(Skin::LeftHand)),
                    Values::Volumes([0.0, 1e-6]),
                ),
                "attempt 2, on the skin (left hand, protected): 0.00 mL in the recording, \
                 1.00 mL found",
                "intento 2, sobre la piel (mano izquierda, con protección): \
                 0,00 mL en la grabación, 1,00 mL en la simulación",
            ),
            (
                thing(Thing::Step("pour".into()), Values::Points([10, 5])),
                "attempt 2, points of step pour: 10 in the recording, 5 found",
                "intento 2, paso pour, puntos: 10 en la grabación, 5 en la simulación",
            ),
            (
                thing(
                    Thing::Rule("cool".into()),
                    Values::Outcomes([Became::Kept, Became::Broken]),
                ),
                "attempt 2, rule cool: kept in the recording, broken found",
                "intento 2, regla cool: cumplida en la grabación, incumplida en la simulación",
            ),
        ];
        let [english, spanish] = [Language::En, Language::Es].map(|it| Words::of(it).unwrap());
        for (beyond, in_english, in_spanish) in cases {
            assert_eq!(beyond.told(&english), in_english);
            assert_eq!(beyond.told(&spanish), in_spanish);
            // As a result keeps it.
            let kept = serde_json::to_string(&beyond).unwrap();
            assert_eq!(serde_json::from_str::<Beyond>(&kept).unwrap(), beyond);
        }
    }
}
