//! Blows against the momentum of bodies that fall or are put down.

use super::*;
use crate::bodies::Strike;

/// All blows of so many seconds.
fn blows(bodies: &mut Bodies, seconds: f32, hands: impl Fn(usize) -> [Hand; 2]) -> Vec<Strike> {
    let steps = (seconds / STEP).round() as usize;
    let mut all = Vec::new();
    for n in 0..steps {
        bodies.step(&hands(n), &[Load::default(); 2]);
        all.extend_from_slice(bodies.strikes());
    }
    all
}

/// m √(2 g h), and a fifth more as it comes back up: within a half, as a contact takes several of rapier's steps, and the beaker lands on
/// one edge first.
#[test]
fn a_beaker_that_falls_gives_its_momentum_to_the_table() {
    for height in [0.005, 0.02, 0.08] {
        let mut bodies = world(vec![beaker(above_table(height))]);
        let blows = blows(&mut bodies, 1.5, |_| NO_HANDS);
        let first = blows.first().copied().unwrap();
        let momentum = GLASS * (2.0 * G * height).sqrt();
        let ratio = first.impulse / (1.2 * momentum);
        assert!((0.5..1.5).contains(&ratio), "{height}: {ratio}, {blows:?}");
        assert_eq!((first.flask, first.other), (0, None));
        assert!(first.position.distance(above_table(0.0).position) < 0.1);
        // It bounces once or twice, each time less, and then stands.
        assert!(blows.len() <= 6, "{blows:?}");
        assert!(blows[1..].iter().all(|it| it.impulse < first.impulse));
    }
}

#[test]
fn what_stands_is_not_struck() {
    let mut bodies = world(vec![beaker(above_table(0.0)), {
        let mut other = beaker(above_table(0.0));
        other.stage_from_flask.position.x += 0.3;
        other
    }]);
    assert_eq!(blows(&mut bodies, 2.0, |_| NO_HANDS), []);
    // Nor where it comes from a snapshot.
    let snapshot = bodies.snapshot().unwrap();
    bodies.restore(&snapshot).unwrap();
    assert_eq!(blows(&mut bodies, 0.5, |_| NO_HANDS), []);
}

/// 300 g of liquid come to lie in it at once, as at the start of a scene; and a hand that holds it where it stands lets it go.
#[test]
fn weight_is_no_blow() {
    let load = Load {
        liquid_mass: 0.3,
        liquid_centre: Vec3::Y * 0.03,
        impulse: Vec3::NEG_Y * 0.3 * G * STEP,
        angular_impulse: Vec3::ZERO,
    };
    let mut bodies = world(vec![beaker(above_table(0.0))]);
    let side = above_table(0.05).position + Vec3::new(RADIUS, 0.0, 0.0);
    for n in 0..180 {
        let squeeze = f32::from(u8::from((60..120).contains(&n)));
        let hand = hand(Pose::from_position(side), squeeze);
        let loads = if n < 3 { [Load::default()] } else { [load] };
        bodies.step(&[hand, Hand::ABSENT], &loads);
        assert_eq!(bodies.strikes(), [], "step {n}");
    }
}

/// A hand lifts it by 5 cm and puts it down at 0.2 m/s, without letting go: glass of 100 g has 20 mN s.
#[test]
fn a_flask_that_is_put_down_knocks_once() {
    let mut bodies = world(vec![beaker(above_table(0.0))]);
    let at = above_table(0.05).position + Vec3::new(RADIUS, 0.0, 0.0);
    let hands = |n: usize| {
        let time = n as f32 * STEP;
        let height = match time {
            ..0.5 => 0.1 * time,
            ..1.0 => 0.05,
            _ => (0.05 - 0.2 * (time - 1.0)).max(0.0),
        };
        let hand = hand(Pose::from_position(at + Vec3::Y * height), 1.0);
        [hand, Hand::ABSENT]
    };
    let blows = blows(&mut bodies, 2.0, hands);
    assert_eq!(blows.len(), 1, "{blows:?}");
    assert!((blows[0].impulse / 0.02 - 1.0).abs() < 0.1, "{blows:?}");
}

/// Held under the table's edge and moved about there, over it and back, a flask meets nothing; the table ends at x = 2 m.
#[test]
fn under_the_table_nothing_is_struck() {
    let mut bodies = world(vec![beaker(Pose::from_position(Vec3::new(2.3, 0.0, 0.0)))]);
    let hands = |n: usize| {
        let time = n as f32 * STEP;
        let aside = 0.5 * (time - 1.5).clamp(0.0, 1.0) - 0.5 * (time - 2.5).clamp(0.0, 1.0);
        let height = 0.4 * (time - 0.3).clamp(0.0, 1.0);
        let at = Vec3::new(2.3 - RADIUS - aside, 0.05 + height, 0.0);
        [hand(Pose::from_position(at), 1.0), Hand::ABSENT]
    };
    assert_eq!(blows(&mut bodies, 4.0, hands), []);
    assert!(bodies.holder(0).is_some());
}

