//! A lesson's film, to be seen before the headset goes on: a track goes through the lesson, and subtitles say what is to be done and what
//! happens.

use std::path::Path;
use std::sync::Arc;

use serde::Serialize;
use vitriol_lesson::procedure::Verdict;
use vitriol_lesson::{Attempt, Language, Lesson, Mode, Texts};
use vitriol_run::progress::Runs;
use vitriol_run::{
    Blame, Colour, Experiment, FILM_FPS, FILM_SIZE, Failure, Film, Format, Observer, Outcome,
    Setup, Subtitles, emit, escaped, in_a_line, output,
};
use vitriol_shaders::Library;
use vitriol_xr::track::{TrackMetadata, TrackSource, builtin, load};

use super::subtitles::{JudgedTrack, SubtitleWords, cues};
use crate::cli::LessonArgs;
use crate::command::course;
use crate::command::plan::{Ask, ReplayPlan};
use crate::command::recorded::is_recording;
use vitriol_run::texts::Texts as Around;

/// How the film goes through a lesson, whatever its modes: each step is shown while it is to be done.
const MODE: Mode = Mode::Guided;

/// What is printed of a film.
#[derive(Debug, Serialize)]
struct Filmed {
    film: String,
    lesson: String,
    track: String,
    simulated_s: f64,
    subtitles: Vec<&'static str>,
    /// What the track's pour comes to.
    #[serde(skip_serializing_if = "Option::is_none")]
    verdict: Option<Verdict>,
}

/// Makes the film of that lesson.
///
/// # Errors
/// [`Failure::Input`] for a file that exists or a bad track, [`Failure::NoDevice`], [`Failure::Other`].
pub fn make(
    (args, path): (&LessonArgs, &Path),
    lesson: &Lesson,
    format: Format,
    prepare: impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure>,
) -> Result<(), Failure> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let file = path.file_name().and_then(|name| name.to_str());
    let file = file.ok_or_else(|| format!("--film {}: names no file", path.display()));
    output::new_file(folder, file.input()?)?;
    let track = match &args.track {
        Some(track) => track.clone(),
        None => usual(lesson)?,
    };
    let ask = Ask {
        track: &track,
        scene: Some(&lesson.scene),
        preset: args.preset,
        device: args.device.as_deref(),
        language: args.language,
        ..Ask::default()
    };
    let plan = ReplayPlan::new(&ask)?;
    if let Some(other) = made_elsewhere(&plan.track.metadata, &plan.name) {
        tracing::warn!("{}: {other}", escaped(&track));
    }
    let mut experiment = prepare(&Setup {
        picture: Some(FILM_SIZE),
        colours: vec![Colour::Liquid],
        // A lesson is seen as the student sees it, in full.
        head: (plan.track.frames.first()).map(|frame| frame.stage_from_view),
        language: args.language,
        shaders: Arc::new(Library::watching()),
        ..plan.setup(args.device.as_deref())
    })?;
    let text = plan.scenes.text(&plan.name);
    let scene = (plan.name.as_str(), text.as_deref());
    experiment.judge(course::judging((lesson, MODE), scene, args.language)?);

    output::make_folder(folder)?;
    let film = Film::with_sound(path, FILM_SIZE, FILM_FPS).other()?;
    let shown = Runs::new(format).of(&track, plan.span);
    let mut observer = Observer::new(plan.span, vec![film], shown);
    let mut source = TrackSource::new(plan.track);
    vitriol_run::replay(&mut source, experiment.as_mut(), plan.span, &mut observer)?;
    let outcome = experiment.outcome()?;
    let verdict = Verdict::retold(lesson, MODE, &outcome.progress).pop();
    let seconds = plan.span.seconds();
    let subtitles = subtitles(lesson, args.language, (&outcome, verdict.as_ref()), seconds)?;
    observer.finish_with(&subtitles)?;

    let filmed = Filmed {
        film: path.display().to_string(),
        lesson: lesson.name.clone(),
        track,
        simulated_s: seconds,
        subtitles: lesson.languages().into_iter().map(Language::code).collect(),
        verdict,
    };
    let around = Around::of(args.language)?.summary;
    emit(format, &filmed, |filmed| {
        let points = filmed.verdict.as_ref();
        let points = points.map(|it| format!("\n{}", around.points(it.points, it.of)));
        format!(
            "{}{}\nsubtitles: {}\n",
            in_a_line(&filmed.film),
            points.unwrap_or_default(),
            filmed.subtitles.join(", ")
        )
    })
}

