//! One of two experiments that keep up with each other.

use std::sync::Arc;

use glam::Vec3;
use vitriol_lesson::{Attempt, Language, Texts, layered};
use vitriol_run::captions::{self, Caption};
use vitriol_run::{
    Blame, Colour, DeviceStatement, Experiment, FILM_FPS, Failure, Look, Sample, Setup,
    SimulatedTime, Span, Stepping, boiling, sample_is_due,
};
use vitriol_shaders::Library;
use vitriol_sim::scene::{Feature, Scene};
use vitriol_xr::track::TrackSource;

use super::super::assemble::contact;
use super::{HALF, Measured};
use crate::cli::ReplayArgs;
use crate::command::plan::ReplayPlan;

/// The tripod's view of a bench at real size with a wider lens: in half the width it would cut the flasks off. Chosen: 0.19 m to each
/// side of the bench's middle are in the picture.
const BENCH: Look = Look {
    eye: Vec3::new(0.0, 1.06, 0.36),
    target: Vec3::new(0.0, 0.865, -0.40),
    field: 31.0,
};

/// One of the two experiments.
pub(super) struct Side {
    name: String,
    title: String,
    scene: Scene,
    experiment: Box<dyn Experiment>,
    source: TrackSource,
    stepping: Stepping,
    span: Span,
    /// Number of the last sample's time.
    sampled: Option<u64>,
    samples: Vec<Sample>,
    /// The flask that liquid left first.
    poured: Option<String>,
}

impl Side {
    /// At the start of what is planned.
    pub(super) fn new(
        args: &ReplayArgs,
        plan: ReplayPlan,
        prepare: &impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure>,
    ) -> Result<Self, Failure> {
        let experiment = prepare(&Setup {
            picture: Some(HALF),
            colours: vec![Colour::Liquid],
            filter: args.filter,
            tint: args.drawn.tint,
            room: args.drawn.room,
            directed: true,
            look: (plan.scene.scale.length_scale == 1.0).then_some(BENCH),
            shaders: Arc::new(Library::watching()),
            ..plan.setup(args.device.as_deref())
        })?;
        let texts = Texts::of(Language::En).other()?;
        let mut side = Self {
            title: captions::title(texts.scene(&plan.name)),
            name: plan.name,
            scene: plan.scene,
            experiment,
            source: TrackSource::new(plan.track),
            stepping: Stepping::default(),
            span: plan.span,
            sampled: None,
            samples: Vec::new(),
            poured: None,
        };
        side.sample()?;
        Ok(side)
    }

    /// Steps until that frame of a film can be taken: the first state at or after its time, but never the start, when no liquid has
    /// found its neighbours yet. So do all films.
    pub(super) fn reach(&mut self, frame: u64) -> Result<(), Failure> {
        let is_due = |time: SimulatedTime| {
            time.steps() > 0 && time.seconds() * f64::from(FILM_FPS) + 1e-6 >= frame as f64
        };
        while !is_due(self.time()) && !self.is_over() {
            self.step()?;
        }
        Ok(())
    }

    /// Steps and simulated time so far.
    pub(super) fn time(&self) -> SimulatedTime {
        self.stepping.time()
    }

    fn is_over(&self) -> bool {
        self.span.is_over(&self.time())
    }

    fn step(&mut self) -> Result<(), Failure> {
        self.stepping
            .step(&mut self.source, self.experiment.as_mut())?;
        self.sample()
    }

    /// Measures where that is due, when and as often as a report's samples are taken.
    fn sample(&mut self) -> Result<(), Failure> {
        let time = self.time();
        if sample_is_due(&mut self.sampled, &time) || self.is_over() {
            let sample = self.experiment.sample(time.seconds())?;
            if self.poured.is_none() {
                self.poured = left_first(&sample);
            }
            self.samples.push(sample);
        }
        Ok(())
    }

    /// Its picture now.
    pub(super) fn picture(&mut self) -> Result<&[u8], Failure> {
        // Not played, and not to pile up.
        drop(self.experiment.heard()?);
        self.experiment.picture(0)
    }

    /// Whether something happens.
    pub(super) fn is_shown(&self) -> bool {
        self.experiment.worth().shown
    }

    fn thrown_kg(&self) -> f64 {
        let poured = self.poured.as_deref();
        let last = self.samples.last();
        last.map_or(0.0, |it| thrown_kg(it, layered(&self.scene), poured))
    }

