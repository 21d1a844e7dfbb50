//! A track that is written and read is the same.

use proptest::prelude::*;
use std::path::Path;
use std::sync::Arc;

use glam::{Quat, Vec3};
use vitriol_xr::track::{Existing, Track, TrackError, TrackMetadata, TrackWriter, save};
use vitriol_xr::{Fov, FrameInfo, Hand, Pose, PoseFrame, SessionState, Switch};

#[test]
fn every_field_comes_back() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("a.mcap");
    let track = super::track(200);
    super::write(&file, &track);
    assert_eq!(Track::open(&file).unwrap(), track);
}

#[test]
fn the_writer_overwrites_only_when_told() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("a.mcap");
    std::fs::write(&file, b"mine").unwrap();
    let refused = TrackWriter::create(&file, &super::metadata(), Existing::Refuse);
    assert!(matches!(refused.err(), Some(TrackError::Exists { .. })));
    assert_eq!(std::fs::read(&file).unwrap(), b"mine");

    let mut writer = TrackWriter::create(&file, &super::metadata(), Existing::Replace).unwrap();
    writer.write(&super::frame(0), &[]).unwrap();
    writer.finish().unwrap();
    assert_eq!(Track::open(&file).unwrap().frames, [super::frame(0)]);
}

#[test]
fn a_minute_is_about_as_small_as_measured() {
    // 60 s at 90 Hz with 5 transforms and inputs took 1.1 MB in lz4 chunks of one second
    // when this format was chosen; with flasks, and half-second chunks, twice that is a sign
    // that chunks are not compressed or are cut too small.
    let mut track = super::track(5400);
    for flasks in &mut track.stage_from_flasks {
        flasks.clear();
    }
    let size = super::bytes(&track).len();
    assert!(size < 2_200_000, "{size} B");
}

#[test]
fn the_writer_can_move_to_another_thread() {
    fn send<T: Send>() {}
    send::<TrackWriter>();
}

fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        Just(0.0f32),
        Just(-0.0f32),
        Just(f32::MIN_POSITIVE / 8.0),
        Just(f32::MAX),
        -10.0f32..10.0,
    ]
}

fn share() -> impl Strategy<Value = f32> {
    prop_oneof![Just(0.0f32), Just(-0.0f32), Just(1.0f32), 0.0f32..1.0]
}

fn pose() -> impl Strategy<Value = Pose> {
    let axis = prop_oneof![
        Just(Vec3::X),
        Just(-Vec3::Y),
        Just(Vec3::new(0.48, 0.6, 0.64))
    ];
    ([number(), number(), number()], axis, -7.0f32..7.0).prop_map(|(position, axis, angle)| {
        Pose::new(
            Vec3::from_array(position),
            Quat::from_axis_angle(axis, angle),
        )
    })
}

fn hand() -> impl Strategy<Value = Hand> {
    (
        any::<[bool; 5]>(),
        pose(),
        pose(),
        [share(), share(), share(), share()],
        ".{0,20}",
    )
        .prop_map(|(flags, grip, aim, values, profile)| Hand {
            active: flags[0],
            valid: flags[1],
            tracked: flags[2],
            stage_from_grip: grip,
            stage_from_aim: aim,
            squeeze: values[0],
            trigger: values[1],
            thumbstick: [values[2], -values[3]],
            button_a: flags[3],
            button_b: flags[4],
            profile: Arc::from(profile),
        })
}

fn info() -> impl Strategy<Value = FrameInfo> {
    (
        any::<i64>(),
        any::<i64>(),
        [-1.5f32..1.5, -1.5f32..1.5, -1.5f32..1.5, -1.5f32..1.5],
        0i32..9,
    )
        .prop_map(|(xr_time, period_ns, a, state)| FrameInfo {
            xr_time,
            period_ns,
            fov: [0, 1].map(|i| Fov {
                left: a[i],
                right: -a[i],
                up: a[i + 2],
                down: -0.0,
            }),
            session_state: SessionState::try_from(state).unwrap(),
        })
}

