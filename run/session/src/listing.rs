//! A lesson on the panel: its steps as the mode allows, and the actions that the user can ask for.

use vitriol_lesson::procedure::{State, Status, StepState};
use vitriol_lesson::{Language, Lesson, Mode, Procedure, Template, Texts};
use vitriol_run::Action;

use super::info::{ActLine, Mark, Shown};
use vitriol_run::texts::LessonTexts;

/// Lines of the panel that steps and a hint have together, and characters that a line has: as its font fits them at least. A Chinese one
/// is as wide as two.
const LINES: usize = 9;
const LINE: usize = 54;

/// The texts that a lesson is shown with.
#[derive(Clone, Copy)]
pub struct Words<'a> {
    /// The texts around a lesson's own.
    pub around: &'a LessonTexts,
    /// The texts of buttons and notes, in the lesson's language.
    pub texts: &'a Texts,
    /// That language.
    pub language: Language,
}

/// The panel's view of a lesson that is judged so. `hinted` is the step whose hint was given last, `failed` why something failed a short
/// time ago.
pub fn shown(
    judge: &Procedure,
    words: Words<'_>,
    hinted: Option<&str>,
    failed: Option<&str>,
) -> Shown {
    let (lesson, state) = (judge.lesson(), judge.state());
    let of_lesson = lesson.texts(words.language);
    let title = &of_lesson.title;
    if state.over {
        let verdict = judge.verdict();
        let points = words.around.points(verdict.points, verdict.of);
        return Shown {
            step: format!("{title}: {points}"),
            ..Shown::default()
        };
    }
    let hint = hint_of(&state, hinted).and_then(|id| of_lesson.step.get(id));
    let hint = hint.map(|step| step.hint.clone());
    let failed = failed.map(str::to_owned);
    let acts = acts(&state, hinted, words.texts);
    let asks = judge
        .question()
        .and_then(|(id, _)| of_lesson.step.get(id))
        .filter(|_| state.mode.tells());
    let answers = asks.map_or_else(Vec::new, |step| step.answers.clone());
    match (state.mode, asks) {
        (Mode::Guided, _) => {
            let number = state.number.unwrap_or(1);
            let step = state.steps.get(number - 1);
            let text = step.and_then(|step| of_lesson.step.get(&step.id));
            let text = text.map_or("", |text| &text.text);
            Shown {
                step: words.around.step(number, state.steps.len(), text),
                hint,
                failed,
                answers,
                acts,
                ..Shown::default()
            }
        }
        // A question and its answers leave no room for a list.
        (Mode::Free, Some(question)) => Shown {
            step: question.text.clone(),
            hint,
            failed,
            answers,
            acts,
            ..Shown::default()
        },
        (Mode::Free, None) => {
            let said = failed.as_ref().or(hint.as_ref());
            let taken = said.map_or(0, |text| lines(text, words.language));
            let all = listed(lesson, &state, words.language);
            let (steps, more) = fitting(all, LINES - taken.min(LINES - 3), words.language);
            Shown {
                step: title.clone(),
                steps,
                note: (more > 0).then(|| numbered(&words.texts.panel.more, more)),
                hint,
                failed,
                acts,
                ..Shown::default()
            }
        }
        // A user who is examined is told the task, and not its state.
        (Mode::Examination, _) => Shown {
            step: format!("{title}: {}", of_lesson.summary),
            note: Some(numbered(&words.texts.panel.steps, state.steps.len())),
            acts,
            quiet: true,
            ..Shown::default()
        },
    }
}

/// The step whose hint is asked for now: the open one behind that whose hint was given last, or else the first. `None` where there is none
/// but the one that is shown.
pub fn to_hint<'a>(state: &'a State, hinted: Option<&str>) -> Option<&'a str> {
    let open = |it: &&StepState| it.status == Status::Open;
    if !state.mode.hints_are_given() {
        return None;
    }
    let last = state.steps.iter().position(|it| Some(&*it.id) == hinted);
    let behind = last.map_or(0, |at| at + 1);
    let (before, after) = state.steps.split_at(behind.min(state.steps.len()));
    let next = after.iter().chain(before).find(open)?;
    let is_shown = next.hint && hint_of(state, hinted) == Some(next.id.as_str());
    (!is_shown).then_some(next.id.as_str())
}

