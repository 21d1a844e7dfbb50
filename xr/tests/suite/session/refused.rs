//! A session goes on without what the runtime refuses.

use glam::{Quat, Vec3};
use vitriol_tests::mock::{Change, Depth, Layer, Mock};
use vitriol_xr::{Headset, Pose, Shown, Side, Turn};

use crate::session::client::{Client, on_mock};

/// XR_ERROR_VALIDATION_FAILURE and XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED
pub const VALIDATION_FAILURE: i32 = -1;
const FORMAT_UNSUPPORTED: i32 = -26;

/// XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT and XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT
const BLEND_TEXTURE_SOURCE_ALPHA: u64 = 2;
const UNPREMULTIPLIED_ALPHA: u64 = 4;

/// The runtime refuses that call always, where `when` holds.
pub fn refuse(call: &str, answer: i32, when: Option<&str>) -> Change {
    Change::Refuse {
        call: call.to_owned(),
        answer,
        times: None,
        when: when.map(str::to_owned),
    }
}

/// The parts with which the last frame was ended.
struct Last {
    depths: [Option<Depth>; 2],
    panels: usize,
    /// Whether each eye has a swapchain of its own.
    apart: bool,
}

impl Last {
    fn of(mock: &Mock) -> Self {
        let (_, ended) = mock.frames().pop().unwrap();
        let [rest @ .., Layer::Projection { views, flags, .. }] = &ended.layers[..] else {
            panic!("{ended:?}");
        };
        let apart = views[0].image.swapchain != views[1].image.swapchain;
        assert_eq!(views[1].image.layer, u32::from(!apart));
        assert!(rest.iter().all(|layer| matches!(layer, Layer::Quad { .. })));
        // The picture is seen through where there is something under it, and there alone.
        let alpha = BLEND_TEXTURE_SOURCE_ALPHA | UNPREMULTIPLIED_ALPHA;
        assert_eq!(*flags, if rest.is_empty() { 0 } else { alpha });
        Self {
            depths: [views[0].depth, views[1].depth],
            panels: rest.len(),
            apart,
        }
    }

    fn has_depth(&self) -> bool {
        self.depths.iter().all(Option::is_some)
    }
}

/// A client that has drawn some frames on a runtime that begins with `changes`.
fn drawn(changes: &[Change]) -> Option<(Mock, Client)> {
    let (mock, mut client) = on_mock(changes)?;
    for _ in 0..5 {
        client.drawn();
    }
    client.assert_silent();
    Some((mock, client))
}

#[test]
fn a_depth_format() {
    let depth = refuse("xrCreateSwapchain", FORMAT_UNSUPPORTED, Some("126"));
    let Some((mock, _client)) = drawn(&[depth]) else {
        return;
    };
    let last = Last::of(&mock);
    assert!(!last.has_depth() && last.panels == 1 && !last.apart);
}

#[test]
fn a_depth_range_without_end() {
    let infinite = refuse("xrEndFrame", VALIDATION_FAILURE, Some("infinite depth"));
    let Some((mock, _client)) = drawn(&[infinite]) else {
        return;
    };
    let last = Last::of(&mock);
    assert_eq!(last.panels, 1);
    for depth in last.depths {
        let depth = depth.unwrap();
        // The extension's reversed depth: the plane of the smaller one is the far one.
        assert_eq!((depth.min, depth.max, depth.far), (0.0, 1.0, 0.05));
        assert!(depth.near.is_finite() && depth.near > 1e4);
    }
    // It is not tried again in each frame.
    let ends = mock.calls_of("xrEndFrame");
    assert_eq!(ends.iter().filter(|call| call.answer < 0).count(), 1);
}

#[test]
fn depth_at_a_frames_end() {
    let depth = refuse("xrEndFrame", VALIDATION_FAILURE, Some("depth"));
    let Some((mock, _client)) = drawn(&[depth]) else {
        return;
    };
    let last = Last::of(&mock);
    assert!(!last.has_depth() && last.panels == 1);
}

#[test]
fn the_panels_layer() {
    let quad = refuse("xrEndFrame", VALIDATION_FAILURE, Some("quad"));
    let Some((mock, _client)) = drawn(&[quad]) else {
        return;
    };
    let last = Last::of(&mock);
    assert!(last.has_depth() && last.panels == 0);
}

#[test]
fn images_with_a_layer_for_each_eye() {
    let Some((mock, _client)) = drawn(&[Change::ArrayLayers(1)]) else {
        return;
    };
    let last = Last::of(&mock);
    assert!(last.apart && last.has_depth() && last.panels == 1);
    // Two of colour, two of depth, and the panel's.
    let made = mock.calls_of("xrCreateSwapchain");
    assert_eq!(made.iter().filter(|call| call.answer >= 0).count(), 5);
}

