//! Glass that breaks, against free fall and where shards can be.

use super::*;
use crate::bodies::{BASE_SHARE, BREAKS_AT, NOWHERE, SHARDS, Shard};

/// Corners of a shard where it is: of a beaker, a disc and three thirds of a wall.
fn corners(shard: &Shard) -> Vec<Vec3> {
    let base = shard.piece == 0;
    let heights = if base {
        [0.0, BASE_SHARE]
    } else {
        [BASE_SHARE, 1.0]
    };
    let (first, turn) = match shard.piece {
        0 => (0.0, 360.0_f32),
        wall => (120.0 * (wall - 1) as f32, 120.0),
    };
    let places = (0..=16).flat_map(|n| {
        let angle = (first + turn * n as f32 / 16.0).to_radians();
        heights.map(|share| Vec3::new(RADIUS * angle.cos(), share * HEIGHT, RADIUS * angle.sin()))
    });
    places
        .map(|at| shard.stage_from_flask.transform_point(at))
        .collect()
}

fn breakable(flasks: Vec<BodySpec>) -> Bodies {
    let mut bodies = world(flasks);
    bodies.set_breakable(true);
    bodies
}

/// A fall from a third of a metre is borne, one from two thirds is not; nor is one of the other glass for that.
#[test]
fn what_falls_too_far_breaks() {
    for (height, breaks) in [(0.33, false), (0.46, false), (0.54, true), (0.66, true)] {
        let mut beside = beaker(above_table(0.0));
        beside.stage_from_flask.position.x += 1.0;
        let mut bodies = breakable(vec![beaker(above_table(height)), beside]);
        let mut fastest = 0.0_f32;
        let mut broke = Vec::new();
        for _ in 0..120 {
            bodies.step(&NO_HANDS, &[]);
            let blows = bodies.strikes().iter().map(|it| it.speed);
            fastest = blows.fold(fastest, f32::max);
            broke.extend_from_slice(bodies.breaks());
        }
        // rapier slows it a little in the step before it touches.
        let fell = (2.0 * G * height).sqrt();
        assert!(
            (fastest / fell - 1.0).abs() < 0.02,
            "{height}: {fastest} {fell}"
        );
        assert_eq!(broke.len(), usize::from(breaks), "{height}: {broke:?}");
        assert_eq!([0, 1].map(|flask| bodies.is_broken(flask)), [breaks, false]);
        assert_eq!(
            bodies.shards().len(),
            if breaks { SHARDS as usize } else { 0 }
        );
        if breaks {
            let at = broke[0].stage_from_flask.position;
            assert!(at.distance(above_table(0.0).position) < 0.01, "{at}");
            assert_eq!(bodies.poses()[0].position, NOWHERE);
            assert_eq!(bodies.distance(0, NOWHERE), None);
            assert!(bodies.velocity(0).is_none());
        }
        // Not where it is not wanted.
        let mut bodies = world(vec![beaker(above_table(height))]);
        run(&mut bodies, 1.3, Load::default());
        assert!(!bodies.is_broken(0) && bodies.shards().is_empty());
    }
}

/// They fly apart from where it was, come to rest on the table and the floor, and none goes through.
#[test]
fn shards_lie_where_it_fell() {
    let mut bodies = breakable(vec![beaker(above_table(0.8))]);
    while bodies.breaks().is_empty() {
        bodies.step(&NO_HANDS, &[]);
    }
    let place = above_table(0.0).position;
    let first = bodies.shards();
    for shard in &first {
        assert!(
            shard.stage_from_flask.position.distance(place) < 0.03,
            "{shard:?}"
        );
    }
    run(&mut bodies, 4.0, Load::default());
    let rest = bodies.shards();
    for (shard, was) in rest.iter().zip(&first) {
        let corners = corners(shard);
        let lowest = corners.iter().map(|it| it.y).fold(f32::INFINITY, f32::min);
        assert!((lowest - TABLE_TOP).abs() < 2e-3, "{lowest} {shard:?}");
        let aside = corners.iter().map(|it| (*it - place).with_y(0.0).length());
        assert!(aside.fold(0.0, f32::max) < 0.6, "{shard:?}");
        assert_eq!((shard.flask, shard.piece), (0, was.piece));
    }
    // The wall's have gone apart: each to its own third.
    for (wall, shard) in rest[1..].iter().enumerate() {
        let angle = (120.0 * wall as f32 + 60.0).to_radians();
        let outward = Vec3::new(angle.cos(), 0.0, angle.sin());
        let middle = corners(shard).iter().sum::<Vec3>() / 34.0;
        assert!((middle - place).dot(outward) > 0.02, "{wall}: {middle}");
    }
    run(&mut bodies, 1.0, Load::default());
    for (shard, before) in bodies.shards().iter().zip(&rest) {
        let moved = shard.stage_from_flask.position - before.stage_from_flask.position;
        assert!(moved.length() < 1e-3, "{shard:?}");
    }
}

