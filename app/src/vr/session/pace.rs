//! Keeping pace with the display: what a governor decides is done here, said and recorded.

use std::sync::Arc;
use std::thread::JoinHandle;

use serde::Serialize;
use vitriol_gpu::{Gpu, Timestamps};
use vitriol_sim::scene::PictureFilter;

use super::{Session, TAKEN_UP};
use crate::experiment::SWITCH_SOLVER;
use crate::failure::{Blame, Failure};
use crate::vr::bench::Bench;
use crate::vr::clock::MOST_STEPS;
use crate::vr::governor::{Governor, Level, Taken};
use crate::vr::ladder::Setting;
use crate::vr::panel::Effort;
use crate::vr::picture::{Eyes, Picture, Subject};
use crate::vr::tally::Load;

/// Key of the switch to a picture of another resolution, its value each side over the display's.
pub const SWITCH_RESOLUTION: &str = "resolution";
/// Key of the switch to another filter of the liquid's surface, its value as `--filter` takes it.
pub const SWITCH_FILTER: &str = "filter";

/// How a session kept pace.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Kept {
    /// Whether a governor was to keep it.
    pub on: bool,
    /// Why there was none, where one was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
    /// Times that it changed something.
    pub changes: u64,
    /// Settings, in the order in which they came.
    pub settings: Vec<With>,
}

/// Frames that were shown with a setting.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct With {
    /// What they were solved and drawn with.
    #[serde(flatten)]
    pub setting: Setting,
    /// How many.
    pub frames: u64,
}

/// See the module.
pub(super) struct Pace {
    /// `None` where everything stays as it begins.
    governor: Option<Governor>,
    /// How much less than was asked for.
    pub(super) level: Level,
    /// Counts what the frames that are under way may differ in.
    pub(super) stamp: u64,
    /// Whether a display period went by without a frame since the governor was told.
    pub(super) missed: bool,
    /// Time since it was told of a frame, s: those without a step tell it nothing.
    since: f64,
    /// Whether the last change was for the better.
    finer: bool,
    kept: Kept,
    repaint: Option<Repaint>,
    /// Whether a picture could not be made: it is not tried again.
    stuck: bool,
}

/// A picture in the making, with another filter, on a thread of its own: compiling takes longer than a frame.
struct Repaint {
    filter: PictureFilter,
    eyes: Eyes,
    thread: JoinHandle<Result<Picture, Failure>>,
}

impl Pace {
    pub(super) fn new(gpu: &Gpu, bench: &Bench, asked: bool) -> Self {
        let asked_of_device = gpu.options().timestamps != Timestamps::None;
        let measures = asked_of_device && gpu.info().timestamp_period > 0.0;
        let on = asked && measures;
        let cause = asked && !measures;
        Self {
            governor: on.then(|| Governor::new(bench.ladder.costs(), [0, 0])),
            level: [0, 0],
            stamp: 0,
            missed: false,
            since: 0.0,
            finer: false,
            kept: Kept {
                on,
                cause: cause.then(|| "this device does not measure what frames take on it".into()),
                ..Kept::default()
            },
            repaint: None,
            stuck: false,
        }
    }

    /// Whether frames are to be timed for it.
    pub(super) fn follows(&self) -> bool {
        self.governor.is_some()
    }

    /// What frames took is of another device, another time or another scene.
    pub(super) fn forget(&mut self) {
        self.repaint = None;
        self.stuck = false;
        self.settle();
    }

    /// The next frames differ from those under way, which count no more.
    fn settle(&mut self) {
        self.stamp += 1;
        self.missed = false;
        if let Some(governor) = &mut self.governor {
            governor.forget();
        }
    }

    /// Counts a frame that is shown with `setting`.
    pub(super) fn shown(&mut self, setting: Setting) {
        let mut counted = self.kept.settings.iter_mut();
        match counted.find(|with| with.setting == setting) {
            Some(with) => with.frames += 1,
            None => self.kept.settings.push(With { setting, frames: 1 }),
        }
    }

    /// What came before was warming up.
    pub(super) fn restart(&mut self) {
        self.kept.changes = 0;
        self.kept.settings.clear();
    }

    pub(super) fn kept(&self) -> &Kept {
        &self.kept
    }
}

impl Session {
    /// What is drawn and solved with now.
    pub(super) fn setting(&self) -> Setting {
        let wanted = self.bench.ladder.setting(self.pace.level);
        Setting {
            filter: self.bench.filter(),
            ..wanted
        }
    }

