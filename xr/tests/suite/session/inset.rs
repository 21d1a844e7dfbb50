//! The runtime's own foveation: a second pair of views (quad views).

use glam::{Quat, Vec3};
use vitriol_tests::gpu::read_back;
use vitriol_tests::mock::{self, Change, Inset, Layer, Mock, ProjectionView};
use vitriol_xr::{Fov, Headset, HeadsetError, Shown};

use crate::session::client::{Client, EYES, INSET, enter, hurried, on_mock};

pub const QUAD: &str = "XR_VARJO_quad_views";
pub const FOLLOWS: &str = "XR_VARJO_foveated_rendering";

/// XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO and XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO
pub const OF_STEREO: i32 = 2;
pub const OF_QUAD: i32 = 1_000_037_000;

/// Size of the eyes' pictures where nothing is foveated.
const STEREO: [u32; 2] = [64, 48];

/// A client that asks for the inset and has the focus, on a runtime that offers both extensions and then begins with `changes`.
pub fn opened(changes: &[Change]) -> Option<(Mock, Client)> {
    let both = Change::offer_all_too(&[QUAD, FOLLOWS]);
    let mock = enter(&[&[both][..], changes].concat())?;
    let mut client = Client::open_with(true);
    client.focus();
    Some((mock, client))
}

/// View configurations of the sessions that were begun, and the runtime's answers.
pub fn begun(mock: &Mock) -> Vec<(i32, i32)> {
    let calls = mock.calls_of("xrBeginSession").into_iter();
    calls
        .map(|call| (call.with["views"].as_i64().unwrap() as i32, call.answer))
        .collect()
}

/// The views of the last frame.
pub fn shown(mock: &Mock) -> Vec<ProjectionView> {
    let (_, ended) = mock.frames().pop().unwrap();
    let found = ended.layers.into_iter().find_map(|layer| match layer {
        Layer::Projection { views, .. } => Some(views),
        _ => None,
    });
    found.unwrap()
}

/// Draws a frame, which has the two views of a session without an inset.
pub fn is_stereo(mock: &Mock, client: &mut Client) {
    assert_eq!(client.xr.extent(), STEREO);
    assert_eq!(client.xr.inset(), None);
    let (frame, _) = client.frame();
    assert!(frame.should_render);
    client.draw();
    client.assert_silent();
    assert_eq!(shown(mock).len(), 2);
}

/// Draws frames until the session was made anew; the other turns are returned in words.
pub fn until_renewed(client: &mut Client) -> Vec<String> {
    let mut others = Vec::new();
    for _ in 0..200 {
        let (_, more) = client.frame();
        client.draw();
        others.extend(more);
        if others.iter().any(|it| it == "renewed") {
            break;
        }
    }
    others
}

pub fn angles(fov: &Fov) -> [f32; 4] {
    [fov.left, fov.right, fov.up, fov.down]
}

/// Angles of a field of view as the runtime makes it, `half` about a middle that is `aside` to the right and `above` up, rad.
pub fn about(aside: f32, above: f32, half: f32) -> [f32; 4] {
    [
        aside - half,
        aside + half,
        above + 0.75 * half,
        above - 0.75 * half,
    ]
}

pub fn assert_near(found: [f32; 4], wanted: [f32; 4]) {
    // Rounding of f32 about 1.
    let near = found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-6);
    assert!(near, "{found:?}, {wanted:?}");
}

