//! `vitriol grade`: a class, offline. What went wrong is recorded in the session, so reading is enough; `--verify` simulates each
//! track again.

mod agreement;
mod expected;
mod graded;
mod lesson;
mod table;
mod verify;

use std::collections::BTreeSet;
use std::num::NonZero;
use std::path::{Path, PathBuf};

use vitriol_lesson::procedure::Verdict as LessonVerdict;
use vitriol_lesson::{Attempt, Score, Texts};
use vitriol_record::store::Store;
use vitriol_record::{Session, Timestamp};
use vitriol_run::output::{make_folder, write_over};
use vitriol_run::progress::Runs;
use vitriol_run::several::at_a_time;
use vitriol_run::{Blame, Experiment, Failure, Format, Setup, emit, interrupt, track};
use vitriol_xr::files;
use vitriol_xr::track::{Track, limits};

use crate::cli::GradeArgs;
use crate::command::recorded::{recorded_events, recorded_progress, whole};
use crate::command::stem;

pub use self::agreement::Tolerance;
use self::expected::Expected;
use self::graded::{Found, Graded, Scored};
use self::lesson::Columns;
use self::table::Ended;
pub use self::table::{Class, Line, Status};
pub use self::verify::Verdict;

/// The table's name in the folder.
const TABLE: &str = "grades.csv";

/// Runs `vitriol grade`; `prepare` makes an experiment. A track that cannot be graded is a line of the table and stops no other.
///
/// # Errors
/// Before anything is read, [`Failure::Input`] for scene, files or folder. After all have been, what the first track that cannot be
/// graded fails with.
pub fn run(
    args: &GradeArgs,
    format: Format,
    prepare: impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure> + Sync,
) -> Result<(), Failure> {
    let (class, failure) = grade(args, format, prepare)?;
    emit(format, &class, table::text)?;
    failure.map_or(Ok(()), Err)
}

/// The table, and what the first track that cannot be graded fails with.
///
/// # Errors
/// As for [`run`].
pub fn grade(
    args: &GradeArgs,
    format: Format,
    prepare: impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure> + Sync,
) -> Result<(Class, Option<Failure>), Failure> {
    let expected = Expected::new(&args.scene, args.preset, args.judge.chosen()?)?;
    let tracks = tracks(&args.tracks)?;
    let store = args.class.as_deref().map(Store::open_existing);
    let store = store.transpose().input()?;
    if let Some(out) = &args.out {
        if let Some(name) = same_name(&tracks) {
            return Err(format!(
                "two tracks are named {name}, and so would be their results in {}: give one of them another name",
                out.display()
            ))
            .input();
        }
        make_folder(out)?;
    }
    let grading = Grading {
        args,
        expected: &expected,
        texts: Texts::english().other()?,
        bars: Runs::new(format),
        prepare: &prepare,
    };
    let one = |file: &PathBuf| {
        interrupt::check()?;
        let done = grading.track(file);
        // What was asked to stop is no mistake in a track.
        interrupt::check().map(|()| done)
    };
    let ended = at_a_time(args.at_a_time(), &tracks, one)?;

    let mut class = Class {
        scene: expected.asked.scene.clone(),
        lesson: (expected.lesson.as_ref()).map(|(lesson, mode)| Columns::of(lesson, *mode)),
        ..Class::default()
    };
    let mut failure = None;
    for (file, done) in tracks.iter().zip(ended) {
        let name = file.display().to_string();
        let (student, ended) = match done {
            Ok((session, graded, taken)) => {
                let graded = Box::new(graded);
                // Who is not found has the track's name; the table is made all the same.
                let found = pseudonym(store.as_ref(), &session);
                let student = found.unwrap_or_else(|error| {
                    failure.get_or_insert(error);
                    None
                });
                (student, Ended::Well { graded, taken })
            }
            Err(error) => {
                let text = error.to_string();
                failure.get_or_insert(error);
                (None, Ended::Failed(text))
            }
        };
        let student = student.unwrap_or_else(|| stem(&name));
        class.add((student, name), &ended);
    }
    // A call for one track leaves its result alone: others like it may run beside it.
    let several = tracks.len() > 1 || args.tracks.iter().any(|it| it.is_dir());
    if let Some(out) = args.out.as_deref().filter(|_| several) {
        let table = out.join(TABLE);
        write_over(&table, &table::csv(&class)?)?;
        class.table = Some(table.display().to_string());
    }
    Ok((class, failure))
}

impl GradeArgs {
    /// Tracks at a time. A simulation alone uses a whole device.
    fn at_a_time(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, NonZero::get);
        match self.jobs {
            Some(jobs) => jobs as usize,
            None if self.verify => 1,
            None => cores(),
        }
    }
}

/// What is the same for all tracks.
struct Grading<'a, P> {
    args: &'a GradeArgs,
    expected: &'a Expected,
    texts: Texts,
    bars: Runs,
    prepare: &'a P,
}

