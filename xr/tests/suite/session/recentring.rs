//! The runtime's own recentring, whichever space it names.

use vitriol_tests::mock::{self, Change, SpaceKind};

use crate::session::client::on_mock;

#[test]
fn it_is_heard_whichever_space_moves() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    for (n, space) in (1..).zip([SpaceKind::Local, SpaceKind::LocalFloor, SpaceKind::Stage]) {
        let origin = mock::Pose::at(0.5 * n as f32, 0.0, 0.0);
        mock.say(Change::recentre(space, origin));
        let heard = [(); 5].map(|()| {
            let (frame, others) = client.frame();
            assert!(others.is_empty(), "{others:?}");
            client.draw();
            frame.recentred
        });
        // Once, in the frame for which it holds or the next.
        assert_eq!(
            heard.iter().filter(|heard| **heard).count(),
            1,
            "{space:?}: {heard:?}"
        );
        assert!(heard[0] || heard[1], "{space:?}: {heard:?}");
    }
    client.assert_silent();
}

/// Poses leap in the frame in which the client reports it, in the space that the user recentres.
#[test]
fn poses_leap_as_it_is_told() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    let (_, ended) = mock.frames().pop().unwrap();
    let [.., mock::Layer::Projection { space, .. }] = &ended.layers[..] else {
        panic!("{ended:?}");
    };
    assert_eq!(*space, Some(SpaceKind::LocalFloor));
    // Both move, as a runtime's do.
    let origin = mock::Pose::at(2.0, 0.0, 0.0);
    mock.say(Change::recentre(SpaceKind::Local, origin));
    mock.say(Change::recentre(SpaceKind::LocalFloor, origin));
    let mut last = 0.0;
    for _ in 0..4 {
        let frame = client.drawn();
        let x = frame.poses.stage_from_view.position.x;
        assert_eq!(frame.recentred, x != last, "{x} after {last}");
        last = x;
    }
    assert_eq!(last, -2.0);
    client.assert_silent();
}
