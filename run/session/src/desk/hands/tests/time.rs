//! Time that is held, another bench, and what changes without the pointer.

use super::*;

#[test]
fn what_comes_while_time_is_held_waits_for_it() {
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    bench.go_to(at_source());
    (bench.controls.press, bench.controls.pressed) = (true, true);
    for _ in 0..200 {
        bench.still();
    }
    bench.wait(1.0);
    assert_eq!(bench.around.holds[1], Some(SOURCE));
    bench.drag(at_source(), at_source() - 0.1 * Vec3::X);
    bench.wait(1.0);
    (bench.controls.release, bench.controls.pressed) = (true, false);
    for _ in 0..200 {
        bench.still();
    }
    bench.wait(5.0);
    bench.stands(SOURCE);
    bench.controls.other = true;
    bench.still();
    assert_eq!(bench.hands.active(), Side::Right);
    bench.frame();
    assert_eq!(bench.hands.active(), Side::Left);
}

/// A key holds a button of the panel, and one that is let go while time is held is let go: the panel's ring fills in display time.
#[test]
fn a_button_of_the_panel_is_held_as_long_as_the_key() {
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    bench.wait(2.0);
    bench.point(Vec3::new(0.1, 1.2, -0.80));
    (bench.controls.panel_press, bench.controls.panel_down) = (true, true);
    bench.wait(1.5);
    assert_eq!(bench.now[1].trigger, 1.0);
    bench.controls.panel_down = false;
    for _ in 0..20 {
        bench.now = bench.hands.advance(&bench.controls, &bench.around, 0.0);
    }
    assert_eq!(bench.now[1].trigger, 0.0);
}

#[test]
fn a_hand_that_is_to_let_go_before_it_holds_does() {
    for toggles in [false, true] {
        let mut bench = Bench::new(two_flasks(), RATES[0]);
        bench.hands = Hands::new(&Pose::new(EYE, Quat::IDENTITY), TABLE).with_toggles(toggles);
        bench.go_to(at_source());
        bench.press();
        // It closes, and it is not known yet what it holds.
        assert_eq!(bench.now[1].squeeze, 1.0);
        let held = bench.around.holds[1].take();
        assert_eq!(held, Some(SOURCE));
        bench.release();
        if toggles {
            bench.click();
        }
        bench.around.holds[1] = held;
        bench.wait(2.0);
        bench.stands(SOURCE);
    }
}

#[test]
fn on_another_bench_the_hands_are_empty_and_at_rest() {
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    bench.frame();
    let rest = bench.now.each_ref().map(|it| it.stage_from_grip.position);
    bench.take();
    bench.around = two_flasks();
    bench.around.scene = 1;
    bench.controls.pressed = false;
    bench.before.clear();
    bench.frame();
    assert_eq!([bench.now[0].squeeze, bench.now[1].squeeze], [0.0; 2]);
    for (hand, rest) in bench.now.iter().zip(rest) {
        let at = hand.stage_from_grip.position;
        assert!(at.distance(rest) < 0.05, "{at}");
    }
    bench.wait(1.0);
    assert_eq!(bench.around.holds, [None; 2]);
}

/// Under a pointer that is still, the bench turns and a flask breaks: what is marked is what is there.
#[test]
fn the_mark_is_on_what_the_pointer_is_at_now() {
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    bench.point(at_source());
    let marked = |bench: &Bench, at: Vec3| {
        let lines = bench.hands.lines();
        lines.len() == 12 && lines.iter().all(|it| it.from.distance(at) < 0.08)
    };
    let foot = |n: usize| two_flasks().things[n].pose.position;
    assert!(marked(&bench, foot(SOURCE)));
    bench.controls.ray = (EYE, (at_target() - EYE).normalize());
    bench.frame();
    assert!(marked(&bench, foot(TARGET)));
    bench.around.things[TARGET].pose.position = Vec3::splat(f32::NAN);
    bench.frame();
    assert!(!marked(&bench, foot(TARGET)));
}

/// The mark of what a press takes comes first, then the pours; of the rings those are left out that come after 40 lines.
#[test]
fn lines_that_are_left_out_are_the_least() {
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    let third = Vec3::new(0.3, TABLE, -0.3);
    let things = &mut bench.around.things;
    things.push(standing([0.03, 0.03, 0.08], third.x, third.z));
    bench.take();
    bench.drag(at_source(), at_source() - 0.05 * Vec3::X);
    bench.wait(1.0);
    bench.tilt(1.0, 1.2);
    bench.controls.other = true;
    bench.release();
    let at_third = third + 0.04 * Vec3::Y;
    bench.go_to(at_third);
    let falls = |line: &vitriol_xr::Line| {
        let way = line.to - line.from;
        way.with_y(0.0).length() < 1e-6 && way.y < 0.0
    };
    let lines = bench.hands.lines();
    let mark = lines[..12].iter().all(|it| it.from.distance(third) < 0.04);
    assert!(mark && falls(&lines[12]), "{lines:?}");
    bench.press();
    bench.wait(1.0);
    assert_eq!(bench.around.holds, [Some(2), Some(SOURCE)]);
    bench.drag(at_third, at_third + 0.05 * Vec3::X);
    bench.wait(2.0);
    bench.tilt(1.0, 1.2);
    let lines = bench.hands.lines();
    assert_eq!(lines.len(), 40);
    assert!(falls(&lines[0]) && falls(&lines[1]), "{lines:?}");
}

/// A tilt by the mouse leaves the pointer elsewhere: what it drags goes on from where it is.
#[test]
fn nothing_leaps_after_a_tilt_by_the_mouse() {
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    bench.take();
    let there = at_source() - 0.05 * Vec3::X;
    bench.drag(at_source(), there);
    bench.wait(2.0);
    bench.controls.tilt_drag = 0.5;
    bench.frame();
    bench.wait(2.0);
    let held = bench.around.things[SOURCE]
        .pose
        .transform_point(0.05 * Vec3::Y);
    // 0.2 m beside the place that it was dragged to.
    let leapt = there + 0.2 * Vec3::Z;
    bench.point(leapt);
    bench.wait(1.0);
    let now = bench.around.things[SOURCE]
        .pose
        .transform_point(0.05 * Vec3::Y);
    assert!(now.distance(held) < 0.005, "{held} {now}");
    bench.drag(leapt, leapt + 0.05 * Vec3::Z);
    bench.wait(2.0);
    let way = bench.around.things[SOURCE]
        .pose
        .transform_point(0.05 * Vec3::Y)
        - now;
    assert!((way.z - 0.05).abs() < 0.01, "{way}");
}
