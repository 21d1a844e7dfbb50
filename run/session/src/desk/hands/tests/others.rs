//! Tools, a sash, and input that is none.

use super::*;

/// What a press would act on is known, and nothing of it while the hand holds something.
#[test]
fn what_is_pointed_at_is_known() {
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    for (at, expected) in [
        (at_source(), Some(Pointed::Thing(SOURCE))),
        (at_target(), Some(Pointed::Thing(TARGET))),
        // On the bench between both, and on the panel's middle.
        (Vec3::new(0.0, TABLE, -0.30), None),
        (Vec3::new(0.0, 1.16, -0.80), Some(Pointed::Panel)),
    ] {
        bench.point(at);
        assert_eq!(bench.hands.pointed(), expected, "{at}");
    }
    bench.take();
    assert_eq!(bench.hands.pointed(), None);
    bench.release();
    bench.wait(6.0);
    assert_eq!(bench.hands.pointed(), Some(Pointed::Thing(SOURCE)));
}

/// A rod is dipped through the mouth of a beaker and leaves through it, and a cloth lies on the table as it wipes. Both are put down
/// as they lay.
#[test]
fn tools_dip_and_wipe() {
    for [rod, raises] in [[true, true], [true, false], [false, false]] {
        let mut around = two_flasks();
        let middle = Vec3::new(0.36, TABLE + 0.0035, -0.30);
        around.things.push(if rod {
            lying([0.0035, 0.25], middle, Kind::Rod)
        } else {
            let pose = Pose::new(middle.with_y(TABLE), Quat::IDENTITY);
            thing([0.07, 0.07, 0.02], pose, Kind::Cloth)
        });
        let mut bench = Bench::new(around, RATES[0]);
        bench.point(middle);
        bench.wait(4.0);
        bench.press();
        bench.wait(2.0);
        assert_eq!(bench.around.holds[1], Some(2));
        let foot = |bench: &Bench| bench.around.things[2].pose.position;
        if rod {
            // The pointer drags the held point, which is over the lower end as soon as the rod is upright.
            let held = middle - 0.0625 * Vec3::X;
            let to = Vec3::new(0.12, middle.y, -0.40);
            bench.drag(middle, middle + to - held);
            bench.wait(6.0);
            let away = (foot(&bench) - Vec3::new(0.12, TABLE, -0.40)).with_y(0.0);
            assert!(away.length() < 0.02, "{away}");
            let dips = foot(&bench).y - TABLE;
            assert!((0.005..0.06).contains(&dips), "{dips}");
            // Beyond the wall it stays in the mouth, as low as it was, until it was raised over the rim.
            let aside = middle + to - held + 0.06 * Vec3::X;
            bench.drag(middle + to - held, aside);
            bench.wait(1.0);
            let out = foot(&bench).x - 0.12;
            assert!((0.02..0.0365).contains(&out), "{out}");
            let dips = foot(&bench).y - TABLE;
            assert!((0.005..0.06).contains(&dips), "{dips}");
            if raises {
                bench.controls.raise = 1.0;
                bench.wait(2.0);
                bench.controls.raise = 0.0;
                bench.wait(1.0);
                let out = foot(&bench).x - 0.12;
                assert!((out - 0.06).abs() < 0.005, "{out}");
            }
            // Well beside the glass it rises and leaves by itself.
            bench.drag(aside, middle);
        } else {
            bench.drag(middle, middle - 0.05 * Vec3::Z);
            bench.wait(2.0);
            let over = foot(&bench).y - TABLE;
            assert!((0.0..0.003).contains(&over), "{over}");
        }
        bench.wait(4.0);
        bench.release();
        bench.wait(8.0);
        assert_eq!(bench.around.holds, [None; 2]);
        let rests = foot(&bench).y - TABLE;
        assert!((-1e-3..0.006).contains(&rests), "{rests}");
    }
}

#[test]
fn a_sash_goes_up_and_down() {
    let mut around = two_flasks();
    let bar = Vec3::new(0.0, 1.05, -0.13);
    around.things.push(lying([0.012, 1.1], bar, Kind::Sash));
    let mut bench = Bench::new(around, RATES[0]);
    bench.point(bar);
    bench.wait(4.0);
    bench.press();
    bench.wait(1.0);
    assert_eq!(bench.around.holds[1], Some(2));
    bench.drag(bar, bar - 0.15 * Vec3::Y);
    bench.wait(3.0);
    let height = bench.around.things[2].pose.position.y;
    assert!((height - 0.90).abs() < 0.02, "{height}");
    bench.release();
    bench.wait(2.0);
    assert_eq!(bench.around.holds, [None; 2]);
    assert_eq!(bench.around.things[2].pose.position.y, height);
}

#[test]
fn what_is_no_number_does_no_harm() {
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30];
    let mut bench = Bench::new(two_flasks(), RATES[0]);
    bench.take();
    let good = bench.controls.clone();
    for value in bad {
        let vector = Vec3::splat(value);
        for (dt, ray) in [
            (RATES[0], (vector, Vec3::NEG_Z)),
            (RATES[0], (EYE, vector)),
            (value, (EYE, Vec3::ZERO)),
        ] {
            bench.controls = Controls {
                ray,
                right: vector,
                away: vector,
                pointed: true,
                wheel: f32::NAN,
                tilt_drag: f32::NAN,
                walk: [f32::NAN; 2],
                raise: f32::NAN,
                tilt: f32::NAN,
                ..good.clone()
            };
            bench.dt = dt;
            bench.frame();
        }
    }
    // A thing that broke is nowhere, and a panel may be none.
    bench.around.things[TARGET].pose.position = Vec3::splat(f32::NAN);
    bench.around.panel = (Pose::new(Vec3::splat(f32::NAN), Quat::IDENTITY), [0.0; 2]);
    (bench.controls, bench.dt) = (good, RATES[0]);
    bench.around.things[TARGET].kind = Kind::Cloth;
    bench.wait(1.0);
    bench.release();
    bench.wait(6.0);
    bench.stands(SOURCE);
}