/// Both pairs are in one layer, each with its views, its part of its own images, and its depth.
#[test]
fn both_pairs_are_shown() {
    let Some((mock, mut client)) = opened(&[]) else {
        return;
    };
    assert_eq!(begun(&mock), [(OF_QUAD, 0)]);
    let [eyes, inset] = Inset::default().following;
    assert_eq!(client.xr.extent(), eyes);
    client.frame();
    let targets = client.xr.acquire(true).unwrap().unwrap();
    client.submit(&targets);
    let (views, second) = (
        client.xr.locate_views().unwrap(),
        client.xr.inset().unwrap(),
    );
    assert_eq!(second.extent, inset);
    let of_inset = targets.inset.unwrap();
    let gpu = client.xr.gpu().clone();
    for (image, extent, colour) in [
        (&targets.colour, eyes, EYES),
        (&of_inset.colour, inset, INSET),
    ] {
        let found: Vec<[u8; 4]> = read_back(&gpu, image).get().unwrap();
        assert_eq!(found.len() as u32, 2 * extent[0] * extent[1]);
        assert!(found.iter().all(|pixel| *pixel == colour));
    }
    let near = 0.05;
    client
        .xr
        .end(Some(&Shown {
            views,
            extent: hurried(eyes),
            inset: Some(vitriol_xr::Inset {
                extent: hurried(inset),
                ..second
            }),
            near,
            panel: None,
        }))
        .unwrap();
    client.assert_silent();
    let all = shown(&mock);
    assert_eq!(all.len(), 4);
    for (index, (view, located)) in all
        .iter()
        .zip(views.iter().chain(&second.views))
        .enumerate()
    {
        let (eye, extent) = (index as u32 % 2, hurried([eyes, inset][index / 2]));
        let fov = [view.fov.left, view.fov.right, view.fov.up, view.fov.down];
        assert_eq!(fov, angles(&located.fov), "view {index}");
        assert_eq!(view.pose.position, located.stage_from_eye.position);
        let [width, height] = extent.map(|side| side as i32);
        assert_eq!(
            (view.image.layer, view.image.rect),
            (eye, [0, 0, width, height])
        );
        let depth = view.depth.unwrap();
        let [width, height] = extent.map(|side| side.div_ceil(2) as i32);
        assert_eq!(
            (depth.image.layer, depth.image.rect),
            (eye, [0, 0, width, height])
        );
        assert_eq!((depth.far, depth.near), (near, f32::INFINITY));
    }
    // Two of colour, two of depth.
    let chains = [
        all[0].image,
        all[2].image,
        all[0].depth.unwrap().image,
        all[2].depth.unwrap().image,
    ];
    let mut chains = chains.map(|part| part.swapchain).to_vec();
    chains.sort_unstable();
    chains.dedup();
    assert_eq!(chains.len(), 4);
}

/// Without the second extension, and in a headset that cannot follow, the inset is where the runtime puts it, and of the size that the
/// runtime gives for that.
fn stays(changes: &[Change]) {
    let looks = mock::Pose::new(Vec3::new(0.0, 1.6, 0.0), Quat::from_rotation_y(0.25));
    let changes = [changes, &[Change::Gaze(Some(looks))]].concat();
    let Some((mock, mut client)) = opened(&changes) else {
        return;
    };
    assert_eq!(begun(&mock), [(OF_QUAD, 0)]);
    assert_eq!(client.xr.extent(), STEREO);
    client.drawn();
    client.assert_silent();
    let inset = client.xr.inset().unwrap();
    assert_eq!(inset.extent, Inset::default().extent);
    let half = Inset::default().half;
    for view in inset.views {
        assert_near(angles(&view.fov), about(0.0, 0.0, half));
    }
    assert_eq!(shown(&mock).len(), 4);
}

#[test]
fn it_stays_without_foveated_rendering() {
    stays(&[Change::offer_too(QUAD)]);
}

#[test]
fn it_stays_in_a_headset_without_eye_tracking() {
    let cannot = Inset {
        follows: false,
        ..Inset::default()
    };
    stays(&[Change::Inset(cannot)]);
}

#[test]
fn none_is_had_where_none_is_offered() {
    // The one extension is of no use without the other.
    let Some((mock, mut client)) = opened(&[Change::offer_too(FOLLOWS)]) else {
        return;
    };
    is_stereo(&mock, &mut client);
    assert_eq!(begun(&mock), [(OF_STEREO, 0)]);
    assert_eq!(extensions(&mock), 0);
}

/// How many of the two extensions the instance was made with.
fn extensions(mock: &Mock) -> usize {
    let with = &mock.calls_of("xrCreateInstance")[0].with["extensions"];
    let on = with.as_array().unwrap().iter();
    on.filter(|it| **it == QUAD || **it == FOLLOWS).count()
}

#[test]
fn none_is_had_where_none_is_asked_for() {
    let Some((mock, mut client)) = on_mock(&[Change::offer_all_too(&[QUAD, FOLLOWS])]) else {
        return;
    };
    is_stereo(&mock, &mut client);
    assert_eq!(begun(&mock), [(OF_STEREO, 0)]);
    assert_eq!(extensions(&mock), 0);
}