/// The step whose hint is shown.
fn hint_of<'a>(state: &'a State, hinted: Option<&str>) -> Option<&'a str> {
    let shows = |it: &&StepState| it.status == Status::Open && it.hint;
    let last = state.steps.iter().find(|it| Some(&*it.id) == hinted);
    let found = last.filter(shows);
    let found = found.or_else(|| state.steps.iter().find(shows));
    found.map(|it| it.id.as_str())
}

/// The actions that the user can ask for in that mode.
pub fn can_ask(mode: Mode) -> &'static [Action] {
    match mode {
        Mode::Guided => &[Action::Hint(None), Action::Skip(None)],
        Mode::Free => &[Action::Hint(None), Action::Finish],
        Mode::Examination => &[Action::Finish],
    }
}

fn numbered(label: &Template, count: usize) -> String {
    label.fill(&[("number", &count.to_string())])
}

fn acts(state: &State, hinted: Option<&str>, texts: &Texts) -> Vec<ActLine> {
    let line = |act: &Action| ActLine {
        act: act.clone(),
        text: match act {
            Action::Hint(_) => &texts.panel.hint,
            Action::Skip(_) => &texts.panel.skip,
            _ => &texts.panel.finish,
        }
        .to_string(),
        on: *act != Action::Hint(None) || to_hint(state, hinted).is_some(),
    };
    can_ask(state.mode).iter().map(line).collect()
}

fn listed(lesson: &Lesson, state: &State, language: Language) -> Vec<(Mark, String)> {
    let texts = lesson.texts(language);
    let steps = state.steps.iter().map(|step| {
        let mark = match step.status {
            Status::Done => Mark::Done,
            Status::Missed => Mark::Missed,
            Status::Open => Mark::Open,
            Status::Waiting => Mark::Waiting,
        };
        let text = texts.step.get(&step.id);
        (mark, text.map_or_else(String::new, |it| it.text.clone()))
    });
    steps.collect()
}

/// Those that fit so many lines, in their order, and how many do not: what is still to be done before what is decided.
fn fitting(
    all: Vec<(Mark, String)>,
    room: usize,
    language: Language,
) -> (Vec<(Mark, String)>, usize) {
    let takes: Vec<usize> = all.iter().map(|(_, text)| lines(text, language)).collect();
    let count = all.len();
    if takes.iter().sum::<usize>() <= room {
        return (all, 0);
    }
    // One line gives the number of those that are left out.
    let mut left = room - 1;
    let left_open = |(mark, _): &(Mark, String)| matches!(mark, Mark::Open | Mark::Waiting);
    let first = all.iter().position(left_open).unwrap_or(0);
    let mut chosen = first..first;
    let (decided, open) = takes.split_at(first);
    for takes in open {
        if *takes > left {
            break;
        }
        left -= takes;
        chosen.end += 1;
    }
    for takes in decided.iter().rev() {
        if *takes > left {
            break;
        }
        left -= takes;
        chosen.start -= 1;
    }
    let more = count - chosen.len();
    (all[chosen].to_vec(), more)
}

