//! Against simulated loads. Frames go through a device that is three behind, as a real one is.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::*;
use std::collections::VecDeque;

const PERIOD: f64 = 1000.0 / 90.0;
/// Frames under way.
const UNDER_WAY: usize = 3;

fn ladders() -> [Vec<f64>; 2] {
    [vec![1.0, 0.8, 0.6, 0.4, 0.25], vec![1.0, 0.81, 0.64, 0.55]]
}

/// A frame whose parts took these shares of the period.
fn taken(shares: [f64; 2]) -> FrameTimes {
    FrameTimes {
        times: shares.map(|share| share * PERIOD),
        period: PERIOD,
        since: 1.0 / 90.0,
    }
}

/// What a run was like.
#[derive(Debug, Default)]
struct Run {
    missed: u32,
    /// Time (s) and level of each change.
    changes: Vec<(f64, Level)>,
    level: Level,
}

impl Run {
    fn level_at(&self, time: f64) -> Level {
        let before = self.changes.iter().rev().find(|(at, _)| *at <= time);
        before.map_or([0, 0], |(_, level)| *level)
    }
}

/// Runs so many seconds of frames whose parts take what `load` gives for a time (s) and a level, in
/// shares of the period.
fn run(seconds: f64, mut load: impl FnMut(f64, Level) -> [f64; 2]) -> Run {
    let mut governor = Governor::new(ladders());
    let mut run = Run::default();
    let mut under_way = VecDeque::new();
    let frames = (seconds * 90.0) as u32;
    for frame in 0..frames {
        let time = f64::from(frame) / 90.0;
        under_way.push_back((governor.level, load(time, governor.level)));
        if under_way.len() <= UNDER_WAY {
            continue;
        }
        let (level, shares) = under_way.pop_front().unwrap();
        run.missed += u32::from(shares[0] + shares[1] > 1.0);
        if level != governor.level {
            continue;
        }
        if let Some(level) = governor.take(&taken(shares), false) {
            run.changes.push((time, level));
        }
    }
    run.level = governor.level;
    run
}

/// The shares at a level whose costs are those of the ladders.
fn at(level: Level, full: [f64; 2]) -> [f64; 2] {
    let costs = ladders();
    [0, 1].map(|part| full[part] * costs[part][level[part]])
}

/// Numbers from −1 to 1 that look like noise, the same each time.
fn noise(seed: &mut u64) -> f64 {
    *seed = seed
        .wrapping_mul(6364136223846793005)
        .wrapping_add(1442695040888963407);
    ((*seed >> 33) as f64) / f64::from(1_u32 << 30) - 1.0
}

/// Twice the load from one frame to the next: at once down to what fits and not lower, and back up
/// to the top when it is gone.
#[test]
fn a_load_that_comes_and_goes() {
    let run = run(40.0, |time, level| {
        let full = if (5.0..15.0).contains(&time) {
            1.2
        } else {
            0.5
        };
        at(level, [0.8 * full, 0.2 * full])
    });
    // 0.24 and 0.96 × 0.6 are 0.816.
    assert_eq!(run.level_at(14.9), [2, 0], "{run:?}");
    // The first, those under way then, the first of the next level, and those under way then.
    assert!(run.missed <= 2 * (UNDER_WAY as u32 + 1), "{run:?}");
    assert_eq!(run.level, [0, 0]);
    assert!(run.changes.len() <= 4, "{run:?}");
    assert!(run.changes.iter().all(|(at, _)| *at > 5.0 && *at < 22.0));
}

/// A load that grows by a fifth of the period a second, as a boiling flask's may, and one that grows by
/// almost three: it is stepped down before any frame is missed.
#[test]
fn a_ramp_is_foreseen() {
    for (rate, length) in [(0.2, 5.0), (2.8, 0.3)] {
        let run = run(20.0, |time, level| {
            let full = 0.5 + rate * (time - 2.0).clamp(0.0, length);
            at(level, [0.7 * full, 0.3 * full])
        });
        assert_eq!(run.missed, 0, "{run:?}");
        assert!(run.level[0] > 0);
        // Some rungs and no more.
        assert!(run.changes.len() <= 5, "{run:?}");
    }
}

/// Frames whose times scatter by a tenth stay where they are.
#[test]
fn noise_moves_nothing() {
    let mut seed = 7;
    let run = run(120.0, |_, level| {
        let full = 0.68 * (1.0 + 0.1 * noise(&mut seed));
        at(level, [0.5 * full, 0.5 * full])
    });
    assert!(run.changes.is_empty(), "{run:?}");
}

