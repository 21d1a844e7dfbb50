//! Quad views that a runtime offers and then refuses.

use vitriol_tests::mock::{Change, Inset};

use crate::inset::{FOLLOWS, OF_QUAD, OF_STEREO, QUAD, begun, is_stereo, opened, shown};

/// XR_ERROR_VALIDATION_FAILURE and XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED
const VALIDATION_FAILURE: i32 = -1;
const UNSUPPORTED: i32 = -41;

fn refuse(call: &str, answer: i32, when: &str) -> Change {
    Change::Refuse {
        call: call.to_owned(),
        answer,
        times: None,
        when: Some(when.to_owned()),
    }
}

/// The session is sought again, once, with the eyes' views alone.
#[test]
fn refused_at_the_sessions_begin() {
    let name = "inset_refused::refused_at_the_sessions_begin";
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

#[test]
fn refused_images() {
    let name = "inset_refused::refused_images";
    let [width, height] = Inset::default().following[1];
    let changes = [
        Change::offer_all_too(&[QUAD, FOLLOWS]),
        refuse(
            "xrCreateSwapchain",
            VALIDATION_FAILURE,
            &format!("{width} x {height}"),
        ),
    ];
    let Some((mock, mut client)) = opened(name, &changes) else {
        return;
    };
    is_stereo(&mock, &mut client);
    // Nothing of it was begun.
    assert_eq!(begun(&mock), [(OF_STEREO, 0)]);
}

/// The inset's depth alone is left out where it alone is refused.
#[test]
fn refused_images_of_depth() {
    let name = "inset_refused::refused_images_of_depth";
    let [width, height] = Inset::default().following[1].map(|side| side.div_ceil(2));
    let changes = [
        Change::offer_all_too(&[QUAD, FOLLOWS]),
        refuse(
            "xrCreateSwapchain",
            VALIDATION_FAILURE,
            &format!("{width} x {height}"),
        ),
    ];
    let Some((mock, mut client)) = opened(name, &changes) else {
        return;
    };
    client.frame();
    client.draw();
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
    let name = "inset_refused::refused_at_every_frames_end";
    let changes = [
        Change::offer_all_too(&[QUAD, FOLLOWS]),
        refuse("xrEndFrame", VALIDATION_FAILURE, "4 views"),
    ];
    let Some((mock, mut client)) = opened(name, &changes) else {
        return;
    };
    let mut others = Vec::new();
    for _ in 0..200 {
        let (_, more) = client.frame();
        client.draw();
        others.extend(more);
        if others.iter().any(|it| it == "renewed") {
            break;
        }
    }
    assert!(
        others.iter().any(|it| it.contains("xrEndFrame")),
        "{others:?}"
    );
    client.focus();
    is_stereo(&mock, &mut client);
    assert_eq!(begun(&mock), [(OF_QUAD, 0), (OF_STEREO, 0)]);
}
