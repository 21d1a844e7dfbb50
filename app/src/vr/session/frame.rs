//! One frame: the parts of a session, in the order in which a frame goes through them (docs/headset.md, "A frame").

use std::time::Instant;

use vitriol_experiment::scenery::has_acid;
use vitriol_experiment::switches::SWITCH_START;
use vitriol_experiment::{Blame, Failure};
use vitriol_gpu::Ticket;
use vitriol_render::camera::NEAR;
use vitriol_sim::world::World;
use vitriol_xr::{Hand, Headset, HeadsetFrame, PoseFrame, Shown, Side, Targets};

use super::Session;
use super::ended::NoFrameOpen;
use crate::vr::blame::blame;
use crate::vr::closing;
use crate::vr::haptics;
use crate::vr::info::Info;
use crate::vr::inputs::sound;
use crate::vr::ladder::Setting;
use crate::vr::panel;
use crate::vr::picture::{Sight, eye};
use crate::vr::tally::Submitted;
use crate::vr::workbench::Workbench;

/// Steps in which the panel's rings fill, per cent: the panel is drawn anew for each.
const RING: u32 = 5;

impl Session {
    /// One frame, which the headset's `next` has begun: item 1 of the list. Between there and the end nothing waits
    /// for the device.
    pub(super) fn frame(
        &mut self,
        headset: &mut dyn Headset,
        frame: &HeadsetFrame,
    ) -> Result<(), Failure> {
        let begun = Instant::now();
        let info = frame.poses.info;
        if self.counts.begin(&info) {
            self.pacing.missed = true;
        }
        if self.counts.is_first() {
            // What came before was the warm-up.
            self.pacing.report.changes = 0;
            self.pacing.report.settings.clear();
            self.pacing.report.rates.clear();
        }
        // 2. What the user decided, and a bench that was built meanwhile.
        let mut now = sound(&frame.poses, self.placement.last.as_ref());
        self.decide(headset, frame.recentred, &now);
        self.replace_bench()?;
        let (world, placed) = (&self.benches.current.world, &self.placement);
        let (last, stage_from_scene) = (placed.last.as_ref(), placed.stage_from_scene());
        closing::close(&mut now, &frame.joints, last, world, &stage_from_scene);
        if let Some(latches) = &mut self.latches {
            // A bare hand has nothing to press.
            for side in Side::BOTH
                .into_iter()
                .filter(|side| frame.joints[*side as usize].is_none())
            {
                let holds = held_by(world, side).next().is_some();
                latches.apply(side, &mut now.hands[side as usize], holds);
            }
        }
        let scene_from_stage = stage_from_scene.inverse();
        self.joints = frame.joints.each_ref().map(|joints| {
            let joints = joints.as_ref()?.0;
            Some(joints.map(|(at, radius)| (scene_from_stage.transform_point(at), radius)))
        });
        // 3. The steps up to this frame's display time.
        self.take_steps(now)?;
        // 4. What the hands feel.
        self.vibrate(headset)?;
        let shown = if frame.should_render {
            // 5. The panel, and which button of it a hand points at.
            self.show_panel();
            // 6. The images, and the liquid's ellipsoids behind the steps.
            match self.acquire(headset)? {
                // 7. The eyes, as late as can be, and the picture for them.
                Some((targets, shapes)) => Some(self.locate_and_draw(headset, &targets, shapes)?),
                None => None,
            }
        } else {
            None
        };
        if shown.is_none() {
            // Times are of frames that are shown.
            self.steps.submitted();
        }
        // 8. The frame's end, with what is shown.
        let no_frame = NoFrameOpen::by_ending(headset, shown.as_ref())?;
        // 9. The mirror's part, behind the picture, and what may wait for the device.
        if let (Some(mirror), Some(shown)) = (&mut self.mirror, &shown) {
            let picture = self.benches.current.picture.image();
            mirror.take(picture, shown.extent, info.xr_time)?;
        }
        self.counts.tally.frame(1e3 * begun.elapsed().as_secs_f64());
        self.catch_up(&no_frame)?;
        // 10. What the next frames are solved and drawn with.
        let (loads, period) = (self.counts.tally.loads(), 1e-6 * info.period_ns as f64);
        let (benches, track) = (&mut self.benches, &mut self.track);
        let display = (period, headset.rates());
        self.pacing
            .govern(&loads, display, benches, track, &no_frame)?;
        if let Some(rate) = self.pacing.wants_rate.take() {
            headset.request_rate(rate).map_err(blame)?;
        }
        // 11. What the lenses hide.
        self.benches.take_mask(headset, &no_frame)
    }

