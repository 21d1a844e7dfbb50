//! Heads and hands that are known in part.

use glam::{Quat, Vec3};
use vitriol_tests::mock::{self, Change, Fov, HandState, Known, Mock};
use vitriol_xr::{Headset, Pause, Pose, Side, Turn, View};

use crate::session::client::{Client, enter, on_mock};

fn head(position: Vec3, yaw: f32, known: Known) -> Change {
    Change::Head {
        pose: mock::Pose::new(position, Quat::from_rotation_y(yaw)),
        known,
    }
}

/// Number of layers of each frame that was ended.
fn layers(mock: &Mock) -> Vec<usize> {
    let frames = mock.frames().into_iter();
    frames.map(|(_, ended)| ended.layers.len()).collect()
}

fn is_turned(pose: &Pose, yaw: f32) -> bool {
    // Quaternions of 32 bits resolve no smaller angles.
    pose.orientation.angle_between(Quat::from_rotation_y(yaw)) < 1e-3
}

#[test]
fn nothing_is_shown_before_the_head_is_seen() {
    let unseen = head(Vec3::new(0.0, 1.6, 0.0), 0.0, Known::NOTHING);
    let Some(mock) = enter(&[unseen]) else {
        return;
    };
    let mut client = Client::open();
    let mut turns = 0;
    while turns < 10 {
        match client.xr.next().unwrap() {
            Turn::Paused { cause } => turns += u32::from(cause == Pause::Unseen),
            turn => panic!("{turn:?}"),
        }
    }
    let place = Vec3::new(0.3, 1.5, 0.2);
    mock.say(head(place, 0.4, Known::TRACKED));
    let (frame, _) = client.frame();
    assert_eq!(frame.poses.stage_from_view.position, place);
    client.draw();
    client.assert_silent();
    let layers = layers(&mock);
    let (last, before) = layers.split_last().unwrap();
    assert!(before.len() >= 10 && before.iter().all(|&count| count == 0));
    assert_eq!(*last, 2);
}

/// Eyes and head in a frame that is drawn, of a head whose place is `lost` or not.
fn seen(client: &mut Client, lost: bool) -> ([View; 2], Pose) {
    let (frame, others) = client.frame();
    assert!(others.is_empty(), "{others:?}");
    assert_eq!(frame.lost, lost);
    let views = client.xr.locate_views().unwrap();
    client.draw();
    (views, frame.poses.stage_from_view)
}

#[test]
fn a_head_whose_place_is_lost_goes_on_turning() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    let place = Vec3::new(0.2, 1.5, 0.1);
    mock.say(head(place, 0.0, Known::TRACKED));
    seen(&mut client, false);
    // The runtime has rubbish for a position from now on, and other fields of view.
    let fov = |left: f32| Fov {
        left,
        right: 0.5,
        up: 0.5,
        down: -0.5,
    };
    mock.say(Change::Views {
        fov: [fov(-0.6), fov(-0.5)],
        ipd: 0.063,
    });
    for n in 1..=5 {
        let yaw = 0.3 * n as f32;
        mock.say(head(place, yaw, Known::TURNED));
        let (views, head) = seen(&mut client, true);
        assert!(head.position == place && is_turned(&head, yaw), "{head:?}");
        for (view, side) in views.iter().zip([-1.0, 1.0]) {
            // 63 mm apart, in the head as it is turned.
            let away = Quat::from_rotation_y(yaw) * Vec3::X * (side * 0.0315);
            let eye = view.stage_from_eye;
            assert!(eye.position.distance(place + away) < 1e-5, "{eye:?}");
            assert!(is_turned(&eye, yaw), "{eye:?}");
        }
        assert_eq!([0, 1].map(|eye: usize| views[eye].fov.left), [-0.6, -0.5]);
    }
    // With nothing known all poses stay, and the picture goes on.
    mock.say(head(place, 9.0, Known::NOTHING));
    let (views, head) = seen(&mut client, true);
    assert!(head.position == place && is_turned(&head, 1.5), "{head:?}");
    assert!(is_turned(&views[0].stage_from_eye, 1.5));
    client.assert_silent();
    assert!(layers(&mock).iter().rev().take(7).all(|&count| count == 2));
}

#[test]
fn a_headset_that_only_turns_serves_after_a_while() {
    let turning = head(Vec3::new(0.0, 1.6, 0.0), 0.7, Known::TURNED);
    let Some(mock) = enter(&[turning]) else {
        return;
    };
    let mut client = Client::open();
    let (frame, others) = client.frame();
    assert!(others.len() > 100, "{}", others.len());
    let head = frame.poses.stage_from_view;
    assert!(head.position.length() < 10.0 && is_turned(&head, 0.7));
    assert!(!frame.lost, "it never had a place");
    client.draw();
    client.assert_silent();
    assert_eq!(*layers(&mock).last().unwrap(), 2);
}