    /// Does what the governor makes of the frames that are done. No frame is open now, and no step is due.
    pub(super) fn keep_pace(&mut self, loads: &[Load], period: f64) -> Result<(), Failure> {
        // A runtime may not say how long a frame is shown, and while another filter is compiled what frames take
        // is about to change.
        let loads = if period > 0.0 && self.pace.repaint.is_none() {
            loads
        } else {
            &[]
        };
        let frame_time = 1e3 * self.bench.world.scene().scale.frame_time;
        // As many steps as a frame may have; not those of one that made up for a missed one.
        let steps = (period / frame_time - 1e-6)
            .ceil()
            .clamp(1.0, MOST_STEPS.into());
        for load in loads {
            let Some(governor) = &mut self.pace.governor else {
                break;
            };
            self.pace.since += 1e-3 * period;
            if load.stamp != self.pace.stamp {
                // What was missed meanwhile was one of these, begun before the last change.
                self.pace.missed = false;
                continue;
            }
            if load.steps == 0 {
                continue;
            }
            let taken = Taken {
                times: [steps * load.solve_ms / load.steps as f64, load.picture_ms],
                period,
                since: std::mem::take(&mut self.pace.since),
            };
            let missed = std::mem::take(&mut self.pace.missed);
            if let Some(level) = governor.take(&taken, missed) {
                self.pace.finer = level.iter().sum::<usize>() < self.pace.level.iter().sum();
                self.pace.kept.changes += 1;
                self.go_to(level)?;
            }
        }
        self.take_up_picture()?;
        self.repaint();
        Ok(())
    }

    /// Goes on at `level`, and has it recorded.
    fn go_to(&mut self, level: Level) -> Result<(), Failure> {
        let before = self.bench.ladder.setting(self.pace.level);
        let after = self.bench.ladder.setting(level);
        self.pace.level = level;
        self.pace.settle();
        if after.solver != self.bench.world.effort() {
            self.bench.world.set_effort(after.solver).other()?;
            self.say_effort();
        }
        let ([substeps, iterations], percent) = (after.solver, 100.0 * after.resolution);
        tracing::info!("to keep pace: {substeps} × {iterations}, picture {percent:.0} %");
        if after.resolution != before.resolution {
            self.switch(SWITCH_RESOLUTION, after.resolution.to_string());
        }
        Ok(())
    }

    /// Has it recorded what the next step is solved with.
    fn say_effort(&mut self) {
        let [substeps, iterations] = self.bench.world.effort();
        self.switch(SWITCH_SOLVER, format!("{substeps}x{iterations}"));
    }

    /// A bench has come: it goes on at the level that its scene had, or as it was asked for where it is another
    /// scene. `resolution` is that of the last picture. A replay begins with what the preset has, so what is not
    /// that is said.
    pub(super) fn pace_bench(&mut self, same: bool, resolution: f64) -> Result<(), Failure> {
        let level = if same { self.pace.level } else { [0, 0] };
        let costs = self.bench.ladder.costs();
        if !same && let Some(governor) = &mut self.pace.governor {
            *governor = Governor::new(costs, level);
        }
        self.pace.forget();
        self.pace.level = level;
        let setting = self.bench.ladder.setting(level);
        self.bench.world.set_effort(setting.solver).other()?;
        if setting.solver != self.bench.of_preset {
            self.say_effort();
        }
        if setting.resolution != resolution {
            self.switch(SWITCH_RESOLUTION, setting.resolution.to_string());
        }
        Ok(())
    }

    /// Lets a picture be made whose filter is the level's.
    fn repaint(&mut self) {
        let filter = self.bench.ladder.setting(self.pace.level).filter;
        let wanted = !self.pace.stuck && filter != self.bench.filter();
        if !wanted {
            self.pace.repaint = None;
        } else if self.pace.repaint.is_none() {
            let gpu = self.bench.world.gpu().clone();
            let (library, eyes) = (Arc::clone(&self.library), self.eyes.clone());
            let mut scene = self.bench.world.scene().clone();
            scene.picture.filter = filter;
            let subject = Subject::of(&self.bench.world);
            let of = eyes.clone();
            self.pace.repaint = Some(Repaint {
                filter,
                eyes,
                thread: std::thread::spawn(move || {
                    Picture::new(&gpu, &library, &scene, subject, &of)
                }),
            });
        }
    }

    /// Takes up the picture that was made meanwhile. What the lenses hide may have to be uploaded anew, so no frame is
    /// open.
    fn take_up_picture(&mut self) -> Result<(), Failure> {
        let finished = |repaint: &mut Repaint| repaint.thread.is_finished();
        let Some(repaint) = self.pace.repaint.take_if(finished) else {
            return Ok(());
        };
        let made = repaint.thread.join();
        match made.unwrap_or_else(|_| Err("the picture's builder broke down; report it").other()) {
            Ok(mut picture) => {
                if repaint.eyes.hidden != self.eyes.hidden {
                    picture.hide(&self.eyes.hidden)?;
                }
                self.bench.repaint(picture, repaint.filter);
                self.pace.settle();
                let name = match repaint.filter {
                    PictureFilter::NarrowRange => "narrow-range",
                    PictureFilter::CurvatureFlow => "curvature-flow",
                };
                tracing::info!(target: TAKEN_UP, "to keep pace: filter {name}");
                self.switch(SWITCH_FILTER, name.into());
            }
            Err(failure) => {
                tracing::warn!("the picture stays as it is: {failure}");
                self.pace.stuck = true;
            }
        }
        Ok(())
    }

    /// What the panel says of it; nothing where all is as it was asked for.
    pub(super) fn effort(&self) -> Option<Effort> {
        let (now, asked) = (self.setting(), self.bench.ladder.setting([0, 0]));
        (now != asked).then_some(Effort {
            finer: self.pace.finer,
            solver: now.solver,
            asked: asked.solver,
            picture: (100.0 * now.resolution).round() as u32,
            other_filter: now.filter != asked.filter,
        })
    }
}