    /// What is said of it now.
    pub(super) fn caption(&self) -> Caption {
        let heat = self.samples.last().and_then(|it| it.heat.as_ref());
        Caption {
            title: self.title.clone(),
            hottest_c: heat.map(|heat| heat.temperature_max_c),
            steam_kg: heat.and_then(|heat| Some(heat.ledger.as_ref()?.steam_kg)),
            thrown_kg: self.thrown_kg(),
        }
    }

    /// Goes to the end, where a film's last frame need not be.
    pub(super) fn end(&mut self) -> Result<(), Failure> {
        while !self.is_over() {
            self.step()?;
        }
        Ok(())
    }

    /// What came of it, and on which device.
    pub(super) fn measured(mut self) -> Result<(Measured, DeviceStatement), Failure> {
        let outcome = self.experiment.outcome()?;
        let attempts = Attempt::all(outcome.events);
        let met = contact(&self.samples, &self.scene, &attempts);
        let bubbles = self.scene.models(Feature::Bubbles);
        let thrown_first_kg = boiling(&self.samples, bubbles, met).thrown_first_kg;
        let heats = self.samples.iter();
        let heats = heats.filter_map(|it| Some((it.t_s, it.heat.as_ref()?)));
        let ledger = heats.clone().next_back().and_then(|(_, heat)| heat.ledger);
        let hottest = heats
            .map(|(t, heat)| (t, heat.temperature_max_c))
            .reduce(|a, b| if b.1 > a.1 { b } else { a });
        let measured = Measured {
            simulated_s: self.time().seconds(),
            fluid_particles: outcome.fluid_particles,
            hottest_c: hottest.map(|(_, celsius)| celsius),
            hottest_at_s: hottest.map(|(t, _)| t),
            thrown_kg: self.thrown_kg(),
            thrown_first_kg,
            steam_kg: ledger.map(|ledger| ledger.steam_kg),
            state_hash: format!("{:016x}", outcome.state_hash),
            scene: self.name,
        };
        Ok((measured, outcome.device))
    }
}

/// The flask that liquid left, the most where it left several.
fn left_first(sample: &Sample) -> Option<String> {
    let left = sample.left_kg.iter().filter(|(_, kg)| **kg > 0.0);
    let most = left.max_by(|a, b| a.1.total_cmp(b.1));
    most.map(|(flask, _)| flask.clone())
}

/// What was thrown out so far, kg, counted as a report counts it: each particle once. Nobody has told yet where acid and water met, since
/// events are found when they are over; but liquid is poured from the flask that it leaves first, and what leaves any other was thrown
/// out of it. Where the liquids lie on one another (`layered`) it is that flask's.
fn thrown_kg(sample: &Sample, layered: Option<&str>, poured: Option<&str>) -> f64 {
    let is_thrown = |flask: &str| match (layered, poured) {
        (Some(layered), _) => flask == layered,
        (None, Some(poured)) => flask != poured,
        (None, None) => false,
    };
    let left = sample.left_kg.iter();
    left.filter(|(flask, _)| is_thrown(flask.as_str()))
        .fold(0.0, |sum, (_, kg)| sum + kg)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is poured is not thrown; what leaves the flask that it is poured into is.
    #[test]
    fn what_leaves_the_other_flask_is_thrown() {
        let sample = |left: [(&str, f64); 3]| Sample {
            left_kg: left.map(|(flask, kg)| (flask.to_owned(), kg)).into(),
            ..Sample::default()
        };
        let before = sample([("beaker", 0.0), ("bottle", 0.0), ("flask", 0.0)]);
        assert_eq!(left_first(&before), None);
        assert_eq!(thrown_kg(&before, None, None), 0.0);
        let begun = sample([("beaker", 0.0), ("bottle", 0.0), ("flask", 1e-3)]);
        let poured = left_first(&begun);
        assert_eq!(poured.as_deref(), Some("flask"));
        assert_eq!(thrown_kg(&begun, None, poured.as_deref()), 0.0);
        let boils = sample([("beaker", 0.25), ("bottle", 0.5), ("flask", 8.0)]);
        assert_eq!(thrown_kg(&boils, None, poured.as_deref()), 0.75);
        assert_eq!(thrown_kg(&boils, Some("beaker"), Some("beaker")), 0.25);
    }
}
