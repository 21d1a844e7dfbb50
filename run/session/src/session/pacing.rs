//! Fits frames into the display's period: the governor's decisions are carried out here, shown and recorded.

use serde::Serialize;
use vitriol_gpu::{Gpu, Timestamps};
use vitriol_run::{Action, Blame, Failure, Run};

use super::benches::Benches;
use super::ended::NoFrameOpen;
use super::repaint::Repainter;
use crate::clock::MOST_STEPS;
use crate::governor::{FrameTimes, Governor, Level};
use crate::info::Effort;
use crate::ladder::Setting;
use crate::rates::{Rates, Taken};
use crate::tally::FrameLoad;
use crate::workbench::{TAKEN_UP, Workbench};

/// Frames behind a picture from close by in which a missed period is laid to that picture. Our choice: two pictures are under way at most, and
/// the display time of the frame behind them tells of a period without one.
const BEHIND_CLOSE_UP: u32 = 3;

/// What the governor did in a session.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct GovernorReport {
    /// Whether there was one.
    pub on: bool,
    /// Why there was none, where one was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
    /// Times that it changed something.
    pub changes: u64,
    /// Settings, in the order in which they came.
    pub settings: Vec<FramesWith>,
    /// Display rates that it asked for, Hz.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rates: Vec<f64>,
}

/// Frames that were shown with a setting.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FramesWith {
    /// What they were solved and drawn with.
    #[serde(flatten)]
    pub setting: Setting,
    /// How many.
    pub frames: u64,
}

/// The governor, its input and its decisions.
#[derive(Default)]
pub(super) struct Pacing {
    /// `None` where everything stays as it begins.
    governor: Option<Governor>,
    /// How much less than was asked for is solved and drawn.
    level: Level,
    /// Counts changes, and goes with each frame that is submitted, see [`FrameLoad::stamp`].
    pub stamp: u64,
    /// A display period went by without a frame since the governor took one in.
    missed: bool,
    /// Frames for which that is laid to a picture from close by.
    excused: u32,
    /// Time since the governor took in a frame, s. It takes in none without a step.
    since: f64,
    /// The last change was to more accuracy or pixels.
    finer: bool,
    /// What it did in the frames that count.
    pub report: GovernorReport,
    /// The display's rates; `None` until a frame has given its period.
    rates: Option<Rates>,
    /// A rate that the headset is to be asked for.
    pub wants_rate: Option<f32>,
    repainter: Repainter,
}

impl Pacing {
    /// With a governor if it is `asked` for and the device measures what frames take.
    pub fn new(gpu: &Gpu, bench: &Workbench, asked: bool) -> Self {
        let timed = gpu.options().timestamps != Timestamps::None;
        let measures = timed && gpu.info().timestamp_period > 0.0;
        let on = asked && measures;
        let cause = asked && !measures;
        Self {
            governor: on.then(|| Governor::new(bench.ladder.costs())),
            report: GovernorReport {
                on,
                cause: cause.then(|| "this device does not measure what frames take on it".into()),
                ..GovernorReport::default()
            },
            ..Self::default()
        }
    }

    /// What frames are solved and drawn with now.
    pub fn setting(&self, bench: &Workbench) -> Setting {
        Setting {
            // The wanted one's picture may still be in the making.
            filter: bench.filter(),
            ..bench.ladder.setting(self.level)
        }
    }

    /// Whether another picture is in the making, on a thread of its own.
    pub fn is_repainting(&self) -> bool {
        self.repainter.is_busy()
    }

    /// A frame begins; display periods were `skipped` before it, or not.
    pub fn begins(&mut self, skipped: bool) {
        self.missed |= skipped && self.excused == 0;
        self.excused = self.excused.saturating_sub(1);
    }

    /// A picture from close by was drawn behind the last frame. Less work for the student would not mend what it makes the next ones miss.
    pub fn drew_close_up(&mut self) {
        self.excused = BEHIND_CLOSE_UP;
    }