/// Lines that a text takes at most.
fn lines(text: &str, language: Language) -> usize {
    let wide = if language == Language::Zh { 2 } else { 1 };
    (wide * text.chars().count()).div_ceil(LINE).max(1)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_lesson::{Event, Sight};

    fn begun(name: &str, mode: Mode) -> Procedure {
        let mut judge = Procedure::new(Lesson::builtin(name).unwrap(), mode);
        let begun = Event::Begun {
            t_s: 0.0,
            scene: String::new(),
            contents: Default::default(),
            glass: Default::default(),
        };
        judge.advance(&Sight::default(), &[begun]);
        judge
    }

    /// The panel's view of a lesson at its beginning, in English.
    fn said(judge: &Procedure, hinted: Option<&str>) -> Shown {
        in_language(judge, Language::En, hinted)
    }

    fn in_language(judge: &Procedure, language: Language, hinted: Option<&str>) -> Shown {
        let around = vitriol_run::texts::Texts::english().unwrap().lesson;
        let words = Words {
            around: &around,
            texts: &Texts::of(language).unwrap(),
            language,
        };
        shown(judge, words, hinted, None)
    }

    fn acts(shown: &Shown) -> Vec<(Action, bool)> {
        shown
            .acts
            .iter()
            .map(|it| (it.act.clone(), it.on))
            .collect()
    }

    /// Steps of each lesson are listed whole in each language; of a lesson with more than fit, those that are to be done first.
    #[test]
    fn each_lesson_fits_in_each_language() {
        for name in Lesson::builtin_names() {
            let lesson = Lesson::builtin(name).unwrap();
            for language in Language::ALL {
                let state = begun(name, Mode::Free).state();
                let all = listed(&lesson, &state, language);
                let (steps, more) = fitting(all.clone(), LINES, language);
                let count = lesson.steps.len();
                assert_eq!(steps.len() + more, count, "{name} {language}");
                assert!(steps.len() >= count.min(3), "{name} {language}: {more}");
                assert_eq!(steps[0].1, all[0].1);
                // With a hint there may be less room: what is to be done is there.
                let hints = lesson.texts(language).step.values();
                let hints = hints.flat_map(|step| step.hint_desk.iter().chain([&step.hint]));
                let hint = hints.map(|hint| lines(hint, language)).max();
                let (steps, _) = fitting(all, LINES - hint.unwrap(), language);
                assert_eq!(steps[0].0, Mark::Open, "{name} {language}");
            }
        }
    }

    #[test]
    fn free_lists_all_steps_and_how_they_stand() {
        let mut judge = begun("dilute", Mode::Free);
        let shown = said(&judge, None);
        let marks = |shown: &Shown| shown.steps.iter().map(|it| it.0).collect::<Vec<_>>();
        use Mark::{Done, Missed, Open, Waiting};
        // Six of nine fit, with a line that says so.
        let (first, rest) = (marks(&shown)[0], &marks(&shown)[1..]);
        assert_eq!((first, rest), (Open, &[Waiting; 5][..]));
        assert!(shown.steps[2].1.starts_with("Pour about half"));
        assert_eq!(shown.note.as_deref(), Some("More steps: 3"));
        assert!(!shown.quiet);
        assert_eq!(
            acts(&shown),
            [(Action::Hint(None), true), (Action::Finish, true)]
        );
        judge.skip("dress", 1.0);
        assert_eq!(marks(&said(&judge, None))[..3], [Missed, Open, Waiting]);
        let mut sight = Sight::default();
        sight.flasks.push(Default::default());
        sight.flasks[0].name = "source".into();
        sight.flasks[0].held = true;
        (sight.goggles, sight.gloves) = (Some(true), Some([true; 2]));
        let mut judge = begun("dilute", Mode::Free);
        judge.advance(&sight, &[]);
        // What is done makes room for what is to be done.
        let shown = said(&judge, None);
        assert_eq!(marks(&shown)[..3], [Open, Waiting, Waiting]);
        assert!(shown.steps[0].1.starts_with("Pour about half"));
        let state = judge.state().steps;
        assert_eq!(state[1].status, Status::Done);
        let listed = listed(judge.lesson(), &judge.state(), Language::En);
        assert_eq!(listed[0].0, Done);
    }

    /// A question stands alone with its answers, and in `free` the list comes back once it is answered.
    #[test]
    fn a_question_is_shown_with_its_answers() {
        for mode in [Mode::Guided, Mode::Free] {
            let mut judge = begun("wrong-order", mode);
            assert!(said(&judge, None).answers.is_empty());
            judge.skip("dress", 1.0);
            let shown = said(&judge, None);
            assert!(shown.step.contains("What will happen?"), "{}", shown.step);
            assert_eq!((shown.answers.len(), shown.steps.len()), (3, 0));
            assert_eq!(shown.answers[0], "They mix calmly.");
            judge.answer("predict", 3, 2.0);
            let shown = said(&judge, None);
            assert!(shown.answers.is_empty());
            assert_eq!(shown.steps.is_empty(), mode == Mode::Guided);
        }
        // The end, in which nothing is asked.
        let mut judge = begun("wrong-order", Mode::Guided);
        judge.finish(1.0);
        assert!(said(&judge, None).answers.is_empty());
    }

    #[test]
    fn an_examination_says_the_task_and_how_many_steps() {
        let mut judge = begun("examination", Mode::Examination);
        let shown = said(&judge, None);
        assert!(
            shown
                .step
                .starts_with("Examination: diluting sulfuric acid: Dilute the 98")
        );
        assert_eq!(shown.note.as_deref(), Some("Number of steps: 6"));
        assert_eq!(acts(&shown), [(Action::Finish, true)]);
        assert!(shown.quiet && shown.steps.is_empty() && shown.hint.is_none());
        // Whatever was done or failed.
        judge.skip("pour", 1.0);
        let around = vitriol_run::texts::Texts::english().unwrap().lesson;
        let words = Words {
            around: &around,
            texts: &Texts::english().unwrap(),
            language: Language::En,
        };
        assert_eq!(
            super::shown(&judge, words, None, Some("It was left out.")),
            shown
        );
        judge.finish(2.0);
        let over = said(&judge, None);
        assert_eq!(over.step, "Examination: diluting sulfuric acid: 0 / 100");
        assert!(!over.quiet && over.acts.is_empty());
    }

    #[test]
    fn a_hint_is_of_the_next_open_step() {
        let mut judge = begun("dilute", Mode::Guided);
        assert_eq!(
            acts(&said(&judge, None)),
            [(Action::Hint(None), true), (Action::Skip(None), true)]
        );
        assert_eq!(to_hint(&judge.state(), None), Some("dress"));
        judge.ask_hint("dress", 1.0).unwrap();
        // It is shown: there is no other.
        let shown = said(&judge, Some("dress"));
        assert_eq!(
            acts(&shown),
            [(Action::Hint(None), false), (Action::Skip(None), true)]
        );
        assert!(shown.hint.unwrap().starts_with("Bring the goggles"));
        judge.skip("dress", 2.0);
        assert_eq!(to_hint(&judge.state(), Some("dress")), Some("lift"));
        assert_eq!(said(&judge, Some("dress")).hint, None);
        assert_eq!(
            to_hint(&begun("examination", Mode::Examination).state(), None),
            None
        );
        // Of several one after the other, and the first again.
        let text = Lesson::builtin_text("dilute")
            .unwrap()
            .replace("after = [", "# [");
        let lesson = Lesson::parse(&text, "dilute.toml").unwrap();
        let mut judge = Procedure::new(lesson, Mode::Free);
        judge.advance(&Sight::default(), &[]);
        let mut hinted: Option<String> = None;
        let mut order = Vec::new();
        for t in 0..10 {
            let state = judge.state();
            let id = to_hint(&state, hinted.as_deref()).unwrap().to_owned();
            judge.ask_hint(&id, f64::from(t)).unwrap();
            order.push(id.clone());
            hinted = Some(id);
        }
        let ids = judge.lesson().steps.iter().map(|step| step.id.clone());
        let mut all: Vec<String> = ids.collect();
        // What lies nowhere is wiped.
        all.retain(|id| id != "wipe");
        assert_eq!(order[..8], all);
        assert_eq!(order[8..], all[..2]);
    }

    /// Fifty long steps do not fit: those that are still to be done come first.
    #[test]
    fn of_many_steps_those_to_be_done_are_shown() {
        let step = |at: usize| {
            let mark = match at {
                ..20 => Mark::Done,
                20 => Mark::Open,
                _ => Mark::Waiting,
            };
            (mark, format!("{at} {}", "x".repeat(130)))
        };
        let (shown, more) = fitting((0..50).map(step).collect(), 9, Language::En);
        // Three lines each, and one for the rest.
        assert_eq!((shown.len(), more), (2, 48));
        assert_eq!(shown[0].0, Mark::Open);
        let (shown, more) = fitting((0..22).map(step).collect(), 10, Language::En);
        assert_eq!((shown.len(), more), (3, 19));
        assert_eq!(shown[0].0, Mark::Done);
        let (shown, more) = fitting((0..2).map(step).collect(), 6, Language::Zh);
        assert_eq!((shown.len(), more), (1, 1));
    }
}
