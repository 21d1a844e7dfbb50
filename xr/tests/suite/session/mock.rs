//! The mock runtime itself: it carries out its script, writes down the calls, and refuses wrong ones.

use std::time::Instant;

use glam::{Quat, Vec3};
use vitriol_tests::mock::{self, Change, HandState, Known, Layer, Mock, SpaceKind};
use vitriol_tests::wait::PATIENCE;
use vitriol_xr::{Headset, HeadsetError, OpenXr, Pose, Side, Turn};

use crate::session::client::{Client, enter, on_mock, options};
use crate::session::refused::refuse;

/// XR_ERROR_LIMIT_REACHED
const LIMIT_REACHED: i32 = -10;
/// XR_ERROR_POSE_INVALID
const POSE_INVALID: i32 = -39;

/// No floor but that one.
fn offer(floor: SpaceKind) -> Change {
    Change::Offer {
        spaces: vec![SpaceKind::View, SpaceKind::Local, floor],
    }
}

#[test]
fn frames_are_shown_to_both_eyes() {
    let Some((mock, mut client)) = on_mock(&[offer(SpaceKind::Stage)]) else {
        return;
    };
    assert_eq!(client.xr.extent(), [64, 48]);
    let frame = client.drawn();
    let head = frame.poses.stage_from_view.position;
    assert_eq!(head, Vec3::new(0.0, 1.6, 0.0));
    client.assert_silent();
    let (_, ended) = mock.frames().pop().unwrap();
    assert_eq!(ended.time, frame.poses.info.xr_time);
    let [
        Layer::Quad { pose, size, .. },
        Layer::Projection { space, views, .. },
    ] = &ended.layers[..]
    else {
        panic!("{ended:?}");
    };
    assert_eq!(*space, Some(SpaceKind::Stage));
    assert_eq!(views.len(), 2);
    for (eye, view) in views.iter().enumerate() {
        assert_eq!(view.image.layer, eye as u32);
        assert_eq!(view.image.rect, [0, 0, 44, 33]);
        // Half as wide and high, rounded up, over the same field of view.
        let depth = view.depth.unwrap().image;
        assert_eq!((depth.layer, depth.rect), (eye as u32, [0, 0, 22, 17]));
        // 63 mm apart.
        let side = [-0.0315, 0.0315][eye];
        assert_eq!(view.pose.position, head + Vec3::X * side);
    }
    assert_ne!(views[0].fov, views[1].fov);
    assert_eq!(pose.position, Vec3::new(0.0, 1.4, -0.7));
    assert_eq!(*size, [0.3, 0.15]);
}

#[test]
fn a_controller_arrives_through_its_bindings() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    let left = HandState {
        squeeze: 0.25,
        trigger: 0.5,
        stick: [0.125, -1.0],
        a: true,
        grip: mock::Pose::new(Vec3::new(-0.3, 1.1, -0.2), Quat::from_rotation_y(0.5)),
        ..HandState::touch(0)
    };
    mock.say(Change::hand(0, left.clone()));
    mock.say(Change::Hand {
        side: 1,
        state: None,
    });
    let frame = client.drawn();
    let hand = frame.poses.hand(Side::Left);
    assert!(hand.active && hand.valid && hand.tracked, "{hand:?}");
    assert_eq!((hand.squeeze, hand.trigger), (0.25, 0.5));
    assert_eq!(hand.thumbstick, [0.125, -1.0]);
    assert!(hand.button_a && !hand.button_b);
    assert_eq!(hand.stage_from_grip.position, left.grip.position);
    assert!(!frame.poses.hand(Side::Right).active);
    // An event announces the profile, which the next frame's turn takes.
    let (frame, _) = client.frame();
    assert_eq!(&*frame.poses.hand(Side::Left).profile, mock::TOUCH);
    client.xr.vibrate(Side::Left, 0.5).unwrap();
    client.xr.vibrate(Side::Left, 0.0).unwrap();
    client.draw();
    client.assert_silent();
    let applied = mock.calls_of("xrApplyHapticFeedback");
    assert_eq!(applied.len(), 1);
    assert_eq!(applied[0].with["hand"], 0);
    assert_eq!(applied[0].with["amplitude"], 0.5);
    assert_eq!(mock.calls_of("xrStopHapticFeedback")[0].with["hand"], 0);
}

