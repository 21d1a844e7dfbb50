//! Quad views that a runtime offers and then refuses.

use vitriol_tests::mock::{Change, Inset, Mock};
use vitriol_xr::depth_extent;

use crate::session::client::Client;
use crate::session::inset::{
    FOLLOWS, OF_QUAD, OF_STEREO, QUAD, begun, is_stereo, opened, shown, until_renewed,
};
use crate::session::refused::{VALIDATION_FAILURE, refuse};

/// XR_ERROR_INITIALIZATION_FAILED and XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED
const INITIALIZATION_FAILED: i32 = -6;
const UNSUPPORTED: i32 = -41;

/// A new session begins, once, with the eyes' views alone.
#[test]
fn refused_at_the_sessions_begin() {
    let begin = refuse("xrBeginSession", UNSUPPORTED, Some(&OF_QUAD.to_string()));
    let Some((mock, mut client)) = opened(&[begin]) else {
        return;
    };
    is_stereo(&mock, &mut client);
    assert_eq!(begun(&mock), [(OF_QUAD, UNSUPPORTED), (OF_STEREO, 0)]);
}

/// A client on a runtime that has no images of that many pixels.
fn without_images([width, height]: [u32; 2]) -> Option<(Mock, Client)> {
    let images = format!("{width} x {height}");
    opened(&[refuse(
        "xrCreateSwapchain",
        VALIDATION_FAILURE,
        Some(&images),
    )])
}

#[test]
fn refused_images() {
    let extent = Inset::default().following[1];
    let Some((mock, mut client)) = without_images(extent) else {
        return;
    };
    is_stereo(&mock, &mut client);
    // No session with four views was begun.
    assert_eq!(begun(&mock), [(OF_STEREO, 0)]);
}

/// The inset's depth alone is left out where it alone is refused.
#[test]
fn refused_images_of_depth() {
    let extent = depth_extent(Inset::default().following[1]);
    let Some((mock, mut client)) = without_images(extent) else {
        return;
    };
    client.drawn();
    client.assert_silent();
    let has_depth: Vec<_> = shown(&mock)
        .iter()
        .map(|view| view.depth.is_some())
        .collect();
    assert_eq!(has_depth, [true, true, false, false]);
}

/// A runtime that offers four views and takes no frame with them is given two.
#[test]
fn refused_at_every_frames_end() {
    let end = refuse("xrEndFrame", VALIDATION_FAILURE, Some("4 views"));
    let Some((mock, mut client)) = opened(&[end]) else {
        return;
    };
    let others = until_renewed(&mut client);
    assert!(
        others.iter().any(|it| it.contains("xrEndFrame")),
        "{others:?}"
    );
    client.focus();
    is_stereo(&mock, &mut client);
    assert_eq!(begun(&mock), [(OF_QUAD, 0), (OF_STEREO, 0)]);
}

/// A runtime that makes no instance with the extensions that it offers makes one without.
fn refused_with(extension: &str) {
    let instance = refuse("xrCreateInstance", INITIALIZATION_FAILED, Some(extension));
    let Some((mock, mut client)) = opened(&[instance]) else {
        return;
    };
    is_stereo(&mock, &mut client);
    assert_eq!(begun(&mock), [(OF_STEREO, 0)]);
    let made = mock.calls_of("xrCreateInstance").into_iter();
    let made: Vec<_> = made
        .map(|call| {
            let on = call.with["extensions"].as_array().unwrap().clone();
            let of_inset = on.iter().filter(|it| **it == QUAD || **it == FOLLOWS);
            (of_inset.count(), call.answer)
        })
        .collect();
    assert_eq!(made, [(2, INITIALIZATION_FAILED), (0, 0)]);
}

#[test]
fn refused_with_the_instance() {
    refused_with(QUAD);
}

#[test]
fn refused_with_the_instance_for_the_gaze() {
    refused_with(FOLLOWS);
}

/// A session that is lost for another reason has its inset again.
#[test]
fn another_call_that_is_always_refused() {
    let Some((mock, mut client)) = opened(&[]) else {
        return;
    };
    mock.say(refuse("xrSyncActions", VALIDATION_FAILURE, None));
    let others = until_renewed(&mut client);
    assert!(
        others.iter().any(|it| it.contains("xrSyncActions")),
        "{others:?}"
    );
    mock.say(Change::RefuseNothing);
    client.focus();
    client.drawn();
    client.assert_silent();
    assert_eq!(shown(&mock).len(), 4);
    assert_eq!(begun(&mock), [(OF_QUAD, 0), (OF_QUAD, 0)]);
}

/// Images that can be given back are, whichever of the images before them could not.
#[test]
fn refused_images_that_are_given_back() {
    let Some((mock, mut client)) = opened(&[]) else {
        return;
    };
    // Colour and depth of the eyes and of the inset, and the panel's.
    for refused in 1..=5 {
        mock.say(Change::Refuse {
            call: "xrReleaseSwapchainImage".to_owned(),
            answer: VALIDATION_FAILURE,
            times: Some(refused),
            when: None,
        });
        let before = mock.calls_of("xrReleaseSwapchainImage").len();
        client.drawn();
        let released = mock.calls_of("xrReleaseSwapchainImage").into_iter();
        let answers: Vec<_> = released.skip(before).map(|call| call.answer).collect();
        let wanted = [0, 1, 2, 3, 4].map(|at| match at < refused {
            true => VALIDATION_FAILURE,
            false => 0,
        });
        assert_eq!(answers, wanted);
        let (_, ended) = mock.frames().pop().unwrap();
        assert!(ended.layers.is_empty(), "{ended:?}");
        client.drawn();
        assert_eq!(shown(&mock).len(), 4);
    }
    client.assert_silent();
}
