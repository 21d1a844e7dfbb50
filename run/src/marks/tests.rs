#![allow(clippy::unwrap_used)]
//! Drops on hands, flasks, bench and goggles, from what an observation lists.

use super::*;
use glam::Quat;
use vitriol_render::Finish;
use vitriol_sim::solver::Came;

fn bone(ends: [Vec3; 2]) -> Bone {
    Bone::new(Finish::Glove, ends, [0.008; 2])
}

fn held(hands: [&[Bone]; 2], length_scale: f64) -> Carriers<'_> {
    Carriers {
        hands,
        flasks: &[],
        length_scale,
    }
}

fn on(flasks: &[Pose]) -> Carriers<'_> {
    Carriers {
        flasks,
        ..held([&[], &[]], 0.5)
    }
}

fn drop(onto: Onto, position: Vec3, volume: f64) -> Landed {
    Landed {
        onto,
        position,
        way: Vec3::new(0.0, -0.03, 0.0),
        volume,
        acid: 0.0,
    }
}

fn census(landed: Vec<Landed>) -> Census {
    Census {
        landed,
        ..Census::default()
    }
}

/// A ball of radius r has 4/3 π r³, so half a ball of 1 mm has 2.0944 µL.
#[test]
fn half_a_ball_has_the_drops_volume() {
    assert!((cap_radius(2.094_395e-9) - 1e-3).abs() < 1e-9);
    assert!((cap_radius(8.0 * 2.094_395e-9) - 2e-3).abs() < 1e-9);
}

/// A drop falls through a finger, in a scene twice as large as real: it lies on top, and goes along when the hand is turned and moved.
#[test]
fn a_drop_on_a_hand_goes_along_with_it() {
    let hand = [
        bone([Vec3::new(0.0, 1.0, 0.05), Vec3::new(0.04, 1.0, 0.05)]),
        bone([Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 1.0, 0.03)]),
    ];
    let under = 2.0 * Vec3::new(0.0, 0.991, 0.01);
    let landed = Landed {
        way: 2.0 * Vec3::new(0.0, -0.03, 0.0),
        ..drop(Onto::Skin(Skin::Right), under, 8.0 * 1e-9)
    };
    let mut marks = Marks::default();
    marks.take(&census(vec![landed]), held([&[], &hand], 0.5));
    let [lies] = marks.drawn(held([&[], &hand], 0.5))[..] else {
        unreachable!("one drop")
    };
    assert!(lies.position.distance(Vec3::new(0.0, 1.008, 0.01)) < 1e-4);
    assert!((f64::from(lies.radius) - cap_radius(1e-9)).abs() < 1e-7);
    let turn = Quat::from_rotation_z(1.0) * Quat::from_rotation_x(0.4);
    let moved = |at: Vec3| turn * at + Vec3::new(0.3, -0.2, 0.1);
    let later = hand.map(|it| bone(it.ends.map(moved)));
    let there = marks.drawn(held([&[], &later], 0.5))[0].position;
    assert!(there.distance(moved(lies.position)) < 1e-5, "{there}");
    // A hand that is not seen has none that is seen, and another glove is clean.
    assert_eq!(marks.drawn(held([&hand, &[]], 0.5)), []);
    let worn = |right| Worn {
        goggles: None,
        gloves: Some([true, right]),
    };
    marks.wears(worn(true));
    assert_eq!(marks.drawn(held([&[], &hand], 0.5)).len(), 1);
    marks.wears(worn(false));
    assert_eq!(marks.drawn(held([&[], &hand], 0.5)), []);
}

/// A drop on the second of two flasks, in a scene twice as large as real, goes along when the flask is turned and moved. It is gone when that
/// flask breaks, and not when the other does.
#[test]
fn a_drop_on_a_flask_goes_along_with_it() {
    let at = Vec3::new(0.05, 0.08, 0.0);
    let turn = Quat::from_rotation_z(1.0) * Quat::from_rotation_x(0.4);
    let first = [Pose::IDENTITY, Pose::from_position(Vec3::X)];
    let later = [
        Pose::from_position(Vec3::Z),
        Pose::new(Vec3::new(0.4, 1.6, -0.2), turn),
    ];
    let mut marks = Marks::default();
    let landed = drop(Onto::Flask(1), at, 8.0 * 1e-9);
    marks.take(&census(vec![landed]), on(&first));
    let half = |at: Vec3| 0.5 * at;
    for (flasks, place) in [
        (&first, half(at + Vec3::X)),
        (&later, half(turn * at + Vec3::new(0.4, 1.6, -0.2))),
    ] {
        let [lies] = marks.drawn(on(flasks))[..] else {
            unreachable!("one drop")
        };
        assert!(lies.position.distance(place) < 1e-6, "{lies:?}");
        assert!((f64::from(lies.radius) - cap_radius(1e-9)).abs() < 1e-7);
    }
    marks.broke(|flask| flask == 0);
    assert_eq!(marks.drawn(on(&later)).len(), 1);
    marks.broke(|flask| flask == 1);
    assert_eq!(marks.drawn(on(&later)), []);
}