#[test]
fn a_hand_whose_place_is_lost_stays_where_it_was() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    let held = HandState {
        squeeze: 0.75,
        grip: mock::Pose::at(0.3, 1.1, -0.5),
        ..HandState::touch(1)
    };
    // A guess of the runtime's is valid, and not tracked.
    for (known, valid, tracked) in [
        (Known::TRACKED, true, true),
        (Known::GUESSED, true, false),
        (Known::TURNED, false, false),
        (Known::NOTHING, false, false),
        (Known::TRACKED, true, true),
    ] {
        let state = HandState {
            known,
            ..held.clone()
        };
        mock.say(Change::hand(1, state));
        let frame = client.drawn();
        let hand = frame.poses.hand(Side::Right);
        assert!(hand.active, "{known:?}");
        assert_eq!((hand.valid, hand.tracked), (valid, tracked), "{known:?}");
        let position = hand.stage_from_grip.position;
        assert_eq!(position, Vec3::new(0.3, 1.1, -0.5), "{known:?}");
        assert_eq!(hand.squeeze, 0.75, "{known:?}");
    }
    client.assert_silent();
    assert!(layers(&mock).iter().rev().take(5).all(|&count| count == 2));
}

/// A right hand whose palm looks left, thumb up and fingers ahead, with the tips of thumb and index finger `apart` m from each other.
fn bare(apart: f32) -> Vec<mock::Joint> {
    let palm = Vec3::new(0.2, 1.1, -0.4);
    // Of a palm joint +Y leaves the back of the hand, and -Z looks along the fingers.
    let turned = Quat::from_rotation_z(-std::f32::consts::FRAC_PI_2);
    let joint = |index: usize| {
        let place = match index {
            0 => palm,
            5 => palm + Vec3::new(0.0, 0.05, -0.08),
            10 => palm + Vec3::new(0.0, 0.05 - apart, -0.08),
            n => palm + Vec3::Z * (0.002 * n as f32),
        };
        mock::Joint {
            pose: mock::Pose::new(place, turned),
            radius: 0.008,
            known: Known::TRACKED,
        }
    };
    (0..26).map(joint).collect()
}

#[test]
fn a_bare_hand_is_seen() {
    let none = [0, 1].map(|side| Change::Hand { side, state: None });
    let Some((mock, mut client)) = on_mock(&none) else {
        return;
    };
    let mut see = |joints: Option<Vec<mock::Joint>>| {
        mock.say(Change::Joints { side: 1, joints });
        client.drawn()
    };
    for (apart, pulls) in [(0.06, 0.0), (0.016, 1.0)] {
        let frame = see(Some(bare(apart)));
        let hand = frame.poses.hand(Side::Right);
        assert!(hand.active && hand.valid && hand.tracked, "{hand:?}");
        assert_eq!(hand.stage_from_grip.position, Vec3::new(0.2, 1.1, -0.4));
        // The grip's -Z leaves the fist at the thumb, which is up.
        let up = hand.stage_from_grip.orientation * Vec3::NEG_Z;
        assert!(up.distance(Vec3::Y) < 1e-5, "{up}");
        assert!((hand.trigger - pulls).abs() < 1e-3, "{hand:?}");
        let joints = frame.joints[1].as_ref().unwrap();
        let tip = Vec3::new(0.2, 1.15 - apart, -0.48);
        assert!(joints.0[10].0.distance(tip) < 1e-6, "{:?}", joints.0[10]);
        assert_eq!(joints.0[10].1, 0.008);
        assert!(frame.joints[0].is_none());
    }
    // If one joint is not known, there are none; nor while it holds a controller.
    let mut partly = bare(0.06);
    partly[7].known = Known::NOTHING;
    assert!(see(Some(partly)).joints[1].is_none());
    mock.say(Change::hand(1, HandState::touch(1)));
    let frame = see(Some(bare(0.06)));
    assert!(frame.joints[1].is_none());
    assert_eq!(
        frame.poses.hand(Side::Right).stage_from_grip.position.y,
        1.0
    );
    // Out of sight it is inactive, and its pose stays.
    mock.say(Change::Hand {
        side: 1,
        state: None,
    });
    see(Some(bare(0.06)));
    let frame = see(None);
    let hand = frame.poses.hand(Side::Right);
    assert!(!hand.active && !hand.valid, "{hand:?}");
    assert_eq!(hand.stage_from_grip.position, Vec3::new(0.2, 1.1, -0.4));
    client.assert_silent();
}