/// A hand that knocks it on the table too fast holds nothing then, and takes nothing before it has opened.
#[test]
fn a_hand_breaks_what_it_slams_down() {
    for (speed, breaks) in [(2.5, false), (3.5, true)] {
        let mut other = beaker(above_table(0.0));
        other.stage_from_flask.position.x += 0.075;
        let mut bodies = breakable(vec![beaker(above_table(0.3)), other]);
        let at = above_table(0.05).position - Vec3::new(RADIUS, 0.0, 0.0);
        let mut held = Vec::new();
        for n in 0..60 {
            let height = (0.3 - speed * STEP * (n as f32 - 5.0).max(0.0)).max(0.0);
            bodies.step(&gripping(Pose::from_position(at + Vec3::Y * height)), &[]);
            held.push(bodies.holder(0));
        }
        assert_eq!(held[3], Some(1));
        assert_eq!(bodies.is_broken(0), breaks, "{speed}");
        let last = held.last().copied().flatten();
        assert_eq!(last.is_none(), breaks, "{speed}");
        assert_eq!(bodies.holder(1), None, "{speed}");
    }
}

/// Thrown at each other, both break; a clamped flask does not.
#[test]
fn glass_breaks_glass() {
    for fixed in [false, true] {
        let mut there = above_table(0.0);
        there.position.x += 0.5;
        let mut other = beaker(there);
        other.fixed = fixed;
        let mut bodies = breakable(vec![beaker(above_table(0.0)), other]);
        let at = above_table(0.06).position - Vec3::new(RADIUS, 0.0, 0.0);
        let mut n = 0;
        while bodies.breaks().is_empty() && n < 120 {
            let aside = 5.0 * STEP * (n as f32 - 20.0).clamp(0.0, 5.0);
            let squeeze = f32::from(u8::from(n < 25));
            let grip = Pose::from_position(at + Vec3::new(aside, 0.01, 0.0));
            bodies.step(&[Hand::ABSENT, hand(grip, squeeze)], &[]);
            n += 1;
        }
        assert_eq!([0, 1].map(|it| bodies.is_broken(it)), [true, !fixed], "{n}");
    }
}

/// From a snapshot of any step before, in or after the blow: the same bits.
#[test]
fn a_break_is_as_if_never_interrupted() {
    let drop = || breakable(vec![beaker(tilted(above_table(0.7), 0.4))]);
    let end = |bodies: &Bodies| (bodies.shards(), bodies.poses().to_vec());
    let mut whole = drop();
    let mut states = Vec::new();
    let mut broke = 0;
    for n in 0..90 {
        states.push(whole.snapshot().unwrap());
        whole.step(&NO_HANDS, &[]);
        if !whole.breaks().is_empty() {
            broke = n;
        }
    }
    assert!(broke > 20, "{broke}");
    for from in [
        broke - 3,
        broke - 2,
        broke - 1,
        broke,
        broke + 1,
        broke + 20,
    ] {
        let mut again = drop();
        again.restore(&states[from]).unwrap();
        for _ in from..90 {
            again.step(&NO_HANDS, &[]);
        }
        assert_eq!(end(&again), end(&whole), "{from}");
    }
    // A flask that broke in the state before has not in the one that is taken up.
    let mut again = drop();
    again.restore(&states[broke]).unwrap();
    again.step(&NO_HANDS, &[]);
    assert_eq!(again.breaks().len(), 1);
    again.restore(&states[broke]).unwrap();
    assert!(again.breaks().is_empty() && !again.is_broken(0));
}

