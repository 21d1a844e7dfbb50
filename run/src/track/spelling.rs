//! How a track spells actions: as switches, each a key and a value, beside the poses of the step before which they are done.

use thiserror::Error;
use vitriol_lesson::procedure::MOST_ANSWERS;
use vitriol_sim::scene::PictureFilter;
use vitriol_xr::Switch;

use crate::action::Action;
use crate::arguments::effort;

/// Keys of switches.
pub mod key {
    /// [`Action::Scene`](crate::Action::Scene).
    pub const SCENE: &str = "scene";
    /// [`Action::Start`](crate::Action::Start).
    pub const START: &str = "start";
    /// [`Action::Solver`](crate::Action::Solver), such as `8x4`.
    pub const SOLVER: &str = "solver";
    /// [`Action::Glass`](crate::Action::Glass).
    pub const GLASS: &str = "glass";
    /// [`Action::Leap`](crate::Action::Leap).
    pub const PLACEMENT: &str = "stage_from_scene";
    /// [`Action::Resolution`](crate::Action::Resolution).
    pub const RESOLUTION: &str = "resolution";
    /// [`Action::Filter`](crate::Action::Filter), as `--filter` takes it.
    pub const FILTER: &str = "filter";
    /// [`Action::Foveation`](crate::Action::Foveation), as `--foveation` takes it.
    pub const FOVEATION: &str = "foveation";
    /// [`Action::Intensity`](crate::Action::Intensity).
    pub const K_V: &str = "k_v";
    /// [`Action::Pause`](crate::Action::Pause).
    pub const TIME: &str = "time";
    /// [`Action::Speed`](crate::Action::Speed).
    pub const SPEED: &str = "speed";
    /// [`Action::Mute`](crate::Action::Mute).
    pub const BOILING: &str = "boiling";
    /// [`Action::Message`](crate::Action::Message).
    pub const MESSAGE: &str = "message";
    /// [`Action::Hint`](crate::Action::Hint), [`Action::Skip`](crate::Action::Skip), [`Action::Answer`](crate::Action::Answer),
    /// [`Action::Finish`](crate::Action::Finish).
    pub const LESSON: &str = "lesson";
}

/// Values where it is off and where it is on.
const GLASS: [&str; 2] = ["holds", "breaks"];
const TIME: [&str; 2] = ["goes on", "is held"];
const BOILING: [&str; 2] = ["heard", "muted"];
const FOVEATION: [&str; 2] = ["off", "fixed"];

const HINT: &str = "hint ";
const SKIP: &str = "skip ";
const ANSWER: &str = "answer ";
const FINISH: &str = "finish";

/// A track has a switch whose value its key does not take.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("a switch of {key} to {value:?}: give {expected}")]
pub struct SpellingError {
    /// The switch's key.
    pub key: String,
    /// Its value.
    pub value: String,
    /// What its key takes.
    pub expected: String,
}

impl Action {
    /// As a track spells it.
    pub fn switch(&self) -> Switch {
        let either = |names: [&str; 2], on: &bool| names[usize::from(*on)].to_owned();
        let of = |start: &str, step: &Option<String>| match step {
            Some(step) => format!("{start}{step}"),
            None => start.trim_end().to_owned(),
        };
        let (key, value) = match self {
            Self::Scene(name) => (key::SCENE, name.clone()),
            Self::Start(name) => (key::START, name.clone().unwrap_or_default()),
            Self::Solver([substeps, iterations]) => {
                (key::SOLVER, format!("{substeps}x{iterations}"))
            }
            Self::Glass(breaks) => (key::GLASS, either(GLASS, breaks)),
            Self::Leap(place) => (key::PLACEMENT, place.clone()),
            Self::Resolution(share) => (key::RESOLUTION, share.to_string()),
            Self::Filter(filter) => (key::FILTER, filter.name().to_owned()),
            Self::Foveation(on) => (key::FOVEATION, either(FOVEATION, on)),
            Self::Intensity(k_v) => (key::K_V, k_v.to_string()),
            Self::Pause(on) => (key::TIME, either(TIME, on)),
            Self::Speed(rate) => (key::SPEED, rate.to_string()),
            Self::Mute(on) => (key::BOILING, either(BOILING, on)),
            Self::Message(text) => (key::MESSAGE, text.clone()),
            Self::Hint(step) => (key::LESSON, of(HINT, step)),
            Self::Skip(step) => (key::LESSON, of(SKIP, step)),
            Self::Answer { step, answer } => {
                (key::LESSON, format!("{} {answer}", of(ANSWER, step)))
            }
            Self::Finish => (key::LESSON, FINISH.to_owned()),
        };
        Switch {
            key: key.to_owned(),
            value,
        }
    }

