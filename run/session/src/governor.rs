//! Keeps frames within the display's period: it takes in the times of frames on the device and decides how much work the
//! next ones are given. Its input is these times and the costs of rungs; `ladder` defines what a rung is.
//!
//! A dropped frame is visible, so the governor reduces work before one drops. It extrapolates the times of the last
//! quarter of a second by their trend; where the sum is more than [`FULL`] of a period, it takes the dearer part of
//! the work (solver or picture) a rung down. It goes a rung up where the finer rung would have taken less than
//! [`ROOM`] of a period for a while. Most rungs differ by less than lies between the two, so that it does not go up
//! and down in turn. Where they differ by more, each step up that has to be taken back doubles the wait for the next.

#[cfg(test)]
mod tests;

use std::collections::VecDeque;

/// Share of a period that a frame's work may take on the device. The rest is for the compositor, which takes about a
/// millisecond of 11.1, and for the processor until its first submission.
pub const FULL: f64 = 0.85;
/// Share of a period below which a finer rung has room.
pub const ROOM: f64 = 0.68;
/// Share of a period above which the device's work is taken as the cause of a missed frame, so that less work
/// helps. Below, the cause was the processor or another program.
const BUSY: f64 = 0.6;

/// Frames that an extrapolation is made from: a quarter of a second at 90 Hz.
const WINDOW: usize = 24;
/// Fewest frames that an extrapolation is made from.
const LEAST: usize = 4;
/// Fewest frames that a trend is taken from; with less, the times are taken as constant.
const TREND: usize = 12;
/// Frames that a trend is extrapolated by: those under way, and those until a step down takes effect.
const AHEAD: f64 = 12.0;

/// Frames of a new bench or device whose times do not count yet: pipelines are used for the first time, which has a driver
/// compile some of them, and the device's clock rises.
const YOUNG: u32 = 2 * WINDOW as u32;
/// So many frames that are missed one after the other are a load all the same.
const LATE: u32 = 12;

/// Two frames missed within this time are taken as overload and not as chance, s.
const AGAIN: f64 = 1.0;

/// Time for which the finer rung must have had room before a step up, s: at first, and at most.
const WAIT: [f64; 2] = [2.0, 64.0];
/// A step up that has to be taken back within this time counts as a mistake, s.
const SOON: f64 = 15.0;

/// Rung of each part of a frame's work, solver and picture; 0 is the finest.
pub type Level = [usize; 2];

/// What a frame took on the device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameTimes {
    /// Time by part, ms: that of as many steps as a display period has, and that of the picture.
    pub times: [f64; 2],
    /// The display's period, ms.
    pub period: f64,
    /// Time since the frame before it that the governor took in, s.
    pub since: f64,
}

/// Chooses the rungs of solver and picture so that frames fit the display's period.
#[derive(Clone, Debug)]
pub struct Governor {
    /// By part, what each rung costs in units of its own; falling.
    costs: [Vec<f64>; 2],
    /// For the next frames.
    level: Level,
    /// By part, the last frames' times at this level, ms.
    times: [VecDeque<f64>; 2],
    /// Seconds for which the next finer rung of each part has had room.
    room: [f64; 2],
    /// Seconds for which it must have had room before a step up.
    wait: [f64; 2],
    /// Seconds since a part went up, until that has held for [`SOON`].
    risen: [Option<f64>; 2],
    /// Seconds since a frame was missed.
    since_miss: f64,
    /// Frames until it is no longer [`YOUNG`].
    young: u32,
    /// Frames that were missed one after the other until now.
    late: u32,
}

impl Governor {
    /// On the finest rung of ladders whose rungs cost `costs`, the finest first.
    pub fn new(costs: [Vec<f64>; 2]) -> Self {
        Self {
            costs,
            level: [0, 0],
            times: [VecDeque::new(), VecDeque::new()],
            room: [0.0; 2],
            wait: [WAIT[0]; 2],
            risen: [None; 2],
            since_miss: f64::INFINITY,
            young: YOUNG,
            late: 0,
        }
    }

    /// Forgets what frames took, because the device or the work has changed.
    pub fn forget(&mut self) {
        self.times.iter_mut().for_each(VecDeque::clear);
        self.room = [0.0; 2];
    }

    /// Forgets it, and that the next frames are a new bench's or another device's.
    pub fn begin(&mut self) {
        self.forget();
        self.young = YOUNG;
    }

    /// Goes on at the level before the last one that [`Governor::take`] gave, since something else was done instead.
    pub fn stay(&mut self, level: Level) {
        self.level = level;
        self.forget();
    }

    /// Takes in a frame that is done, and whether a frame was missed since the last one. Returns the new level if the
    /// level changes. Only for frames that were begun at this level: after a change, some of the level before are
    /// still under way.
    pub fn take(&mut self, taken: &FrameTimes, missed: bool) -> Option<Level> {
        for (times, &time) in self.times.iter_mut().zip(&taken.times) {
            if times.len() == WINDOW {
                times.pop_front();
            }
            times.push_back(time);
        }
        self.age(taken.since);
        self.young = self.young.saturating_sub(1);
        let whole: f64 = taken.times.iter().sum();
        let missed = whole > taken.period || (missed && whole > BUSY * taken.period);
        self.late = if missed { self.late + 1 } else { 0 };
        let missed = missed && (self.young == 0 || self.late >= LATE);
        let next = self
            .step_down(taken, missed)
            .or_else(|| self.step_up(taken.period));
        if let Some(level) = next {
            self.level = level;
            self.forget();
        }
        next
    }

