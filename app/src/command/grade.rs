//! `vitriol grade`: a class, offline. What went wrong is recorded in the session, so reading is enough; `--verify` simulates each
//! track again.

mod agreement;
mod beyond;
mod expected;
mod graded;
mod lesson;
mod page;
mod table;
mod tracks;
mod verify;
mod wrong;

use std::num::NonZero;
use std::path::Path;

use vitriol_lesson::procedure::Verdict as LessonVerdict;
use vitriol_lesson::{Attempt, Score};
use vitriol_record::store::Store;
use vitriol_record::{Session, Timestamp};
use vitriol_run::output::{make_folder, write_over};
use vitriol_run::progress::Runs;
use vitriol_run::several::at_a_time;
use vitriol_run::track::STUDENT;
use vitriol_run::{Blame, Experiment, Failure, Format, Setup, emit, interrupt, track};
use vitriol_xr::files;
use vitriol_xr::track::{Track, limits};

use crate::cli::GradeArgs;
use crate::command::course;
use crate::command::recorded::{recorded_events, recorded_progress, whole};
use crate::report::told_page;

pub use self::agreement::Tolerance;
use self::expected::Expected;
use self::graded::{Found, Graded, Scored};
use self::lesson::Columns;
use self::table::Ended;
pub use self::table::{Class, Line, Status};
use self::tracks::{Named, Tracks};
pub use self::verify::Verdict;
use self::wrong::Words;

/// The table's name in the folder.
const TABLE: &str = "grades.csv";

/// The page's.
const PAGE: &str = "grades.html";

/// Runs `vitriol grade`; `prepare` makes an experiment. A track that cannot be graded is a line of the table and stops no other.
///
/// # Errors
/// Before anything is read, [`Failure::Input`] for scene, files or folder. After all have been, what [`grade`] gives with the table,
/// unless it is only that some files are bad: these fail the class with `--strict`. Where none is graded it fails too.
pub fn run(
    args: &GradeArgs,
    format: Format,
    prepare: impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure> + Sync,
) -> Result<(), Failure> {
    let (class, failure) = grade(args, format, prepare)?;
    let words = Words::of(args.language)?;
    emit(format, &class, |class| table::text(class, &words))?;
    let files = &words.grades.files;
    let only_files = matches!(failure, Some(Failure::Input(_))) && !args.strict;
    match failure {
        Some(_) if only_files && class.graded > 0 => {
            let names = class.bad(files);
            tracing::warn!("{}", files.bad.fill(&[("names", &names)]));
            Ok(())
        }
        // A bad file is not why nothing is graded where other recordings were read.
        Some(failure) if !only_files || class.otherwise == 0 => Err(failure),
        _ if class.graded == 0 => Err(files.nothing.fill(&[])).input(),
        _ => Ok(()),
    }
}

/// The table, and what the first track that cannot be graded fails with; what is no fault of a track comes before that.
///
/// # Errors
/// As for [`run`].
pub fn grade(
    args: &GradeArgs,
    format: Format,
    prepare: impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure> + Sync,
) -> Result<(Class, Option<Failure>), Failure> {
    let lessons = args.lesson.iter();
    let lessons = lessons.map(|it| course::named(it, args.mode, args.language));
    let lessons = lessons.collect::<Result<Vec<_>, _>>()?;
    let expected = Expected::all(&args.scene, args.preset, &lessons, args.language)?;
    let mut words = Words::of(args.language)?;
    let files = &words.grades.files;
    let tracks = Tracks::of(&args.tracks, args.out.as_deref(), files)?;
    if !tracks.passed_over.is_empty() {
        let names = tracks::short(&tracks.passed_over, files);
        tracing::warn!("{}", files.passed_over.fill(&[("names", &names)]));
    }
    let store = args.class.as_deref().map(Store::open_existing);
    let store = store.transpose().input()?;
    if let Some(out) = &args.out {
        if let Some(name) = tracks.same_name() {
            let folder = out.display().to_string();
            let holes = [("name", name), ("folder", &*folder)];
            return Err(files.same_name.fill(&holes)).input();
        }
        make_folder(out)?;
    }
    for (lesson, _) in expected.iter().filter_map(|it| it.lesson.as_ref()) {
        words.texts.learn(lesson);
    }
    let grading = Grading {
        args,
        expected: &expected,
        words: &words,
        bars: Runs::new(format),
        prepare: &prepare,
    };
    let one = |named: &Named| {
        interrupt::check()?;
        let done = grading.track(named);
        // What was asked to stop is no mistake in a track.
        interrupt::check().map(|()| done)
    };
    let ended = at_a_time(args.at_a_time(), &tracks.all, one)?;

    let out = args.out.as_deref();
    let mut class = Class {
        lessons: expected
            .iter()
            .filter_map(|it| it.lesson.as_ref())
            .map(|(lesson, mode)| Columns::of(lesson, *mode))
            .collect(),
        passed_over: tracks.passed_over,
        ..Class::default()
    };
    let mut failure = None;
    for (named, done) in tracks.all.iter().zip(ended) {
        let track = named.file.display().to_string();
        match done {
            Ok(read) => {
                // Who is not found has the track's name; the table is made all the same.
                let found = pseudonym(store.as_ref(), &read.session);
                let found = found.unwrap_or_else(|error| {
                    fail(&mut failure, error);
                    None
                });
                // A folder was named by the platform, a recording by its student.
                let own = || read.student.clone().unwrap_or_else(|| named.stem.clone());
                let unnamed = || named.folder.clone().unwrap_or_else(own);
                let student = found.unwrap_or_else(unnamed);
                let report = out.map(|out| read.tell(out, (&named.stem, &student), &words));
                let ended = Ended::Well {
                    graded: &read.graded,
                    taken: read.taken,
                };
                class.add((student, track, report.transpose()?), &ended, &words);
            }
            Err(error) => {
                let text = error.to_string();
                fail(&mut failure, error);
                let student = named.folder.as_ref().unwrap_or(&named.stem).clone();
                class.add((student, track, None), &Ended::Failed(&text), &words);
            }
        }
    }
    if let Some(out) = out {
        let (table, page) = (out.join(TABLE), out.join(PAGE));
        write_over(&table, &table::csv(&class)?)?;
        write_over(&page, page::html(&class, &words).as_bytes())?;
        class.table = Some(table.display().to_string());
        class.page = Some(page.display().to_string());
    }
    Ok((class, failure))
}

