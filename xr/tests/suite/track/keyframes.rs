//! Keyframe files.

use std::path::Path;

use crate::track::convert;
use glam::{Quat, Vec3};
use vitriol_xr::track::{Existing, Keyframes, TrackError, load};
use vitriol_xr::{Pose, Side};

const TEXT: &str = r#"
name = "test"
scene = "one-flask"
seed = 7
duration = 2.5
rate_hz = 60

[[head]]
t = 0.0
position = [0.0, 1.5, 0.25]
rotation = { yaw = 90, pitch = -30, roll = 10 }

[[right]]
t = 0.5
position = [0.5, 1.0, -0.5]

[[right]]
t = 1.0
position = [0.5, 1.0, -1.5]
squeeze = 1.0
ease = "linear"

[[right]]
t = 2.0
position = [1.5, 1.0, -1.5]
rotation = { roll = 90 }

[[right]]
t = 2.25
position = [9.0, 9.0, 9.0]
ease = "hold"

[[scenario]]
t = 0.75
key = "scenario"
value = "incorrect"
"#;

fn parse(text: &str) -> Result<Keyframes, TrackError> {
    Keyframes::parse(text, Path::new("test.toml"))
}

fn grip(keyframes: &Keyframes, t: f64) -> Pose {
    keyframes.sample(0, t).hand(Side::Right).stage_from_grip
}

/// It was told of a key that tracks do not have.
#[test]
fn a_scene_and_a_lesson_are_told_from_a_track() {
    for (text, parts) in [
        (
            include_str!("../../../../sim/scenes/two-flasks.toml"),
            ["test.toml: is a scene and no track", "--scene FILE"],
        ),
        (
            include_str!("../../../../run/lesson/lessons/dilute.toml"),
            [
                "test.toml: is a lesson and no track",
                "`vitriol lesson FILE`",
            ],
        ),
    ] {
        let said = parse(text).err().unwrap().to_string();
        for part in parts {
            assert!(said.contains(part), "{said}");
        }
    }
}

#[test]
fn keyframes_are_hit_exactly() {
    let keyframes = parse(TEXT).unwrap();
    let at = |t| grip(&keyframes, t).position;
    assert_eq!(at(0.5), Vec3::new(0.5, 1.0, -0.5));
    assert_eq!(at(1.0), Vec3::new(0.5, 1.0, -1.5));
    assert_eq!(at(2.0), Vec3::new(1.5, 1.0, -1.5));
    assert_eq!(at(2.25), Vec3::new(9.0, 9.0, 9.0));
    // Before the first and after the last.
    assert_eq!(at(0.0), at(0.5));
    assert_eq!(at(2.5), at(2.25));
    let turned = grip(&keyframes, 2.0).orientation;
    let half = std::f32::consts::FRAC_1_SQRT_2;
    assert!(turned.abs_diff_eq(Quat::from_xyzw(0.0, 0.0, half, half), 1e-7));
}

#[test]
fn easing_between_keyframes() {
    let keyframes = parse(TEXT).unwrap();
    let at = |t| grip(&keyframes, t).position;
    // f32 rounding of values about 1.
    let near = |a: f32, b: f32| assert!((a - b).abs() < 1e-6, "{a} is not {b}");
    // Linear: a quarter of the time, a quarter of the way and of the squeeze.
    near(at(0.625).z, -0.75);
    near(keyframes.sample(0, 0.625).hand(Side::Right).squeeze, 0.25);
    // Minimum jerk, 10 t^3 - 15 t^4 + 6 t^5: 0.103515625 at a quarter, 0.5 at the half.
    near(at(1.25).x, 0.5 + 0.103_515_625);
    near(at(1.5).x, 1.0);
    near(at(1.75).x, 0.5 + 0.896_484_4);
    // A turn of 90 degrees about Z by the same course: 45 at the half.
    let turned = grip(&keyframes, 1.5).orientation * Vec3::X;
    near(turned.x, 0.5f32.sqrt());
    near(turned.y, 0.5f32.sqrt());
    // Hold.
    assert_eq!(at(2.249), at(2.0));
    // Squeeze stays once it is not named any more.
    near(keyframes.sample(0, 2.5).hand(Side::Right).squeeze, 1.0);
}