fn any_frame() -> impl Strategy<Value = (PoseFrame, Vec<Pose>)> {
    (
        (1u64..1000, 1i64..1_000_000_000),
        pose(),
        [hand(), hand()],
        prop::collection::vec((".{1,9}", ".{0,9}"), 0..3),
        info(),
        prop::collection::vec(pose(), 0..12),
    )
        .prop_map(
            |((step, time_ns), stage_from_view, hands, switches, info, flasks)| {
                let frame = PoseFrame {
                    step,
                    time_ns,
                    stage_from_view,
                    hands,
                    scenario: switches
                        .into_iter()
                        .map(|(key, value)| Switch { key, value })
                        .collect(),
                    info,
                };
                (frame, flasks)
            },
        )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn any_valid_track_comes_back_bit_for_bit(
        mut frames in prop::collection::vec(any_frame(), 1..12),
        scene in ".{0,12}",
        seed in any::<u64>(),
    ) {
        // Steps and times so far are distances.
        let (mut step, mut time_ns) = (0, 0);
        for (frame, _) in &mut frames {
            step += frame.step;
            time_ns += frame.time_ns;
            (frame.step, frame.time_ns) = (step, time_ns);
        }
        let (frames, stage_from_flasks) = frames.into_iter().unzip();
        let metadata = TrackMetadata { scene, seed, ..super::metadata() };
        let track = Track { metadata, frames, stage_from_flasks, recovered: false, outcome: Default::default(), events: Vec::new(), progress: Vec::new() };
        let read = Track::parse(&super::bytes(&track), Path::new("x.mcap")).unwrap();
        prop_assert_eq!(&read, &track);
        for (a, b) in read.frames.iter().zip(&track.frames) {
            prop_assert_eq!(super::bits(a), super::bits(b));
        }
    }
}

/// Events of a session are read in their order, are kept in a track that is saved again, and are left out where the track is cut before
/// them; events that no reader could accept are refused.
#[test]
fn what_was_found_goes_with_the_track() {
    let dir = tempfile::tempdir().unwrap();
    let [file, again] = ["x.mcap", "again.mcap"].map(|name| dir.path().join(name));
    let mut track = super::track(4);
    let [early, late] = [0, 3].map(|frame| track.frames[frame].time_ns);
    track.events = [
        (early, "{\"a\":1}"),
        (late, "{\"b\":2}"),
        (late, "{\"c\":3}"),
    ]
    .map(|(at, json)| (at, json.to_owned()))
    .to_vec();
    // Likewise changes in a lesson, on a topic of their own.
    track.progress = [(early, "{\"d\":4}"), (late, "{\"e\":5}")]
        .map(|(at, json)| (at, json.to_owned()))
        .to_vec();
    save(&track, &file, Existing::Refuse).unwrap();
    let read = Track::open(&file).unwrap();
    assert_eq!(read, track);
    save(&read, &again, Existing::Refuse).unwrap();
    assert_eq!(Track::open(&again).unwrap(), track);
    let mut holed = track.clone();
    holed.frames.remove(2);
    holed.stage_from_flasks.remove(2);
    let cut = holed.up_to_the_first_hole();
    assert_eq!(cut.events, track.events[..1]);
    assert_eq!(cut.progress, track.progress[..1]);
    track.events[1].1 = format!("\"{}\"", "x".repeat(70_000));
    let long = dir.path().join("long.mcap");
    save(&track, &long, Existing::Refuse).unwrap();
    let error = Track::open(&long).unwrap_err().to_string();
    assert!(
        error.contains("/events") && error.contains("65536"),
        "{error}"
    );
    (track.events, track.progress[1].1) = (Vec::new(), format!("\"{}\"", "x".repeat(70_000)));
    save(&track, &long, Existing::Replace).unwrap();
    let error = Track::open(&long).unwrap_err().to_string();
    assert!(error.contains("/lesson"), "{error}");
}