/// It comes over the edge 1 mm above the table and is put down in the next step at 0.09 m/s: that it was 0.75 m above the floor before is
/// no fall.
#[test]
fn what_comes_over_the_edge_has_not_fallen() {
    let mut bodies = world(vec![beaker(Pose::from_position(Vec3::new(2.3, 0.0, 0.0)))]);
    // The table ends at x = 2 m.
    let at = |n: usize| match n {
        ..20 => [2.3, 0.0],
        20..100 => [
            2.3 - 0.3 * (n - 19) as f32 / 80.0,
            0.753 * (n - 19) as f32 / 80.0,
        ],
        100 => [2.003, 0.752],
        101 => [1.998, 0.751],
        _ => [1.998, 0.75],
    };
    let hands = |n: usize| {
        let [x, y] = at(n);
        let at = Pose::from_position(Vec3::new(x - RADIUS, y + 0.05, 0.0));
        [hand(at, f32::from(u8::from(n > 2))), Hand::ABSENT]
    };
    let blows = blows(&mut bodies, 1.5, hands);
    assert_eq!(blows.len(), 1, "{blows:?}");
    assert!(
        (blows[0].impulse / (GLASS * 0.001 / STEP) - 1.0).abs() < 0.05,
        "{blows:?}"
    );
}

/// A world twenty times as large has the same blows: masses go with the third power of length, speeds with the first.
#[test]
fn a_larger_world_is_struck_as_hard() {
    let blows_in = |height: f32, hands: &dyn Fn(usize) -> [Hand; 2]| {
        let mut bodies = twenty_times(height);
        blows(&mut bodies, 1.0, hands)
    };
    let nobody = |_: usize| NO_HANDS;
    assert_eq!(blows_in(0.0, &nobody), []);
    let momentum = |speed: f32| GLASS * speed * 20.0_f32.powi(4);
    let ratio = blows_in(0.02, &nobody)[0].impulse / momentum(1.2 * (2.0 * G * 0.02_f32).sqrt());
    assert!((0.5..1.5).contains(&ratio), "{ratio}");
    // Put down from 5 mm at 0.1 m/s it knocks, at 0.01 m/s it does not: 1 mN s at real size.
    for (speed, count) in [(0.1, 1), (0.01, 0)] {
        let hands = |n: usize| {
            let height = (0.005 - speed * (n as f32 * STEP - 0.2).max(0.0)).max(0.0);
            let at = 20.0 * Vec3::new(RADIUS, 0.05 + height, 0.0);
            [hand(Pose::from_position(at), 1.0), Hand::ABSENT]
        };
        let blows = blows_in(0.005, &hands);
        assert_eq!(blows.len(), count, "{speed}: {blows:?}");
        for blow in blows {
            assert!(
                (blow.impulse / momentum(speed) - 1.0).abs() < 0.1,
                "{blow:?}"
            );
        }
    }
}

/// Two beakers, one of which is thrown at the other, which stands: the blow is of both.
#[test]
fn glass_meets_glass() {
    let mut there = above_table(0.0);
    there.position.x += 2.0 * RADIUS + 0.01;
    let mut bodies = world(vec![beaker(above_table(0.0)), beaker(there)]);
    // Held at its side, it goes 5 cm to the right in a tenth of a second.
    let at = above_table(0.06).position - Vec3::new(RADIUS, 0.0, 0.0);
    let hands = |n: usize| {
        let time = n as f32 * STEP;
        let aside = 0.5 * (time - 0.3).clamp(0.0, 0.1);
        let at = at + Vec3::new(aside, 0.003, 0.0);
        [hand(Pose::from_position(at), 1.0), Hand::ABSENT]
    };
    let blows = blows(&mut bodies, 1.0, hands);
    let struck: Vec<_> = blows.iter().filter(|it| it.other == Some(1)).collect();
    assert!(!struck.is_empty(), "{blows:?}");
    // A hand at 0.5 m/s sets 100 g in motion, once and a fifth as fast.
    let most = struck.iter().map(|it| it.impulse).fold(0.0, f32::max);
    assert!((0.3..2.0).contains(&(most / 0.06)), "{most}");
}
