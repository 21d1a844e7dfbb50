//! Flasks that no hand holds.

use super::*;

#[test]
fn free_fall() {
    let start = above_table(0.6);
    let mut bodies = world(vec![beaker(start)]);
    for step in 1..=30 {
        bodies.step(&NO_HANDS, &[]);
        let t = step as f32 * STEP;
        let fallen = start.position.y - bodies.poses()[0].position.y;
        // Symplectic Euler is ahead of ½gt² by ½gt times its substep of Δt/16.
        let ahead = 0.5 * G * t * STEP / 16.0;
        let error = fallen - (0.5 * G * t * t + ahead);
        assert!(
            error.abs() < 2e-5,
            "step {step}: {error} m beside free fall"
        );
    }
}

fn rests(spec: fn(Pose) -> BodySpec, load: Load) {
    let mut bodies = world(vec![
        spec(above_table(0.0)),
        spec(Pose::from_position(Vec3::new(0.5, TABLE_TOP, 0.3))),
    ]);
    run(&mut bodies, 1.0, load);
    let settled = bodies.poses().to_vec();
    assert!(
        (settled[0].position.y - TABLE_TOP).abs() < 1e-4,
        "stands at {} m above the table",
        settled[0].position.y - TABLE_TOP
    );
    for _ in 0..900 {
        bodies.step(&NO_HANDS, &[load; 2]);
        for (now, then) in bodies.poses().iter().zip(&settled) {
            let moved = (now.position - then.position).length();
            assert!(moved < 1e-4, "moved by {moved} m");
            assert!(axis(*now).y > 1.0 - 1e-6, "leans: {}", axis(*now));
        }
    }
}

#[test]
fn an_empty_flask_stays_where_it_stands() {
    rests(beaker, Load::default());
    rests(erlenmeyer, Load::default());
}

/// 2.5 N downwards, once as a bare push and once as 255 g of liquid.
#[test]
fn a_full_flask_stays_where_it_stands() {
    let impulse = Vec3::new(0.0, -2.5 * STEP, 0.0);
    let bare = Load {
        impulse,
        ..Load::default()
    };
    let liquid = Load {
        impulse,
        liquid_mass: 2.5 / G,
        liquid_centre: Vec3::new(0.0, 0.035, 0.0),
        ..Load::default()
    };
    for load in [bare, liquid] {
        rests(beaker, load);
        rests(erlenmeyer, load);
    }
}

/// Tips about the edge of its base where the centre of mass passes over it.
#[test]
fn falls_over_beyond_the_tipping_angle_only() {
    let (side, base) = (2.0 * HEIGHT, RADIUS);
    let centre = 0.5 * HEIGHT * side / (side + base);
    let tipping = (RADIUS / centre).atan();
    for (fraction, falls) in [(0.9, false), (1.1, true)] {
        let angle = fraction * tipping;
        let lifted = RADIUS * angle.sin() + 1e-3;
        let mut bodies = world(vec![beaker(tilted(above_table(lifted), angle))]);
        run(&mut bodies, 8.0, Load::default());
        let pose = bodies.poses()[0];
        let velocity = bodies.velocity(0).unwrap();
        if falls {
            assert!(axis(pose).y.abs() < 0.01, "does not lie: {}", axis(pose));
            assert!((pose.position.y - TABLE_TOP - RADIUS).abs() < 5e-4);
            assert!(velocity.linear.length() < 1e-2, "still moves: {velocity:?}");
        } else {
            assert!(axis(pose).y > 0.9999, "does not stand: {}", axis(pose));
        }
    }
}

/// Thrown lying, a beaker soon rolls without slipping, and then loses speed at
/// μ_r g / (1 + I/mR²), the textbook's deceleration by a rolling resistance μ_r.
#[test]
fn rolls_without_slipping_and_slows() {
    let lying = Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
    let start = Pose::new(Vec3::new(-1.0, TABLE_TOP + RADIUS + 1e-3, 0.0), lying);
    let mut bodies = world(vec![beaker(start)]);
    for step in 0..10 {
        let moved = start.position + Vec3::X * (0.6 * STEP * step as f32);
        bodies.step(&gripping(Pose::new(moved, lying)), &[]);
    }
    bodies.step(&[Hand::ABSENT, hand(start, 0.0)], &[]);
    run(&mut bodies, 0.5, Load::default());
    // The flask's base lies on its axis, so its velocity is the axle's.
    let before = bodies.velocity(0).unwrap();
    let rim = -before.angular.z * RADIUS;
    assert!(before.linear.x > 0.2, "stopped: {before:?}");
    assert!(
        (before.linear.x - rim).abs() < 0.02 * before.linear.x,
        "slips: {before:?}"
    );
    run(&mut bodies, 0.5, Load::default());
    let slowed = (before.linear.x - bodies.velocity(0).unwrap().linear.x) / 0.5;
    let (side, base) = (2.0 * HEIGHT, RADIUS);
    let inertia = (side + 0.5 * base) / (side + base);
    let expected = 0.01 * G / (1.0 + inertia);
    // rapier's soft contacts brake by 0.01 m/s² of their own (measured with μ_r = 0).
    assert!(
        (0.95..1.25).contains(&(slowed / expected)),
        "slows by {slowed}, not {expected}"
    );
}

#[test]
fn a_dropped_flask_lands_and_does_not_fall_through() {
    for spec in [beaker, erlenmeyer] {
        // Fast enough to pass 40 mm of table in one simulation step.
        let mut bodies = world(vec![spec(above_table(3.0))]);
        run(&mut bodies, 5.0, Load::default());
        let pose = bodies.poses()[0];
        assert!(pose.position.y > TABLE_TOP - 1e-3, "at {}", pose.position);
        assert!(pose.position.y < TABLE_TOP + 0.1, "at {}", pose.position);
    }
}

#[test]
fn same_inputs_give_same_bits_and_a_snapshot_continues_them() {
    let build = || {
        world(vec![
            erlenmeyer(tilted(above_table(0.3), 0.4)),
            beaker(tilted(above_table(0.1), 1.2)),
        ])
    };
    let load = |step: usize| Load {
        impulse: Vec3::new(0.001 * (step % 7) as f32, -0.02, 0.0),
        liquid_mass: 0.2 + 0.001 * (step % 5) as f32,
        liquid_centre: Vec3::new(0.002, 0.03, 0.0),
        ..Load::default()
    };
    let mut uninterrupted = build();
    let mut again = build();
    let mut snapshot = Vec::new();
    for step in 0..240 {
        if step == 17 {
            snapshot = uninterrupted.snapshot().unwrap();
        }
        uninterrupted.step(&NO_HANDS, &[load(step), load(step + 1)]);
        again.step(&NO_HANDS, &[load(step), load(step + 1)]);
    }
    let end = uninterrupted.snapshot().unwrap();
    assert_eq!(end, again.snapshot().unwrap());

    let mut restored = build();
    restored.restore(&snapshot).unwrap();
    for step in 17..240 {
        restored.step(&NO_HANDS, &[load(step), load(step + 1)]);
    }
    assert_eq!(restored.poses(), uninterrupted.poses());
    assert_eq!(end, restored.snapshot().unwrap());

    assert!(restored.restore(&snapshot[..snapshot.len() / 2]).is_err());
    let mut other = world(vec![]);
    assert!(other.restore(&snapshot).is_err());
    assert_eq!(restored.poses(), uninterrupted.poses());
}