/// Where the extension is offered, and asked for, the gaze arrives.
#[test]
fn the_gaze_arrives() {
    let changes = [Change::offer_too("XR_EXT_eye_gaze_interaction")];
    let Some(mock) = enter(&changes) else {
        return;
    };
    let mut client = Client::open_with(true);
    client.focus();
    // The gaze is not known at first.
    client.frame();
    client.xr.locate_views().unwrap();
    assert_eq!(client.xr.gaze(), None);
    client.draw();
    let looks = mock::Pose::new(Vec3::new(0.0, 1.6, 0.0), Quat::from_rotation_y(0.25));
    mock.say(Change::Gaze(Some(looks)));
    client.frame();
    client.xr.locate_views().unwrap();
    let gaze = client.xr.gaze().unwrap();
    assert_eq!(gaze.position, looks.position);
    // 0.25 rad about +Y is to the left.
    let towards = gaze.orientation * Vec3::NEG_Z;
    assert!((towards - Vec3::new(-0.25_f32.sin(), 0.0, -0.25_f32.cos())).length() < 1e-6);
    client.draw();
    mock.say(Change::Gaze(None));
    client.frame();
    client.xr.locate_views().unwrap();
    assert_eq!(client.xr.gaze(), None);
    client.draw();
    client.assert_silent();
}

/// A runtime that could track the gaze does so only where it is asked for.
#[test]
fn the_gaze_is_not_asked_for_by_itself() {
    let changes = [
        Change::offer_too("XR_EXT_eye_gaze_interaction"),
        Change::Gaze(Some(mock::Pose::IDENTITY)),
    ];
    let Some((_mock, mut client)) = on_mock(&changes) else {
        return;
    };
    client.frame();
    client.xr.locate_views().unwrap();
    assert_eq!(client.xr.gaze(), None);
    client.draw();
    client.assert_silent();
}

#[test]
fn a_change_takes_effect_in_its_frame() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    let first = mock.frame();
    let head = |x: f32| Change::head(mock::Pose::at(x, 1.6, 0.0));
    for n in 1..=8 {
        mock.say_at(first + n, head(n as f32));
    }
    for n in 1..=8 {
        let (frame, _) = client.frame();
        let position = frame.poses.stage_from_view.position;
        assert_eq!(position.x, n as f32);
        client.draw();
        assert_eq!(mock.frame(), first + n);
    }
    client.assert_silent();
}

/// Result of [`moves`]: the poses leap in the frame for which the space moves, and the client reports it in that frame.
const AT_ITS_TIME: [(f32, bool); 5] = [
    (0.0, false),
    (0.0, false),
    (0.0, false),
    (-2.0, true),
    (-2.0, false),
];

/// Position of the head in the frames around one before which the space moves, and whether the client reports a recentring.
fn moves(mock: &Mock, client: &mut Client, space: SpaceKind) -> Vec<(f32, bool)> {
    client.focus();
    let mut seen = Vec::new();
    let mut frame = |client: &mut Client| {
        let frame = client.drawn();
        let head = frame.poses.stage_from_view.position;
        seen.push((head.x, frame.recentred));
    };
    frame(client);
    mock.say(Change::Move {
        space,
        origin: mock::Pose::at(2.0, 0.0, 0.0),
        announced: true,
        pose_valid: true,
        later: 2,
    });
    for _ in 0..4 {
        frame(client);
    }
    client.assert_silent();
    seen
}

#[test]
fn the_stage_moves_at_its_time() {
    let Some(mock) = enter(&[offer(SpaceKind::Stage)]) else {
        return;
    };
    let mut client = Client::open();
    assert_eq!(moves(&mock, &mut client, SpaceKind::Stage), AT_ITS_TIME);
}

#[test]
fn the_floor_moves_at_its_time() {
    let Some(mock) = enter(&[offer(SpaceKind::LocalFloor)]) else {
        return;
    };
    let mut client = Client::open();
    assert_eq!(
        moves(&mock, &mut client, SpaceKind::LocalFloor),
        AT_ITS_TIME
    );
}

#[test]
fn what_is_to_be_refused_is_refused() {
    let changes = [
        Change::refuse_once("xrCreateSession", LIMIT_REACHED),
        // A format that nobody asks for.
        refuse("xrCreateSwapchain", LIMIT_REACHED, Some("37")),
    ];
    let Some(mock) = enter(&changes) else {
        return;
    };
    let Err(refused) = OpenXr::open(options(), |_| false) else {
        panic!("it is open");
    };
    assert!(
        matches!(
            refused,
            HeadsetError::Refused {
                call: "xrCreateSession",
                ..
            }
        ),
        "{refused:?}"
    );
    let refusals = mock.calls_of("xrCreateSession");
    assert_eq!(refusals.len(), 1);
    assert_eq!(refusals[0].answer, LIMIT_REACHED);
    Client::open().focus();
    let chains = mock.calls_of("xrCreateSwapchain");
    assert!(chains.iter().all(|call| call.answer == 0), "{chains:?}");
}

