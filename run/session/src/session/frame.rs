//! One frame: the parts of a session, in the order in which a frame goes through them (docs/headset.md, "A frame").

use std::time::Instant;

use vitriol_gpu::{LockWaits, Ticket};
use vitriol_render::camera::NEAR;
use vitriol_run::{Action, Carriers, Failure, Looked};
use vitriol_sim::world::World;
use vitriol_xr::{Hand, Headset, HeadsetFrame, Inset, PoseFrame, Shown, Side, Targets, View};

use super::Session;
use super::around;
use super::ended::NoFrameOpen;
use crate::blame::blame;
use crate::closing;
use crate::decision::Decision;
use crate::haptics;
use crate::inputs::sound;
use crate::ladder::Setting;
use crate::mirror::Layer;
use crate::panel;
use crate::picture::{self, Outlook, Sight, eye};
use crate::projection::panel_from_picture;
use crate::sign::{Drawn, Sign};
use crate::tally::Submitted;
use crate::workbench::TAKEN_UP;

impl Session {
    /// One frame, which the headset's `next` has begun: item 1 of the list. Between there and the end nothing waits
    /// for the device.
    pub(super) fn frame(
        &mut self,
        headset: &mut dyn Headset,
        frame: &HeadsetFrame,
    ) -> Result<(), Failure> {
        let begun = Instant::now();
        // What was waited for before belongs to no frame.
        LockWaits::take();
        let was_building = self.is_building();
        let info = frame.poses.info;
        let skipped = self.counts.begin(&info);
        self.pacing.begins(skipped);
        if self.counts.is_first() {
            // What came before was the warm-up.
            self.pacing.report.changes = 0;
            self.pacing.report.settings.clear();
            self.pacing.report.rates.clear();
        }
        // 2. What the user decided.
        let mut now = sound(&frame.poses, self.placement.last.as_ref());
        self.decide(headset, frame.recentred, &now)?;
        self.fade
            .advance(info.xr_time, frame.lost, self.benches.is_built());
        let dark = self.fade.shown() == 0.0 || !frame.should_render;
        let (world, placed) = (&self.run.world, &self.placement);
        let (last, stage_from_scene) = (placed.last.as_ref(), placed.stage_from_scene());
        closing::close(&mut now, &frame.joints, last, world, &stage_from_scene);
        if let Some(latches) = &mut self.latches {
            // A bare hand has nothing to press.
            for side in Side::BOTH
                .into_iter()
                .filter(|side| frame.joints[*side as usize].is_none())
            {
                let holds = world.holds(side as usize) || self.handles.is_held_by(side);
                latches.apply(side, &mut now.hands[side as usize], holds);
            }
        }
        // A table's height is no matter of a screen, whose view goes up and down instead.
        if headset.eyes() > 1 {
            self.move_bench(&now)?;
        }
        let scene_from_stage = self.placement.stage_from_scene().inverse();
        self.joints = frame.joints.each_ref().map(|joints| {
            let joints = joints.as_ref()?.0;
            Some(joints.map(|(at, radius)| (scene_from_stage.transform_point(at), radius)))
        });
        // 3. The steps up to this frame's display time.
        self.take_steps(now)?;
        // 4. What the hands feel.
        self.vibrate(headset)?;
        let shown = if frame.should_render {
            // 5. The panel, and which button of it a hand points at; what a first user is to do.
            self.show_panel();
            self.hint();
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
            // A screen has no runtime that shows the panel's layer.
            let layer = shown.panel.filter(|_| headset.eyes() == 1);
            let layer = layer.map(|(pose, _)| Layer {
                image: &self.panel.image,
                panel_from_picture: panel_from_picture(&shown.views[0], (pose, panel::SIZE)),
            });
            mirror.take((picture, layer), shown.extent, info.xr_time)?;
        }
        if let Some(shown) = &shown {
            self.show_instructor(shown, info.xr_time)?;
        }
        let built = was_building || self.is_building();
        let cpu_ms = 1e3 * begun.elapsed().as_secs_f64();
        self.counts.tally.frame(cpu_ms, &LockWaits::take(), built);
        self.instructor.took(1e-3 * cpu_ms);
        self.tell(false);
        self.catch_up(&no_frame)?;
        // 10. A bench that was built meanwhile, in the dark; and what the next frames are solved and drawn with.
        let (loads, period) = (self.counts.tally.loads(), 1e-6 * info.period_ns as f64);
        if dark {
            self.replace_bench(&no_frame)?;
        }
        let (benches, run) = (&mut self.benches, &mut self.run);
        let display = (period, headset.rates());
        self.pacing
            .govern(&loads, display, benches, run, &no_frame)?;
        if let Some(rate) = self.pacing.wants_rate.take() {
            headset.request_rate(rate).map_err(blame)?;
        }
        // 11. Where the bodies are, for who points at them; and what the lenses hide.
        if self.pointer {
            let around = self.bench_around();
            if let Some(shown) = &shown {
                self.show_label(headset.pointed(), &around, &shown.views[0]);
            }
            headset.around(around);
        }
        self.benches.take_mask(headset, &no_frame)
    }

