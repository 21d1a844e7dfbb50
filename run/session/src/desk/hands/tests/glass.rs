//! Flasks are carried, poured from and put down.

use super::*;

#[test]
fn a_beginner_pours_and_breaks_nothing() {
    for dt in RATES {
        let mut bench = Bench::new(two_flasks(), dt);
        bench.take();
        let over = at_target() - 0.03 * Vec3::X;
        bench.drag(at_source(), over);
        bench.wait(3.0);
        let held = bench.around.things[SOURCE].pose.position;
        assert!((held.x - over.x).abs() < 0.005, "{held}");
        assert!(held.y > TABLE + 0.110, "{held}");
        bench.tilt(-1.0, 1.6);
        let up = bench.up(SOURCE);
        assert!(up.x > 0.9, "tilted to the right: {up}");
        let lines = bench.hands.lines();
        let down = |line: &&vitriol_xr::Line| {
            let way = line.to - line.from;
            way.x == 0.0 && way.z == 0.0 && way.y < -0.01
        };
        assert_eq!(lines.iter().filter(down).count(), 1, "the pour's line");
        bench.tilt(1.0, 2.0);
        bench.drag(over, at_source());
        bench.wait(2.0);
        bench.release();
        bench.wait(8.0);
        bench.stands(SOURCE);
        assert_eq!(bench.now[1].squeeze, 0.0);
        let back = bench.around.things[SOURCE].pose.position;
        let start = two_flasks().things[SOURCE].pose.position;
        assert!(back.distance(start) < 0.01, "{back}");
    }
}

#[test]
fn a_flask_is_not_put_down_on_glass() {
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    bench.take();
    bench.drag(at_source(), at_target());
    bench.wait(2.0);
    bench.release();
    bench.wait(6.0);
    assert_eq!(bench.around.holds[1], Some(SOURCE));
    // Held there it stays, wherever the pointer goes, until it is dragged away.
    let there = bench.around.things[SOURCE].pose.position;
    bench.drag(at_target(), at_source());
    bench.wait(1.0);
    let still = bench.around.things[SOURCE].pose.position;
    assert!(still.distance(there) < 0.002, "{still}");
    bench.point(at_target());
    bench.press();
    bench.drag(at_target(), at_target() + 0.15 * Vec3::X);
    bench.wait(2.0);
    bench.release();
    bench.wait(6.0);
    bench.stands(SOURCE);
}

#[test]
fn the_other_hand_leaves_the_first_its_flask() {
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    bench.take();
    bench.controls.other = true;
    bench.frame();
    assert_eq!(bench.hands.active(), Side::Left);
    bench.release();
    bench.wait(1.0);
    bench.take_at(at_target());
    assert_eq!(bench.around.holds, [Some(TARGET), Some(SOURCE)]);
    // It was steadied where it stands.
    let start = two_flasks().things[SOURCE].pose.position;
    assert!(bench.around.things[SOURCE].pose.position.distance(start) < 1e-3);
    bench.release();
    bench.wait(2.0);
    assert_eq!(bench.around.holds, [None, Some(SOURCE)]);
    bench.stands(TARGET);
}

#[test]
fn a_click_on_the_panel_pulls_a_trigger_and_grips_nothing() {
    for dt in RATES {
        let mut bench = Bench::new(two_flasks(), dt);
        bench.go_to(at_source());
        let button = Vec3::new(0.1, 1.2, -0.80);
        bench.point(button);
        bench.press();
        bench.controls.release = true;
        bench.release();
        let ray = (button - EYE).normalize();
        let mut pulled = Vec::new();
        for _ in 0..(5.0 / bench.counts) as usize {
            bench.frame();
            pulled.push(bench.now[1].trigger);
            assert_eq!([bench.now[0].trigger, bench.now[1].squeeze], [0.0; 2]);
            assert_eq!(bench.around.holds, [None; 2]);
            let along = bench.now[1].stage_from_aim.orientation * Vec3::NEG_Z;
            assert!(along.dot(ray) > 0.99999);
        }
        let pulls = pulled.iter().filter(|it| **it == 1.0).count();
        assert!(pulls >= 3, "{pulls} frames");
        // It pointed before it pulled, and it has let go.
        assert_eq!([pulled[0], *pulled.last().unwrap()], [0.0; 2]);
        assert_eq!(bench.around.holds, [None; 2]);
    }
}

/// A hand that holds something presses, and keeps what it holds; put down while the button is pressed, that is let go.
#[test]
fn a_click_on_the_panel_counts_with_both_hands_full() {
    for dt in RATES {
        let mut bench = Bench::new(two_flasks(), dt);
        for at in [at_source(), at_target()] {
            bench.go_to(at);
            bench.grip();
            bench.wait(1.0);
            bench.controls.other = at == at_source();
            bench.frame();
        }
        let full = [Some(TARGET), Some(SOURCE)];
        assert_eq!(bench.around.holds, full);
        bench.point(Vec3::new(0.1, 1.2, -0.80));
        bench.click();
        let mut pulled = Vec::new();
        for _ in 0..(2.0 / bench.counts) as usize {
            bench.frame();
            pulled.push(bench.now[0].trigger);
            assert_eq!(bench.now[1].trigger, 0.0);
            assert_eq!(bench.around.holds, full);
        }
        let pulls = pulled.iter().filter(|it| **it == 1.0).count();
        assert!(pulls >= 3, "{pulls} frames");
        assert_eq!(*pulled.last().unwrap(), 0.0);
        for (was, is) in two_flasks().things.iter().zip(&bench.around.things) {
            let moved = was.pose.position.distance(is.pose.position);
            assert!(moved < 1e-3, "{moved}");
        }
        (bench.controls.panel_press, bench.controls.panel_down) = (true, true);
        bench.wait(1.0);
        assert_eq!(bench.now[0].trigger, 1.0);
        bench.controls.grip = true;
        bench.wait(2.0);
        assert_eq!(bench.around.holds, [None, Some(SOURCE)]);
        bench.stands(TARGET);
    }
}

