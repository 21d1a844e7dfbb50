//! What the user chooses, by button, key and panel.

use glam::Vec3;
use vitriol_sim::scene::Flask;
use vitriol_xr::{Hand, Headset, PoseFrame, Side, Switch};

use super::{Coming, Decision, SWITCH_PLACEMENT, Session, TAKEN_UP, blame};
use crate::experiment::{SWITCH_SCENE, SWITCH_START};
use crate::failure::Failure;
use crate::vr::bench::{Builder, Plan};
use crate::vr::inputs::Pressed;
use crate::vr::panel::{FlaskLine, Info};
use crate::vr::placement;

/// Speed below which it is slow motion that one would see.
const SLOW: f64 = 0.97;

impl Session {
    /// Takes in what was decided elsewhere than in the headset.
    pub(super) fn hear(&mut self, headset: &mut dyn Headset) -> Result<(), Failure> {
        while let Ok(decision) = self.decisions.try_recv() {
            match decision {
                Decision::End => headset.request_exit().map_err(blame)?,
                decision => self.wanted.push(decision),
            }
        }
        Ok(())
    }

    /// Does what was decided.
    pub(super) fn decide(
        &mut self,
        headset: &mut dyn Headset,
        pressed: Pressed,
        recentred: bool,
        now: &PoseFrame,
    ) -> Result<(), Failure> {
        let mut recentre = pressed.recentre || recentred || self.placed.is_none();
        let mut scene = pressed.start.then(|| self.bench.plan.scene.clone());
        for decision in std::mem::take(&mut self.wanted) {
            match decision {
                Decision::Scene(name) => scene = Some(name),
                Decision::Start => scene = Some(self.bench.plan.scene.clone()),
                Decision::Recentre => recentre = true,
                Decision::End => headset.request_exit().map_err(blame)?,
            }
        }
        if let Some(scene) = scene {
            self.build(headset, scene);
        }
        if recentre {
            let placed = placement::before(&now.stage_from_view, self.options.posture);
            self.placed = Some(placed);
            self.switch(SWITCH_PLACEMENT, placement::as_text(&placed));
            // In between lies the leap from one stage to the other.
            self.last = None;
            self.clock.pause();
        }
        Ok(())
    }

    /// Begins to build a scene at its start.
    fn build(&mut self, headset: &dyn Headset, scene: String) {
        let same = scene == self.bench.plan.scene;
        let switch = Switch {
            key: if same { SWITCH_START } else { SWITCH_SCENE }.into(),
            value: scene.clone(),
        };
        let mut plan = Plan {
            scene,
            ..self.bench.plan.clone()
        };
        if !same {
            // What was asked for was asked for of the first scene.
            (plan.solver, plan.filter) = (None, None);
        }
        let (gpu, eyes) = (headset.gpu(), self.eyes.clone());
        let builder = Builder::start(gpu, &self.library, plan, eyes);
        self.coming = Some(Coming { builder, switch });
    }

    /// Takes up the bench that was built meanwhile.
    pub(super) fn take_up_bench(&mut self) -> Result<(), Failure> {
        let Some(coming) = self.coming.take_if(|coming| coming.builder.is_finished()) else {
            return Ok(());
        };
        let eyes = coming.builder.eyes().clone();
        match coming.builder.finish() {
            Ok(bench) => {
                let resolution = self.setting().resolution;
                self.bench = bench;
                // What the lenses hide may have changed since; it is taken up after the frame.
                self.eyes = eyes;
                let same = coming.switch.key == SWITCH_START;
                tracing::info!(target: TAKEN_UP, "set up: {}", coming.switch.value);
                self.switches.push(coming.switch);
                self.pace_bench(same, resolution)?;
                // Of the bench that was.
                self.reading = None;
                self.read.clear();
            }
            Err(failure) => tracing::warn!("the bench stays as it is: {failure}"),
        }
        Ok(())
    }

    pub(super) fn switch(&mut self, key: &str, value: String) {
        self.switches.push(Switch {
            key: key.into(),
            value,
        });
    }

    /// Lets the hands that are free point at the panel; `seen` is the user in the scene's stage.
    pub(super) fn show_panel(&mut self, seen: Option<&PoseFrame>) {
        let world = &self.bench.world;
        let holds = |side: Side| {
            let mut flasks = 0..world.scene().flasks.len();
            flasks.any(|flask| world.holder(flask) == Some(side as usize))
        };
        let pointing = |side: Side| -> Option<&Hand> {
            let hand = seen?.hand(side);
            (hand.active && hand.valid && !holds(side)).then_some(hand)
        };
        let hands = Side::BOTH.map(pointing);
        let info = self.info();
        self.wanted.extend(self.panel.update(hands, &info));
        if let Some(mirror) = &mut self.mirror {
            mirror.entitle(&info, None);
        }
    }

    pub(super) fn info(&self) -> Info {
        let scene = self.bench.world.scene();
        let acid = scene
            .liquids
            .iter()
            .any(|liquid| liquid.acid_fraction > 0.0);
        let line = |(index, flask): (usize, &Flask)| {
            let reading = self.read.get(index).filter(|reading| reading.particles > 0);
            FlaskLine {
                name: flask.name.clone(),
                temperature: reading.map(|reading| reading.temperature.round() as i32),
                acid: reading
                    .filter(|_| acid)
                    .map(|reading| (100.0 * reading.acid).round() as i32),
            }
        };
        // A funnel, which hangs upside down, holds nothing for long.
        let upright = |flask: &Flask| (flask.stage_from_flask.orientation * Vec3::Y).y > 0.0;
        let flasks = scene.flasks.iter().enumerate();
        let flasks = flasks.filter(|(_, flask)| upright(flask)).map(line);
        let recorded = self.recording.as_ref().map(|recording| recording.state());
        Info {
            scene: self.bench.plan.scene.clone(),
            flasks: flasks.collect(),
            acid,
            slow: (self.speed < SLOW).then(|| 5 * (20.0 * self.speed).round() as u32),
            recording: recorded.as_ref().map(|_| self.time.seconds() as u64),
            unwritten: recorded.map_or(0, |recorded| recorded.unwritten),
            missed: self.skipped,
            effort: self.effort(),
            coming: self
                .coming
                .as_ref()
                .map(|coming| coming.switch.value.clone()),
        }
    }
}
