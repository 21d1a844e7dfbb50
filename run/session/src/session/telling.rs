//! A session and its instructor: her orders are carried out, and the console is sent the session's state, as panel and window title are.

use std::time::Instant;

use vitriol_console::List;
use vitriol_run::scenery::has_acid;
use vitriol_run::{Action, Failure};
use vitriol_sim::scene::PictureTint;
use vitriol_sim::solver::Skin;
use vitriol_xr::{Shown, Side};

use super::Session;
use super::instructor::Now;
use crate::decision::Decision;
use crate::info::{Info, Lying};

/// Steps in which the panel's rings fill, per cent: the panel is drawn anew for each.
const RING: u32 = 5;

/// A share of a hold, 0 to 1, in those steps, per cent.
fn in_rings(share: f32) -> u32 {
    RING * (100.0 * share / RING as f32) as u32
}

impl Session {
    /// Carries out the instructor's orders; returns whether one ends the session.
    pub(super) fn obey(&mut self) -> bool {
        let mut ends = false;
        for (order, asked) in self.instructor.orders() {
            let said = match asked.and_then(|asked| asked.at(self.run.scene())) {
                Some(Decision::End) => {
                    ends = true;
                    Some(self.texts.instructor.end.clone())
                }
                Some(Decision::Act(action)) => self.follow(action),
                _ => None,
            };
            if let Some(said) = said {
                tracing::info!("{said}");
                self.instructor.announce(said);
            }
            self.instructor.taken_up(order);
        }
        ends
    }

    /// Carries out an instructor's action from the next step on, and returns it in words; `None` where it is not done.
    fn follow(&mut self, action: Action) -> Option<String> {
        let words = &self.texts.instructor;
        let said = match &action {
            Action::Scene(name) => words.scene(self.summary.texts().scene(name)),
            Action::Start(_) => words.start.clone(),
            action => words.instruction(action),
        };
        if !action.is_instructors() {
            self.choices.add(Some(Decision::Act(action)));
            return Some(said);
        }
        match self.run.act(action.clone()) {
            Ok(true) => {}
            Ok(false) => return None,
            Err(error) => {
                tracing::warn!("the instructor's wish is left out: {error}");
                return None;
            }
        }
        match &action {
            // The hands went on meanwhile: what they hold goes to where they are.
            Action::Pause(false) if self.instructor.holds_time() => self.placement.interrupt(),
            Action::Speed(rate) => self.steps.clock.rate = *rate,
            _ => {}
        }
        self.instructor.follow(&action);
        Some(said)
    }

    /// A replay does what was switched before the step that came next. Where none would, one more is taken.
    pub(super) fn step_for_switches(&mut self) -> Result<(), Failure> {
        let last = self.placement.last.clone();
        let (Some(now), true) = (last, self.run.awaits_step()) else {
            return Ok(());
        };
        if self.instructor.holds_time() {
            // As where time goes on.
            self.placement.interrupt();
            if let Some(leap) = self.placement.place(&now, false) {
                self.run.act(leap)?;
            }
            self.placement.last = Some(now.clone());
        }
        let scene = self.run.world.scene();
        self.steps.once_more(&now, &self.placement, scene);
        Ok(())
    }

    /// Sends the console the session's present state.
    pub(super) fn tell(&mut self, ended: bool) {
        let run = &self.run;
        let info = self.placement.last.as_ref().map(|last| last.info);
        let period = info.filter(|info| info.period_ns > 0);
        self.instructor.tell(&Now {
            frame: self.counts.frames,
            time: run.time().seconds(),
            scene: (run.scene(), run.world.scene()),
            flasks: self.readings.names(),
            coming: self.benches.coming(),
            holds: Side::BOTH
                .iter()
                .any(|side| run.world.holds(*side as usize)),
            intensity: run.world.intensity(),
            spilt: self.spills.spilt,
            events: run.events(),
            so_far: &|| run.so_far(),
            period: period.map(|info| 1e-9 * info.period_ns as f64),
            missed: self.counts.skipped,
            step: self.guide.step(run),
            points: self.guide.points(run),
            rubric: self.summary.rubric(),
            hints: List::clipped(self.guide.hints()),
            ended,
        });
    }

    /// The state that panel and window title show.
    pub(super) fn info(&mut self) -> Info {
        let now = Instant::now();
        let ends = self.choices.asks_to_end(now);
        let (bench, run) = (&self.benches.current, &self.run);
        let ends_told = ends && self.guide.tells(run);
        let happened = (self.summary).shown(&self.texts.summary, run, ends_told);
        let (scene, texts, recorded) = (run.world.scene(), self.summary.texts(), run.recorded());
        Info {
            scene: run.scene().to_owned(),
            title: texts.scene(run.scene()).to_owned(),
            flasks: (self.readings).lines(scene, |flask| run.world.is_broken(flask)),
            acid: has_acid(scene) && scene.picture.tint == PictureTint::Artificial,
            spilt: Lying::of(self.spills.spilt.bench, self.spills.spilt.floor),
            heard: (self.texts).heard(&self.sounds.captions(1e-9 * self.shown_at() as f64)),
            device_lost: self.losses.is_said(self.counts.frames),
            burns: Skin::ALL.map(|skin| self.spills.touched(skin)),
            slow: self.steps.slow_motion(),
            recording: recorded.as_ref().map(|_| run.time().seconds() as u64),
            waits_for_disk: recorded.as_ref().is_some_and(|state| state.refused),
            unwritten: recorded.map_or(0, |state| state.unwritten),
            missed: self.counts.skipped,
            effort: self.pacing.effort(bench),
            coming: self.benches.coming().map(|it| texts.scene(it).to_owned()),
            holding: self.choices.holding(self.shown_at()).map(in_rings),
            key_held: self.choices.key_held(self.shown_at(), now).map(in_rings),
            pouring: self.readings.pouring(),
            ends,
            pointer: self.pointer,
            happened,
            lesson: self.guide.shown(run, &self.texts.lesson),
            told: (self.instructor).told(&self.texts.instructor, self.shown_at()),
        }
    }

    /// Shows the instructor what the left eye sees, and behind it the glass from close by.
    pub(super) fn show_instructor(&mut self, shown: &Shown, time: i64) -> Result<(), Failure> {
        let picture = self.benches.current.picture.image();
        if let Some(view) = &mut self.instructor.view {
            view.take(picture, shown.extent, time)?;
        }
        self.show_close_up(time)
    }
}
