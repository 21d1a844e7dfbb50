//! One frame.

use std::time::Instant;

use vitriol_experiment::{Blame, Failure, stage};
use vitriol_gpu::QueueKind;
use vitriol_sim::world::StepInput;
use vitriol_xr::{Headset, HeadsetFrame, Pose, PoseFrame, Shown, Side};

use super::{Session, WARM_UP, blame, milliseconds, nanoseconds};
use crate::vr::bench::Bench;
use crate::vr::hands;
use crate::vr::haptics;
use crate::vr::inputs::sound;
use crate::vr::panel;
use crate::vr::picture::{Eyes, Picture, Sight, eye};
use crate::vr::placement;
use crate::vr::tally::{Holdings, Submitted};

/// Frames between two readings of the flasks' temperatures: ten a second at 90 Hz.
const READING_EVERY: u64 = 9;

impl Session {
    /// One frame, from after its begin to after its end.
    pub(super) fn frame(
        &mut self,
        headset: &mut dyn Headset,
        frame: &HeadsetFrame,
    ) -> Result<(), Failure> {
        let begun = Instant::now();
        self.count(frame);
        let now = sound(&frame.poses, self.last.as_ref());
        let pressed = self.buttons.advance(&now.hands);
        self.decide(headset, pressed, frame.recentred, &now)?;
        self.take_up_bench()?;
        self.plan_steps(now);
        // What would wait for the device waits until the frame has ended.
        while !self.due.is_empty() && self.bench.world.is_ready().other()? {
            self.take_step()?;
        }
        self.feel(headset)?;
        if frame.should_render {
            self.draw(headset)?;
        } else {
            headset.end(None).map_err(blame)?;
            // Times are of frames that are shown.
            self.solved.clear();
        }
        self.tally.frame(milliseconds(begun.elapsed()));
        self.after()?;
        let loads = self.tally.loads();
        self.keep_pace(&loads, 1e-6 * frame.poses.info.period_ns as f64)?;
        self.take_up_mask(headset)
    }

    /// What the lenses hide is known with the eyes' fields of view, which come with the first views, and
    /// may change. It waits for an upload, so no frame is open now.
    fn take_up_mask(&mut self, headset: &dyn Headset) -> Result<(), Failure> {
        let eyes = Eyes::of(headset);
        if eyes.hidden != self.eyes.hidden {
            self.bench.picture.hide(&eyes.hidden)?;
            self.eyes = eyes;
        }
        Ok(())
    }

    /// What may wait for the device: no frame is open now.
    pub(super) fn after(&mut self) -> Result<(), Failure> {
        while !self.due.is_empty() {
            self.take_step()?;
        }
        self.bench.picture.keep_up()?;
        if let Some(mirror) = &mut self.mirror {
            mirror.hand_over()?;
        }
        self.take_reading()?;
        self.tally.collect()
    }

    fn count(&mut self, frame: &HeadsetFrame) {
        self.frames += 1;
        if self.frames == WARM_UP + 1 {
            self.tally.restart();
            self.pace.restart();
            self.skipped = 0;
            self.began_with = Holdings::now();
        }
        let info = &frame.poses.info;
        let last = self.counted.replace(info.xr_time);
        if let (Some(last), true) = (last, info.period_ns > 0) {
            let passed = info.xr_time.saturating_sub(last) as f64;
            let periods = (passed / info.period_ns as f64).round();
            let skipped = (periods - 1.0).max(0.0) as u64;
            self.skipped += skipped;
            self.pace.missed |= skipped > 0;
        }
    }

    /// Finds the steps that are due, with the poses of their own times.
    fn plan_steps(&mut self, now: PoseFrame) {
        let scene = self.bench.world.scene();
        let frame_time = scene.scale.frame_time;
        let origin = (scene.origin * scene.scale.length_scale).as_vec3();
        let due = self.clock.advance(now.info.xr_time, frame_time);
        if let (Some(last), Some(placed)) = (&self.last, &self.placed) {
            let passed = (now.info.xr_time - last.info.xr_time) as f64;
            for s in due.ends {
                let frame = placement::in_scene(&last.between(&now, s), placed);
                let mut frame = placement::shifted(frame, origin);
                frame.info.xr_time = last.info.xr_time + (f64::from(s) * passed).round() as i64;
                self.due.push(frame);
            }
            if passed > 0.0 {
                let speed = 1.0 - 1e9 * due.skipped / passed;
                self.speed += 0.05 * (speed - self.speed);
            }
        }
        self.last = Some(now);
    }

