//! An inset that follows the gaze, where and while the runtime has that.

use glam::{Quat, Vec3};
use vitriol_tests::mock::{self, Change, Inset, Mock, SpaceKind};
use vitriol_xr::Headset;

use crate::session::inset::{about, angles, assert_near, opened, shown};

/// Where the runtime supports it, the inset is where the user looks, in the frame for which that is known, and is shown as it was drawn.
#[test]
fn it_follows_the_gaze() {
    let Some((mock, mut client)) = opened(&[]) else {
        return;
    };
    let half = Inset::default().half;
    for [left, up] in [[0.25, 0.0], [-0.1, 0.3], [0.4, -0.2]] {
        let turn = Quat::from_rotation_y(left) * Quat::from_rotation_x(up);
        mock.say(Change::Gaze(Some(mock::Pose::new(
            Vec3::new(0.0, 1.6, 0.0),
            turn,
        ))));
        client.drawn();
        let towards = turn * Vec3::NEG_Z;
        let [aside, above] = [towards.x, towards.y].map(|it| (it / -towards.z).atan());
        // A turn to the left alone is that angle.
        assert!(up != 0.0 || (aside + left).abs() < 1e-6);
        for (located, view) in client
            .xr
            .inset()
            .unwrap()
            .views
            .iter()
            .zip(&shown(&mock)[2..])
        {
            assert_near(angles(&located.fov), about(aside, above, half));
            let fov = [view.fov.left, view.fov.right, view.fov.up, view.fov.down];
            assert_eq!(fov, angles(&located.fov));
        }
    }
    client.assert_silent();
}

/// Whether each xrLocateViews since the first `before` of them asked for an inset that follows.
fn asked(mock: &Mock, before: usize) -> Vec<bool> {
    let calls = mock.calls_of("xrLocateViews").into_iter().skip(before);
    calls
        .map(|call| call.with["follows"].as_bool().unwrap())
        .collect()
}

/// The runtime is asked for an inset that follows only while it has the gaze. Without it, the inset stands ahead; its pictures stay.
#[test]
fn a_gaze_that_is_lost_and_found() {
    let Some((mock, mut client)) = opened(&[]) else {
        return;
    };
    let half = Inset::default().half;
    for left in [Some(0.25), None, Some(-0.1), None] {
        let before = asked(&mock, 0).len();
        mock.say(Change::Gaze(left.map(|left| {
            mock::Pose::new(Vec3::new(0.0, 1.6, 0.0), Quat::from_rotation_y(left))
        })));
        client.drawn();
        let asked = asked(&mock, before);
        assert!(!asked.is_empty());
        assert!(asked.iter().all(|it| *it == left.is_some()), "{asked:?}");
        let inset = client.xr.inset().unwrap();
        assert_eq!(inset.extent, Inset::default().following[1]);
        let aside = left.map_or(0.0, |left| -left);
        for view in inset.views {
            assert_near(angles(&view.fov), about(aside, 0.0, half));
        }
        assert_eq!(shown(&mock).len(), 4);
    }
    client.assert_silent();
}

/// Without the gaze's space it is not known whether there is a gaze: the inset stands ahead, and all else is as it was.
#[test]
fn it_stays_without_the_gazes_space() {
    let looks = mock::Pose::new(Vec3::new(0.0, 1.6, 0.0), Quat::from_rotation_y(0.25));
    let changes = [
        Change::Offer {
            spaces: vec![SpaceKind::View, SpaceKind::Local, SpaceKind::Stage],
        },
        Change::Gaze(Some(looks)),
    ];
    let Some((mock, mut client)) = opened(&changes) else {
        return;
    };
    client.drawn();
    client.assert_silent();
    let asked = asked(&mock, 0);
    assert!(!asked.is_empty() && asked.iter().all(|it| !it), "{asked:?}");
    assert_eq!(client.xr.extent(), Inset::default().following[0]);
    let inset = client.xr.inset().unwrap();
    assert_eq!(inset.extent, Inset::default().following[1]);
    for view in inset.views {
        assert_near(angles(&view.fov), about(0.0, 0.0, Inset::default().half));
    }
    assert_eq!(shown(&mock).len(), 4);
}
