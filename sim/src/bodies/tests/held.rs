//! Flasks in hands.

use super::*;

/// A pose that wanders and turns, at `t` seconds.
fn wander(t: f32) -> Pose {
    Pose::new(
        Vec3::new(
            0.1 + 0.2 * t.sin(),
            TABLE_TOP + 0.3 + 0.1 * (3.0 * t).cos(),
            -0.2 + 0.1 * t,
        ),
        Quat::from_rotation_y(2.0 * t) * Quat::from_rotation_x(t.sin()),
    )
}

/// Follows a hand exactly: f32 round-off of two rotations at 1 m.
fn assert_follows(found: Pose, stage_from_grip: Pose, grip_from_flask: Pose) {
    let expected = stage_from_grip.compose(grip_from_flask);
    assert!((found.position - expected.position).length() < 1e-6);
    assert!(found.orientation.dot(expected.orientation).abs() > 1.0 - 1e-6);
}

#[test]
fn a_gripped_flask_follows_the_hand() {
    let grip = wander(0.0);
    let start = Pose::new(grip.position - Vec3::Y * 0.05, Quat::from_rotation_z(0.3));
    let mut bodies = world(vec![beaker(start)]);
    let grip_from_flask = grip.inverse().compose(start);
    for step in 0..200 {
        let grip = wander(step as f32 * STEP);
        bodies.step(
            &gripping(grip),
            &[Load {
                impulse: Vec3::new(0.0, -5.0, 3.0),
                ..Load::default()
            }],
        );
        assert_eq!(bodies.holder(0), Some(1));
        assert_follows(bodies.poses()[0], grip, grip_from_flask);
    }
}

/// Through the table and back at 50 m/s, beside a flask that stands.
#[test]
fn a_shaken_flask_follows_the_hand_and_strikes_nothing_from_afar() {
    let start = above_table(0.3);
    let bystander = above_table(0.0);
    let mut bodies = world(vec![
        beaker(start),
        beaker(Pose::from_position(bystander.position + Vec3::X * 0.5)),
    ]);
    bodies.step(&gripping(start), &[]);
    for step in 1..200 {
        let along = if step % 2 == 0 { 0.0 } else { -50.0 * STEP };
        let grip = Pose::new(
            start.position + Vec3::Y * along,
            Quat::from_rotation_x(along),
        );
        bodies.step(&gripping(grip), &[]);
        assert_follows(bodies.poses()[0], grip, Pose::IDENTITY);
        assert!((bodies.poses()[1].position.y - TABLE_TOP).abs() < 1e-4);
    }
}

/// A tracker that leaps past a flask does not strike it.
#[test]
fn a_leap_strikes_nothing_on_its_way() {
    let start = above_table(0.0);
    let at = |x: f32| Pose::from_position(start.position + Vec3::X * x);
    let mut bodies = world(vec![beaker(start), beaker(at(0.25))]);
    bodies.step(&gripping(start), &[]);
    for step in 1..60 {
        let leapt = at(if step % 2 == 0 { 0.0 } else { 0.5 });
        bodies.step(&gripping(leapt), &[]);
    }
    assert!((bodies.poses()[1].position - at(0.25).position).length() < 1e-4);
}

#[test]
fn only_a_closing_hand_within_reach_takes_hold() {
    let start = above_table(0.0);
    let beside =
        |gap: f32| Pose::from_position(start.position + Vec3::new(RADIUS + gap, 0.04, 0.0));
    let mut bodies = world(vec![beaker(start)]);
    bodies.step(&gripping(beside(0.051)), &[]);
    assert_eq!(bodies.holder(0), None);
    // A fist that comes near has not closed there.
    bodies.step(&gripping(beside(0.01)), &[]);
    assert_eq!(bodies.holder(0), None);
    let squeeze = |bodies: &mut Bodies, squeeze| {
        bodies.step(&[hand(beside(0.049), squeeze), Hand::ABSENT], &[]);
        bodies.holder(0)
    };
    assert_eq!(squeeze(&mut bodies, 0.5), None);
    assert_eq!(squeeze(&mut bodies, 0.7), Some(0));
    assert_eq!(squeeze(&mut bodies, 0.5), Some(0));
    assert_eq!(squeeze(&mut bodies, f32::NAN), Some(0));
    assert_eq!(squeeze(&mut bodies, 0.3), None);
    assert_eq!(squeeze(&mut bodies, 0.5), None);

    let clamped = BodySpec {
        fixed: true,
        ..beaker(above_table(0.2))
    };
    let mut bodies = world(vec![clamped, beaker(above_table(0.0))]);
    bodies.step(&gripping(above_table(0.2)), &[]);
    run(&mut bodies, 1.0, Load::default());
    assert_eq!(bodies.holder(0), None);
    assert_eq!(bodies.poses()[0], above_table(0.2));
}