    /// Does what the user decided by button, key and panel; what the panel says in this frame is for the next one.
    fn decide(&mut self, headset: &dyn Headset, recentred: bool, now: &PoseFrame) {
        let present = &self.benches.current.plan.scene;
        let chosen = self.choices.take(&now.hands, now.info.xr_time, present);
        if let Some(scene) = chosen.scene {
            self.benches.build(headset.gpu(), scene);
        }
        if let Some(switch) = self.placement.place(now, chosen.recentre || recentred) {
            self.track.switch(switch);
            self.benches.current.world.hands_leap();
            self.steps.clock.pause();
        }
    }

    /// Goes on with the bench that was built meanwhile, if one was.
    fn replace_bench(&mut self) -> Result<(), Failure> {
        let resolution = self.pacing.setting(&self.benches.current).resolution;
        if let Some(switch) = self.benches.replace_if_built() {
            let same = switch.key == SWITCH_START;
            // Before the switches of its settings: a replay brings up the scene first.
            self.track.switch(switch);
            let (bench, track) = (&mut self.benches.current, &mut self.track);
            self.pacing.begin(same, resolution, bench, track)?;
            self.readings.clear();
        }
        Ok(())
    }

    /// Plans the steps that are due and takes those that need not wait for the device.
    fn take_steps(&mut self, now: PoseFrame) -> Result<(), Failure> {
        let world = &mut self.benches.current.world;
        self.steps.plan(&now, &self.placement, world.scene());
        self.placement.last = Some(now);
        self.steps.take_ready(world, &mut self.track)
    }

    /// Lets each hand feel what stirs in the flask that it holds.
    fn vibrate(&mut self, headset: &mut dyn Headset) -> Result<(), Failure> {
        let world = &self.benches.current.world;
        let scale = world.scene().scale.length_scale;
        for side in Side::BOTH {
            let felt = held_by(world, side)
                .map(|flask| haptics::amplitude(world.stirring(flask), scale))
                .fold(0.0, f32::max);
            headset.vibrate(side, felt).map_err(blame)?;
        }
        Ok(())
    }

    /// Brings panel and window title up to date, and lets the hands that hold nothing point at the panel.
    fn show_panel(&mut self) {
        let world = &self.benches.current.world;
        let seen = self.placement.seen();
        let pointing = |side: Side| -> Option<&Hand> {
            let hand = seen.as_ref()?.hand(side);
            let holds = held_by(world, side).next().is_some();
            (hand.active && hand.valid && !holds).then_some(hand)
        };
        let hands = Side::BOTH.map(pointing);
        let info = self.info();
        let decided = self.panel.update(hands, &info, self.shown_at());
        self.choices.add(decided);
        if let Some(mirror) = &mut self.mirror {
            mirror.entitle(&info, None);
        }
    }

    /// Acquires the headset's images, and submits the picture's part that reads the particles behind the steps, on
    /// the solver's queue. `None` where the headset gives no images.
    fn acquire(&mut self, headset: &mut dyn Headset) -> Result<Option<(Targets, Ticket)>, Failure> {
        let targets = headset.acquire(self.panel.has_changed());
        let Some(targets) = targets.map_err(blame)? else {
            return Ok(None);
        };
        let Workbench { world, picture, .. } = &self.benches.current;
        let is_due = self.readings.is_due(self.counts.frames);
        let mut reading = None;
        let shapes = picture.shapes(world.gpu(), world, |rec| {
            if is_due {
                reading = world.solver().record_reading(rec).other()?;
            }
            Ok(())
        })?;
        if let Some(reading) = reading {
            self.readings.under_way = Some((reading, shapes.clone()));
        }
        Ok(Some((targets, shapes)))
    }

