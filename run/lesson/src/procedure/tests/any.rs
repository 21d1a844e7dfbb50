//! Arbitrary files and observations.

use proptest::prelude::*;

use super::fits::facts;
use super::spoiled::GOOD;
use super::*;
use crate::Language;

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in ".{0,200}") {
        let _ = Lesson::parse(&text, "any.toml");
    }

    /// A valid file in which a piece is replaced by another piece of it, or removed.
    #[test]
    fn a_damaged_lesson_is_read_or_refused(
        at in 0..GOOD.len(), long in 0usize..60, from in 0..GOOD.len(), of in 0usize..60,
    ) {
        let bytes = GOOD.as_bytes();
        let piece = &bytes[from..(from + of).min(bytes.len())];
        let rest = &bytes[(at + long).min(bytes.len())..];
        let text = [&bytes[..at], piece, rest].concat();
        let text = String::from_utf8_lossy(&text);
        let _ = Lesson::parse_for(&text, ("any.toml", Language::En), |_| Ok(Some(facts())));
        if let Ok(lesson) = Lesson::parse(&text, "any.toml") {
            let mut procedure = Procedure::new(lesson, Mode::Guided);
            procedure.advance(&sight(1.0), &[ended(1.0)]);
        }
    }

    /// A judge takes any numbers without a panic.
    #[test]
    fn a_judge_bears_any_number(values in proptest::collection::vec(proptest::num::f64::ANY, 6)) {
        let lesson = Lesson::parse(GOOD, "good.toml").unwrap();
        for mode in Mode::ALL {
            let mut procedure = Procedure::new(lesson.clone(), mode);
            for t in &values {
                let mut sight = sight(*t);
                sight.flasks[1].temperature_c = Some(values[1]);
                sight.flasks[1].acid = values[2];
                procedure.advance(&sight, &[pour([values[3], values[4]], values[5], *t, 0.98), spilt(*t, *t)]);
            }
            let verdict = procedure.verdict();
            prop_assert!(verdict.points <= verdict.of);
        }
    }
}
