//! Goggles and gloves, and a swirl.

use super::*;

/// With goggles in place of the target flask.
fn with_goggles(dt: f32) -> (Bench, Vec3) {
    let mut around = two_flasks();
    let at = Vec3::new(0.25, TABLE, -0.30);
    let pose = Pose::new(at, Quat::IDENTITY);
    let sizes = [0.075, 0.075, 0.06];
    around.things[TARGET] = thing(sizes, pose, Kind::Goggles);
    (Bench::new(around, dt), at)
}

fn is_worn(bench: &Bench) -> bool {
    !bench.around.things[TARGET].grips && bench.around.holds == [None; 2]
}

#[test]
fn a_click_or_two_keys_put_goggles_on() {
    for dt in RATES {
        for keys in [false, true] {
            let (mut bench, at) = with_goggles(dt);
            bench.point(at);
            if keys {
                bench.grip();
                bench.wait(3.0);
                assert_eq!(bench.around.holds[1], Some(TARGET));
                bench.grip();
            } else {
                // The hand is not there yet.
                bench.click();
            }
            bench.wait(8.0);
            assert!(is_worn(&bench), "{:?}", bench.around.things[TARGET]);
        }
    }
}

/// Where clicks toggle, one click still puts them on, wherever the pointer goes meanwhile.
#[test]
fn one_click_puts_goggles_on_where_clicks_toggle() {
    let (mut bench, at) = with_goggles(RATES[0]);
    bench.hands = Hands::new(&Pose::new(EYE, Quat::IDENTITY), TABLE).with_toggles(true);
    bench.point(at);
    bench.click();
    bench.point(at - 0.05 * Vec3::X);
    bench.wait(8.0);
    assert!(is_worn(&bench), "{:?}", bench.around.things[TARGET]);
}

#[test]
fn goggles_that_are_dragged_are_put_down() {
    let (mut bench, at) = with_goggles(RATES[0]);
    bench.take_at(at);
    bench.drag(at, at - 0.08 * Vec3::Z);
    bench.wait(2.0);
    bench.release();
    bench.wait(6.0);
    assert!(!is_worn(&bench));
    bench.stands(TARGET);
}

/// With a box of gloves beside the flasks, its index, and its middle.
fn with_a_box() -> (Around, usize, Vec3) {
    let mut around = two_flasks();
    let pose = Pose::new(Vec3::new(0.30, TABLE, -0.20), Quat::IDENTITY);
    let it = thing([0.08, 0.08, 0.09], pose, Kind::Gloves);
    around.things.push(it);
    let last = around.things.len() - 1;
    (around, last, pose.position + 0.045 * Vec3::Y)
}

/// `Tab` is for the second glove alone: then the pointer takes the target with the hand beside which its pour falls, as it would without.
#[test]
fn gloves_leave_the_choice_of_the_hand_as_it_was() {
    let (around, glove_box, at) = with_a_box();
    let mut bench = Bench::new(around, RATES[0]);
    bench.hands = Hands::new(&Pose::new(EYE, Quat::IDENTITY), TABLE).with_choice();
    for side in [Side::Right, Side::Left] {
        bench.controls.other = side == Side::Left;
        bench.take_at(at);
        assert_eq!(bench.around.holds[side as usize], Some(glove_box));
        bench.release();
        bench.wait(4.0);
        assert_eq!(bench.around.holds, [None; 2]);
    }
    assert_eq!(bench.hands.active(), Side::Left);
    bench.take_at(at_target());
    assert_eq!(bench.around.holds, [None, Some(TARGET)]);
}

/// The box of gloves is no use to a hand that wears one, and is to the other one.
#[test]
fn a_hand_with_a_glove_does_not_go_to_the_box() {
    let (mut around, glove_box, at) = with_a_box();
    around.gloves = [false, true];
    let mut bench = Bench::new(around, RATES[0]);
    for (side, expected) in [
        (Side::Right, None),
        (Side::Left, Some(Pointed::Thing(glove_box))),
    ] {
        bench.controls.other = side == Side::Left;
        bench.point(at);
        assert_eq!(bench.hands.active(), side);
        assert_eq!(bench.hands.pointed(), expected);
    }
}

/// Pulled off by key, and by a click on the glove, also from a hand that is at a flask.
#[test]
fn gloves_are_pulled_off() {
    for dt in RATES {
        for [clicks, at_flask] in [[false, false], [true, false], [false, true]] {
            let mut bench = Bench::new(two_flasks(), dt);
            bench.around.gloves = [true; 2];
            if at_flask {
                bench.controls.other = true;
                bench.go_to(at_source());
                bench.controls.other = true;
            }
            bench.frame();
            assert_eq!(bench.hands.active(), Side::Right);
            let palm = bench.now[0].stage_from_grip.position;
            if clicks {
                bench.point(palm);
                let glove = Pointed::Glove(Side::Left);
                assert_eq!(bench.hands.pointed(), Some(glove));
                let marks = bench.hands.lines();
                let wrist = palm + 0.095 * Vec3::Z;
                assert_eq!(marks.len(), 12);
                let on_ring =
                    |it: &vitriol_xr::Line| (it.from.distance(wrist) - 0.045).abs() < 1e-3;
                assert!(marks.iter().all(on_ring), "{marks:?}");
                bench.click();
            } else {
                bench.controls.gloves = true;
                bench.frame();
            }
            bench.wait(8.0);
            assert_eq!(bench.around.gloves, [false, true]);
            assert_eq!(bench.around.holds, [None; 2]);
            assert_eq!([bench.now[0].squeeze, bench.now[1].squeeze], [0.0; 2]);
        }
    }
}

/// The circle of the track `layer-and-swirl`: 20 mm, 2.5 turns a second; and the flask is put down where it was.
#[test]
fn a_held_flask_is_swirled() {
    let mut bench = Bench::new(two_flasks(), 1.0 / 90.0);
    // The circle alone: 0.31 m/s and 4.93 m/s², and as it opens up to 1 m/s² more.
    bench.limits = [0.63 + 0.33, 3.15 + 6.0];
    bench.take();
    bench.controls.swirl = true;
    bench.wait(2.0);
    let mut places = Vec::new();
    for _ in 0..72 {
        bench.frame();
        places.push(bench.around.things[SOURCE].pose.position);
        assert!(bench.up(SOURCE).y > 0.9999);
    }
    let middle = places.iter().sum::<Vec3>() / 72.0;
    let start = two_flasks().things[SOURCE].pose.position;
    assert!((middle - start).with_y(0.0).length() < 0.003, "{middle}");
    assert!(middle.y > TABLE + 0.005, "{middle}");
    let mut turned = 0.0;
    for pair in places.windows(2) {
        let [a, b] = [pair[0] - middle, pair[1] - middle];
        assert!((b.length() - 0.02).abs() < 0.003, "{}", b.length());
        turned += a.angle_between(b);
    }
    // 71 frames of a ninetieth of a second, of two turns.
    let turns = turned / TAU;
    assert!((turns - 2.5 * 71.0 / 90.0).abs() < 0.1, "{turns}");
    bench.controls.swirl = false;
    bench.wait(1.0);
    bench.release();
    bench.wait(4.0);
    bench.stands(SOURCE);
    let back = bench.around.things[SOURCE].pose.position;
    assert!((back - start).length() < 0.005, "{back}");
}
