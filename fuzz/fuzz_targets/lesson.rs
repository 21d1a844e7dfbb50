//! The reader of lessons: any text is a lesson or a message, never a crash; what is one can be judged.
#![no_main]

use libfuzzer_sys::fuzz_target;
use vitriol_lesson::{Lesson, Mode, Procedure, Sight};

fuzz_target!(|text: &str| {
    let Ok(lesson) = Lesson::parse(text, "fuzz.toml") else {
        return;
    };
    for mode in Mode::ALL {
        let mut judge = Procedure::new(lesson.clone(), mode);
        for second in 0..4 {
            let sight = Sight { t_s: f64::from(second), ..Sight::default() };
            judge.advance(&sight, &[]);
        }
        let verdict = judge.verdict();
        assert!(verdict.points <= verdict.of);
    }
});
