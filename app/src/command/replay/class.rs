//! What a class has beside a replay: the console that shows it, and the class's file that keeps it.

use std::path::Path;
use std::time::{Duration, SystemTime};

use vitriol_lesson::{Attempt, Lesson};
use vitriol_record::{Session, Timestamp};
use vitriol_run::{Blame, Experiment, Failure, Format};
use vitriol_xr::track::Track;

use crate::cli::ReplayArgs;
use crate::command::keeping::{self, Keeper, Kept, Sitting};
use vitriol_live::{Live, Serving};

/// The console of a run of the program, where `--live` asks for one.
pub(super) struct ReplayConsole(Option<Serving>);

impl ReplayConsole {
    /// Serves it and lets one browser in.
    ///
    /// # Errors
    /// [`Failure::Input`] for options that do not go together, or an address that cannot be listened on.
    pub fn begin(args: &ReplayArgs, format: Format) -> Result<Self, Failure> {
        if !args.live && args.console.is_given() {
            return Err("--listen, --hub and --name are of the console: give --live with them")
                .input();
        }
        if args.tracks.len() > 1 && args.keep.pseudonym.is_some() {
            return Err(
                "--pseudonym: several tracks are of several students; replay one at a time",
            )
            .input();
        }
        let serving = args
            .live
            .then(|| Serving::begin(&args.console, args.language, false));
        let serving = serving.transpose()?;
        if let Some(serving) = &serving {
            serving.invite(format)?;
        }
        Ok(Self(serving))
    }

    /// The experiment, which the console shows from now on.
    ///
    /// # Errors
    /// [`Failure::Other`] where no thread can be started.
    pub fn show(
        &self,
        experiment: Box<dyn Experiment>,
        scene: &str,
    ) -> Result<Box<dyn Experiment>, Failure> {
        match &self.0 {
            Some(serving) => Ok(Box::new(Live::new(experiment, serving.console(), scene)?)),
            None => Ok(experiment),
        }
    }
}

/// What is needed to keep a track's attempts, found before it is simulated.
pub(super) struct Record<'a> {
    args: &'a ReplayArgs,
    keeper: Keeper,
    session: Session,
    source: &'a Path,
}

impl<'a> Record<'a> {
    /// `asked` names the options that ask for something else than was recorded.
    ///
    /// # Errors
    /// [`Failure::Input`] where there are any, or the class's file or a token cannot be used.
    pub fn of(
        (args, name): (&'a ReplayArgs, &'a str),
        track: &Track,
        asked: &[&str],
    ) -> Result<Self, Failure> {
        if let (true, Some(option)) = (args.keep.pseudonym.is_some(), asked.first()) {
            return Err(format!(
                "--pseudonym keeps what was recorded, and {option} asks for something else: leave one of them out"
            ))
            .input();
        }
        Ok(Self {
            args,
            keeper: keeping::keeper(&args.keep)?,
            session: session(name, track),
            source: Path::new(name),
        })
    }

    /// Keeps the attempts, of that lesson if one is named, with statements in the folder `out`; `None` without a pseudonym.
    ///
    /// # Errors
    /// As [`keeping::keep_under`].
    pub fn keep(
        &self,
        out: &Path,
        lesson: Option<&Lesson>,
        attempts: &[Attempt],
    ) -> Result<Option<Kept>, Failure> {
        let sitting = Sitting {
            session: self.session,
            source: Some(self.source),
            out: Some(out),
            lesson,
        };
        keeping::keep_under(&self.args.keep, &self.keeper, &sitting, attempts)
    }
}

/// The sitting that a track was recorded in, which began as long before its file was written as it lasts; of a built-in track one of now.
fn session(name: &str, track: &Track) -> Session {
    let Ok(content) = std::fs::read(name) else {
        return Session::now();
    };
    let written = Path::new(name).metadata().and_then(|it| it.modified()).ok();
    // A copy's clock may be ahead, and no statement may be of the future.
    let written = written.map(|at| at.min(SystemTime::now()));
    let begun = written.and_then(|at| at.checked_sub(Duration::from_secs_f64(track.duration())));
    let begun = begun.and_then(|at| Timestamp::try_from(at).ok());
    Session::of_recording(&content, begun.unwrap_or_else(Timestamp::now))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_run::track::load;

    /// A Learning Record Store may refuse statements of the future.
    #[test]
    fn a_recording_of_a_fast_clock_is_not_of_the_future() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("k.mcap");
        let file = std::fs::File::create(&path).unwrap();
        let ahead = SystemTime::now() + Duration::from_secs(3 * 86_400);
        file.set_modified(ahead).unwrap();
        let sitting = session(path.to_str().unwrap(), &load("two-flasks").unwrap());
        assert!(sitting.begun <= Timestamp::now());
    }
}
