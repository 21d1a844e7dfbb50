//! What an instructor did to a session while it ran, as a track keeps it: a switch beside the poses, before the step from which on it
//! counted.

use vitriol_xr::Switch;

/// Something that an instructor did.
#[derive(Clone, Debug, PartialEq)]
pub enum Instruction {
    /// The boiling's coefficient k_v from then on.
    Intensity(f64),
    /// Whether simulated time was held. No step was taken meanwhile.
    Pause(bool),
    /// Simulated seconds a second from then on. Steps are as long as ever.
    Speed(f64),
    /// Whether the boiling is muted, for ears and hands.
    Spare(bool),
    /// What the student was told; an empty text takes it away.
    Message(String),
}

const K_V: &str = "k_v";
const TIME: &str = "time";
const SPEED: &str = "speed";
const BOILING: &str = "boiling";
const MESSAGE: &str = "message";
/// Values where it is off and where it is on.
const HELD: [&str; 2] = ["goes on", "is held"];
const MUTED: [&str; 2] = ["heard", "muted"];

impl Instruction {
    /// As a track keeps it.
    pub fn switch(&self) -> Switch {
        let (key, value) = match self {
            Self::Intensity(value) => (K_V, value.to_string()),
            Self::Pause(on) => (TIME, HELD[usize::from(*on)].to_owned()),
            Self::Speed(rate) => (SPEED, rate.to_string()),
            Self::Spare(on) => (BOILING, MUTED[usize::from(*on)].to_owned()),
            Self::Message(text) => (MESSAGE, text.clone()),
        };
        Switch {
            key: key.to_owned(),
            value,
        }
    }

    /// What a switch of a track stands for; `None` for one of another kind.
    ///
    /// # Errors
    /// What its value would have to be.
    pub fn of(switch: &Switch) -> Option<Result<Self, String>> {
        let Switch { key, value } = switch;
        let number = |of: fn(f64) -> Self| {
            let number = value.parse().ok().filter(|it: &f64| it.is_finite());
            number.filter(|it| *it >= 0.0).map(of)
        };
        let either = |names: [&str; 2], of: fn(bool) -> Self| {
            let found = names.iter().position(|name| name == value);
            found.map(|at| of(at == 1))
        };
        let read = match key.as_str() {
            K_V => number(Self::Intensity),
            SPEED => number(Self::Speed),
            TIME => either(HELD, Self::Pause),
            BOILING => either(MUTED, Self::Spare),
            MESSAGE => Some(Self::Message(value.clone())),
            _ => return None,
        };
        Some(read.ok_or_else(|| {
            let words = match key.as_str() {
                TIME => format!("“{}” or “{}”", HELD[0], HELD[1]),
                BOILING => format!("“{}” or “{}”", MUTED[0], MUTED[1]),
                _ => "a number of 0 or more".to_owned(),
            };
            format!("a switch of {key} to {value:?}: it is {words}")
        }))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_track_keeps_each_as_it_was() {
        for instruction in [
            Instruction::Intensity(0.1),
            Instruction::Pause(true),
            Instruction::Pause(false),
            Instruction::Speed(0.25),
            Instruction::Spare(true),
            Instruction::Spare(false),
            Instruction::Message("Put the flask down: “now”.".into()),
            Instruction::Message(String::new()),
        ] {
            let read = Instruction::of(&instruction.switch());
            assert_eq!(read, Some(Ok(instruction)));
        }
    }

    #[test]
    fn what_is_none_is_left_alone_or_refused() {
        let switch = |key: &str, value: &str| Switch {
            key: key.into(),
            value: value.into(),
        };
        assert_eq!(Instruction::of(&switch("solver", "8x4")), None);
        for (key, value, words) in [
            ("k_v", "-1", "a number of 0 or more"),
            ("k_v", "inf", "a number of 0 or more"),
            ("speed", "slow", "a number of 0 or more"),
            ("time", "held", "“goes on” or “is held”"),
            ("boiling", "", "“heard” or “muted”"),
        ] {
            let said = Instruction::of(&switch(key, value)).unwrap().unwrap_err();
            assert!(said.contains(words) && said.contains(key), "{said}");
        }
    }
}
