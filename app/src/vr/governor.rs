//! Keeps a session within its display's period: from what frames took on the device to how much
//! work the next ones are given. It knows times and ladders of work only; what a rung is, `ladder`
//! says.
//!
//! It foresees. A frame that is missed is seen by who wears the headset, so a part is stepped
//! down when the times of the last quarter of a second, carried on by their own trend, come to more
//! than [`FULL`] of a period. It steps up when what the finer rung would take has been below
//! [`ROOM`] for a while. Between the two lies more than the step between most rungs, and
//! where that is not enough, what has to be taken back is tried ever more seldom.

#[cfg(test)]
mod tests;

use std::collections::VecDeque;

/// Share of a period that a frame's work may take on the device. The rest is the compositor's, about a
/// millisecond of 11.1, and the processor's before its first submission.
pub const FULL: f64 = 0.85;
/// Share of a period below which a finer rung has room.
pub const ROOM: f64 = 0.68;
/// Share of a period from which on a missed frame is the device's fault, and less work would mend it. Below,
/// it was another program or the processor.
const BUSY: f64 = 0.6;

/// Frames that are looked at: a quarter of a second at 90 Hz.
const WINDOW: usize = 24;
/// Frames of a window before anything is foreseen from it.
const LEAST: usize = 4;
/// Frames of a window from which on it has a trend.
const TREND: usize = 12;
/// Frames that a trend is carried on for: those under way, and a step down with its own.
const AHEAD: f64 = 12.0;

/// A frame missed within this time of another is no single mishap, s.
const AGAIN: f64 = 1.0;

/// Time for which there must be room before a step up, s: at first, and at most.
const WAIT: [f64; 2] = [2.0, 64.0];
/// A step up that has to be taken back within this time was a mistake, s.
const SOON: f64 = 15.0;

/// Rungs of the solver and of the picture, the parts of a frame's work; 0 is the finest.
pub type Level = [usize; 2];

/// A frame as the device took it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taken {
    /// Time by part, ms: of as many steps as a display period has, and of the picture.
    pub times: [f64; 2],
    /// The display's period, ms.
    pub period: f64,
    /// Time since the frame taken before it, s.
    pub since: f64,
}

/// See the module.
#[derive(Clone, Debug)]
pub struct Governor {
    /// By part, what each rung costs in terms of the others; falling.
    costs: [Vec<f64>; 2],
    level: Level,
    /// By part, the last frames' times at this level, ms.
    times: [VecDeque<f64>; 2],
    /// Seconds for which the next finer rung of each part has had room.
    room: [f64; 2],
    /// Seconds for which it must.
    wait: [f64; 2],
    /// Seconds since a part was stepped up, until that is proven.
    risen: [Option<f64>; 2],
    /// Seconds since a frame was missed.
    since_miss: f64,
}

impl Governor {
    /// At `level` of ladders whose rungs cost `costs`, the finest first.
    pub fn new(costs: [Vec<f64>; 2], level: Level) -> Self {
        let mut level = level;
        for (rung, ladder) in level.iter_mut().zip(&costs) {
            *rung = (*rung).min(ladder.len().saturating_sub(1));
        }
        Self {
            costs,
            level,
            times: [VecDeque::new(), VecDeque::new()],
            room: [0.0; 2],
            wait: [WAIT[0]; 2],
            risen: [None; 2],
            since_miss: f64::INFINITY,
        }
    }

    /// The level for the next frames.
    pub fn level(&self) -> Level {
        self.level
    }

    /// Forgets what frames took: there is another device or another picture.
    pub fn forget(&mut self) {
        self.times.iter_mut().for_each(VecDeque::clear);
        self.room = [0.0; 2];
    }

    /// Takes in a frame of this level that is done, and whether one was missed since the last; the new level if that
    /// changes it. Frames of the level before, which are under way still then, are not to be given.
    pub fn take(&mut self, taken: &Taken, missed: bool) -> Option<Level> {
        for (times, &time) in self.times.iter_mut().zip(&taken.times) {
            if times.len() == WINDOW {
                times.pop_front();
            }
            times.push_back(time);
        }
        self.age(taken.since);
        let whole: f64 = taken.times.iter().sum();
        let missed = whole > taken.period || (missed && whole > BUSY * taken.period);
        let next = self
            .step_down(taken, missed)
            .or_else(|| self.step_up(taken.period));
        if let Some(level) = next {
            self.level = level;
            self.forget();
        }
        next
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
        // Taken back where there turns out to be none.
        self.room.iter_mut().for_each(|room| *room += seconds);
    }

    /// Down from the dearest part, until what is foreseen fits.
    fn step_down(&mut self, taken: &Taken, missed: bool) -> Option<Level> {
        let again = missed && std::mem::replace(&mut self.since_miss, 0.0) < AGAIN;
        let known = self.foreseen();
        // Before there is a window there is the frame itself.
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
        // A miss is one step at once: was it a single mishap, more would be too much.
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

    /// One rung up in the part that is farthest down, where there has been room for long enough.
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
            // Of equals the solver.
            .reduce(|a, b| if down(b) > down(a) { b } else { a })?;
        let mut level = self.level;
        level[part] -= 1;
        self.risen[part] = Some(0.0);
        Some(level)
    }

    /// What rung `to` of a part takes over what `from` takes.
    fn ratio(&self, part: usize, to: usize, from: usize) -> f64 {
        self.costs[part][to] / self.costs[part][from]
    }

    /// Time by part that frames will take as things go, ms; `None` before there is a window.
    fn foreseen(&self) -> Option<[f64; 2]> {
        let [solver, picture] = self.times.each_ref().map(foreseen);
        Some([solver?, picture?])
    }
}

/// The greatest time but one, which a single frame's mishap does not move, and where it is going.
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