#[test]
fn takes_the_nearer_of_two() {
    let (a, b) = (
        above_table(0.0),
        Pose::from_position(above_table(0.0).position + Vec3::X * 0.1),
    );
    for (offset, nearer) in [(0.045, 0), (0.055, 1)] {
        let mut bodies = world(vec![beaker(a), beaker(b)]);
        bodies.step(
            &gripping(Pose::from_position(
                a.position + Vec3::new(offset, 0.05, 0.0),
            )),
            &[],
        );
        assert_eq!(bodies.holder(nearer), Some(1));
        assert_eq!(bodies.holder(1 - nearer), None);
    }
}

/// Let go in motion, the centre of mass flies a parabola and the spin stays.
#[test]
fn a_thrown_flask_flies_a_parabola() {
    let start = above_table(0.5);
    let mut bodies = world(vec![beaker(start)]);
    let (velocity, spin) = (Vec3::new(0.8, 1.1, -0.4), Vec3::new(0.0, 3.0, 0.0));
    let held = |t: f32| {
        Pose::new(
            start.position + velocity * t,
            Quat::from_scaled_axis(spin * t),
        )
    };
    for step in 0..20 {
        bodies.step(&gripping(held(step as f32 * STEP)), &[]);
    }
    let released = held(19.0 * STEP);
    let open = [Hand::ABSENT, hand(released, 0.0)];
    for step in 1..=30 {
        bodies.step(&open, &[]);
        let t = step as f32 * STEP;
        let euler = 0.5 * G * t * (t + STEP / 16.0);
        let expected = released.position + velocity * t - Vec3::Y * euler;
        // The poses' f32 round-off (1e-7 m) over Δt makes 1e-5 m/s of velocity.
        let error = (bodies.poses()[0].position - expected).length();
        assert!(error < 5e-5, "step {step}: {error} m beside the parabola");
    }
    let found = bodies.velocity(0).unwrap();
    assert!((found.angular - spin).length() < 1e-3, "{found:?}");
}

/// A flask that is let go during a tracker's jerk does not fly off faster than a throw.
#[test]
fn release_velocity_is_limited() {
    let start = above_table(0.5);
    let mut bodies = world(vec![beaker(start)]);
    bodies.step(&gripping(start), &[]);
    // 18 m/s, less than a leap.
    let leapt = Pose::new(start.position + Vec3::Y * 0.2, Quat::from_rotation_x(3.0));
    bodies.step(&gripping(leapt), &[]);
    bodies.step(&[Hand::ABSENT, hand(leapt, 0.0)], &[]);
    let velocity = bodies.velocity(0).unwrap();
    assert!(velocity.angular.length() < RELEASE_SPIN_MAX * 1.001);
    // The base circles the centre of mass, at most at the flask's height.
    assert!(velocity.linear.length() < RELEASE_SPEED_MAX + RELEASE_SPIN_MAX * HEIGHT);
}

/// After a leap a flask moves as before it, seen from the hand, without a step at rest.
#[test]
fn a_leap_takes_no_time() {
    let start = above_table(0.5);
    let (velocity, spin) = (Vec3::new(0.6, 0.2, 0.0), Vec3::new(0.0, 3.0, 1.0));
    let carried = |t: f32| {
        let turned = Quat::from_scaled_axis(spin * t);
        Pose::new(start.position + velocity * t, turned)
    };
    let far = Pose::new(Vec3::new(2.0, 0.1, -1.0), Quat::from_rotation_y(2.0));
    let near = Pose::new(Vec3::new(0.05, 0.0, 0.0), Quat::from_rotation_y(0.1));
    for (asked, there) in [(true, near), (true, far), (false, far)] {
        let mut bodies = world(vec![beaker(start)]);
        for step in 0..10 {
            bodies.step(&gripping(carried(step as f32 * STEP)), &[]);
            assert_eq!(bodies.leaps(), []);
        }
        if asked {
            bodies.hands_leap();
        }
        for step in 10..12 {
            let before = bodies.poses()[0];
            let grip = there.compose(carried(step as f32 * STEP));
            bodies.step(&gripping(grip), &[]);
            assert_eq!(bodies.holder(0), Some(1));
            assert_follows(bodies.poses()[0], grip, Pose::IDENTITY);
            // Round-off of the poses over a step.
            let found = bodies.velocity(0).unwrap();
            let linear = found.linear - there.transform_vector(velocity);
            let angular = found.angular - there.transform_vector(spin);
            assert!(
                linear.length() < 1e-3 && angular.length() < 1e-3,
                "{found:?}"
            );
            if step == 10 {
                let [leap] = bodies.leaps() else {
                    panic!("{:?}", bodies.leaps())
                };
                let expected = there.compose(before);
                assert_follows(
                    leap.after_from_before.compose(before),
                    expected,
                    Pose::IDENTITY,
                );
            } else {
                assert_eq!(bodies.leaps(), []);
            }
        }
    }
}

