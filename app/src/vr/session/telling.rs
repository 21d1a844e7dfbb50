//! A session and its instructor: what she asks for is done, and she is told what goes on.

use vitriol_console::List;
use vitriol_experiment::{Failure, Instruction};
use vitriol_xr::Shown;

use super::Session;
use super::instructor::{Asked, Now};
use crate::vr::decision::Decision;

impl Session {
    /// Does what the instructor asked for; whether that is to end.
    pub(super) fn obey(&mut self) -> bool {
        let mut ends = false;
        for (order, asked) in self.instructor.orders() {
            let words = &self.texts.instructor;
            let said = match asked {
                Some(Asked::Decided(decision)) => {
                    let said = match &decision {
                        Decision::Scene(name) => words.scene(self.texts.panel.scene(name)),
                        _ => words.start.clone(),
                    };
                    self.choices.add(Some(decision));
                    Some(said)
                }
                Some(Asked::Instruction(instruction)) => {
                    let said = words.instruction(&instruction);
                    self.follow(&instruction).then_some(said)
                }
                Some(Asked::End) => {
                    ends = true;
                    Some(words.end.clone())
                }
                None => None,
            };
            if let Some(said) = said {
                tracing::info!("{said}");
                self.instructor.announce(said);
            }
            self.instructor.taken_up(order);
        }
        ends
    }

    /// Whether it is followed, from the next step on.
    fn follow(&mut self, instruction: &Instruction) -> bool {
        match instruction {
            Instruction::Intensity(value) => {
                if let Err(error) = self.benches.current.world.set_intensity(*value) {
                    tracing::warn!("the instructor's k_v is not set: {error}");
                    return false;
                }
            }
            // The hands went on meanwhile: what they hold goes to where they are.
            Instruction::Pause(false) if self.instructor.holds_time() => self.placement.interrupt(),
            Instruction::Speed(rate) => self.steps.clock.rate = *rate,
            Instruction::Spare(on) => self.sounds.mute_boiling(*on),
            Instruction::Pause(_) | Instruction::Message(_) => {}
        }
        self.instructor.follow(instruction);
        self.track.switch(instruction.switch());
        true
    }

    /// A replay does what was switched before the step that came next. Where none would, one more is taken.
    pub(super) fn step_for_switches(&mut self) {
        let last = self.placement.last.clone();
        let (Some(now), true) = (last, self.track.awaits_step()) else {
            return;
        };
        if self.instructor.holds_time() {
            // As where time goes on.
            self.placement.interrupt();
            if let Some(switch) = self.placement.place(&now, false) {
                self.track.switch(switch);
                self.benches.current.world.hands_leap();
            }
            self.placement.last = Some(now.clone());
        }
        let scene = self.benches.current.world.scene();
        self.steps.once_more(&now, &self.placement, scene);
    }

    /// Tells the instructor how it is.
    pub(super) fn tell(&mut self, ended: bool) {
        let bench = &self.benches.current;
        let info = self.placement.last.as_ref().map(|last| last.info);
        let period = info.filter(|info| info.period_ns > 0);
        self.instructor.tell(&Now {
            frame: self.counts.frames,
            time: self.track.seconds(),
            scene: (&bench.plan.scene, bench.world.scene()),
            intensity: bench.world.intensity(),
            spilt: self.spills.spilt,
            events: &self.track.events,
            period: period.map(|info| 1e-9 * info.period_ns as f64),
            missed: self.counts.skipped,
            step: self.guide.step(&bench.plan.scene),
            hints: List::clipped(self.guide.hints()),
            ended,
        });
    }

    /// Shows the instructor what the left eye sees.
    pub(super) fn show_instructor(&mut self, shown: &Shown, time: i64) -> Result<(), Failure> {
        let picture = self.benches.current.picture.image();
        self.instructor.take(picture, shown.extent, time)
    }
}