#[test]
fn keys_alone_pour() {
    for dt in RATES {
        let mut bench = Bench::new(two_flasks(), dt);
        let walk = |bench: &mut Bench, right: f32, seconds: f32| {
            bench.controls.walk = [right, 0.0];
            bench.wait(seconds);
            bench.controls.walk = [0.0; 2];
            bench.wait(0.5);
        };
        // From the middle of the bench: 12 cm at 0.25 m/s.
        walk(&mut bench, -1.0, 0.48);
        bench.wait(3.0);
        bench.grip();
        bench.wait(2.0);
        assert_eq!(bench.around.holds, [None, Some(SOURCE)]);
        walk(&mut bench, 1.0, 2.0);
        bench.tilt(-1.0, 1.6);
        assert!(bench.up(SOURCE).x > 0.8, "{}", bench.up(SOURCE));
        bench.tilt(1.0, 2.0);
        walk(&mut bench, -1.0, 2.0);
        bench.grip();
        bench.wait(8.0);
        bench.stands(SOURCE);
    }
}

/// The pointer takes each flask with the hand that is above the lip as it is poured into the other one, since liquid falls. After `Tab` the
/// user's hand takes one thing.
#[test]
fn the_hand_beside_which_a_pour_falls_takes_a_flask() {
    for (thing, at, side, way) in [
        (SOURCE, at_source(), Side::Left, -1.0),
        (TARGET, at_target(), Side::Right, 1.0),
    ] {
        let mut bench = Bench::new(two_flasks(), RATES[0]);
        bench.hands = Hands::new(&Pose::new(EYE, Quat::IDENTITY), TABLE).with_choice();
        bench.take_at(at);
        assert_eq!(bench.around.holds[side as usize], Some(thing));
        bench.controls.wheel = 5.0;
        bench.wait(2.0);
        bench.tilt(way, 1.6);
        let it = &bench.around.things[thing];
        let lip = it
            .pose
            .transform_point(Vec3::new(-way * it.rim, it.height, 0.0));
        let palm = bench.now[side as usize].stage_from_grip.position;
        assert!(palm.y > lip.y + 0.02, "{side:?}: {palm} {lip}");
    }
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    bench.hands = Hands::new(&Pose::new(EYE, Quat::IDENTITY), TABLE).with_choice();
    bench.controls.other = true;
    bench.take_at(at_target());
    assert_eq!(bench.around.holds, [Some(TARGET), None]);
    bench.release();
    bench.wait(6.0);
    bench.stands(TARGET);
    bench.take_at(at_target());
    assert_eq!(bench.around.holds, [None, Some(TARGET)]);
}

/// Tilted with its lip lower than the other's rim, it comes over that by keys that are only tapped.
#[test]
fn taps_bring_a_tilted_flask_over_a_rim() {
    let mut bench = Bench::new(two_flasks(), 0.1);
    bench.take();
    bench.drag(at_source(), at_source() + 0.12 * Vec3::X);
    bench.wait(2.0);
    bench.tilt(-1.0, 0.8);
    assert!(bench.up(SOURCE).x > 0.5, "{}", bench.up(SOURCE));
    bench.controls.slow = true;
    let lip = |bench: &Bench| {
        let it = &bench.around.things[SOURCE];
        let at = it.pose.transform_point(Vec3::new(it.rim, it.height, 0.0));
        at.x - bench.around.things[TARGET].pose.position.x
    };
    assert!(lip(&bench) < -0.04, "{}", lip(&bench));
    // Each tap is a frame, and 6 mm at most.
    let taps = (0..60).find(|_| {
        bench.controls.walk = [1.0, 0.0];
        bench.frame();
        bench.controls.walk = [0.0; 2];
        bench.wait(0.3);
        lip(&bench) > -0.015
    });
    assert!(taps.is_some(), "{} m", lip(&bench));
}

#[test]
fn clicks_take_and_put_down_where_they_toggle() {
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    bench.hands = Hands::new(&Pose::new(EYE, Quat::IDENTITY), TABLE).with_toggles(true);
    bench.go_to(at_source());
    bench.click();
    bench.wait(1.0);
    assert_eq!(bench.around.holds[1], Some(SOURCE));
    bench.drag(at_source(), at_source() - 0.1 * Vec3::X);
    bench.wait(2.0);
    bench.press();
    bench.wait(5.0);
    bench.stands(SOURCE);
    bench.release();
    let x = bench.around.things[SOURCE].pose.position.x;
    assert!((x + 0.22).abs() < 0.005, "{x}");
}