/// And where they scatter about the limit itself: down, and no to and fro.
#[test]
fn noise_at_the_limit_settles() {
    let mut seed = 11;
    let run = run(120.0, |_, level| {
        let full = 0.85 * (1.0 + 0.1 * noise(&mut seed));
        at(level, [0.6 * full, 0.4 * full])
    });
    assert_eq!(run.missed, 0);
    assert!(run.changes.len() <= 3, "{run:?}");
}

/// The finer rung costs more than its ladder gives: from below there seems to be room for it, and there is not. It is tried, and ever more
/// seldom.
#[test]
fn a_trap_is_not_walked_into_over_and_over() {
    let run = run(600.0, |_, [solver, picture]| {
        [
            if solver == 0 { 0.9 } else { 0.4 },
            if picture == 0 { 0.1 } else { 0.08 },
        ]
    });
    // Tried after 2, 4, 8, 16, 32 and then each 64 s: 13 times in ten minutes, each there and back.
    assert!((9..=30).contains(&run.changes.len()), "{run:?}");
    assert_eq!(run.missed, 0);
}

/// One slow frame that is not missed is nothing; one that is missed is one step, taken back.
#[test]
fn a_spike() {
    for (spike, steps) in [(0.98, 0), (3.0, 2)] {
        let mut frame = 0;
        let run = run(30.0, |_, level| {
            frame += 1;
            let full = if frame == 900 { spike } else { 0.6 };
            at(level, [0.7 * full, 0.3 * full])
        });
        assert_eq!(run.changes.len(), steps, "{spike}: {run:?}");
        assert_eq!(run.level, [0, 0]);
        if let [(down, level), (up, _)] = run.changes[..] {
            assert_eq!(level, [1, 0]);
            assert!(down < 10.1 && up - down > 2.0 && up - down < 2.5, "{run:?}");
        }
    }
}

/// The first frames of a session take long, and a few of them are missed: that is no load. A dozen that are missed one after
/// the other are.
#[test]
fn a_start_is_no_load() {
    for (spike, frames, calm) in [(0.95, 22, true), (3.0, 8, true), (1.3, 24, false)] {
        let mut frame = 0;
        let run = run(10.0, |_, level| {
            frame += 1;
            let full = if frame <= frames { spike } else { 0.45 };
            at(level, [0.5 * full, 0.5 * full])
        });
        assert_eq!(run.changes.is_empty(), calm, "{spike}: {run:?}");
        assert_eq!(run.level, [0, 0]);
    }
}

/// The dear part is made cheaper, whichever it is; where both are dear, both.
#[test]
fn the_dear_part_pays() {
    let last = |full: [f64; 2]| {
        // After the start.
        let load = |time: f64| if time < 1.0 { [0.1, 0.1] } else { full };
        let run = run(10.0, |time, level| at(level, load(time)));
        (run.level, run.missed)
    };
    assert_eq!(last([0.8, 0.1]).0, [1, 0]);
    assert_eq!(last([0.1, 0.8]).0, [0, 1]);
    // 0.4 and 0.41, which is nearer than one part alone could come.
    assert_eq!(last([0.5, 0.5]).0, [1, 1]);
    // A part that is at its end leaves it to the other: 0.25 of 2, and 0.55 of 0.6.
    let (level, missed) = last([2.0, 0.6]);
    assert_eq!(level, [4, 3]);
    assert!(missed <= 2 * (UNDER_WAY as u32 + 1), "{missed}");
}

/// Frames of 0.7 of a period leave 0.15 of it below the limit, which is 0.85. Where no frame is known, nothing is known to fit.
#[test]
fn room_is_what_the_frames_leave() {
    let mut governor = Governor::new(ladders());
    assert!(!governor.has_room_for(0.0, PERIOD));
    let taken = taken([0.5, 0.2]);
    assert!((0..YOUNG).all(|_| governor.take(&taken, false).is_none()));
    assert!(governor.has_room_for(0.14 * PERIOD, PERIOD));
    assert!(!governor.has_room_for(0.16 * PERIOD, PERIOD));
}

/// A frame is missed though the device had time: less work for it would mend nothing. Where it was busy, it does.
#[test]
fn only_what_the_device_misses_is_its_fault() {
    for (share, stepped) in [(0.3, None), (0.7, Some([1, 0]))] {
        let mut governor = Governor::new(ladders());
        let taken = taken([0.9, 0.1].map(|part| part * share));
        // Past its start.
        assert!((0..YOUNG).all(|_| governor.take(&taken, false).is_none()));
        assert_eq!(governor.take(&taken, true), stepped);
    }
}