/// Keeps the first failure; one that is no fault of a track, such as a full disk, replaces one that is.
fn fail(failure: &mut Option<Failure>, error: Failure) {
    let of_track = |it: &Failure| matches!(it, Failure::Input(_));
    if failure
        .as_ref()
        .is_none_or(|it| of_track(it) && !of_track(&error))
    {
        *failure = Some(error);
    }
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
    expected: &'a [Expected],
    words: &'a Words,
    bars: Runs,
    prepare: &'a P,
}

/// A track that was read.
struct Read {
    session: Session,
    graded: Graded,
    /// Whether an earlier call left the result.
    taken: bool,
    /// The name that the student gave; results of it name nobody.
    student: Option<String>,
}

impl<P: Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure> + Sync> Grading<'_, P> {
    /// Grades one track.
    fn track(&self, named: &Named) -> Result<Read, Failure> {
        let (args, file) = (self.args, named.file.as_path());
        if files::is_absent(file) {
            let name = file.display().to_string();
            let files = &self.words.grades.files;
            return Err(files.no_file.fill(&[("name", &name)])).input();
        }
        let read = files::read(file, "track", limits::FILE);
        let bytes = read.map_err(|error| track::blame(error.into()))?;
        // When it was does not matter here.
        let session = Session::of_recording(&bytes, Timestamp::UNIX_EPOCH);
        let content = session.id.to_string();
        let name = file.display().to_string();
        let track = Track::parse(&bytes, file).map_err(track::blame)?;
        let expected = Expected::of_track(self.expected, &track.metadata);
        let expected = expected.ok_or("there is no scene to grade by").other()?;
        let asked = &expected.asked;
        let student = track.metadata.parameters.get(STUDENT).cloned();
        let done = |graded, taken| Read {
            session,
            student,
            graded,
            taken,
        };
        let result = args.out.as_ref().map(|out| Graded::file(out, &named.stem));
        let by = || (args.tolerance.unwrap_or_default(), args.device.as_deref());
        let verified = args.verify.then(by);
        let earlier = result
            .as_deref()
            .and_then(|it| Graded::earlier(it, &content, asked, verified));
        if let Some(mut earlier) = earlier.filter(|it| args.accept_truncated || !it.truncated) {
            earlier.score_again(&self.words.texts);
            return Ok(done(earlier, true));
        }
        let frames = track.frames.len();
        let cut = track.recovered;
        let track = whole(&name, track, args.accept_truncated, args.language)?;
        let truncated = cut || track.frames.len() < frames;
        let attempts = Attempt::all(recorded_events(&track));
        let otherwise = expected.otherwise(&track, &attempts);
        if otherwise.is_none() && attempts.is_empty() {
            let files = &self.words.grades.files;
            return Err(files.no_events.fill(&[("name", &name)])).input();
        }
        let judged = |attempt: Attempt| Scored {
            score: Score::of(&attempt, &asked.rubric, &self.words.texts),
            attempt,
        };
        let simulated = args.verify && otherwise.is_none();
        let found = match otherwise {
            Some(why) => Found::Otherwise(why),
            None => Found::Attempts(attempts.into_iter().map(judged).collect()),
        };
        let of = (file_name(file), content);
        let mut graded = Graded::new(of, asked, truncated, found);
        if let (Some((lesson, mode)), Found::Attempts(_)) = (&expected.lesson, &graded.found) {
            graded.lesson = LessonVerdict::retold(lesson, *mode, &recorded_progress(&track));
        }
        if simulated {
            let verified = verify::Verified::of(
                (args, file),
                (track, truncated),
                expected,
                &self.bars,
                self.prepare,
            )?;
            graded.verified = Some(verified);
        }
        if let Some(result) = result {
            graded.keep(&result)?;
        }
        Ok(done(graded, false))
    }
}

impl Read {
    /// Writes the page on the track, for that student, and gives back its name.
    fn tell(
        &self,
        out: &Path,
        (stem, student): (&str, &str),
        words: &Words,
    ) -> Result<String, Failure> {
        let (attempts, not_graded): (Vec<_>, _) = match &self.graded.found {
            Found::Attempts(all) => {
                let all = all.iter().map(|it| (&it.attempt, &it.score));
                (all.collect(), None)
            }
            Found::Otherwise(why) => (Vec::new(), Some(words.grades.otherwise(why))),
        };
        let name = format!("{stem}.report.html");
        let page = told_page(
            student,
            &attempts,
            not_graded.as_deref(),
            &self.graded.lesson,
            &words.texts,
        );
        write_over(&out.join(&name), page.as_bytes())?;
        Ok(name)
    }
}

/// Whose sitting it was, if the class's file has it.
fn pseudonym(store: Option<&Store>, session: &Session) -> Result<Option<String>, Failure> {
    let Some(store) = store else { return Ok(None) };
    let found = store.pseudonym_of(session.attempt_id(0)).other()?;
    Ok(found.map(|it| it.to_string()))
}

fn file_name(file: &Path) -> String {
    let name = file.file_name();
    name.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}