    /// What a switch of a track spells; `None` of a key that this version does not know, and of what only a session's pictures were
    /// drawn with.
    ///
    /// # Errors
    /// [`SpellingError`] of a value that its key does not take.
    pub fn of(switch: &Switch) -> Result<Option<Self>, SpellingError> {
        let Switch { key, value } = switch;
        let number = |of: fn(f64) -> Self| {
            let number = value.parse().ok().filter(|it: &f64| it.is_finite());
            number.filter(|it| *it >= 0.0).map(of)
        };
        let either = |names: [&str; 2], of: fn(bool) -> Self| {
            let found = names.iter().position(|name| name == value);
            found.map(|at| of(at == 1))
        };
        let step = |start: &str| value.strip_prefix(start).filter(|step| !step.is_empty());
        let quoted = |names: [&str; 2]| format!("“{}” or “{}”", names[0], names[1]);
        let a_number = || "a number of 0 or more".to_owned();
        let (read, expected) = match key.as_str() {
            key::SCENE => return Ok(Some(Self::Scene(value.clone()))),
            key::START => return Ok(Some(Self::Start(Some(value.clone())))),
            key::PLACEMENT => return Ok(Some(Self::Leap(value.clone()))),
            key::MESSAGE => return Ok(Some(Self::Message(value.clone()))),
            key::RESOLUTION => return Ok(number(Self::Resolution)),
            key::FOVEATION => return Ok(either(FOVEATION, Self::Foveation)),
            key::FILTER => {
                let mut filters = PictureFilter::ALL.into_iter();
                return Ok(filters.find(|it| it.name() == value).map(Self::Filter));
            }
            key::SOLVER => match effort(value) {
                Ok(effort) => (Some(Self::Solver(effort)), String::new()),
                Err(_) => (None, "substeps and iterations, such as 8x4".to_owned()),
            },
            key::GLASS => (either(GLASS, Self::Glass), "holds or breaks".to_owned()),
            key::K_V => (number(Self::Intensity), a_number()),
            key::SPEED => (number(Self::Speed), a_number()),
            key::TIME => (either(TIME, Self::Pause), quoted(TIME)),
            key::BOILING => (either(BOILING, Self::Mute), quoted(BOILING)),
            key::LESSON => {
                let read = match (step(HINT), step(SKIP)) {
                    (Some(step), _) => Some(Self::Hint(Some(step.to_owned()))),
                    (_, Some(step)) => Some(Self::Skip(Some(step.to_owned()))),
                    _ if value == FINISH => Some(Self::Finish),
                    _ => step(ANSWER).and_then(answered),
                };
                let expected = format!(
                    "“{HINT}STEP”, “{SKIP}STEP”, “{ANSWER}STEP NUMBER” with a number from 1 to {MOST_ANSWERS}, or “{FINISH}”"
                );
                (read, expected)
            }
            _ => return Ok(None),
        };
        read.map(Some).ok_or_else(|| SpellingError {
            key: key.clone(),
            value: value.clone(),
            expected,
        })
    }
}