    /// Whether another thread makes a bench or a picture.
    fn is_building(&self) -> bool {
        self.benches.coming().is_some() || self.pacing.is_repainting()
    }

    /// Does what the user decided by button, key and panel; decisions on the panel in this frame are for the next one.
    fn decide(
        &mut self,
        headset: &dyn Headset,
        recentred: bool,
        now: &PoseFrame,
    ) -> Result<(), Failure> {
        let mut recentre = recentred;
        for decision in self.choices.take(&now.hands, now.info.xr_time) {
            let Some(decision) = decision.at(self.run.scene()) else {
                continue;
            };
            match decision {
                Decision::Act(Action::Scene(name)) => self.benches.build(headset.gpu(), name),
                Decision::Act(Action::Start(_)) => {
                    let present = self.run.scene().to_owned();
                    self.benches.build(headset.gpu(), present);
                }
                Decision::Act(action) => {
                    if let Some(action) = self.guide.named(&self.run, action) {
                        self.run.act(action)?;
                    }
                }
                Decision::Recentre => recentre = true,
                Decision::Summary if self.guide.tells(&self.run) => self.summary.toggle(),
                Decision::Summary => {}
                // `Choices::hear` has taken these, and `at` the last.
                Decision::End | Decision::AskEnd | Decision::Hold(_) | Decision::Toggle => {}
            }
        }
        if let Some(leap) = self.placement.place(now, recentre) {
            self.run.act(leap)?;
            self.handles.leap();
            self.steps.clock.pause();
        }
        Ok(())
    }

    /// Moves the bench with the hand that holds a handle of it. Steps go on: between the last frame and this one each hand
    /// moves as it did in the room, and leaps by what the bench has moved.
    fn move_bench(&mut self, now: &PoseFrame) -> Result<(), Failure> {
        let placed = self.placement.stage_from_scene();
        let Some(by) = self.handles.update(now, &placed, &self.run.world) else {
            return Ok(());
        };
        if let Some(leap) = self.placement.raise(now, by) {
            self.run.act(leap)?;
        }
        self.handles.settle(now, &self.placement.stage_from_scene());
        Ok(())
    }

    /// Goes on with the bench that was built meanwhile, if one was. The picture is dark, and what was under way on the bench before is
    /// waited for: it is counted, heard and judged with that bench.
    fn replace_bench(&mut self, no_frame: &NoFrameOpen) -> Result<(), Failure> {
        let drawn = self.pacing.setting(&self.benches.current);
        let gpu = self.run.world.gpu().clone();
        let Some(built) = self.benches.take_built(&gpu) else {
            return Ok(());
        };
        tracing::info!(target: TAKEN_UP, "set up: {}", built.scene());
        if let Err(failure) = self.end_attempt() {
            if gpu.is_lost() {
                self.benches.build_again(built);
            }
            return Err(failure);
        }
        self.hear();
        let (action, world) = self.benches.put(built, no_frame);
        let same = matches!(action, Action::Start(_));
        // Before the actions of its settings: a replay brings up the scene first.
        self.run.bring_up(action, world);
        self.fade.close();
        let (bench, run) = (&self.benches.current, &mut self.run);
        self.pacing.begin(same, Some(drawn), bench, run)?;
        (self.readings).begin(self.run.world.scene(), self.summary.texts());
        self.sounds.begin();
        let before = self.run.events().len();
        self.instructor.begin(before);
        self.scenes += 1;
        self.checkpoints.forget();
        self.spills.clean();
        self.hints.begin();
        self.summary.begin(before);
        Ok(())
    }

    /// Plans the steps that are due and takes those that need not wait for the device.
    fn take_steps(&mut self, now: PoseFrame) -> Result<(), Failure> {
        if self.instructor.holds_time() {
            self.steps.clock.pause();
            self.placement.last = Some(now);
            return Ok(());
        }
        let scene = self.run.world.scene();
        self.steps.plan(&now, &self.placement, scene);
        self.placement.last = Some(now);
        self.steps.take_ready(&mut self.run)
    }

