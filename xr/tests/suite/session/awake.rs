//! Headsets that sleep, that nobody wears, that show something else, and runtimes that are of no use.

use vitriol_tests::mock::{Change, Goal, HandState, Mock};
use vitriol_xr::{Headset, HeadsetError, OpenXr, Pause, Side, Turn};

use crate::session::client::{Client, enter, focused, on_mock, options};

/// The next pause, after frames that are drawn; `None` if there is none in a while.
fn pause(client: &mut Client) -> Option<Pause> {
    for _ in 0..20 {
        match client.xr.next().unwrap() {
            Turn::Frame(_) => {
                client.draw();
            }
            Turn::Paused { cause } => return Some(cause),
            turn => panic!("{turn:?}"),
        }
    }
    None
}

#[test]
fn a_headset_that_is_off_is_waited_for() {
    let Some(mock) = enter(&[Change::Headset(false)]) else {
        return;
    };
    // It waits as long as `waits` is true.
    let given_up = OpenXr::open(options(), |_| false).err().unwrap();
    assert!(
        matches!(given_up, HeadsetError::Asleep { .. }),
        "{given_up:?}"
    );
    let mut asked = 0;
    let waits = |remedy: &str| {
        assert!(remedy.contains("switch it on"), "{remedy}");
        asked += 1;
        if asked == 3 {
            mock.say(Change::Headset(true));
        }
        true
    };
    let mut xr = OpenXr::open(options(), waits).unwrap();
    assert_eq!(asked, 3);
    while !matches!(xr.next().unwrap(), Turn::Frame(_)) {}
    xr.end(None).unwrap();
}

#[test]
fn a_headset_that_sleeps_is_waited_for() {
    let Some(mock) = enter(&[Change::Goal(Goal::Idle)]) else {
        return;
    };
    let mut client = Client::open();
    for _ in 0..5 {
        assert_eq!(pause(&mut client), Some(Pause::Off));
    }
    mock.say(Change::Goal(Goal::Focused));
    client.focus();
    client.assert_silent();
}

#[test]
fn nobody_wears_it() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    assert_eq!(pause(&mut client), None);
    mock.say(Change::Presence(false));
    assert_eq!(pause(&mut client), Some(Pause::Off));
    assert!(mock.frames().pop().unwrap().1.layers.is_empty());
    mock.say(Change::Presence(true));
    client.focus();
    client.assert_silent();
}

/// Without the focus pictures are drawn, and the hands are inactive.
#[test]
fn something_else_has_the_focus() {
    let gripping = HandState {
        squeeze: 1.0,
        ..HandState::touch(1)
    };
    let Some((mock, mut client)) = on_mock(&[Change::hand(1, gripping.clone())]) else {
        return;
    };
    mock.say(Change::Goal(Goal::Visible));
    let mut unfocused = 0;
    for _ in 0..6 {
        let (frame, others) = client.frame();
        assert!(others.is_empty(), "{others:?}");
        client.draw();
        if focused(&frame) {
            continue;
        }
        unfocused += 1;
        let hand = frame.poses.hand(Side::Right);
        assert!(!hand.active && hand.squeeze == 0.0, "{hand:?}");
        assert_eq!(hand.stage_from_grip.position, gripping.grip.position);
    }
    assert!(unfocused > 3);
    assert_eq!(mock.frames().pop().unwrap().1.layers.len(), 2);
    mock.say(Change::Goal(Goal::Focused));
    let frame = client.focus();
    assert!(frame.poses.hand(Side::Right).active);
    client.assert_silent();
}

#[test]
fn a_runtime_without_vulkan_is_not_the_one() {
    let extensions = Change::Extensions(vec!["XR_KHR_D3D11_enable".to_owned()]);
    let Some(_mock) = enter(&[extensions]) else {
        return;
    };
    let error = OpenXr::open(options(), |_| true).err().unwrap();
    assert!(matches!(error, HeadsetError::NoRuntime { .. }));
    let text = error.to_string();
    // The message names the runtime, and others to choose: Monado's file lies beside.
    for part in ["Mock", "SteamVR", "openxr_monado.json"] {
        assert!(text.contains(part), "{text}");
    }
}

/// Triangles that the lenses hide, as the client has them for the left eye.
fn hidden(mock: &Mock, client: &mut Client, corner: f32) -> Vec<[f32; 2]> {
    mock.say(Change::Mask {
        eye: 0,
        vertices: vec![[corner, corner], [0.0, corner], [corner, 0.0]],
        indices: vec![0, 1, 2],
    });
    for _ in 0..2 {
        client.drawn();
    }
    client.xr.hidden_area()[0].clone()
}

#[test]
fn a_mask_may_change() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    for corner in [-0.5, -0.25] {
        let found = hidden(&mock, &mut client, corner);
        assert_eq!(found.len(), 3);
        // In the picture of an eye whose tangents are these: from left to right, and downwards.
        let fov = client.xr.locate_views().unwrap()[0].fov;
        let across = (corner - fov.left.tan()) / (fov.right.tan() - fov.left.tan());
        let down = (fov.up.tan() - corner) / (fov.up.tan() - fov.down.tan());
        assert!((found[0][0] - across).abs() < 1e-5, "{found:?}");
        assert!((found[0][1] - down).abs() < 1e-5, "{found:?}");
    }
    client.assert_silent();
}

/// A display that is slower than 90 Hz is asked for 90, one that is faster is left alone, and a rate that is asked for later arrives.
#[test]
fn the_displays_rate_can_be_chosen() {
    let rates = |now| Change::Rates {
        rates: vec![72.0, 80.0, 90.0, 120.0],
        now,
    };
    let Some(mock) = enter(&[rates(72.0)]) else {
        return;
    };
    let asked = || {
        let calls = mock.calls_of("xrRequestDisplayRefreshRateFB").into_iter();
        calls
            .map(|call| call.with["rate"].as_f64().unwrap())
            .collect::<Vec<_>>()
    };
    let mut client = Client::open();
    client.focus();
    assert_eq!(asked(), [90.0]);
    assert_eq!(client.xr.rates(), [72.0, 80.0, 90.0, 120.0]);
    client.xr.request_rate(80.0).unwrap();
    client.focus();
    let frame = client.drawn();
    // Whole nanoseconds.
    assert!((frame.poses.info.period_ns - 12_500_000).abs() < 2);
    client.assert_silent();
    drop(client);
    mock.say(rates(120.0));
    let mut client = Client::open();
    client.focus();
    assert_eq!(asked(), [90.0, 80.0]);
    client.assert_silent();
}
