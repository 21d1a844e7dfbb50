//! Simulates a track again, and compares the result with what its recording holds.

use std::path::Path;

use serde::{Deserialize, Serialize};
use vitriol_lesson::procedure::{Progress, Verdict as LessonVerdict};
use vitriol_lesson::{Attempt, Event, Score, Texts};
use vitriol_run::progress::Runs;
use vitriol_run::texts::VerifiedTexts;
use vitriol_run::{Blame, DeviceStatement, Experiment, Failure, Observer, Setup};
use vitriol_xr::track::{Track, TrackSource};

use super::agreement::{Agreement, Tolerance};
use super::expected::Expected;
use super::wrong::Words;
use crate::cli::GradeArgs;
use crate::command::course;
use crate::command::plan::{Ask, ReplayPlan};
use crate::command::recorded::{differences, recorded_events, recorded_progress};

/// What simulating a track again came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verified {
    /// The device.
    pub device: DeviceStatement,
    /// What it was asked for by.
    pub asked_device: Option<String>,
    /// In what this run is known to differ from the session, such as the device; its bits may differ then.
    pub differs: Vec<String>,
    /// Whether all that happened is the same, to the bit.
    pub to_the_bit: bool,
    /// How it agrees otherwise.
    pub agreement: Agreement,
    /// The tolerance that this is by.
    pub tolerance: Tolerance,
    /// Points of each attempt that was found, and of how many.
    pub points: Vec<[u32; 2]>,
    /// What was found of the lesson in each, where one is judged.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lesson: Vec<LessonVerdict>,
}

/// Whether a recording agrees with its simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// To the bit.
    ToTheBit,
    /// Within the tolerance, on another device.
    WithinTolerance,
    /// No.
    Differs,
}

impl Verdict {
    /// Its name, as in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::ToTheBit => "to-the-bit",
            Self::WithinTolerance => "within-tolerance",
            Self::Differs => "differs",
        }
    }

    /// It in words.
    pub fn said(self, texts: &VerifiedTexts) -> &str {
        match self {
            Self::ToTheBit => &texts.to_the_bit,
            Self::WithinTolerance => &texts.within_tolerance,
            Self::Differs => &texts.differs,
        }
    }
}

impl Verified {
    /// Simulates `track` again, of which `recorded` is what its recording holds, in the scene that was asked for.
    ///
    /// # Errors
    /// As for [`Plan::new`], and errors of the experiment.
    pub fn of(
        (args, file): (&GradeArgs, &Path),
        (track, truncated): (Track, bool),
        expected: &Expected,
        bars: &Runs,
        prepare: impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure>,
    ) -> Result<Self, Failure> {
        let name = file.display().to_string();
        let ask = Ask {
            track: &name,
            // Before what the track carries under that name.
            scene: Some(&expected.source),
            preset: args.preset,
            device: args.device.as_deref(),
            accept_truncated: args.accept_truncated,
            language: args.language,
            ..Ask::default()
        };
        let (events, progress) = (recorded_events(&track), recorded_progress(&track));
        let metadata = track.metadata.clone();
        let plan = ReplayPlan::of(&ask, track)?;
        let mut experiment = prepare(&plan.setup(args.device.as_deref()))?;
        if let Some((lesson, mode)) = &expected.lesson {
            let text = plan.scenes.text(&plan.name);
            let scene = (plan.name.as_str(), text.as_deref());
            experiment.judge(course::judging((lesson, *mode), scene, args.language)?);
        }
        let mut observer = Observer::new(plan.span, Vec::new(), bars.of(&name, plan.span));
        let mut source = TrackSource::new(plan.track);
        vitriol_run::replay(&mut source, experiment.as_mut(), plan.span, &mut observer)?;
        let outcome = experiment.outcome()?;
        let scene = (plan.name.as_str(), &plan.scenes);
        // What was not yet over where a recording breaks off is not in it.
        let asked = truncated.then_some("--accept-truncated");
        let differs = differences(&metadata, scene, Some(&outcome.device), asked.as_slice());
        let judged = expected.lesson.is_none() || progress == outcome.progress;
        let to_the_bit = Event::are_same(&events, &outcome.events) && judged;
        let retold = |said: &[Progress]| {
            let lesson = expected.lesson.as_ref();
            let retold = lesson.map(|(lesson, mode)| LessonVerdict::retold(lesson, *mode, said));
            retold.unwrap_or_default()
        };
        let lessons = [retold(&progress), retold(&outcome.progress)];
        let found = Attempt::all(outcome.events);
        let tolerance = args.tolerance.unwrap_or_default();
        let texts = Texts::english().other()?;
        let points = found.iter();
        let points = points.map(|it| Score::of(it, &expected.asked.rubric, &texts));
        let agreement = Agreement::of(&Attempt::all(events), &found, tolerance);
        Ok(Self {
            device: outcome.device,
            asked_device: args.device.clone(),
            differs,
            to_the_bit,
            agreement: agreement.with_lesson(&lessons[0], &lessons[1], tolerance),
            tolerance,
            points: points.map(|it| [it.points, it.of]).collect(),
            lesson: lessons.into_iter().next_back().unwrap_or_default(),
        })
    }

    /// Whether the recording agrees with its simulation: to the bit where nothing is known to differ.
    pub fn verdict(&self) -> Verdict {
        if self.to_the_bit {
            Verdict::ToTheBit
        } else if !self.differs.is_empty() && self.agreement.beyond.is_empty() {
            Verdict::WithinTolerance
        } else {
            Verdict::Differs
        }
    }

    /// In what it differs, in a few words; empty where in nothing.
    pub fn text(&self, words: &Words) -> String {
        if self.to_the_bit {
            return String::new();
        }
        let why = self.agreement.text(words);
        if self.differs.is_empty() {
            words.grades.verified.same_device.fill(&[("why", &why)])
        } else {
            why
        }
    }
}