#[test]
fn what_is_wrong_is_refused() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    client.frame();
    let targets = client.xr.acquire(true).unwrap().unwrap();
    client.submit(&targets);
    let mut views = client.xr.locate_views().unwrap();
    views[1].stage_from_eye = Pose {
        orientation: Quat::from_xyzw(0.0, 0.0, 0.0, 1.01),
        ..views[1].stage_from_eye
    };
    let shown = client.shown(views);
    // The client's own result does not matter here.
    let _ = client.xr.end(Some(&shown));
    let ends = mock.calls_of("xrEndFrame");
    let refused = ends.iter().find(|call| call.answer < 0).unwrap();
    assert_eq!(refused.answer, POSE_INVALID);
    let ended = refused.ended().unwrap();
    let Layer::Projection { views, .. } = &ended.layers[0] else {
        panic!("{ended:?}");
    };
    assert_eq!(views[1].pose.orientation.w, 1.01);
    client.drawn();
    client.assert_silent();
}

#[test]
fn a_lost_session_is_followed_by_another() {
    let Some(mock) = enter(&[]) else {
        return;
    };
    let mut client = Client::open();
    for lost in [mock::Lost::Session, mock::Lost::Instance] {
        client.focus();
        mock.say_at(mock.frame() + 2, Change::Lose(lost));
        let (_, others) = client.frame();
        assert!(others.is_empty(), "{others:?}");
        client.draw();
        let (_, others) = client.frame();
        assert!(others.iter().any(|turn| turn == "renewed"), "{others:?}");
        client.draw();
        client.focus();
        client.assert_silent();
    }
}

#[test]
fn the_way_down_is_legal_too() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    mock.say(Change::Goal(mock::Goal::Idle));
    let begun = Instant::now();
    while mock.calls_of("xrEndSession").is_empty() {
        assert!(begun.elapsed() < PATIENCE, "the session does not end");
        if let Turn::Frame(_) = client.xr.next().unwrap() {
            client.draw();
        }
    }
    // The headset sleeps until it is woken, or the program ends.
    assert!(matches!(client.xr.next().unwrap(), Turn::Paused { .. }));
    mock.say(Change::Goal(mock::Goal::Focused));
    client.focus();
    mock.say(Change::Goal(mock::Goal::Exiting));
    while !matches!(client.xr.next().unwrap(), Turn::Ended) {
        assert!(begun.elapsed() < PATIENCE, "the end does not come");
    }
    client.assert_silent();
}

#[test]
fn what_is_not_known_is_rubbish() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    mock.say(Change::Head {
        pose: mock::Pose::at(0.5, 1.6, 0.0),
        known: Known::TURNED,
    });
    mock.say(Change::hand(
        1,
        HandState {
            known: Known::NOTHING,
            ..HandState::touch(1)
        },
    ));
    let (frame, _) = client.frame();
    // The client keeps the last known position.
    assert_eq!(frame.poses.stage_from_view.position.x, 0.0);
    let hand = frame.poses.hand(Side::Right);
    assert!(hand.active && !hand.valid && !hand.tracked, "{hand:?}");
    client.draw();
    client.assert_silent();
}

#[test]
fn hands_without_controllers_and_masks_arrive() {
    let joint = |x: f32| mock::Joint {
        pose: mock::Pose::at(x, 1.2, -0.3),
        radius: 0.01,
        known: Known::TRACKED,
    };
    // Thumb and index finger touch: joints 5 and 10 lie within 1 cm.
    let joints = (0..26).map(|n| joint(if n == 10 { 0.31 } else { 0.3 }));
    let changes = [
        Change::Hand {
            side: 1,
            state: None,
        },
        Change::Joints {
            side: 1,
            joints: Some(joints.collect()),
        },
        Change::Mask {
            eye: 1,
            vertices: vec![[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]],
            indices: vec![0, 1, 2],
        },
    ];
    let Some(mock) = enter(&changes) else {
        return;
    };
    let mut client = Client::open();
    let frame = client.focus();
    let hand = frame.poses.hand(Side::Right);
    assert!(hand.active && hand.valid && hand.trigger == 1.0, "{hand:?}");
    assert_eq!(hand.stage_from_grip.position, Vec3::new(0.3, 1.2, -0.3));
    assert_eq!(client.xr.hidden_area().map(|mask| mask.len()), [0, 3]);
    // An event announces another mask.
    mock.say(Change::Mask {
        eye: 0,
        vertices: vec![[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5]],
        indices: vec![0, 1, 2, 1, 2, 3],
    });
    client.drawn();
    assert_eq!(client.xr.hidden_area().map(|mask| mask.len()), [6, 3]);
    client.assert_silent();
}