#[test]
fn rotations_are_yaw_pitch_roll() {
    let head = parse(TEXT).unwrap().sample(0, 1.0).stage_from_view;
    // Written out as matrices: Ry(90) Rx(-30) Rz(10). The line of sight -Z is not moved by
    // the roll, dips 30 degrees by the pitch and turns to the left (-X) by the yaw.
    let sight = head.orientation * -Vec3::Z;
    let (sin, cos) = 30f32.to_radians().sin_cos();
    assert!(
        (sight - Vec3::new(-cos, -sin, 0.0)).length() < 1e-6,
        "{sight}"
    );
    // The head's right, +X: ahead (-Z) after the yaw, lifted by the roll.
    let right = head.orientation * Vec3::X;
    assert!(
        right.z < -0.98 && (right.length() - 1.0).abs() < 1e-6,
        "{right}"
    );
    let lift = 10f32.to_radians().sin() * cos;
    assert!((right.y - lift).abs() < 1e-6, "{right}");
}

#[test]
fn a_pivot_stays_where_its_keyframes_say() {
    let text = TEXT.replace("[[head]]", "[pivot]\nright = [0.1, -0.2, 0.3]\n\n[[head]]");
    let pivot = Vec3::new(0.1, -0.2, 0.3);
    let (with, without) = (parse(&text).unwrap(), parse(TEXT).unwrap());
    for step in 0..50 {
        let t = f64::from(step) * 0.05;
        let point = grip(&with, t).transform_point(pivot);
        // Up to 9 m at 32 bits.
        assert!((point - grip(&without, t).position).length() < 2e-6);
        assert_eq!(grip(&with, t).orientation, grip(&without, t).orientation);
    }
}

#[test]
fn the_track_has_its_rate_and_its_switches() {
    let track = parse(TEXT).unwrap().sample_track();
    assert_eq!(track.frames.len(), 151);
    assert_eq!(track.duration(), 2.5);
    assert_eq!(track.metadata.scene, "one-flask");
    assert_eq!(track.metadata.seed, 7);
    let switched: Vec<_> = track
        .frames
        .iter()
        .filter(|f| !f.scenario.is_empty())
        .collect();
    assert_eq!(switched.len(), 1);
    assert_eq!(switched[0].step, 45);
    assert_eq!(switched[0].scenario[0].value, "incorrect");
    // There is no left hand.
    assert!(
        track
            .frames
            .iter()
            .all(|f| !f.hand(Side::Left).active && !f.hand(Side::Left).valid)
    );
    assert!(track.frames.iter().all(|f| f.hand(Side::Right).tracked));
}

#[test]
fn conversion_keeps_every_bit_and_overwrites_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let (text, mcap) = (dir.path().join("a.toml"), dir.path().join("a.mcap"));
    std::fs::write(&text, TEXT).unwrap();
    let written = convert(text.to_str().unwrap(), &mcap, Existing::Refuse).unwrap();
    assert_eq!((written.frames, written.end_ns), (151, 2_500_000_000));
    let expected = parse(TEXT).unwrap().sample_track();
    assert_eq!(load(mcap.to_str().unwrap()).unwrap(), expected);
    assert_eq!(load(text.to_str().unwrap()).unwrap(), expected);
    let again = convert(text.to_str().unwrap(), &mcap, Existing::Refuse);
    assert!(matches!(again, Err(TrackError::Exists { .. })));

    // A bad source leaves no file, and leaves an existing one as it is.
    std::fs::write(&text, TEXT.replace("t = 2.0", "t = 0.9")).unwrap();
    let new = dir.path().join("b.mcap");
    assert!(convert(text.to_str().unwrap(), &new, Existing::Refuse).is_err());
    assert!(!new.exists());
    let before = std::fs::read(&mcap).unwrap();
    assert!(convert(text.to_str().unwrap(), &mcap, Existing::Replace).is_err());
    assert_eq!(std::fs::read(&mcap).unwrap(), before);

    let message = load("two-flask").unwrap_err().to_string();
    assert!(
        message.contains("two-flasks, dilute, shake, three-flasks"),
        "{message}"
    );
}

