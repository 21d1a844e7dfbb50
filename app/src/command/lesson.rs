//! `vitriol lesson`: the lessons, what one asks for, its film, and the file of a new one.

mod film;
mod new;
mod subtitles;

use serde::Serialize;
use vitriol_lesson::{Language, Lesson, Texts};
use vitriol_run::{Blame, Experiment, Failure, Format, Setup, emit, escaped};

use crate::cli::{LessonArgs, LessonCommand};
use crate::command::course::open;

/// Sum of a lesson's points that makes a percentage of them.
const PERCENT: u32 = 100;

/// What is printed of a lesson.
#[derive(Debug, Serialize)]
struct Told {
    name: String,
    scene: String,
    title: String,
    summary: String,
    modes: Vec<&'static str>,
    languages: Vec<&'static str>,
    points: u32,
    steps: Vec<Item>,
    rules: Vec<Item>,
    /// What caps the score of an attempt.
    caps: Vec<String>,
}

/// A step or a rule.
#[derive(Debug, Serialize)]
struct Item {
    id: String,
    points: u32,
    text: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    hint: Option<String>,
    /// The answers to its question.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    answers: Vec<String>,
}

/// All of them.
#[derive(Debug, Serialize)]
struct All {
    lessons: Vec<Told>,
}

/// Runs `vitriol lesson`; `prepare` makes the experiment of a film.
///
/// # Errors
/// [`Failure::Input`] for a lesson that is not there, is spoiled, or asks for what its scene does not have, and for a new one whose file is
/// there already; of a film also
/// [`Failure::NoDevice`] and [`Failure::Other`], and no file is left of it then.
pub fn run(
    args: &LessonArgs,
    format: Format,
    prepare: impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure>,
) -> Result<(), Failure> {
    let (name, language) = match &args.command {
        Some(LessonCommand::New(new)) => return new::write(new, format),
        Some(LessonCommand::Check(check)) => (Some(&check.lesson), check.language),
        None => (args.lesson.as_ref(), args.language),
    };
    let texts = Texts::of(language).other()?;
    let modes = |told: &Told, lesson: &Lesson| -> String {
        let names = lesson.modes.iter().map(|mode| texts.mode(*mode));
        format!("{}: {}", told.name, names.collect::<Vec<_>>().join(", "))
    };
    let Some(name) = name else {
        let names = Lesson::builtin_names().into_iter();
        let lessons = names.map(|name| open(name, language));
        let lessons: Vec<Lesson> = lessons.collect::<Result<_, _>>()?;
        let told = lessons.iter().map(|it| of(it, language, &texts)).collect();
        return emit(format, &All { lessons: told }, |all| {
            let lines = all.lessons.iter().zip(&lessons);
            let lines =
                lines.map(|(told, lesson)| format!("{}\n  {}\n", modes(told, lesson), told.title));
            lines.collect()
        });
    };
    if args.toml {
        let text = Lesson::builtin_text(name);
        let text = text.ok_or_else(|| texts.fault.toml.fill(&[("name", name)]));
        return emit(format, &text.input()?, |text| (*text).to_owned());
    }
    let lesson = open(name, language)?;
    let told = of(&lesson, language, &texts);
    if told.points != PERCENT {
        let warning = texts.fault.hundred.fill(&[
            ("name", &escaped(name)),
            ("points", &told.points.to_string()),
            ("hundred", &PERCENT.to_string()),
        ]);
        tracing::warn!("{warning}");
    }
    if let Some(film) = &args.film {
        return film::make((args, film), &lesson, format, prepare);
    }
    let heads = vitriol_run::texts::Texts::of(language)?.grades;
    emit(format, &told, |told| {
        let mut text = format!(
            "{}\n{}\n{}\n{}: {}, {}: {}\n",
            modes(told, &lesson),
            told.title,
            told.summary,
            heads.scene,
            told.scene,
            heads.points,
            told.points
        );
        for (number, step) in (1..).zip(&told.steps) {
            text += &format!("{number:>3}  {} ({})\n", step.text, step.points);
            text += &step
                .hint
                .as_ref()
                .map_or_else(String::new, |hint| format!("     {hint}\n"));
            for (number, answer) in (1..).zip(&step.answers) {
                text += &format!("     {number}: {answer}\n");
            }
        }
        for rule in &told.rules {
            text += &format!("  ·  {} ({})\n", rule.text, rule.points);
        }
        for cap in &told.caps {
            text += &format!("  !  {cap}\n");
        }
        text
    })
}

fn of(lesson: &Lesson, language: Language, words: &Texts) -> Told {
    let texts = lesson.texts(language);
    let steps = lesson.steps.iter().map(|step| {
        let said = texts.step.get(&step.id);
        Item {
            id: step.id.clone(),
            points: step.points,
            text: said.map(|it| it.text.clone()).unwrap_or_default(),
            hint: said.map(|it| it.hint.clone()),
            answers: said.map(|it| it.answers.clone()).unwrap_or_default(),
        }
    });
    let rules = lesson.rules.iter().map(|rule| Item {
        id: rule.id.clone(),
        points: rule.points,
        text: texts.rule.get(&rule.id).cloned().unwrap_or_default(),
        hint: None,
        answers: Vec::new(),
    });
    let (steps, rules): (Vec<_>, Vec<_>) = (steps.collect(), rules.collect());
    Told {
        name: lesson.name.clone(),
        scene: lesson.scene.clone(),
        title: texts.title.clone(),
        summary: texts.summary.clone(),
        modes: lesson.modes.iter().map(|mode| mode.name()).collect(),
        languages: lesson.languages().into_iter().map(Language::code).collect(),
        points: steps.iter().chain(&rules).map(|item| item.points).sum(),
        steps,
        rules,
        caps: lesson.rubric().caps.sentences(words),
    }
}
