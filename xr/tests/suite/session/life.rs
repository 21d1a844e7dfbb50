//! A session's beginning and end.

use std::process::Command;
use std::time::Instant;

use vitriol_tests::monado::{self, Controller};
use vitriol_tests::program::{Kept, own_name};
use vitriol_tests::wait::PATIENCE;
use vitriol_xr::{Headset, Side, Turn};

use crate::session::client::{Client, focused};

#[test]
fn an_exit_that_is_asked_for_comes() {
    let Some(_rig) = monado::enter(&own_name()) else {
        return;
    };
    let mut client = Client::open();
    client.focus();
    client.xr.request_exit().unwrap();
    // STOPPING, IDLE and EXITING follow within some frames, as soon as the runtime sends them.
    let begun = Instant::now();
    loop {
        assert!(begun.elapsed() < PATIENCE, "the end does not come");
        match client.xr.next().unwrap() {
            Turn::Frame(_) => {
                client.draw();
            }
            Turn::Ended => break,
            Turn::Paused { .. } => {}
            turn => panic!("{turn:?}"),
        }
    }
    client.assert_silent();
}

#[test]
fn every_frame_that_has_begun_is_ended() {
    let Some(_rig) = monado::enter(&own_name()) else {
        return;
    };
    let mut client = Client::open();
    let first = client.focus().index;
    // Not ended, ended without a picture, begun to be drawn and given up, drawn. The core validation layer reports a frame that begins
    // within another, and so does Monado.
    for n in 0..12 {
        let (frame, _) = client.frame();
        assert_eq!(frame.index, first + 1 + n);
        match n % 4 {
            0 => {}
            1 => client.xr.end(None).unwrap(),
            2 => {
                let targets = client.xr.acquire(true).unwrap().unwrap();
                client.submit(&targets);
            }
            _ => {
                client.draw();
            }
        }
    }
    client.assert_silent();
}

/// Marks a process of the test of the focus as the other program.
const OTHER: &str = "VITRIOL_OTHER_PROGRAM";

/// Another program in the headset, until it is killed.
fn another_program() -> ! {
    let mut other = Client::open();
    loop {
        other.frame();
        other.draw();
    }
}

/// Makes Monado show the client with that number.
fn show(client: &str) {
    let done = Command::new("monado-ctl")
        .args(["-p", client])
        .output()
        .unwrap();
    assert!(done.status.success(), "{done:?}");
}

/// Turns until one is `wanted`.
fn until(client: &mut Client, wanted: impl Fn(&Turn) -> bool) {
    let begun = Instant::now();
    while begun.elapsed() < PATIENCE {
        let turn = client.xr.next().unwrap();
        if let Turn::Frame(_) = &turn {
            client.draw();
        }
        if wanted(&turn) {
            return;
        }
        assert!(
            matches!(turn, Turn::Frame(_) | Turn::Paused { .. }),
            "{turn:?}"
        );
    }
    panic!("the turn does not come");
}

#[test]
fn the_focus_goes_to_another_program_and_comes_back() {
    if std::env::var_os(OTHER).is_some() {
        another_program();
    }
    let Some(rig) = monado::enter(&own_name()) else {
        return;
    };
    let mut client = Client::open();
    let mut remote = rig.remote();
    remote.controller(1, &Controller::default());
    remote.send().unwrap();
    let has_hand = |turn: &Turn| {
        matches!(turn, Turn::Frame(frame)
            if focused(frame) && frame.poses.hand(Side::Right).active)
    };
    until(&mut client, has_hand);
    let other = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", &own_name(), "--include-ignored"])
        .env(OTHER, "")
        // Its validation layer would empty the file of ours.
        .env(
            "XR_CORE_VALIDATION_FILE_NAME",
            rig.folder().join("other.txt"),
        )
        .spawn()
        .unwrap();
    let _other = Kept(other);
    // The newcomer is shown in our place.
    until(&mut client, |turn| matches!(turn, Turn::Paused { .. }));
    show("1");
    until(&mut client, has_hand);
    client.assert_silent();
}