    /// Whether work of that much more time (ms) fits beside that of the next frames, by what the last ones took of the display's period (ms).
    /// Not where too few of them are known.
    pub fn has_room_for(&self, more: f64, period: f64) -> bool {
        let foreseen = self.foreseen();
        foreseen.is_some_and(|times| times.iter().sum::<f64>() + more <= FULL * period)
    }

    fn age(&mut self, seconds: f64) {
        self.since_miss += seconds;
        for (risen, wait) in self.risen.iter_mut().zip(&mut self.wait) {
            if let Some(since) = risen {
                *since += seconds;
                if *since > SOON {
                    *wait = (0.5 * *wait).max(WAIT[0]);
                    *risen = None;
                }
            }
        }
        // `step_up` sets it back to 0 where there is none.
        self.room.iter_mut().for_each(|room| *room += seconds);
    }

    /// Rungs down, each of the part that takes longer, until the extrapolated time fits.
    fn step_down(&mut self, taken: &FrameTimes, missed: bool) -> Option<Level> {
        let again = missed && std::mem::replace(&mut self.since_miss, 0.0) < AGAIN;
        let known = self.foreseen().filter(|_| self.young == 0);
        // With too few frames for an extrapolation, this frame's own times.
        let mut foreseen = known.unwrap_or(taken.times);
        let mut level = self.level;
        let mut step = |foreseen: &mut [f64; 2]| -> bool {
            let [solver, picture] = *foreseen;
            let dear = if solver >= picture { [0, 1] } else { [1, 0] };
            let part = dear
                .into_iter()
                .find(|&part| level[part] + 1 < self.costs[part].len());
            if let Some(part) = part {
                foreseen[part] *= self.ratio(part, level[part] + 1, level[part]);
                level[part] += 1;
            }
            part.is_some()
        };
        // A miss is one rung down at once. If it was chance, more would be too much.
        let mut went = missed && step(&mut foreseen);
        let full = FULL * taken.period;
        while (known.is_some() || again)
            && foreseen.iter().sum::<f64>() > full
            && step(&mut foreseen)
        {
            went = true;
        }
        if !went {
            return None;
        }
        for part in [0, 1] {
            if level[part] > self.level[part] && self.risen[part].take().is_some() {
                self.wait[part] = (2.0 * self.wait[part]).min(WAIT[1]);
            }
        }
        Some(level)
    }

    /// One rung up, of the part that is farthest down among those that have had room for long enough.
    fn step_up(&mut self, period: f64) -> Option<Level> {
        let foreseen = self.foreseen()?;
        let whole: f64 = foreseen.iter().sum();
        for part in [0, 1] {
            let rung = self.level[part];
            let finer = match rung.checked_sub(1) {
                Some(finer) => whole + foreseen[part] * (self.ratio(part, finer, rung) - 1.0),
                None => f64::INFINITY,
            };
            if finer > ROOM * period {
                self.room[part] = 0.0;
            }
        }
        let down = |part: usize| self.level[part] as f64 / (self.costs[part].len() - 1) as f64;
        let part = (0..2)
            .filter(|&part| self.level[part] > 0 && self.room[part] >= self.wait[part])
            // Where both are equally far down, the solver.
            .reduce(|a, b| if down(b) > down(a) { b } else { a })?;
        let mut level = self.level;
        level[part] -= 1;
        self.risen[part] = Some(0.0);
        Some(level)
    }

    /// Cost of rung `to` of a part over that of rung `from`.
    fn ratio(&self, part: usize, to: usize, from: usize) -> f64 {
        self.costs[part][to] / self.costs[part][from]
    }

    /// Extrapolated time by part, ms; `None` with too few frames.
    fn foreseen(&self) -> Option<[f64; 2]> {
        let [solver, picture] = self.times.each_ref().map(foreseen);
        Some([solver?, picture?])
    }
}

/// The second greatest time, which one slow frame does not change, plus the trend over [`AHEAD`] frames.
fn foreseen(times: &VecDeque<f64>) -> Option<f64> {
    if times.len() < LEAST {
        return None;
    }
    let mut sorted: Vec<f64> = times.iter().copied().collect();
    sorted.sort_by(f64::total_cmp);
    let high = sorted[sorted.len() - 2];
    if times.len() < TREND {
        return Some(high);
    }
    let half = times.len() / 2;
    let median = |part: &mut dyn Iterator<Item = f64>| {
        let mut sorted: Vec<f64> = part.collect();
        sorted.sort_by(f64::total_cmp);
        sorted[sorted.len() / 2]
    };
    let early = median(&mut times.iter().copied().take(half));
    let late = median(&mut times.iter().copied().skip(times.len() - half));
    let slope = (late - early) / (times.len() - half) as f64;
    Some(high + AHEAD * slope.max(0.0))
}
