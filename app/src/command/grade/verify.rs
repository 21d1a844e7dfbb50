//! Simulates a track again, and compares what happens with what its recording says.

use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use vitriol_experiment::progress::Runs;
use vitriol_experiment::{Blame, DeviceStatement, Experiment, Failure, Observer, Setup};
use vitriol_lesson::{Attempt, Rubric, Score, Texts};
use vitriol_shaders::Library;
use vitriol_xr::track::{Track, TrackSource};

use super::agreement::{Agreement, Tolerance};
use crate::cli::GradeArgs;
use crate::command::plan::{Ask, Plan};
use crate::command::recorded::{differences, recorded_events};

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
}

/// Whether a recording says what happened.
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
}

impl Verified {
    /// Simulates `track` again, of which `recorded` is what its recording says, in the scene that was asked for.
    ///
    /// # Errors
    /// As for [`Plan::new`], and what the experiment says.
    pub fn of(
        (args, file): (&GradeArgs, &Path),
        (track, truncated): (Track, bool),
        rubric: &Rubric,
        bars: &Runs,
        prepare: impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure>,
    ) -> Result<Self, Failure> {
        let name = file.display().to_string();
        let ask = Ask {
            track: &name,
            // Before what the track carries under that name.
            scene: Some(&args.scene),
            preset: args.preset,
            device: args.device.as_deref(),
            accept_truncated: args.accept_truncated,
            ..Ask::default()
        };
        let events = recorded_events(&track);
        let metadata = track.metadata.clone();
        let plan = Plan::of(&ask, track)?;
        let mut experiment = prepare(&Setup {
            scene: &plan.scene,
            scene_name: &plan.name,
            scenes: &plan.scenes,
            preset: plan.preset,
            seed: plan.seed,
            device: args.device.as_deref(),
            picture: None,
            colours: Vec::new(),
            eyes: 1,
            filter: None,
            head: None,
            shaders: Arc::new(Library::embedded()),
        })?;
        let mut observer = Observer::new(plan.span, Vec::new(), bars.of(&name, plan.span));
        let mut source = TrackSource::new(plan.track);
        vitriol_experiment::run(&mut source, experiment.as_mut(), plan.span, &mut observer)?;
        let outcome = experiment.outcome()?;
        let scene = (plan.name.as_str(), &plan.scenes);
        // What was not yet over where a recording breaks off is not in it.
        let asked = truncated.then_some("--accept-truncated");
        let differs = differences(&metadata, scene, Some(&outcome.device), asked.as_slice());
        let to_the_bit = events == outcome.events;
        let found = Attempt::all(outcome.events);
        let tolerance = args.tolerance.unwrap_or_default();
        let texts = Texts::english().other()?;
        let points = found.iter().map(|it| Score::of(it, rubric, &texts));
        Ok(Self {
            device: outcome.device,
            asked_device: args.device.clone(),
            differs,
            to_the_bit,
            agreement: Agreement::of(&Attempt::all(events), &found, tolerance),
            tolerance,
            points: points.map(|it| [it.points, it.of]).collect(),
        })
    }

    /// Whether the recording says what happened: to the bit where nothing is known to differ.
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
    pub fn text(&self) -> String {
        if self.to_the_bit {
            return String::new();
        }
        let agreement = self.agreement.text();
        if self.differs.is_empty() {
            format!("not to the bit on the same device: {agreement}")
        } else {
            agreement
        }
    }
}