    /// Locates the eyes, and draws and submits the picture with these views, which are those that it is to be shown
    /// with. Between the two is as little as can be.
    fn locate_and_draw(
        &mut self,
        headset: &mut dyn Headset,
        targets: &Targets,
        shapes: Ticket,
    ) -> Result<Shown, Failure> {
        let placed = self.placement.stage_from_scene();
        let seen = self.placement.seen();
        let setting = self.pacing.setting(&self.benches.current);
        let extent = scaled(self.benches.eyes.extent, &setting);
        let Workbench { world, picture, .. } = &mut self.benches.current;
        let gloves = picture.gloves(world, seen.as_ref(), &self.joints);

        let views = headset.locate_views().map_err(blame)?;
        let located = Instant::now();
        let sight = Sight {
            extent,
            views: views.each_ref().map(|view| eye(view, &placed)),
            hands: gloves.each_ref().map(Vec::as_slice),
        };
        let panel = &mut self.panel;
        let picture = picture.draw(world, &shapes, &sight, targets, |rec| {
            match &targets.panel {
                Some(target) => {
                    panel.record(rec)?;
                    rec.copy_image(&panel.image, target).other()
                }
                None => Ok(()),
            }
        })?;
        let age_ms = 1e3 * located.elapsed().as_secs_f64();

        let behind = self.steps.behind(world.scene().scale.frame_time);
        self.counts.tally.picture(age_ms, behind);
        self.counts.tally.submitted(Submitted {
            steps: self.steps.submitted(),
            shapes,
            picture,
            stamp: self.pacing.stamp,
        });
        self.pacing.shown(setting);
        Ok(Shown {
            views,
            extent,
            near: NEAR,
            panel: Some((placed.compose(&panel::scene_from_panel()), panel::WIDTH)),
        })
    }

    /// Does what may wait for the device: takes the steps that are left over, waits for the picture before the last,
    /// and collects pictures, readings and times that have come.
    pub(super) fn catch_up(&mut self, no_frame: &NoFrameOpen) -> Result<(), Failure> {
        let Workbench { world, picture, .. } = &mut self.benches.current;
        self.steps.take_rest(world, &mut self.track, no_frame)?;
        picture.keep_up()?;
        if let Some(mirror) = &mut self.mirror {
            mirror.hand_over()?;
        }
        self.readings.collect()?;
        self.counts.tally.collect()
    }

    /// Display time of the last frame, ns.
    fn shown_at(&self) -> i64 {
        self.placement
            .last
            .as_ref()
            .map_or(0, |last| last.info.xr_time)
    }

    /// What panel and window title say.
    pub(super) fn info(&self) -> Info {
        let bench = &self.benches.current;
        let scene = bench.world.scene();
        let recorded = self.track.state();
        Info {
            scene: bench.plan.scene.clone(),
            flasks: self.readings.lines(scene),
            acid: has_acid(scene),
            slow: self.steps.slow_motion(),
            recording: recorded.as_ref().map(|(seconds, _)| *seconds as u64),
            waits_for_disk: recorded.as_ref().is_some_and(|(_, state)| state.refused),
            unwritten: recorded.map_or(0, |(_, state)| state.unwritten),
            missed: self.counts.skipped,
            effort: self.pacing.effort(bench),
            coming: self.benches.coming().map(Into::into),
            holding: (self.choices.holding(self.shown_at()))
                .map(|share| RING * (100.0 * share / RING as f32) as u32),
            ends: self.choices.asks_to_end(Instant::now()),
        }
    }
}

/// The flasks that a hand holds.
fn held_by(world: &World, side: Side) -> impl Iterator<Item = usize> {
    let flasks = 0..world.scene().flasks.len();
    flasks.filter(move |&flask| world.holder(flask) == Some(side as usize))
}

/// Width and height of a picture with that setting, pixels, where the display has `extent`.
fn scaled(extent: [u32; 2], setting: &Setting) -> [u32; 2] {
    extent.map(|side| {
        let side = (setting.resolution * f64::from(side)).round();
        (side as u32).max(1)
    })
}