/// The base of one that falls aslant goes to no side by itself: as far as its flask would have gone with its spin, and the wall's three
/// go by half a metre a second more, each to another side.
#[test]
fn the_base_goes_on_as_the_flask_went() {
    let mut bodies = breakable(vec![beaker(tilted(above_table(0.7), 0.4))]);
    let (mut before, mut velocity) = (Vec::new(), None);
    while before.is_empty() {
        velocity = bodies.velocity(0);
        bodies.step(&NO_HANDS, &[]);
        before = bodies.shards();
    }
    let velocity = velocity.unwrap();
    let pose = bodies.breaks()[0].stage_from_flask;
    // In one step; half a metre a second would be 5 mm.
    let expected = pose.position + STEP * velocity.linear;
    let base = before[0].stage_from_flask.position;
    let aside = (base - expected).with_y(0.0).length();
    assert!(aside < 1e-3, "{aside}");
    let apart = before[1..]
        .iter()
        .map(|shard| shard.stage_from_flask.position - base);
    let sum = apart.clone().sum::<Vec3>().with_y(0.0);
    assert!(apart.map(Vec3::length).fold(0.0, f32::max) > 2e-3);
    assert!(sum.length() < 6e-3, "{sum}");
}

/// Shards that have come to rest sleep; a snapshot of them goes on with the same bits, and a beaker that falls among them wakes them.
#[test]
fn sleeping_shards_are_taken_up_as_well() {
    let fall = || {
        let mut other = beaker(above_table(0.0));
        other.stage_from_flask.position.x += 0.5;
        breakable(vec![beaker(above_table(0.7)), other])
    };
    // From the fifth second on a hand pushes the other beaker through where they lie.
    let hands = |n: usize| {
        let time = n as f32 * STEP;
        let aside = 0.5 * (time - 5.2).clamp(0.0, 1.2);
        let at = above_table(0.05).position + Vec3::new(0.5 + RADIUS - aside, 0.003, 0.0);
        gripping(Pose::from_position(at)).map(|mut hand| {
            hand.squeeze = f32::from(u8::from(n > 3));
            hand
        })
    };
    let end = |bodies: &Bodies| (bodies.shards(), bodies.poses().to_vec());
    let steps = (7.0 / STEP) as usize;
    let mut whole = fall();
    let mut kept = Vec::new();
    let mut at_rest = Vec::new();
    for n in 0..steps {
        if n == steps * 4 / 7 {
            kept = whole.snapshot().unwrap();
            at_rest = whole.shards();
        }
        whole.step(&hands(n), &[]);
        // The hand's beaker is clear of the table: shards that it meets strike nothing.
        if n as f32 * STEP > 5.1 {
            assert_eq!(whole.strikes(), [], "step {n}");
        }
    }
    let moved = whole.shards().iter().zip(&at_rest).any(|(now, then)| {
        let moved = now.stage_from_flask.position - then.stage_from_flask.position;
        moved.length() > 0.02
    });
    assert!(moved, "a beaker that comes by pushes them");
    let mut again = fall();
    again.restore(&kept).unwrap();
    for n in steps * 4 / 7..steps {
        again.step(&hands(n), &[]);
    }
    assert_eq!(end(&again), end(&whole));
}

/// Speeds go with length in a world twenty times as large.
#[test]
fn a_larger_world_breaks_alike() {
    for (height, breaks) in [(0.45, false), (0.55, true)] {
        let mut bodies = twenty_times(height);
        bodies.set_breakable(true);
        run(&mut bodies, 1.0, Load::default());
        assert_eq!(bodies.is_broken(0), breaks, "{height}");
        run(&mut bodies, 2.0, Load::default());
        for shard in bodies.shards() {
            let at = shard.stage_from_flask.position / 20.0;
            assert!(at.length() < 0.6, "{shard:?}");
            let real = Shard {
                stage_from_flask: Pose::new(at, shard.stage_from_flask.orientation),
                ..shard
            };
            let heights = corners(&real).into_iter().map(|it| it.y);
            let lowest = heights.fold(f32::INFINITY, f32::min);
            assert!(lowest.abs() < 2e-3, "{lowest} {shard:?}");
        }
    }
    assert!(BREAKS_AT > (2.0 * G * 0.45_f32).sqrt());
}