/// What is replaced in [`TEXT`] => by what => what is told, in parts that ` | ` divides. `⏎` is a line's end.
///
/// A decimal comma makes four numbers. A rotation is no quaternion, and no three angles without names.
const BAD: &str = r#"
seed = 7 => sede = 7 => line 4 | unknown field `sede` | seed
squeeze = 1.0 => squeze = 1.0 => line 20 | unknown field `squeze` | squeeze
roll = 90 => rol = 90 => line 26 | unknown field `rol` | roll
ease = "linear" => ease = "quick" => line 21 | `quick` | `smooth`, `linear`, `hold`
[0.5, 1.0, -1.5] => [0.5, 1,0, -1.5] => line 19 | has 4 numbers; write 3 | decimal point
duration = 2.5⏎ =>  => missing field `duration`
t = 2.0⏎ =>  => line 23 | missing field `t`
t = 2.0 => t = 2.0.0 => line 24
t = 2.0 => t = nan => test.toml:23 | right.t is NaN | between 0 and the duration, 2.5 s
t = 2.0 => t = 0.75 => test.toml:23 | right.t is 0.75 after 1 | order of time
t = 2.0 => t = 1.0 => test.toml:23 | right.t is 1 after 1
t = 2.25 => t = 2.75 => test.toml:28 | right.t is 2.75 | 2.5 s
t = 0.75 => t = -1.0 => test.toml:33 | scenario.t is -1
key = "scenario" => key = "" => test.toml:33 | scenario.key is empty
[9.0, 9.0, 9.0] => [9.0, inf, 9.0] => test.toml:28 | right.position has inf | finite
yaw = 90 => yaw = nan => test.toml:8 | head.rotation has NaN
rotation = { yaw = 90, pitch = -30, roll = 10 } => rotation = [0.0, 0.0, 0.0, 1.5] => line 11 | sequence | map
yaw = 90 => yaww = 90 => `yaww` | `yaw`, `pitch`, `roll`
squeeze = 1.0 => squeeze = 1.5 => test.toml:17 | right.squeeze is 1.5 | between 0 and 1
position = [0.5, 1.0, -0.5]⏎ =>  => test.toml:13 | right.position is missing | metres
duration = 2.5 => duration = nan => test.toml:5 | duration is NaN | above 0
rate_hz = 60 => rate_hz = 0 => test.toml:6 | rate_hz is 0 | above 0
name = "test" => name = "" => test.toml:2 | name is empty
"#;

#[test]
fn bad_keyframes_are_refused_with_their_line() {
    for case in BAD.trim().lines() {
        let parts: Vec<String> = case.split(" => ").map(|it| it.replace('⏎', "\n")).collect();
        let [good, bad, says] = &parts[..] else {
            panic!("{case}");
        };
        let text = TEXT.replacen(good, bad, 1);
        assert_ne!(text, TEXT, "{good}");
        let message = parse(&text).expect_err(bad).to_string();
        for part in says.split(" | ").chain(["test.toml"]) {
            assert!(message.contains(part), "{bad}: no `{part}` in: {message}");
        }
    }
    for headless in ["", "head = []"] {
        let text = format!("name = \"a\"\nduration = 1.0\n{headless}");
        let message = parse(&text).unwrap_err().to_string();
        assert!(message.contains("head has no keyframe"), "{message}");
    }
}
