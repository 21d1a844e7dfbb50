//! The built-in tracks do what their comments derive: the flask, carried rigidly by the grip,
//! stands where it is lifted, pours over the mouth of the other vessel and touches nothing.

use crate::track::convert;
use glam::{Quat, Vec2, Vec3};
use vitriol_xr::track::{Existing, Track, builtin, load};
use vitriol_xr::{Pose, Side};

const TABLE: f32 = 0.75;
/// Outer radius and height of the flask that is poured from, m.
const FLASK: (f32, f32) = (0.036, 0.095);
/// Outer radius, inner radius and height of the beaker that is poured into, m.
const BEAKER: (f32, f32, f32) = (0.040, 0.038, 0.110);
/// Rounding of f32 products of metres.
const NEAR: f32 = 2e-6;

/// The flask's poses while the hand squeezes: grasped where it stands, upright on the table
/// at `base_x`, it follows the grip rigidly.
fn carried(track: &Track, side: Side, base_x: f32) -> Vec<(f64, Pose)> {
    let standing = Pose::new(Vec3::new(base_x, TABLE, -0.40), Quat::IDENTITY);
    let mut grip_from_flask = None;
    track
        .frames
        .iter()
        .filter(|frame| frame.hand(side).squeeze > 0.5)
        .map(|frame| {
            let grip = frame.hand(side).stage_from_grip;
            let held = grip_from_flask.get_or_insert_with(|| grip.inverse().compose(&standing));
            (frame.time_ns as f64 * 1e-9, grip.compose(held))
        })
        .collect()
}

/// How far the flask is tilted from upright, degrees.
fn tilt(flask: &Pose) -> f32 {
    (flask.orientation * Vec3::Y)
        .y
        .clamp(-1.0, 1.0)
        .acos()
        .to_degrees()
}

/// Checks a pour from a flask at `base_x` into a beaker at `into_x`. `towards` is the sign of
/// the way in x.
fn pours(track: &Track, side: Side, base_x: f32, into_x: f32) -> f64 {
    let towards = (into_x - base_x).signum();
    let path = carried(track, side, base_x);
    let (_, first) = &path[0];
    let (_, last) = path.last().unwrap();
    for end in [first, last] {
        let base = end.position - Vec3::new(base_x, TABLE, -0.40);
        assert!(
            base.length() < NEAR,
            "taken from and put back to its place: {base}"
        );
        assert!(tilt(end) < 0.1);
    }
    // The grip is at the flask's side, 5 to 6 cm up.
    let grasp = track
        .frames
        .iter()
        .find(|f| f.hand(side).squeeze > 0.5)
        .unwrap();
    let grip = first
        .inverse()
        .transform_point(grasp.hand(side).stage_from_grip.position);
    assert!((grip.x.hypot(grip.z) - FLASK.0).abs() < NEAR, "{grip}");
    assert!((0.05..=0.06).contains(&grip.y), "{grip}");

    let rim = TABLE + BEAKER.2;
    let lip_of_flask = Vec3::new(towards * FLASK.0, FLASK.1, 0.0);
    let (mut most, mut drained) = (0.0f32, 0.0);
    let mut before: Option<f64> = None;
    for (t, flask) in &path {
        let dt = before.map_or(0.0, |before| t - before);
        before = Some(*t);
        let tilt = tilt(flask);
        most = most.max(tilt);
        // It tilts towards the beaker, about the line of sight only.
        let axis = flask.orientation * Vec3::Y;
        assert!(axis.z.abs() < NEAR && axis.x * towards > -NEAR, "{axis}");
        assert!(flask.position.y > TABLE - NEAR);

        // The cut in the plane of the tilt, mirrored so that the beaker is to the right, and
        // the origin in the middle of its mouth. The flask's outline is a rectangle, the
        // beaker's as well; that the flask's front wall and bottom keep off the beaker's near
        // rim is that this rim lies on the outer side of one of both.
        let near_rim = Vec3::new(into_x - towards * BEAKER.0, rim, -0.40);
        let p = flask.inverse().transform_point(near_rim);
        let clearance = (p.x * towards - FLASK.0).max(-p.y);
        assert!(clearance > 0.002, "{clearance} m from the rim at {t} s");

        // It pours, or may: at 37 degrees, the shallowest at which a flask filled to seven
        // tenths of its height reaches its lip (tan 37 = (0.095 - 0.069) / 0.034).
        let lip = flask.transform_point(lip_of_flask);
        if tilt >= 37.0 {
            let x = (lip.x - into_x) * towards;
            assert!((-0.015..=0.010).contains(&x), "lip at {x} at {t} s");
            let y = lip.y - rim;
            assert!(
                (0.02..=0.0455).contains(&y),
                "lip {y} above the rim at {t} s"
            );
            assert!((lip.z + 0.40).abs() < NEAR);
            assert!(x.abs() < BEAKER.1);
        }
        drained += if tilt > 114.0 { dt } else { 0.0 };
        // Clear of the rim beside it: while upright it is not yet over the beaker.
        if tilt < 1.0 {
            assert!((lip.x - near_rim.x) * towards < -0.005, "at {t} s");
        }
    }
    assert!((most - 115.0).abs() < 0.1, "{most}");
    drained
}

