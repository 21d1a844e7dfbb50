//! Keeps what a student did: in the class's file, as statements, and in a Learning Record Store where one is named.

use std::path::{Path, PathBuf};

use serde::Serialize;
use vitriol_lesson::{Attempt, Lesson, Rubric, Score, Texts};
use vitriol_record::lrs::{Lrs, Patience, Token};
use vitriol_record::store::{Store, default_path};
use vitriol_record::{Cap, KeepError, Keeping, Points, Scored, Session, keep};
use vitriol_run::output::make_folder;
use vitriol_run::units::count;
use vitriol_run::{Blame, Failure};
use vitriol_xr::files;

use crate::cli::KeepArgs;

/// What was kept in the class's file, and sent.
#[derive(Debug, Serialize)]
pub struct Kept {
    /// The class's file.
    pub class: String,
    /// Attempts that were not kept before.
    pub new: usize,
    /// Attempts that were.
    pub before: usize,
    /// The file of statements.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub statements: Option<String>,
    /// The result of sending the statements.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sent: Option<Delivered>,
}

/// The result of sending statements to their store.
#[derive(Debug, Serialize)]
pub struct Delivered {
    /// Statements that the store has since.
    pub delivered: u64,
    /// Statements that wait for the next time.
    pub waiting: u64,
    /// What it refused, and why.
    pub refused: Vec<String>,
    /// Why it went no further.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopped: Option<String>,
}

/// Where attempts come from.
pub struct Sitting<'a> {
    /// The sitting.
    pub session: Session,
    /// The recording.
    pub source: Option<&'a Path>,
    /// The folder for statements.
    pub out: Option<&'a Path>,
    /// The lesson, if there is one: it is named beside the attempts, and its caps are theirs.
    pub lesson: Option<&'a Lesson>,
}

/// What is needed to keep attempts, found before anything is simulated.
#[derive(Debug, Default)]
pub struct Keeper {
    class: Option<PathBuf>,
    lrs: Option<Lrs>,
}

/// Opens the class's file and reads the token's, so that a mistake in them costs nobody a session.
///
/// # Errors
/// [`Failure::Input`] for files that are none, or a token that others may read.
pub fn keeper(args: &KeepArgs) -> Result<Keeper, Failure> {
    if args.pseudonym.is_none() {
        return Ok(Keeper::default());
    }
    let class = args.class.clone().or_else(default_path);
    let class =
        class.ok_or("this system tells no folder for data: name the class's file with --class");
    let class = class.input()?;
    if let Some(folder) = class.parent().filter(|_| args.class.is_none()) {
        make_folder(folder)?;
    }
    Store::open(&class).input()?;
    let lrs = match (&args.lrs, &args.lrs_token) {
        (Some(endpoint), Some(file)) => Some(Lrs {
            endpoint: endpoint.clone(),
            token: Token::held(file, &files::read_line(file, "token").input()?).input()?,
            patience: Patience::default(),
        }),
        _ => None,
    };
    Ok(Keeper {
        class: Some(class),
        lrs,
    })
}

/// Keeps them under the pseudonym that was given; `None` where none was.
///
/// # Errors
/// [`Failure::Input`] where the class's file is none; [`Failure::Other`] where something cannot be written.
pub fn keep_under(
    args: &KeepArgs,
    keeper: &Keeper,
    sitting: &Sitting<'_>,
    attempts: &[Attempt],
) -> Result<Option<Kept>, Failure> {
    let (Some(pseudonym), Some(class)) = (&args.pseudonym, &keeper.class) else {
        return Ok(None);
    };
    let texts = Texts::english().other()?;
    let rubric = sitting.lesson.map(Lesson::rubric).unwrap_or_default();
    let attempts: Vec<Scored> = attempts
        .iter()
        .map(|it| scored(it, &rubric, &texts))
        .collect();
    let kept = keep(&Keeping {
        class,
        pseudonym,
        session: sitting.session,
        lesson: sitting.lesson.map(|it| it.name.as_str()),
        source: sitting.source,
        attempts: &attempts,
        out: sitting.out,
        lrs: keeper.lrs.as_ref(),
    });
    let kept = kept.map_err(|error| match error {
        KeepError::Write { .. } => Failure::Other(error.into()),
        _ => Failure::Input(error.into()),
    })?;
    Ok(Some(Kept {
        class: class.display().to_string(),
        new: kept.new,
        before: kept.before,
        statements: kept.statements.map(|file| file.display().to_string()),
        sent: kept.sent.map(|sent| Delivered {
            delivered: sent.delivered,
            waiting: sent.waiting,
            refused: sent.refused.into_iter().map(|it| it.why).collect(),
            stopped: sent.stopped,
        }),
    }))
}