impl<P: Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure> + Sync> Grading<'_, P> {
    /// Grades one track: its sitting, what is in it, and whether an earlier call left that.
    fn track(&self, file: &Path) -> Result<(Session, Graded, bool), Failure> {
        let (args, asked) = (self.args, &self.expected.asked);
        if files::is_absent(file) {
            return Err(format!(
                "{}: no such file; name recordings or folders of them",
                file.display()
            ))
            .input();
        }
        let read = files::read(file, "track", limits::FILE);
        let bytes = read.map_err(|error| track::blame(error.into()))?;
        // When it was does not matter here.
        let session = Session::of_recording(&bytes, Timestamp::UNIX_EPOCH);
        let content = session.id.to_string();
        let name = file.display().to_string();
        let result = args.out.as_ref().map(|out| Graded::file(out, &stem(&name)));
        let by = || (args.tolerance.unwrap_or_default(), args.device.as_deref());
        let verified = args.verify.then(by);
        let earlier = result
            .as_deref()
            .and_then(|it| Graded::earlier(it, &content, asked, verified));
        if let Some(earlier) = earlier.filter(|it| args.accept_truncated || !it.truncated) {
            return Ok((session, earlier, true));
        }
        let track = Track::parse(&bytes, file).map_err(track::blame)?;
        let frames = track.frames.len();
        let cut = track.recovered;
        let track = whole(&name, track, args.accept_truncated)?;
        let truncated = cut || track.frames.len() < frames;
        let attempts = Attempt::all(recorded_events(&track));
        let otherwise = self.expected.otherwise(&track, &attempts);
        if otherwise.is_none() && attempts.is_empty() {
            return Err(format!(
                "{name}: says nothing of what happened: it is no recording of a session, or one of an older version; \
                 `vitriol replay` finds it"
            ))
            .input();
        }
        let judged = |attempt: Attempt| Scored {
            score: Score::of(&attempt, &asked.rubric, &self.texts),
            attempt,
        };
        let simulated = args.verify && otherwise.is_none();
        let found = match otherwise {
            Some(why) => Found::Otherwise(why),
            None => Found::Attempts(attempts.into_iter().map(judged).collect()),
        };
        let of = (file_name(file), content);
        let mut graded = Graded::new(of, asked, truncated, found);
        if let (Some((lesson, mode)), Found::Attempts(_)) = (&self.expected.lesson, &graded.found) {
            graded.lesson = LessonVerdict::retold(lesson, *mode, &recorded_progress(&track));
        }
        if simulated {
            let of = (args, file);
            let verified = verify::Verified::of(
                of,
                (track, truncated),
                self.expected,
                &self.bars,
                self.prepare,
            )?;
            graded.verified = Some(verified);
        }
        if let Some(result) = result {
            graded.keep(&result)?;
        }
        Ok((session, graded, false))
    }
}

/// Whose sitting it was, if the class's file has it.
fn pseudonym(store: Option<&Store>, session: &Session) -> Result<Option<String>, Failure> {
    let Some(store) = store else { return Ok(None) };
    let found = store.pseudonym_of(session.attempt_id(0)).other()?;
    Ok(found.map(|it| it.to_string()))
}

/// The tracks that are named, and those in the folders that are, by name.
fn tracks(named: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut all = Vec::new();
    for path in named {
        if !path.is_dir() {
            all.push(path.clone());
            continue;
        }
        let mut inside = Vec::new();
        let unlisted = |error| {
            format!(
                "{}: cannot be listed: {error}; may you read it?",
                path.display()
            )
        };
        for entry in std::fs::read_dir(path).map_err(unlisted).other()? {
            let file = entry.other()?.path();
            let track = file
                .extension()
                .is_some_and(|it| it.eq_ignore_ascii_case("mcap"));
            // What macOS lays beside a file on other file systems.
            let is_beside = file
                .file_name()
                .is_some_and(|name| name.as_encoded_bytes().starts_with(b"._"));
            if track && !is_beside && !file.is_dir() {
                inside.push(file);
            }
        }
        if inside.is_empty() {
            return Err(format!(
                "{}: holds no recordings; name a folder with files that end in .mcap, or such files",
                path.display()
            ))
            .input();
        }
        inside.sort();
        all.append(&mut inside);
    }
    Ok(all)
}

/// A name that two of the tracks have. Some file systems do not tell capitals from small letters.
fn same_name(tracks: &[PathBuf]) -> Option<String> {
    let mut names = BTreeSet::new();
    tracks.iter().find_map(|file| {
        let name = stem(&file.display().to_string());
        let again = !names.insert(name.to_lowercase());
        again.then_some(name)
    })
}

fn file_name(file: &Path) -> String {
    let name = file.file_name();
    name.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}
