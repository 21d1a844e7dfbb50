//! What a student asks of a lesson while going through it, as a track keeps it: a switch beside the poses, before the step from which on
//! it counts.

use vitriol_xr::Switch;

/// Something that a student asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wish {
    /// The hint of the step of that id.
    Hint(String),
    /// That step is left out.
    Skip(String),
    /// All is done.
    Finish,
}

const LESSON: &str = "lesson";
const HINT: &str = "hint ";
const SKIP: &str = "skip ";
const FINISH: &str = "finish";

impl Wish {
    /// As a track keeps it.
    pub fn switch(&self) -> Switch {
        Switch {
            key: LESSON.to_owned(),
            value: match self {
                Self::Hint(step) => format!("{HINT}{step}"),
                Self::Skip(step) => format!("{SKIP}{step}"),
                Self::Finish => FINISH.to_owned(),
            },
        }
    }

    /// What a switch of a track stands for; `None` for one of another kind.
    ///
    /// # Errors
    /// What its value would have to be.
    pub fn of(switch: &Switch) -> Option<Result<Self, String>> {
        let Switch { key, value } = switch;
        if key != LESSON {
            return None;
        }
        let step = |start: &str| value.strip_prefix(start).filter(|step| !step.is_empty());
        Some(match (step(HINT), step(SKIP)) {
            (Some(step), _) => Ok(Self::Hint(step.to_owned())),
            (_, Some(step)) => Ok(Self::Skip(step.to_owned())),
            _ if value == FINISH => Ok(Self::Finish),
            _ => Err(format!(
                "a switch of {LESSON} to {value:?}: it is “{HINT}STEP”, “{SKIP}STEP” or “{FINISH}”"
            )),
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_track_keeps_each_as_it_was() {
        let wishes = [
            Wish::Hint("put-down".into()),
            Wish::Skip("pour".into()),
            Wish::Finish,
        ];
        for wish in wishes {
            assert_eq!(Wish::of(&wish.switch()), Some(Ok(wish)));
        }
    }

    #[test]
    fn what_is_none_is_left_alone_or_refused() {
        let switch = |key: &str, value: &str| Switch {
            key: key.into(),
            value: value.into(),
        };
        assert_eq!(Wish::of(&switch("boiling", "hint pour")), None);
        for value in ["", "hint", "hint ", "skip ", "finish it", "done"] {
            let said = Wish::of(&switch("lesson", value)).unwrap().unwrap_err();
            assert!(said.contains("“skip STEP”"), "{said}");
        }
    }
}