/// That a track was made in another scene than that of its film, as a replay says it of a recording: hands may miss what they reach for.
/// `None` of one that names no scene, and of a recording, of which the plan says it.
fn made_elsewhere(made: &TrackMetadata, scene: &str) -> Option<String> {
    let other = !is_recording(made) && !made.scene.is_empty() && made.scene != scene;
    other.then(|| {
        format!(
            "the track was made in the scene {}, and the film is of {}: the hands may miss glasses and tools; name a track of that scene",
            in_a_line(&made.scene),
            in_a_line(scene)
        )
    })
}

/// The built-in track that is made for the lesson's scene, first the one that has the lesson's name: another one may answer no question.
fn usual(lesson: &Lesson) -> Result<String, Failure> {
    let own = builtin::NAMES.into_iter().filter(|it| *it == lesson.name);
    for name in own.chain(builtin::NAMES) {
        if load(name).other()?.metadata.scene == lesson.scene {
            return Ok(name.to_owned());
        }
    }
    let scene = &lesson.scene;
    Err(format!("--track: no built-in track is made for the scene {scene}; name one, such as dilute or a recording"))
        .input()
}

/// Those of each of the lesson's languages; a player shows those of `shown` unasked.
fn subtitles(
    lesson: &Lesson,
    shown: Language,
    (outcome, verdict): (&Outcome, Option<&Verdict>),
    seconds: f64,
) -> Result<Vec<Subtitles>, Failure> {
    let attempts = Attempt::all(outcome.events.iter().cloned());
    let told = JudgedTrack {
        progress: &outcome.progress,
        attempts: &attempts,
        verdict,
        seconds,
    };
    let languages = lesson.languages();
    // The first stands in for a language that the lesson does not have.
    let has = languages.contains(&shown);
    let shown = languages.first().filter(|_| !has).copied().unwrap_or(shown);
    let of = |language| {
        let (texts, around) = (Texts::of(language).other()?, Around::of(language)?);
        let words = SubtitleWords {
            lesson: lesson.texts(language),
            texts: &texts,
            summary: &around.summary,
        };
        Ok(Subtitles {
            language: code(language),
            shown: language == shown,
            cues: cues(&words, &told),
        })
    };
    languages.into_iter().map(of).collect()
}

/// ISO 639-2/T.
fn code(language: Language) -> [u8; 3] {
    *match language {
        Language::En => b"eng",
        Language::De => b"deu",
        Language::Es => b"spa",
        Language::Zh => b"zho",
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_film_shows_the_track_of_the_lessons_scene() {
        let mut other = Lesson::builtin("wrong-order-hot").unwrap();
        other.scene = "hot-acid-85".to_owned();
        let none = usual(&other).unwrap_err().to_string();
        assert!(none.contains("hot-acid-85"), "{none}");
        let usual = |name| usual(&Lesson::builtin(name).unwrap());
        assert_eq!(usual("dilute").unwrap(), "dilute");
        assert_eq!(usual("examination").unwrap(), "examination");
        // Track `layer-and-swirl` has the scene of `wrong-order-layered` too, and gives none of its answers.
        for name in ["wrong-order", "wrong-order-layered", "wrong-order-hot"] {
            assert_eq!(usual(name).unwrap(), name);
        }
    }

    #[test]
    fn a_track_of_another_scene_is_told() {
        let mut made = load("two-flasks").unwrap().metadata;
        assert_eq!(made_elsewhere(&made, "two-flasks"), None);
        let other = made_elsewhere(&made, "hot-acid").unwrap();
        assert!(
            other.contains("in the scene two-flasks") && other.contains("of hot-acid"),
            "{other}"
        );
        made.scene.clear();
        assert_eq!(made_elsewhere(&made, "hot-acid"), None);
    }

    /// Of ISO 639-2's two codes that of the language's own name.
    #[test]
    fn each_language_has_a_code_of_its_own() {
        let codes = Language::ALL.map(code);
        assert_eq!(codes, [*b"eng", *b"deu", *b"spa", *b"zho"]);
    }
}