    /// Whether work of that much more time (ms) fits beside that of the next frames, of which the display shows one in each period (ms).
    /// Without a governor, or where the runtime names no period, no times are known, and missed frames alone tell.
    pub fn has_room_for(&self, more: f64, period: f64) -> bool {
        let governor = self.governor.as_ref().filter(|_| period > 0.0);
        governor.is_none_or(|governor| governor.has_room_for(more, period))
    }

    /// Counts a frame that is shown with `setting`.
    pub fn shown(&mut self, setting: Setting) {
        let mut counted = self.report.settings.iter_mut();
        match counted.find(|with| with.setting == setting) {
            Some(with) => with.frames += 1,
            None => self.report.settings.push(FramesWith { setting, frames: 1 }),
        }
    }

    /// Forgets what frames took: it was on another device or another scene.
    pub fn forget(&mut self) {
        self.repainter.forget();
        self.settle();
        if let Some(governor) = &mut self.governor {
            governor.begin();
        }
    }

    /// Another session has its own display.
    pub fn forget_rates(&mut self) {
        (self.rates, self.wants_rate) = (None, None);
    }

    /// Something changed, so that the times of frames under way do not apply to the next ones.
    fn settle(&mut self) {
        self.stamp += 1;
        self.missed = false;
        if let Some(governor) = &mut self.governor {
            governor.forget();
        }
    }

    /// Gives the governor the times of frames that are done, and carries out its decision; `period` is the display's,
    /// ms, and `rates` are those that it offers, Hz.
    pub fn govern(
        &mut self,
        loads: &[FrameLoad],
        (period, rates): (f64, &[f32]),
        benches: &mut Benches,
        run: &mut Run,
        no_frame: &NoFrameOpen,
    ) -> Result<(), Failure> {
        // A runtime may not report how long a frame is shown. While another picture is in the making nothing is
        // decided, since it changes what frames take.
        if period > 0.0 && !self.repainter.is_busy() {
            (self.rates).get_or_insert_with(|| Rates::new(rates, 1e3 / period));
            for load in loads {
                if let Some(level) = self.heed(load, period, run) {
                    self.go_to(level, &benches.current, run)?;
                }
            }
        }
        if let Some(filter) = self.repainter.replace_if_made(benches, no_frame)? {
            self.settle();
            let name = filter.name();
            tracing::info!(target: TAKEN_UP, "to keep pace: filter {name}");
            run.act(Action::Filter(filter))?;
        }
        let wanted = benches.current.ladder.setting(self.level).filter;
        self.repainter.want(wanted, benches, &run.world);
        Ok(())
    }

    /// Gives the governor a frame that is done; returns the new level, if it wants another.
    fn heed(&mut self, load: &FrameLoad, period: f64, run: &Run) -> Option<Level> {
        let governor = self.governor.as_mut()?;
        self.since += 1e-3 * period;
        if load.stamp != self.stamp {
            // It was begun before the last change; so was the one that was missed meanwhile.
            self.missed = false;
            return None;
        }
        if load.steps == 0 {
            return None;
        }
        // As many steps as a period has. A frame that makes up for a missed one has more, which is no reason to do
        // less in the next ones.
        let frame_time = 1e3 * run.world.scene().scale.frame_time;
        let steps = (period / frame_time - 1e-6)
            .ceil()
            .clamp(1.0, MOST_STEPS.into());
        let times = FrameTimes {
            times: [steps * load.solve_ms / load.steps as f64, load.picture_ms],
            period,
            // While time is held nothing is learnt.
            since: std::mem::take(&mut self.since).min(1.0),
        };
        let missed = std::mem::take(&mut self.missed);
        let decided = governor.take(&times, missed);
        let taken = Taken {
            step: load.solve_ms / load.steps as f64,
            picture: load.picture_ms,
            frame_time,
        };
        let rates = self.rates.get_or_insert_default();
        let coarser = |to: &Level| to.iter().sum::<usize>() > self.level.iter().sum();
        let rate = match decided {
            Some(level) if coarser(&level) => rates.lower(&taken),
            None if self.level == [0, 0] => rates.raise(&taken, times.since),
            _ => None,
        };
        if let Some(rate) = rate {
            governor.stay(self.level);
            tracing::info!("to keep pace: display {rate} Hz");
            self.wants_rate = Some(rate as f32);
            self.report.rates.push(rate);
            self.settle();
            return None;
        }
        let level = decided?;
        self.finer = !coarser(&level);
        self.report.changes += 1;
        Some(level)
    }

