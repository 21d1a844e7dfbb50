//! Questions: predictions, explanations, and lessons that ask wrongly.

use super::*;
use crate::{Language, Texts};

/// A lesson of a prediction, an explanation whose second answer is right, and a step of another kind.
fn asking() -> String {
    let steps = [
        ("predict", "condition = { answered = { answers = 2 } }"),
        (
            "explain",
            "condition = { answered = { answers = 3, right = 2 } }",
        ),
        ("lift", "condition = { lifted = { flask = \"a\" } }"),
    ];
    let text = text(&steps, &[("whole", "{ never = \"dropped\" }")]);
    let given = |text: String, id: &str, answers: &str| {
        let from = format!("Do {id}.\", hint = \"So.\"");
        text.replace(&from, &format!("{from}, answers = [{answers}]"))
    };
    let text = given(text, "predict", "\"Yes.\", \"No.\"");
    given(text, "explain", "\"Air.\", \"Heat.\", \"Glass.\"").replace(", \"examination\"", "")
}

fn run(mode: Mode) -> Run {
    Run::new(Lesson::parse(&asking(), "own.toml").unwrap(), mode)
}

impl Run {
    fn answer(&mut self, id: &str, answer: u8) -> usize {
        let said = self.procedure.answer(id, answer, self.t);
        let count = said.len();
        self.said.extend(said);
        count
    }
}

#[test]
fn a_prediction_takes_each_answer() {
    for answer in [1, 2] {
        let mut run = run(Mode::Guided);
        run.wait(1.0);
        assert_eq!(run.status("predict"), Status::Open);
        assert_eq!(run.procedure.question().unwrap().0, "predict");
        run.answer("predict", answer);
        let line = run.line("predict");
        assert_eq!((line.met, line.points), (true, 10));
        assert_eq!(line.evidence_s, Some(run.t));
        assert_eq!(run.procedure.question().unwrap().0, "explain");
    }
}

/// The lesson goes on without its points, and with the text of the right answer.
#[test]
fn an_explanation_has_points_for_the_right_answer_alone() {
    for answer in [1, 2, 3] {
        let mut run = run(Mode::Guided);
        run.answer("predict", 1);
        run.answer("explain", answer);
        let line = run.line("explain");
        let is_right = answer == 2;
        assert_eq!(line.met, is_right);
        assert_eq!(line.points, if is_right { 10 } else { 0 });
        let became = if is_right { "done" } else { "failed" };
        assert_eq!(line.became().name(), became);
        assert_eq!(run.status("lift"), Status::Open);
        assert_eq!(run.procedure.question(), None);
        // One answer is taken.
        assert_eq!(run.answer("explain", 2), 0);
        assert_eq!(run.line("explain"), line);
        let said: Vec<String> = run.whys().iter().map(|why| told(&run, why)).collect();
        let expected = match is_right {
            true => Vec::new(),
            false => vec![format!(
                "Answer {answer} was given, and answer 2 is right. Heat."
            )],
        };
        assert_eq!(said, expected);
    }
}

fn told(run: &Run, why: &Why) -> String {
    let lesson = run.procedure.lesson().texts(Language::En);
    Texts::english().unwrap().why_of(lesson, "explain", why)
}

#[test]
fn what_is_no_answer_is_not_taken() {
    let mut run = run(Mode::Guided);
    for (id, answer) in [
        ("predict", 0),
        ("predict", 3),
        ("predict", 255),
        ("explain", 2),
        ("lift", 1),
        ("other", 1),
    ] {
        assert_eq!(run.answer(id, answer), 0, "{id} {answer}");
    }
    assert_eq!(run.status("predict"), Status::Open);
    run.procedure.finish(run.t);
    assert_eq!(run.answer("predict", 1), 0);
}

/// In `free` the questions are open together, and a lesson that begins again asks again.
#[test]
fn questions_are_asked_again_from_the_start() {
    let mut run = run(Mode::Free);
    run.answer("explain", 1);
    assert_eq!(run.procedure.question().unwrap().0, "predict");
    run.answer("predict", 2);
    let first = run.procedure.verdict();
    run.hear(&[begun(run.t)]);
    assert_eq!(run.status("explain"), Status::Open);
    run.answer("explain", 2);
    let second = run.procedure.verdict();
    assert_ne!(first, second);
    // As a recording keeps it.
    let kept = serde_json::to_string(&run.said).unwrap();
    let read: Vec<Progress> = serde_json::from_str(&kept).unwrap();
    let lesson = run.procedure.lesson();
    assert_eq!(Verdict::retold(lesson, Mode::Free, &read), [first, second]);
}

/// What spoils them => by what => what is told.
const SPOILED: &str = r#"
answers = 3, right = 2 => answers = 4, right = 2 => step 2, condition.answered.answers: 4 | 1 to 3
answers = 3, right = 2 => answers = 0 => step 2, condition.answered.answers: 0 | 1 to 3
right = 2 => right = 4 => step 2, condition.answered.right: 4 | 1 to 3
right = 2 => right = -1 => `-1` does not fit
right = 2 => wrong = 2 => unknown field `wrong` | `right`
{ answered = { answers = 2 } } => { all = [{ answered = { answers = 2 } }] } => step 1, condition.all 1, answered: | make a step of it
"Yes.", "No." => "Yes." => texts.en.step.predict.answers: has 1 | asks for 2
Do lift.", hint = "So." => Do lift.", hint = "So.", answers = ["Yes."] => texts.en.step.lift.answers: has 1 | asks for 0
"Heat." => "" => texts.en.step.explain.answers 2: empty
"free" => "free", "examination" => modes: | "examination" | questions
"#;

#[test]
fn a_question_that_is_spoiled_is_refused() {
    let good = asking();
    assert_each_is_refused(&good, SPOILED);
    let long = good.replace("\"Heat.\"", &format!("\"{}\"", "x".repeat(51)));
    let error = Lesson::parse(&long, "bad.toml").unwrap_err().to_string();
    assert!(error.contains("answers 2: 51 characters"), "{error}");
}
