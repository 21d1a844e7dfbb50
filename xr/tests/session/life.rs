//! A session's beginning and end.

use vitriol_tests::monado;
use vitriol_xr::{Headset, Turn};

use crate::client::Client;

#[test]
fn an_exit_that_is_asked_for_comes() {
    let Some(_rig) = monado::enter("life::an_exit_that_is_asked_for_comes") else {
        return;
    };
    let mut client = Client::open();
    client.focus();
    client.xr.request_exit().unwrap();
    // STOPPING, IDLE and EXITING follow within some frames.
    let mut turns = 0;
    loop {
        turns += 1;
        assert!(turns < 200, "the end does not come");
        match client.xr.next().unwrap() {
            Turn::Frame(_) => {
                client.draw();
            }
            Turn::Ended => break,
            Turn::Paused => {}
            turn => panic!("{turn:?}"),
        }
    }
    client.assert_silent();
}

#[test]
fn every_frame_that_has_begun_is_ended() {
    let Some(_rig) = monado::enter("life::every_frame_that_has_begun_is_ended") else {
        return;
    };
    let mut client = Client::open();
    let first = client.focus().index;
    // Not ended, ended without a picture, begun to be drawn and given up, drawn. The core
    // validation layer tells of a frame that begins within another, and so does Monado.
    for n in 0..12 {
        let (frame, _) = client.frame();
        assert_eq!(frame.index, first + 1 + n);
        match n % 4 {
            0 => {}
            1 => client.xr.end(None).unwrap(),
            2 => {
                let targets = client.xr.acquire().unwrap();
                client.submit(&targets);
            }
            _ => {
                client.draw();
            }
        }
    }
    client.assert_silent();
}
