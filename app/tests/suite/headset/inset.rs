//! The program in a headset with quad views.

use glam::{Quat, Vec3};
use vitriol_tests::mock::{self, Change, Inset, Layer, ProjectionView};
use vitriol_xr::track::load;

use crate::headset::pour::{replay, whole};
use crate::headset::program::{self, Program};

/// The projection layer of each frame that has one.
fn shown(mock: &mock::Mock) -> Vec<Vec<ProjectionView>> {
    let layers = mock
        .frames()
        .into_iter()
        .flat_map(|(_, ended)| ended.layers);
    let views = layers.filter_map(|layer| match layer {
        Layer::Projection { views, .. } => Some(views),
        _ => None,
    });
    views.collect()
}

/// It draws both pairs, the second where the user looks; says so; and what it simulates knows nothing of it.
#[test]
fn the_program_draws_the_inset_where_the_user_looks() {
    let extensions = ["XR_VARJO_quad_views", "XR_VARJO_foveated_rendering"];
    let inset = Inset {
        following: [[96, 84], [128, 70]],
        ..Inset::default()
    };
    let looks = |left| {
        let turn = Quat::from_rotation_y(left);
        Change::Gaze(Some(mock::Pose::new(Vec3::new(0.0, 1.6, 0.0), turn)))
    };
    let changes = [
        Change::offer_all_too(&extensions),
        Change::Inset(inset),
        looks(0.2),
    ];
    let name = "headset::inset::the_program_draws_the_inset_where_the_user_looks";
    let Some(mock) = mock::enter(name, &changes) else {
        return;
    };
    let scene = program::scene(mock.folder());
    let recording = mock.folder().join("session.mcap");
    let mut program = Program::start_with(&scene, &recording, &["--foveation", "eye", "--fixed"]);
    program.frames(20);
    mock.say(looks(-0.3));
    program.frames(20);
    let (report, _) = program.end();
    assert_eq!(report["inset"], serde_json::json!([128, 70]));
    assert_eq!(
        (&report["foveation"], &report["renewals"]),
        (&"eye".into(), &0.into())
    );
    let all = shown(&mock);
    let [first, last] = [&all[5], &all[all.len() - 1]];
    for (views, aside) in [(first, -0.2), (last, 0.3)] {
        let rects: Vec<_> = views.iter().map(|view| view.image.rect).collect();
        let (eyes, second) = ([0, 0, 96, 84], [0, 0, 128, 70]);
        assert_eq!(rects, [eyes, eyes, second, second]);
        for view in &views[2..] {
            let middle = 0.5 * (view.fov.left + view.fov.right);
            assert!((middle - aside).abs() < 1e-6, "{:?}", view.fov);
        }
        assert!(views.iter().all(|view| view.depth.is_some()));
    }
    let track = load(recording.to_str().unwrap()).unwrap();
    whole(&track, report["steps"].as_u64().unwrap());
    // What is recorded of the eyes is of the first pair.
    let fov = &track.frames[track.frames.len() - 2].info.fov[0];
    assert_eq!((fov.left, fov.right), (last[0].fov.left, last[0].fov.right));
    assert_eq!(report["state_hash"], replay(&track).hash.as_str());
}

mod long {
    use super::*;

    /// Where the runtime refuses to begin with four views, the session goes on with two.
    #[test]
    fn the_program_goes_on_without_the_inset() {
        let extensions = ["XR_VARJO_quad_views", "XR_VARJO_foveated_rendering"];
        let changes = [
            Change::offer_all_too(&extensions),
            Change::Refuse {
                call: "xrBeginSession".to_owned(),
                // XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED, to PRIMARY_QUAD_VARJO
                answer: -41,
                times: None,
                when: Some("1000037000".to_owned()),
            },
        ];
        let name = "headset::inset::long::the_program_goes_on_without_the_inset";
        let Some(mock) = mock::enter(name, &changes) else {
            return;
        };
        let scene = program::scene(mock.folder());
        let recording = mock.folder().join("session.mcap");
        let mut program = Program::start_with(&scene, &recording, &["--foveation", "eye"]);
        program.says("it goes on without");
        program.frames(20);
        let (report, _) = program.end();
        assert_eq!(
            (&report["inset"], &report["renewals"]),
            (&serde_json::Value::Null, &1.into())
        );
        assert_eq!(shown(&mock).pop().unwrap().len(), 2);
        let track = load(recording.to_str().unwrap()).unwrap();
        assert_eq!(report["state_hash"], replay(&track).hash.as_str());
    }
}