    /// Lets each hand feel what stirs in the flask that it holds, and acid that touches it.
    fn vibrate(&mut self, headset: &mut dyn Headset) -> Result<(), Failure> {
        let world = &self.run.world;
        let scale = world.scene().scale.length_scale;
        for side in Side::BOTH {
            let now = self.shown_at();
            let said = self.instructor.felt(now).max(self.spills.felt(side, now));
            // What stirred in the last step stirs no more while time is held.
            let instructor = &self.instructor;
            let stands = instructor.mutes_boiling() || instructor.holds_time();
            let stirs = held_by(world, side).filter(|_| !stands);
            let felt = stirs
                .map(|flask| haptics::amplitude(world.stirring(flask), scale))
                .fold(said, f32::max);
            headset.vibrate(side, felt).map_err(blame)?;
        }
        Ok(())
    }

    /// Brings panel and window title up to date, and lets the hands that hold nothing point at the panel. A pointer points whatever its
    /// hands hold: their aim is its ray.
    fn show_panel(&mut self) {
        let world = &self.run.world;
        let seen = self.placement.seen();
        let pointing = |side: Side| -> Option<&Hand> {
            let hand = seen.as_ref()?.hand(side);
            let holds = world.holds(side as usize) || self.handles.is_held_by(side);
            (hand.active && hand.valid && (self.pointer || !holds)).then_some(hand)
        };
        let hands = Side::BOTH.map(pointing);
        let info = self.info();
        let decided = self.panel.update(hands, &info, self.shown_at());
        self.choices.add(decided);
        if let Some(mirror) = &mut self.mirror {
            mirror.entitle(&info, &self.texts.panel, None);
        }
    }

    /// Shows a first user what to do next.
    fn hint(&mut self) {
        if self.hints.sign.is_none() {
            return;
        }
        let (seen, time) = (self.viewed(), 1e-9 * self.shown_at() as f64);
        let bare = self.joints.each_ref().map(Option::is_some);
        let asked = self.guide.asked(&self.run);
        let bench = (&self.run.world, asked);
        self.hints.update(bench, seen.as_ref(), bare, time);
    }