/// The action of a step's id and an answer's number.
fn answered(text: &str) -> Option<Action> {
    let (step, answer) = text.rsplit_once(' ')?;
    let answer = answer.parse().ok()?;
    let is_one = !step.is_empty() && (1..=MOST_ANSWERS).contains(&answer);
    is_one.then(|| Action::Answer {
        step: Some(step.to_owned()),
        answer,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_lesson::Lesson;
    use vitriol_lesson::procedure::Condition;

    fn switch(key: &str, value: &str) -> Switch {
        Switch {
            key: key.into(),
            value: value.into(),
        }
    }

    #[test]
    fn each_action_is_read_as_it_was_spelt() {
        let step = Some("put-down".to_owned());
        for action in [
            Action::Scene("beaker".into()),
            Action::Start(Some("beaker".into())),
            Action::Solver([8, 4]),
            Action::Glass(true),
            Action::Glass(false),
            Action::Leap("0.1 0.2 0.3 1.5".into()),
            Action::Resolution(0.75),
            Action::Filter(PictureFilter::NarrowRange),
            Action::Foveation(true),
            Action::Intensity(0.1),
            Action::Pause(true),
            Action::Pause(false),
            Action::Speed(0.25),
            Action::Mute(true),
            Action::Mute(false),
            Action::Message("Put the flask down: “now”.".into()),
            Action::Message(String::new()),
            Action::Hint(step.clone()),
            Action::Skip(step.clone()),
            Action::Answer { step, answer: 3 },
            Action::Finish,
        ] {
            assert_eq!(Action::of(&action.switch()), Ok(Some(action)));
        }
    }

    /// As earlier versions wrote them: what is in a file stays readable.
    #[test]
    fn files_have_these_words() {
        for (action, key, value) in [
            (Action::Solver([8, 4]), "solver", "8x4"),
            (Action::Glass(true), "glass", "breaks"),
            (Action::Pause(true), "time", "is held"),
            (Action::Mute(true), "boiling", "muted"),
            (Action::Foveation(true), "foveation", "fixed"),
            (Action::Skip(Some("pour".into())), "lesson", "skip pour"),
            (
                Action::Answer {
                    step: Some("explain".into()),
                    answer: 2,
                },
                "lesson",
                "answer explain 2",
            ),
            (Action::Leap("x".into()), "stage_from_scene", "x"),
        ] {
            assert_eq!(action.switch(), switch(key, value));
        }
    }

    #[test]
    fn what_is_no_action_is_left_alone_or_refused() {
        for (key, value) in [("scenario", "incorrect"), ("filter", "new"), ("x", "")] {
            assert_eq!(Action::of(&switch(key, value)), Ok(None));
        }
        for (key, value, words) in [
            ("solver", "8", "such as 8x4"),
            ("glass", "melts", "holds or breaks"),
            ("k_v", "-1", "a number of 0 or more"),
            ("k_v", "inf", "a number of 0 or more"),
            ("speed", "slow", "a number of 0 or more"),
            ("time", "held", "“goes on” or “is held”"),
            ("boiling", "", "“heard” or “muted”"),
            ("lesson", "hint", "“skip STEP”"),
            ("lesson", "hint ", "“skip STEP”"),
            ("lesson", "skip ", "“skip STEP”"),
            ("lesson", "finish it", "“skip STEP”"),
            ("lesson", "", "“skip STEP”"),
            ("lesson", "answer explain", "“answer STEP NUMBER”"),
            ("lesson", "answer  2", "“answer STEP NUMBER”"),
            ("lesson", "answer explain 0", "from 1 to 3"),
            ("lesson", "answer explain 4", "from 1 to 3"),
            ("lesson", "answer explain two", "from 1 to 3"),
        ] {
            let said = Action::of(&switch(key, value)).unwrap_err().to_string();
            assert!(said.contains(words) && said.contains(key), "{said}");
        }
    }

    /// Without them the lesson would stop at its first question, and no film of it would show what it is about.
    #[test]
    fn the_tracks_of_the_wrong_order_answer_their_lessons_questions() {
        for name in ["wrong-order", "wrong-order-layered", "wrong-order-hot"] {
            answers(name);
        }
    }

    /// The track of this name has the lesson's scene, and gives each answer that is asked for, a right one where there is one.
    fn answers(name: &str) {
        let lesson = Lesson::builtin(name).unwrap();
        let track = crate::track::load(name).unwrap();
        assert_eq!(track.metadata.scene, lesson.scene);
        let switches = track.frames.iter().flat_map(|frame| &frame.scenario);
        let given: Vec<Action> = switches.filter_map(|it| Action::of(it).unwrap()).collect();
        let asked = lesson.steps.iter().filter_map(|step| match step.condition {
            Condition::Answered(question) => Some((step.id.clone(), question)),
            _ => None,
        });
        let asked: Vec<_> = asked.collect();
        assert_eq!(given.len(), asked.len());
        for (given, (id, question)) in given.into_iter().zip(asked) {
            let Action::Answer { step, answer } = given else {
                unreachable!("{given:?}")
            };
            assert_eq!(step, Some(id));
            assert!(question.has(answer) && question.right.is_none_or(|it| it == answer));
        }
    }
}