    /// Takes the next step that is due.
    fn take_step(&mut self) -> Result<(), Failure> {
        let mut frame = self.due.remove(0);
        frame.step = self.time.steps();
        frame.time_ns = nanoseconds(&self.time);
        frame.scenario = std::mem::take(&mut self.switches);
        let world = &mut self.bench.world;
        let frame_time = world.scene().scale.frame_time;
        let hands = stage::hands(&frame.hands, world.scene());
        world
            .step_on(QueueKind::Async, &StepInput { hands })
            .other()?;
        self.solved.extend(world.last_step().cloned());
        if let Some(recording) = &mut self.recording {
            recording.push(&frame, stage::flasks(world));
        }
        self.time.advance(frame_time);
        Ok(())
    }

    /// Lets each hand feel what stirs in the flask that it holds.
    fn feel(&mut self, headset: &mut dyn Headset) -> Result<(), Failure> {
        let world = &self.bench.world;
        let scale = world.scene().scale.length_scale;
        for side in Side::BOTH {
            let flasks = 0..world.scene().flasks.len();
            let held = flasks
                .filter(|&flask| world.holder(flask) == Some(side as usize))
                .map(|flask| haptics::amplitude(world.stirring(flask), scale));
            let amplitude = held.fold(0.0, f32::max);
            headset.vibrate(side, amplitude).map_err(blame)?;
        }
        Ok(())
    }

    fn draw(&mut self, headset: &mut dyn Headset) -> Result<(), Failure> {
        let placed = self.placed.unwrap_or(Pose::IDENTITY);
        let seen = self
            .last
            .as_ref()
            .map(|last| placement::in_scene(last, &placed));
        self.show_panel(seen.as_ref());
        let beads = seen.as_ref().map_or_else(Vec::new, hands::beads);

        let setting = self.setting();
        let extent = self.eyes.extent.map(|side| {
            let side = (setting.resolution * f64::from(side)).round();
            (side as u32).max(1)
        });
        let targets = headset.acquire().map_err(blame)?;
        let Bench { world, picture, .. } = &mut self.bench;
        let gpu = world.gpu().clone();
        let mut reading = None;
        let reads = self.reading.is_none() && self.frames.is_multiple_of(READING_EVERY);
        let shapes = picture.shapes(&gpu, world, |rec| {
            if reads {
                reading = world.solver().record_reading(rec).other()?;
            }
            Ok(())
        })?;
        if let Some(reading) = reading {
            self.reading = Some((reading, shapes.clone()));
        }
        let views = headset.locate_views().map_err(blame)?;
        let located = Instant::now();
        let sight = Sight {
            extent,
            views: views.each_ref().map(|view| eye(view, &placed)),
            beads: &beads,
        };
        let panel = &mut self.panel;
        let drawn = picture.draw(world, shapes, &sight, &targets, |rec| {
            panel.record(rec)?;
            rec.copy_image(panel.image(), &targets.panel).other()
        })?;
        let age = milliseconds(located.elapsed());
        let behind = self.clock.behind() / world.scene().scale.frame_time;
        self.tally.picture(age, behind + self.due.len() as f64);
        self.tally.submitted(Submitted {
            steps: std::mem::take(&mut self.solved),
            shapes: drawn.shapes,
            picture: drawn.picture,
            stamp: self.pace.stamp,
        });
        self.pace.shown(setting);
        let shown = Shown {
            views,
            extent,
            near: Picture::near(),
            panel: Some((placed.compose(&panel::scene_from_panel()), panel::WIDTH)),
        };
        headset.end(Some(&shown)).map_err(blame)?;
        // Behind the picture, and nothing that the headset waits for.
        if let (Some(mirror), Some(time)) = (&mut self.mirror, self.counted) {
            mirror.take(self.bench.picture.image(), extent, time)?;
        }
        Ok(())
    }

    /// Takes a reading that has come.
    fn take_reading(&mut self) -> Result<(), Failure> {
        if let Some((reading, ticket)) = &self.reading
            && ticket.is_done().other()?
        {
            self.read = reading.get().other()?;
            self.reading = None;
        }
        Ok(())
    }
}