/// Images without layers: eight swapchains beside the panel's.
#[test]
fn images_with_one_layer() {
    let Some((mock, mut client)) = opened(&[Change::ArrayLayers(1)]) else {
        return;
    };
    client.drawn();
    client.assert_silent();
    let views = shown(&mock);
    assert_eq!(views.len(), 4);
    let parts = views
        .iter()
        .flat_map(|view| [view.image, view.depth.unwrap().image]);
    let mut chains: Vec<_> = parts.map(|part| part.swapchain).collect();
    chains.sort_unstable();
    chains.dedup();
    assert_eq!(chains.len(), 8);
}

/// Neither three views nor pictures without pixels are an inset.
fn is_none(inset: Inset) {
    let Some((mock, mut client)) = opened(&[Change::Inset(inset)]) else {
        return;
    };
    is_stereo(&mock, &mut client);
    assert_eq!(begun(&mock), [(OF_STEREO, 0)]);
}

#[test]
fn three_views_are_none() {
    let three = Inset {
        views: 3,
        ..Inset::default()
    };
    is_none(three);
}

#[test]
fn five_views_are_none() {
    let five = Inset {
        views: 5,
        ..Inset::default()
    };
    is_none(five);
}

#[test]
fn pictures_without_pixels_are_none() {
    let empty = Inset {
        following: [[32, 28], [0, 20]],
        ..Inset::default()
    };
    is_none(empty);
}

/// A session whose runtime gives three views in the middle of it ends, and a new one begins without an inset.
#[test]
fn three_views_in_the_middle() {
    let Some((mock, mut client)) = opened(&[]) else {
        return;
    };
    mock.say(Change::Inset(Inset {
        views: 3,
        ..Inset::default()
    }));
    let others = until_renewed(&mut client);
    let said = others.iter().any(|it| it.contains("xrLocateViews"));
    assert!(said, "{others:?}");
    client.focus();
    is_stereo(&mock, &mut client);
}

/// An invalid field of view is not used: at first the inset is all of each eye's picture, later it keeps its last field of view.
#[test]
fn an_empty_field_of_view() {
    let sees = |half| {
        Change::Inset(Inset {
            half,
            ..Inset::default()
        })
    };
    let Some((mock, mut client)) = opened(&[sees(0.0)]) else {
        return;
    };
    let frame = |client: &mut Client| {
        client.drawn();
        client.xr.inset().unwrap().views
    };
    let inset = frame(&mut client);
    let eyes = &shown(&mock)[..2];
    for (eye, inset) in eyes.iter().zip(inset) {
        let fov = [eye.fov.left, eye.fov.right, eye.fov.up, eye.fov.down];
        assert_eq!(angles(&inset.fov), fov);
    }
    for (half, wanted) in [(0.3, 0.3), (0.0, 0.3), (f32::NAN, 0.3), (0.1, 0.1)] {
        mock.say(sees(half));
        let inset = frame(&mut client);
        assert_near(angles(&inset[0].fov), about(0.0, 0.0, wanted));
        assert_eq!(shown(&mock).len(), 4);
    }
    client.assert_silent();
}

/// A program that has no picture for the inset shows nothing and gets an error. The runtime is not blamed, and the session stays.
#[test]
fn a_frame_without_it_is_ended_without_a_picture() {
    let Some((mock, mut client)) = opened(&[]) else {
        return;
    };
    // More such frames than a session allows refused ones in a row.
    for _ in 0..100 {
        let (_, others) = client.frame();
        assert!(others.is_empty(), "{others:?}");
        let targets = client.xr.acquire(true).unwrap().unwrap();
        client.submit(&targets);
        let views = client.xr.locate_views().unwrap();
        let lacks = Shown {
            inset: None,
            ..client.shown(views)
        };
        let ended = client.xr.end(Some(&lacks));
        assert!(matches!(ended, Err(HeadsetError::NoInset)), "{ended:?}");
        let (_, ended) = mock.frames().pop().unwrap();
        assert!(ended.layers.is_empty(), "{ended:?}");
    }
    client.drawn();
    client.assert_silent();
    assert_eq!(shown(&mock).len(), 4);
}
