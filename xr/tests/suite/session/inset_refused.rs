//! Quad views that a runtime offers and then refuses.

use vitriol_tests::mock::{Change, Inset, Mock};
use vitriol_xr::depth_extent;

use crate::session::client::Client;
use crate::session::inset::{
    FOLLOWS, OF_QUAD, OF_STEREO, QUAD, begun, is_stereo, opened, shown, until_renewed,
};

/// XR_ERROR_VALIDATION_FAILURE, XR_ERROR_INITIALIZATION_FAILED and XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED
const VALIDATION_FAILURE: i32 = -1;
const INITIALIZATION_FAILED: i32 = -6;
const UNSUPPORTED: i32 = -41;

fn refuse(call: &str, answer: i32, when: &str) -> Change {
    Change::Refuse {
        call: call.to_owned(),
        answer,
        times: None,
        when: Some(when.to_owned()),
    }
}

/// A new session begins, once, with the eyes' views alone.
#[test]
fn refused_at_the_sessions_begin() {
    let name = "session::inset_refused::refused_at_the_sessions_begin";
    let changes = [
        Change::offer_all_too(&[QUAD, FOLLOWS]),
        refuse("xrBeginSession", UNSUPPORTED, &OF_QUAD.to_string()),
    ];
    let Some((mock, mut client)) = opened(name, &changes) else {
        return;
    };
    is_stereo(&mock, &mut client);
    assert_eq!(begun(&mock), [(OF_QUAD, UNSUPPORTED), (OF_STEREO, 0)]);
}

/// A client on a runtime that has no images of that many pixels.
fn without_images(name: &str, [width, height]: [u32; 2]) -> Option<(Mock, Client)> {
    let images = format!("{width} x {height}");
    let changes = [
        Change::offer_all_too(&[QUAD, FOLLOWS]),
        refuse("xrCreateSwapchain", VALIDATION_FAILURE, &images),
    ];
    opened(name, &changes)
}

#[test]
fn refused_images() {
    let name = "session::inset_refused::refused_images";
    let extent = Inset::default().following[1];
    let Some((mock, mut client)) = without_images(name, extent) else {
        return;
    };
    is_stereo(&mock, &mut client);
    // No session with four views was begun.
    assert_eq!(begun(&mock), [(OF_STEREO, 0)]);
}

/// The inset's depth alone is left out where it alone is refused.
#[test]
fn refused_images_of_depth() {
    let name = "session::inset_refused::refused_images_of_depth";
    let extent = depth_extent(Inset::default().following[1]);
    let Some((mock, mut client)) = without_images(name, extent) else {
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
    let name = "session::inset_refused::refused_at_every_frames_end";
    let changes = [
        Change::offer_all_too(&[QUAD, FOLLOWS]),
        refuse("xrEndFrame", VALIDATION_FAILURE, "4 views"),
    ];
    let Some((mock, mut client)) = opened(name, &changes) else {
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
fn refused_with(name: &str, extension: &str) {
    let changes = [
        Change::offer_all_too(&[QUAD, FOLLOWS]),
        refuse("xrCreateInstance", INITIALIZATION_FAILED, extension),
    ];
    let Some((mock, mut client)) = opened(name, &changes) else {
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
    refused_with("session::inset_refused::refused_with_the_instance", QUAD);
}

#[test]
fn refused_with_the_instance_for_the_gaze() {
    let name = "session::inset_refused::refused_with_the_instance_for_the_gaze";
    refused_with(name, FOLLOWS);
}

/// A session that is lost for another reason has its inset again.
#[test]
fn another_call_that_is_always_refused() {
    let name = "session::inset_refused::another_call_that_is_always_refused";
    let Some((mock, mut client)) = opened(name, &[Change::offer_all_too(&[QUAD, FOLLOWS])]) else {
        return;
    };
    mock.say(Change::Refuse {
        call: "xrSyncActions".to_owned(),
        answer: VALIDATION_FAILURE,
        times: None,
        when: None,
    });
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
    let name = "session::inset_refused::refused_images_that_are_given_back";
    let Some((mock, mut client)) = opened(name, &[Change::offer_all_too(&[QUAD, FOLLOWS])]) else {
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