/// A frame as the session's loop has it, with a hand that shakes or does not.
fn try_to_draw(client: &mut Client, shakes: f32, panel: bool) {
    client.xr.vibrate(Side::Right, shakes).unwrap();
    let Some(targets) = client.xr.acquire(panel).unwrap() else {
        return client.xr.end(None).unwrap();
    };
    client.submit(&targets);
    let views = client.xr.locate_views().unwrap();
    let shown = Shown {
        panel: Some((Pose::new(Vec3::new(0.0, 1.4, -0.7), Quat::IDENTITY), 0.3)),
        ..client.shown(views)
    };
    client.xr.end(Some(&shown)).unwrap();
}

#[test]
fn any_call_of_a_frame_once() {
    let Some((mock, mut client)) = drawn(&[]) else {
        return;
    };
    for call in [
        "xrPollEvent",
        "xrWaitFrame",
        "xrBeginFrame",
        "xrSyncActions",
        "xrGetActionStatePose",
        "xrGetActionStateFloat",
        "xrLocateSpace",
        "xrLocateViews",
        "xrAcquireSwapchainImage",
        "xrWaitSwapchainImage",
        "xrReleaseSwapchainImage",
        "xrEndFrame",
        "xrApplyHapticFeedback",
        "xrStopHapticFeedback",
    ] {
        mock.say(Change::refuse_once(call, VALIDATION_FAILURE));
        for shakes in [0.5, 0.0, 0.5, 0.0] {
            match client.xr.next().unwrap() {
                Turn::Frame(_) => try_to_draw(&mut client, shakes, true),
                Turn::Paused { .. } => {}
                turn => panic!("{call}: {turn:?}"),
            }
        }
        let made = mock.calls_of(call);
        let refused = made.iter().filter(|it| it.answer == VALIDATION_FAILURE);
        assert_eq!(refused.count(), 1, "{call}");
        // And then all is as before.
        let (_, others) = client.frame();
        assert!(others.is_empty(), "{call}: {others:?}");
        client.draw();
        let last = Last::of(&mock);
        assert_eq!(last.panels, 1, "{call}");
        if call != "xrEndFrame" {
            assert!(last.has_depth(), "{call}");
        }
    }
    client.assert_silent();
    // Each frame that was waited for was ended.
    let ended: Vec<u64> = mock.frames().into_iter().map(|(frame, _)| frame).collect();
    let waited = mock.calls_of("xrWaitFrame").into_iter();
    let waited = waited.filter_map(|call| call.frame.filter(|_| call.answer >= 0));
    assert_eq!(ended, waited.collect::<Vec<_>>());
}

#[test]
fn a_call_that_always_is_means_a_loss() {
    let Some((mock, mut client)) = drawn(&[]) else {
        return;
    };
    mock.say(refuse("xrLocateViews", VALIDATION_FAILURE, None));
    let mut frames = 0;
    let cause = loop {
        match client.xr.next().unwrap() {
            Turn::Frame(_) => try_to_draw(&mut client, 0.0, true),
            Turn::Lost { cause } => break cause,
            turn => panic!("{turn:?}"),
        }
        frames += 1;
        assert!(frames < 200);
    };
    assert!(cause.contains("xrLocateViews"), "{cause}");
    mock.say(Change::RefuseNothing);
    client.focus();
    client.assert_silent();
}

/// A hand at rest gets no call, and one that was vibrating is stopped once.
#[test]
fn nothing_is_said_to_a_hand_at_rest() {
    let Some((mock, mut client)) = drawn(&[]) else {
        return;
    };
    for felt in [0.0, 0.0, 0.5, 0.7, 0.0, 0.0, 0.0] {
        client.frame();
        client.xr.vibrate(Side::Left, 0.0).unwrap();
        try_to_draw(&mut client, felt, true);
    }
    client.assert_silent();
    let hands = |name: &str| {
        let calls = mock.calls_of(name).into_iter();
        calls
            .map(|call| call.with["hand"].as_i64().unwrap())
            .collect::<Vec<_>>()
    };
    assert_eq!(hands("xrApplyHapticFeedback"), [1, 1]);
    assert_eq!(hands("xrStopHapticFeedback"), [1]);
}

/// A panel that has not changed is shown as it was, without another image.
#[test]
fn a_panel_that_stays_takes_no_image() {
    let Some((mock, mut client)) = drawn(&[]) else {
        return;
    };
    let acquired = || mock.calls_of("xrAcquireSwapchainImage").len();
    let before = acquired();
    for _ in 0..5 {
        client.frame();
        try_to_draw(&mut client, 0.0, false);
    }
    client.assert_silent();
    // Colour and depth.
    assert_eq!(acquired() - before, 10);
    assert_eq!(Last::of(&mock).panels, 1);
}