/// 0.3 mL of 50 % to the face, in a scene twice as large as real, are 0.15 mL of acid: less than one splash of six has. Ten times as much
/// covers all. Water leaves none, and nothing is seen through goggles that are off.
#[test]
fn acid_in_the_face_covers_the_goggles() {
    let mut marks = Marks::default();
    let splash = |marks: &mut Marks, acid: f64, volume: f64| {
        let mut census = Census::default();
        census.skin[Skin::Face as usize].came = Came {
            particles: 1,
            volume: 8.0 * volume,
            acid,
            ..Came::default()
        };
        marks.take(&census, held([&[], &[]], 0.5));
        marks.goggles()
    };
    assert_eq!(splash(&mut marks, 0.0, 1e-6), 0.0);
    assert_eq!(splash(&mut marks, 0.5, 0.3e-6), 1.0 / 6.0);
    let half = splash(&mut marks, 0.5, 0.7e-6);
    assert!((half - 0.5).abs() < 1e-6, "{half}");
    assert_eq!(splash(&mut marks, 0.5, 3e-6), 1.0);
    for (on, seen) in [(Some(false), 0.0), (Some(true), 1.0), (None, 1.0)] {
        marks.wears(Worn {
            goggles: on,
            gloves: None,
        });
        assert_eq!(marks.goggles(), seen, "{on:?}");
    }
}

/// More drops than are drawn: the largest stay, and a cloth takes off those that it lies on. Larger ones on glass take no place from them.
#[test]
fn the_largest_stay_until_they_are_wiped() {
    let at = |n: usize| Vec3::new(0.01 * n as f32, 0.75, 0.0);
    let flasks = [Pose::IDENTITY];
    let on = Carriers {
        length_scale: 1.0,
        ..on(&flasks)
    };
    let number = 128 + 20;
    let aside = |n: usize| at(n) + Vec3::Z;
    let glass = (0..number).map(|n| drop(Onto::Flask(0), aside(n), 1e-9));
    let table = (0..number).map(|n| drop(Onto::Table, at(n), 1e-12 * (n + 1) as f64));
    let mut marks = Marks::default();
    marks.take(&census(glass.chain(table).collect()), on);
    let drawn = marks.drawn(on);
    assert_eq!(drawn.len(), MOST_RESTING);
    let (glass, table): (Vec<&RestingDrop>, Vec<&RestingDrop>) =
        drawn.iter().partition(|it| it.position.z > 0.5);
    assert_eq!([glass.len(), table.len()], [32, 128]);
    assert!(table.iter().all(|it| it.position.x > at(19).x));
    marks.wipe([at(number - 1), at(number - 1) + 0.02 * Vec3::Y], 0.035);
    // Of those 1 cm apart the last four.
    assert_eq!(marks.drawn(on).len(), MOST_RESTING - 4);
}

/// Two parts of water and one of acid of 90 % by volume: 30 %.
#[test]
fn a_drop_has_the_acid_of_what_fell_there() {
    let at = Vec3::new(0.0, 0.75, 0.0);
    let acid = Landed {
        acid: 0.9,
        ..drop(Onto::Table, at, 5e-9)
    };
    let mut marks = Marks::default();
    let on = held([&[], &[]], 1.0);
    marks.take(&census(vec![drop(Onto::Table, at, 1e-8)]), on);
    marks.take(&census(vec![acid]), on);
    let [lies] = marks.drawn(on)[..] else {
        unreachable!("one drop")
    };
    assert!((lies.acid - 0.3).abs() < 1e-6, "{lies:?}");
}

/// What falls on a drop joins it, up to a drop's 0.05 mL; ten times as much water takes it off a hand.
#[test]
fn drops_join_and_are_rinsed_off() {
    let hand = [bone([Vec3::ZERO, Vec3::new(0.0, 0.0, 0.03)])];
    let landed = drop(Onto::Skin(Skin::Left), Vec3::new(0.0, -0.01, 0.01), 15e-9);
    let mut marks = Marks::default();
    let on = held([&hand, &[]], 1.0);
    for count in 1..=5 {
        marks.take(&census(vec![landed]), on);
        let drawn = marks.drawn(on);
        assert_eq!(drawn.len(), 1);
        let volume = (15e-9 * f64::from(count)).min(0.05e-6);
        assert!((f64::from(drawn[0].radius) - cap_radius(volume)).abs() < 1e-7);
    }
    let mut water = Census::default();
    water.skin[0].rinsed = 0.3e-6;
    marks.take(&water, on);
    assert_eq!(marks.drawn(on).len(), 1);
    marks.take(&water, on);
    assert_eq!(marks.drawn(on), []);
}
