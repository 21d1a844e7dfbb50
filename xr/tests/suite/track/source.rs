//! A track as a pose source.

use glam::{Quat, Vec3};
use vitriol_xr::track::{Track, TrackSource};
use vitriol_xr::{Pose, PoseSource, Side, SourceError};

fn source(track: Track) -> TrackSource {
    TrackSource::new(track)
}

#[test]
fn the_recorded_steps_get_the_recorded_bits() {
    let track = super::track(300);
    let mut source = source(track.clone());
    for recorded in &track.frames {
        // The simulation's own clock, not the file's nanoseconds.
        // A hair beside, because a clock that adds up its steps drifts by roundings.
        let beside = [0.0, 4e-7, -4e-7][recorded.step as usize % 3];
        let time = (recorded.step as f64 / 90.0 + beside).max(0.0);
        let frame = source.next(recorded.step, time).unwrap().unwrap();
        assert_eq!(&frame, recorded);
        assert_eq!(super::bits(&frame), super::bits(recorded));
    }
    assert_eq!(source.next(300, 300.0 / 90.0), Ok(None));
    assert_eq!(source.next(301, 301.0 / 90.0), Ok(None));
}

#[test]
fn another_rate_interpolates_and_gives_each_switch_once() {
    let track = super::track(91);
    let mut source = source(track.clone());
    let mut switches = Vec::new();
    for step in 0..=60 {
        let time = step as f64 / 60.0;
        let frame = source.next(step, time).unwrap().unwrap();
        assert_eq!(frame.step, step);
        switches.extend(frame.scenario.clone());
        // The test movement is 0.01 m a frame in x: 0.9 m/s. f32 lerp of numbers below 2.
        let x = frame.stage_from_view.position.x;
        assert!(
            (f64::from(x) - (0.5 + 0.9 * time)).abs() < 1e-6,
            "{x} at {time}"
        );
        // And turns 0.02 rad a frame about Y: 1.8 rad/s, behind a fixed tilt.
        let angle = 1.8 * time as f32 + 0.5;
        let turn = Quat::from_rotation_y(angle) * Quat::from_rotation_x(0.15);
        let dot = frame.stage_from_view.orientation.dot(turn).abs();
        assert!((dot - 1.0).abs() < 1e-6, "{dot} at {time}");
    }
    let recorded: Vec<_> = track
        .frames
        .iter()
        .flat_map(|f| f.scenario.clone())
        .collect();
    assert_eq!(recorded.len(), 18);
    assert_eq!(switches, recorded);
}

#[test]
fn a_gap_holds_the_last_pose() {
    let mut track = super::track(180);
    // No frames from 0.5 s to 1.5 s.
    track
        .frames
        .retain(|frame| !(45..135).contains(&frame.step));
    let before = track.frames[44].clone();
    let after = track.frames[45].clone();
    assert_eq!((before.step, after.step), (44, 135));
    let mut source = source(track);
    for step in 45..135 {
        let frame = source.next(step, step as f64 / 90.0).unwrap().unwrap();
        assert_eq!(super::bits(&frame), super::bits(&before), "step {step}");
        assert_eq!(frame.step, step);
    }
    assert_eq!(source.next(135, 1.5).unwrap().unwrap(), after);
}

#[test]
fn a_hand_that_is_lost_stays_where_it_was() {
    let mut track = super::track(90);
    for frame in &mut track.frames[30..60] {
        let hand = &mut frame.hands[Side::Left as usize];
        hand.valid = false;
        // What a runtime reports for a controller that sleeps.
        hand.stage_from_grip = Pose::IDENTITY;
        hand.stage_from_aim = Pose::IDENTITY;
    }
    let last = track.frames[29].hands[0].clone();
    let other = track.frames[45].hands[1].clone();
    let mut source = source(track);
    for half in 58..120 {
        // Half steps, so that interpolation towards a lost pose would show.
        let frame = source.next(half, half as f64 / 180.0).unwrap().unwrap();
        let hand = frame.hand(Side::Left);
        // The lost frames are 30 to 59. On the way from 59.5 to 60 it comes back.
        if (60..119).contains(&half) {
            assert!(!hand.valid);
            let moved = hand.stage_from_grip.position - last.stage_from_grip.position;
            assert!(moved.length() < 1e-6, "{moved} at half step {half}");
        }
        if half == 90 {
            assert_eq!(hand.stage_from_grip, last.stage_from_grip);
            assert_eq!(hand.stage_from_aim, last.stage_from_aim);
            assert_eq!(frame.hand(Side::Right), &other);
        }
    }
}

#[test]
fn before_the_first_frame_it_waits_there() {
    let mut track = super::track(100);
    track.frames.drain(..50);
    let first = track.frames[0].clone();
    let mut source = source(track);
    let frame = source.next(0, 0.0).unwrap().unwrap();
    assert_eq!(super::bits(&frame), super::bits(&first));
    assert_eq!((frame.step, frame.time_ns), (0, 0));
    assert!(frame.stage_from_view.position != Vec3::ZERO);
}

#[test]
fn a_time_that_is_none_is_refused() {
    let mut source = source(super::track(2));
    for time in [f64::NAN, f64::INFINITY, -1.0] {
        let error = source.next(7, time).unwrap_err();
        assert!(matches!(error, SourceError::Time { step: 7, .. }));
    }
}