/// A hand that is not tracked for a while leaves the body that it holds where it is, and still holds it when it is tracked again.
#[test]
fn a_hand_that_comes_back_leaps() {
    let start = above_table(0.5);
    let mut bodies = world(vec![beaker(start)]);
    bodies.step(&gripping(start), &[]);
    for _ in 0..3 {
        bodies.step(&NO_HANDS, &[]);
        assert_eq!((bodies.poses()[0], bodies.leaps()), (start, &[][..]));
    }
    // 1.8 m/s, were it followed.
    let there = above_table(0.52);
    bodies.step(&gripping(there), &[]);
    assert_follows(bodies.poses()[0], there, Pose::IDENTITY);
    assert_eq!(bodies.leaps().len(), 1);
    assert_eq!(bodies.velocity(0).unwrap().linear, Vec3::ZERO);
    // One that closes when it comes takes hold, and nothing leaps.
    let mut bodies = world(vec![beaker(start)]);
    bodies.step(&NO_HANDS, &[]);
    bodies.step(&gripping(start), &[]);
    assert_eq!((bodies.holder(0), bodies.leaps()), (Some(1), &[][..]));
}

/// Recentred, a held flask strikes nothing that stands between, however near.
#[test]
fn a_short_leap_strikes_nothing_either() {
    let start = above_table(0.0);
    let at = |x: f32| Pose::from_position(start.position + Vec3::X * x);
    let mut bodies = world(vec![beaker(start), beaker(at(0.1))]);
    bodies.step(&gripping(start), &[]);
    // 18 m/s would be no leap by itself.
    bodies.hands_leap();
    bodies.step(&gripping(at(0.2)), &[]);
    for _ in 0..30 {
        bodies.step(&gripping(at(0.2)), &[]);
    }
    assert!((bodies.poses()[1].position - at(0.1).position).length() < 1e-4);
}

#[test]
fn a_flask_changes_hands() {
    let start = above_table(0.3);
    let mut bodies = world(vec![beaker(start)]);
    let left = |x: f32, squeeze| hand(Pose::from_position(start.position + Vec3::X * x), squeeze);
    let right = |y: f32, squeeze| hand(Pose::from_position(start.position + Vec3::Y * y), squeeze);
    bodies.step(&[left(0.0, 1.0), right(0.05, 0.0)], &[]);
    assert_eq!(bodies.holder(0), Some(0));
    bodies.step(&[left(0.0, 1.0), right(0.05, 1.0)], &[]);
    assert_eq!(bodies.holder(0), Some(1));
    // The former hand goes away, still closed, and then opens: the flask is not affected.
    for (x, squeeze) in [(0.3, 1.0), (0.4, 0.0)] {
        bodies.step(&[left(x, squeeze), right(0.15, 1.0)], &[]);
        assert_eq!(bodies.holder(0), Some(1));
        assert_follows(
            bodies.poses()[0],
            right(0.15, 1.0).stage_from_grip,
            Pose::from_position(Vec3::Y * -0.05),
        );
    }
}

#[test]
fn a_hand_that_is_lost_or_invalid_holds_on_where_it_was() {
    let start = above_table(0.3);
    let mut bodies = world(vec![beaker(start)]);
    bodies.step(&gripping(start), &[]);
    let nan = Pose::from_position(Vec3::new(0.0, f32::NAN, 0.0));
    let lost = [
        Hand {
            present: false,
            ..hand(above_table(0.6), 0.0)
        },
        hand(nan, 0.0),
        hand(
            Pose::new(start.position, Quat::from_xyzw(0.0, 0.0, 0.0, 3.0)),
            0.0,
        ),
    ];
    for gap in lost {
        bodies.step(&[Hand::ABSENT, gap], &[]);
        assert_eq!(bodies.holder(0), Some(1));
        assert_follows(bodies.poses()[0], start, Pose::IDENTITY);
    }
    bodies.step(&gripping(above_table(0.31)), &[]);
    assert_follows(bodies.poses()[0], above_table(0.31), Pose::IDENTITY);
}

/// A held flask pushed against one that stands moves it, and the two never overlap.
#[test]
fn a_flask_pushes_another_without_entering_it() {
    let start = Pose::from_position(Vec3::new(0.0, TABLE_TOP, 0.0));
    let other = Pose::from_position(Vec3::new(0.1, TABLE_TOP, 0.0));
    let mut bodies = world(vec![beaker(start), beaker(other)]);
    for step in 0..180 {
        let x = 0.1 * STEP * step as f32;
        bodies.step(
            &gripping(Pose::from_position(start.position + Vec3::X * x)),
            &[],
        );
        let gap = bodies.poses()[1].position.x - bodies.poses()[0].position.x - 2.0 * RADIUS;
        assert!(gap > -5e-4, "step {step}: {gap} m");
    }
    let pushed = bodies.poses()[1];
    assert!(pushed.position.x > 0.2 + RADIUS);
    assert!(axis(pushed).y > 0.99);
}