fn scored(attempt: &Attempt, rubric: &Rubric, texts: &Texts) -> Scored {
    let score = Score::of(attempt, rubric, texts);
    let [points, of] = [score.points, score.of].map(f64::from);
    // Where nothing could be judged there is none.
    let mut kept = vitriol_record::Score::new(points, of).ok();
    if let Some(kept) = &mut kept {
        let lines = score.lines.iter();
        kept.points = lines
            .map(|line| Points {
                criterion: line.criterion.name(texts),
                raw: line.points.into(),
                max: line.of.into(),
            })
            .collect();
        let caps = score.caps.iter();
        kept.caps = caps
            .map(|cap| Cap {
                danger: cap.danger.name().to_owned(),
                max: cap.most.into(),
            })
            .collect();
    }
    Scored {
        attempt: attempt.clone(),
        score: kept,
    }
}

impl Kept {
    /// In lines.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!("kept    {} new in {}", self.new, self.class)];
        lines.extend(self.statements.iter().map(|file| format!("xAPI    {file}")));
        let Some(sent) = &self.sent else {
            return lines;
        };
        lines.push(format!(
            "sent    {}, {} waiting",
            count(sent.delivered, "statement"),
            sent.waiting
        ));
        lines.extend(sent.refused.iter().map(|why| format!("refused {why}")));
        lines.extend(sent.stopped.iter().map(|why| format!("stopped {why}")));
        lines
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_lesson::{Content, Pour};

    /// The class's file and the statements say why the points are capped.
    #[test]
    fn a_cap_is_kept_with_its_danger() {
        let pour = |bare_face| Pour {
            t_s: 0.1,
            until_s: 5.1,
            from: "acid".into(),
            into: Some("water".into()),
            volume_m3: 20e-6,
            fastest_m3_s: 4e-6,
            acid: 0.98,
            met: Some(Content {
                volume_m3: 160e-6,
                acid: 0.0,
                temperature_c: None,
            }),
            bare_face,
        };
        let caps = |bare_face| {
            let attempt = Attempt {
                pours: vec![pour(bare_face)],
                ..Attempt::default()
            };
            let texts = Texts::english().unwrap();
            let kept = scored(&attempt, &Rubric::default(), &texts).score.unwrap();
            (kept.max(), kept.caps)
        };
        let (of, capped) = caps(true);
        let [cap] = &capped[..] else {
            unreachable!("{capped:?}");
        };
        assert_eq!(cap.danger, "no-goggles");
        // 60 of 100, rounded down to whole points: both are whole, so that no bit differs.
        assert_eq!(cap.max, (60.0 * of / 100.0).floor());
        assert_eq!(caps(false).1, []);
    }

    #[test]
    fn an_attempt_is_kept_with_its_lesson() {
        let folder = tempfile::tempdir().unwrap();
        let class = folder.path().join("class.sqlite");
        let args = KeepArgs {
            pseudonym: Some("p07".parse().unwrap()),
            class: Some(class.clone()),
            ..KeepArgs::default()
        };
        let keeper = keeper(&args).unwrap();
        let dilute = Lesson::builtin("dilute").unwrap();
        for (lesson, name) in [(Some(&dilute), Some("dilute")), (None, None)] {
            let sitting = Sitting {
                session: Session::now(),
                source: None,
                out: None,
                lesson,
            };
            let kept = keep_under(&args, &keeper, &sitting, &[Attempt::default()]).unwrap();
            assert_eq!(kept.unwrap().new, 1);
            let store = Store::open_existing(&class).unwrap();
            let kept = store.attempt(sitting.session.attempt_id(0)).unwrap();
            assert_eq!(kept.lesson.as_deref(), name);
        }
    }
}