    /// Goes on at `level`, and has it recorded.
    fn go_to(&mut self, level: Level, bench: &Workbench, run: &mut Run) -> Result<(), Failure> {
        let before = bench.ladder.setting(self.level);
        let after = bench.ladder.setting(level);
        self.level = level;
        self.settle();
        if after.solver != run.world.effort() {
            run.act(Action::Solver(after.solver))?;
        }
        let ([substeps, iterations], percent) = (after.solver, 100.0 * after.resolution);
        let aside = if after.foveated {
            ", fewer pixels aside"
        } else {
            ""
        };
        tracing::info!("to keep pace: {substeps} × {iterations}, picture {percent:.0} %{aside}");
        if after.resolution != before.resolution {
            run.act(Action::Resolution(after.resolution))?;
        }
        if after.foveated != before.foveated {
            run.act(Action::Foveation(after.foveated))?;
        }
        Ok(())
    }

    /// A bench has come. With the `same` scene as before it goes on at the level that there was, with another one as
    /// it was asked for. `drawn` is what the last picture was drawn with, if there was one. A replay begins with what the preset has,
    /// so what differs from it is recorded.
    pub fn begin(
        &mut self,
        same: bool,
        drawn: Option<Setting>,
        bench: &Workbench,
        run: &mut Run,
    ) -> Result<(), Failure> {
        if !same {
            self.level = [0, 0];
            if let Some(governor) = &mut self.governor {
                *governor = Governor::new(bench.ladder.costs());
            }
        }
        self.forget();
        let setting = bench.ladder.setting(self.level);
        if setting.solver != bench.of_preset {
            run.act(Action::Solver(setting.solver))?;
        } else {
            run.world.set_effort(setting.solver).other()?;
        }
        let (resolution, foveated) = drawn.map_or((1.0, false), |it| (it.resolution, it.foveated));
        if setting.resolution != resolution {
            run.act(Action::Resolution(setting.resolution))?;
        }
        if setting.foveated != foveated {
            run.act(Action::Foveation(setting.foveated))?;
        }
        Ok(())
    }

    /// The effort as the panel shows it; `None` where all is as it was asked for.
    pub fn effort(&self, bench: &Workbench) -> Option<Effort> {
        let (now, asked) = (self.setting(bench), bench.ladder.setting([0, 0]));
        let rate = self.rates.as_ref().and_then(Rates::lowered);
        (now != asked || rate.is_some()).then_some(Effort {
            finer: self.finer,
            solver: now.solver,
            asked: asked.solver,
            picture: (100.0 * now.resolution).round() as u32,
            foveated: now.foveated != asked.foveated,
            other_filter: now.filter != asked.filter,
            rate: rate.map(|rate| rate.round() as u32),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is missed right behind a picture from close by is laid to that picture; what is missed later is not.
    #[test]
    fn a_picture_from_close_by_lowers_nothing() {
        let mut pacing = Pacing::default();
        pacing.drew_close_up();
        for _ in 0..BEHIND_CLOSE_UP {
            pacing.begins(true);
            assert!(!pacing.missed);
        }
        pacing.begins(false);
        assert!(!pacing.missed);
        pacing.begins(true);
        assert!(pacing.missed);
        // Until the governor has taken it in.
        pacing.begins(false);
        assert!(pacing.missed);
    }
}
