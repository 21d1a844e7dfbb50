//! Input that is driven into the runtime comes out as head and hands.

use glam::{Quat, Vec3};
use vitriol_tests::gpu::read_back;
use vitriol_tests::monado::{self, Controller};
use vitriol_tests::program::own_name;
use vitriol_xr::{Headset, HeadsetFrame, Pose, Side};

use crate::session::client::{Client, focused};

/// A hand on its way at frame `n`: on a circle, turning, squeezing more and more.
fn moving(n: u32, side: Side) -> Controller {
    let angle = 0.05 * n as f32;
    let x = match side {
        Side::Left => -0.2,
        Side::Right => 0.2,
    };
    Controller {
        position: Vec3::new(x, 1.0 + 0.1 * angle.sin(), -0.4 + 0.1 * angle.cos()),
        orientation: Quat::from_rotation_y(0.1) * Quat::from_rotation_x(angle * 0.3 - 0.6),
        squeeze: (0.02 * n as f32).min(1.0),
        trigger: (1.0 - 0.02 * n as f32).max(0.0),
        thumbstick: [0.5, -0.25],
        a: side == Side::Left,
        b: side == Side::Right,
        active: true,
    }
}

/// Whether the poses are the same to the rounding of a quaternion's normalisation.
fn same(pose: &Pose, controller: &Controller) -> bool {
    pose.position.distance(controller.position) < 1e-5
        && pose.orientation.dot(controller.orientation).abs() > 1.0 - 1e-5
}

/// A frame that began when the runtime had taken in these values shows them: the driver does not predict.
fn shows(frame: &HeadsetFrame, head: Vec3, n: u32) {
    assert!(frame.poses.stage_from_view.position.distance(head) < 1e-5);
    for side in Side::BOTH {
        let hand = frame.poses.hand(side);
        assert!(hand.active && hand.valid && hand.tracked);
        let sent = moving(n, side);
        assert!(same(&hand.stage_from_grip, &sent), "{n}: {hand:?}");
        // Monado's bindings hold the values in 32 bits as they were sent.
        assert_eq!((hand.squeeze, hand.trigger), (sent.squeeze, sent.trigger));
        assert_eq!(hand.thumbstick, [0.5, -0.25]);
        assert_eq!(hand.button_a, side == Side::Left);
        assert_eq!(hand.button_b, side == Side::Right);
        assert_eq!(
            &*hand.profile,
            "/interaction_profiles/valve/index_controller"
        );
    }
}

#[test]
fn what_is_driven_arrives() {
    let Some(rig) = monado::enter(&own_name()) else {
        return;
    };
    let mut remote = rig.remote();
    let mut client = Client::open();
    let first = client.focus();
    let mut last_time = first.poses.info.xr_time;
    let mut shown = None;
    let head = |n: u32| Vec3::new(0.01 * n as f32, 1.6, 0.1);
    for n in 1..=50 {
        let (frame, others) = client.frame();
        assert!(others.is_empty(), "{others:?}");
        assert!(focused(&frame) && frame.should_render);
        let info = frame.poses.info;
        assert!(info.xr_time > last_time && info.period_ns > 0, "{info:?}");
        last_time = info.xr_time;
        // The profile is named some frames after the focus.
        if n > 10 {
            shows(&frame, head(n - 1), n - 1);
        }
        remote.head(head(n), Quat::from_rotation_x(-0.2));
        for side in Side::BOTH {
            remote.controller(side as usize, &moving(n, side));
        }
        remote.send().unwrap();
        client.hear(head(n));
        shown = Some(client.draw());
        client.xr.vibrate(Side::Right, 0.5).unwrap();
    }
    client.xr.vibrate(Side::Right, 0.0).unwrap();

    // The runtime's own image holds the bytes of our picture.
    let texels = read_back(client.xr.gpu(), &shown.unwrap());
    let texels = texels.get::<[u8; 4]>().unwrap();
    assert_eq!(
        texels.len() as u32,
        2 * client.xr.extent()[0] * client.xr.extent()[1]
    );
    assert!(
        texels
            .iter()
            .all(|texel| texel[0].abs_diff(64) <= 1 && texel[2].abs_diff(191) <= 1)
    );
    client.assert_silent();
}

#[test]
fn a_hand_that_sleeps_stays_where_it_was() {
    let Some(rig) = monado::enter(&own_name()) else {
        return;
    };
    let mut remote = rig.remote();
    let mut client = Client::open();
    client.focus();
    let held = Controller {
        position: Vec3::new(0.3, 1.1, -0.5),
        orientation: Quat::from_rotation_z(0.5),
        squeeze: 0.75,
        ..Controller::default()
    };
    // The head's position shows which packet was taken in.
    let mut head = Vec3::new(0.0, 1.6, 0.1);
    let mut settle = |client: &mut Client, state: &Controller, frames: u32| {
        head.x += 0.1;
        remote.head(head, Quat::IDENTITY);
        remote.controller(1, state);
        client.frame();
        remote.send().unwrap();
        client.hear(head);
        client.draw();
        let mut last = None;
        for _ in 0..frames {
            last = Some(client.frame().0);
            client.draw();
        }
        last.unwrap().poses.hand(Side::Right).clone()
    };
    let hand = settle(&mut client, &held, 5);
    assert!(
        hand.active && hand.valid && hand.squeeze == 0.75,
        "{hand:?}"
    );
    assert!(same(&hand.stage_from_grip, &held));

    // Switched off, it reports the origin.
    let asleep = Controller {
        active: false,
        ..Controller::default()
    };
    let hand = settle(&mut client, &asleep, 5);
    assert!(!hand.active && !hand.valid && !hand.tracked, "{hand:?}");
    assert!(same(&hand.stage_from_grip, &held), "{hand:?}");
    assert_eq!((hand.squeeze, hand.trigger), (0.0, 0.0));

    let hand = settle(&mut client, &held, 5);
    assert!(
        hand.active && hand.valid && hand.squeeze == 0.75,
        "{hand:?}"
    );
    client.assert_silent();
}