#[test]
fn two_flasks_pours_right() {
    let track = load("two-flasks").unwrap();
    assert!(track.duration() >= 8.0);
    let drained = pours(&track, Side::Right, -0.12, 0.12);
    assert!(drained >= 1.5, "{drained} s");
    // Briskly: the carry is faster than 0.4 m/s.
    let fastest = carried(&track, Side::Right, -0.12)
        .windows(2)
        .map(|w| f64::from((w[1].1.position - w[0].1.position).length()) / (w[1].0 - w[0].0))
        .fold(0.0, f64::max);
    assert!((0.4..1.0).contains(&fastest), "{fastest} m/s");
}

#[test]
fn three_flasks_pours_twice() {
    let track = load("three-flasks").unwrap();
    assert!(pours(&track, Side::Left, -0.24, 0.0) >= 1.0);
    assert!(pours(&track, Side::Right, 0.24, 0.0) >= 1.0);
    // The flasks keep 10 cm apart from each other's axis, so that neither hand is hit.
    for frame in &track.frames {
        let [left, right] = [Side::Left, Side::Right].map(|side| frame.hand(side));
        if left.squeeze > 0.5 && right.squeeze > 0.5 {
            let apart = left
                .stage_from_grip
                .position
                .distance(right.stage_from_grip.position);
            assert!(apart > 0.1, "{apart} m at step {}", frame.step);
        }
    }
}

#[test]
fn shake_shakes_hard_above_the_table() {
    let track = load("shake").unwrap();
    let path = carried(&track, Side::Right, -0.12);
    let ends = [path[0].1, path.last().unwrap().1];
    for end in ends {
        assert!((end.position - Vec3::new(-0.12, TABLE, -0.40)).length() < NEAR);
    }
    // Second differences at 90 Hz: at least twice gravity's 9.81 m/s^2.
    let hardest = path
        .windows(3)
        .map(|w| {
            let [a, b, c] = [&w[0], &w[1], &w[2]].map(|(_, flask)| flask.position);
            (a + c - 2.0 * b).length() * 90.0 * 90.0
        })
        .fold(0.0, f32::max);
    assert!((20.0..50.0).contains(&hardest), "{hardest} m/s^2");
    assert!(
        path.iter()
            .all(|(_, flask)| flask.position.y > TABLE - NEAR && tilt(flask) < 16.0)
    );
}

/// 9.6e9 · 1e-9 is 9.600000000000001.
#[test]
fn a_length_is_as_it_was_written() {
    let written = load("two-flasks").unwrap().duration().to_string();
    assert_eq!(written, "9.6");
}

/// The built-in track of that name from a time on, s: the hand closed in the box of gloves before.
fn later(name: &str, from: f64) -> Track {
    let mut track = load(name).unwrap();
    track
        .frames
        .retain(|frame| frame.time_ns as f64 * 1e-9 > from);
    track
}

#[test]
fn wrong_order_hot_pours_as_two_flasks_does() {
    let track = later("wrong-order-hot", 6.0);
    let drained = pours(&track, Side::Right, -0.12, 0.12);
    assert!(drained >= 1.0, "{drained} s");
}

/// Five turns of six are on the whole circle, 40 mm wide; the rest is the spiral to it and back.
#[test]
fn wrong_order_layered_swirls_upright() {
    let track = later("wrong-order-layered", 6.0);
    let path = carried(&track, Side::Right, -0.12);
    let foot = Vec3::new(-0.12, TABLE, -0.40);
    for (_, end) in [&path[0], path.last().unwrap()] {
        assert!((end.position - foot).length() < NEAR, "{}", end.position);
    }
    let highest = path.iter().map(|(_, flask)| flask.position.y);
    let highest = highest.fold(0.0, f32::max);
    assert!((highest - TABLE - 0.05).abs() < NEAR, "{highest}");
    assert!(path.iter().all(|(_, flask)| tilt(flask) < 0.1));

    let aside = |flask: &Pose| Vec2::new(flask.position.x - foot.x, flask.position.z - foot.z);
    let (mut widest, mut turned) = (0.0f32, 0.0f32);
    for pair in path.windows(2) {
        let [a, b] = [0, 1].map(|n| aside(&pair[n].1));
        widest = widest.max(b.length());
        if a.length() > 0.01 && b.length() > 0.01 {
            turned += a.perp_dot(b).atan2(a.dot(b));
        }
    }
    assert!((widest - 0.02).abs() < 1e-3, "{widest} m");
    let turns = turned.abs() / std::f32::consts::TAU;
    assert!((4.5..=5.5).contains(&turns), "{turns}");
}

#[test]
fn each_is_valid_and_survives_conversion() {
    let dir = tempfile::tempdir().unwrap();
    for name in builtin::NAMES {
        let track = load(name).unwrap();
        assert!(!track.metadata.scene.is_empty(), "{name}");
        let file = dir.path().join(format!("{name}.mcap"));
        convert(name, &file, Existing::Refuse).unwrap();
        assert_eq!(Track::open(&file).unwrap(), track);
    }
}