    /// Acquires the headset's images, and submits the picture's part that reads the particles behind the steps, on
    /// the solver's queue. `None` where the headset gives no images.
    fn acquire(&mut self, headset: &mut dyn Headset) -> Result<Option<(Targets, Ticket)>, Failure> {
        let targets = headset.acquire(self.panel.has_changed());
        let Some(targets) = targets.map_err(blame)? else {
            return Ok(None);
        };
        let (world, picture) = (&self.run.world, &self.benches.current.picture);
        let mut state = None;
        let shapes = picture.shapes(world.gpu(), world, |rec| {
            state = self.checkpoints.record(world, rec)?;
            Ok(())
        })?;
        if let Some(state) = state {
            self.checkpoints.submitted(state, shapes.clone());
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
        let (most, wanted) = (self.benches.eyes.extent, headset.wanted());
        let extent = scaled([0, 1].map(|side| most[side].min(wanted[side])), &setting);
        let foveating = self.benches.eyes.foveating(setting.foveated);
        let (world, picture) = (&self.run.world, &mut self.benches.current.picture);
        self.gloves = picture.gloves(world, seen.as_ref(), &self.joints);
        self.spills.wears(world.worn());
        for side in Side::BOTH {
            self.spills.mark(side, &mut self.gloves[side as usize]);
        }
        // Neither is of the user's skin.
        let mut drawn = self.gloves.clone();
        let mut tools = vitriol_run::tools(world, self.run.thermometer());
        if headset.eyes() > 1 {
            if let Some((side, ray)) = self.panel.ray() {
                drawn[side as usize].push(ray);
            }
            for (bones, handle) in drawn.iter_mut().zip(self.handles.bones(world.scene())) {
                bones.extend(handle);
            }
        }
        around::draw(&headset.lines(), &placed, &mut drawn, &mut tools);

        let resting = (self.run.marks()).drawn(Carriers::of(world, &self.gloves));
        let (image, shown) = (self.panel.image.clone(), self.fade.shown());
        let sign = self.hints.sign.as_ref().and_then(Sign::drawn);

        let views = headset.locate_views().map_err(blame)?;
        let eye_of_screen = (headset.eyes() == 1).then_some(views[0].stage_from_eye);
        self.eye = eye_of_screen.map(|stage_from_eye| placed.inverse().compose(&stage_from_eye));
        let inset = headset.inset().map(|inset| Inset {
            extent: scaled(inset.extent, &setting),
            ..inset
        });
        let located = Instant::now();
        let outlook = |extent, views: &[View; 2]| Outlook {
            extent,
            views: views.each_ref().map(|view| eye(view, &placed)),
        };
        let sight = Sight {
            eyes: outlook(extent, &views),
            inset: inset.map(|inset| outlook(inset.extent, &inset.views)),
            hands: drawn.each_ref().map(Vec::as_slice),
            tools: &tools,
            resting: &resting,
            panel: Some(picture::panel(&image)),
            sign: sign.as_ref().map(Drawn::panel),
            shown,
            goggles: self.run.marks().goggles(),
            foveation: foveating.foveation(&views, headset.gaze()),
        };
        let (panel, signs) = (&mut self.panel, &mut self.hints.sign);
        let picture = picture.draw(world, &shapes, &sight, targets, |rec| {
            panel.record(rec)?;
            if let Some(sign) = signs {
                sign.record(rec)?;
            }
            match &targets.panel {
                Some(target) => panel.hand_over(rec, target),
                None => Ok(()),
            }
        })?;
        let age_ms = 1e3 * located.elapsed().as_secs_f64();

        let frame_time = world.scene().scale.frame_time;
        let behind = self.steps.behind(frame_time);
        let period = self.placement.last.as_ref().map(|last| last.info.period_ns);
        let per_frame = period.map_or(1.0, |period| 1e-9 * period as f64 / frame_time);
        self.counts.tally.picture(age_ms, behind, per_frame);
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
            inset,
            near: NEAR,
            // What fades is the picture.
            panel: (shown == 1.0)
                .then(|| (placed.compose(&panel::scene_from_panel()), panel::WIDTH)),
        })
    }

    /// Does what may wait for the device or takes long: takes the steps that are left over, waits for the picture before the last,
    /// and collects pictures, readings and times that have come.
    pub(super) fn catch_up(&mut self, no_frame: &NoFrameOpen) -> Result<(), Failure> {
        self.steps.take_rest(&mut self.run, no_frame)?;
        self.benches.current.picture.keep_up()?;
        if let Some(mirror) = &mut self.mirror {
            mirror.hand_over()?;
        }
        if let Some(view) = &mut self.instructor.view {
            view.hand_over()?;
        }
        self.observe(false)?;
        self.hear();
        self.checkpoints.collect(&mut self.run.world)?;
        self.counts.tally.collect()
    }

    /// Ends the attempt, all of whose observations are taken in; waits for the device.
    pub(super) fn end_attempt(&mut self) -> Result<(), Failure> {
        self.observe(true)?;
        self.run.end_attempt()?;
        self.guide.follow(&self.run);
        Ok(())
    }

    /// Takes in the observations that have come, or all where it shall `wait`.
    pub(super) fn observe(&mut self, wait: bool) -> Result<(), Failure> {
        while let Some(looked) = match wait {
            true => self.run.wait(0)?,
            false => self.run.collect()?,
        } {
            self.observed(&looked);
        }
        self.guide.follow(&self.run);
        Ok(())
    }

    fn observed(&mut self, looked: &Looked) {
        let now = self.shown_at();
        let time = 1e-9 * now as f64;
        let (world, census) = (&self.run.world, &looked.census);
        let scale = world.scene().scale.length_scale;
        let hands = looked.hands.each_ref().map(Vec::as_slice);
        self.readings.take(census, self.run.pouring());
        self.instructor.looked(census);
        let burnt = self.spills.take(census, scale, hands, now);
        self.sounds.burnt(&burnt, census, scale, time);
        self.hints.looked(world, census, time);
    }

    /// Lets the user hear what happened up to the frame that was shown last.
    fn hear(&mut self) {
        let time = 1e-9 * self.shown_at() as f64;
        self.sounds.add(self.run.sounds(), time);
        let seen = self.viewed();
        self.sounds
            .hear(seen.as_ref().map(|it| &it.stage_from_view));
    }

    /// Display time of the last frame, ns.
    pub(super) fn shown_at(&self) -> i64 {
        self.placement
            .last
            .as_ref()
            .map_or(0, |last| last.info.xr_time)
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
