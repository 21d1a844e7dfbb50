//! The runtime dies, and comes back.

use std::time::{Duration, Instant};

use glam::Vec3;
use vitriol_gpu::Buffer;
use vitriol_tests::monado::{self, Controller, Rig};
use vitriol_tests::program::own_name;
use vitriol_tests::wait::{PATIENCE, own_time};
use vitriol_xr::{Headset, HeadsetFrame, Side, Turn};

use crate::session::client::Client;

/// The call of a frame before which the runtime is killed.
#[derive(Clone, Copy, Debug)]
enum At {
    Acquire,
    Locate,
    End,
    Next,
}

/// Kills the runtime within a frame, starts it again, and goes on to the focus.
fn survive(rig: &mut Rig, client: &mut Client, at: At) -> HeadsetFrame {
    let kill = |rig: &mut Rig, now: At| {
        if std::mem::discriminant(&now) == std::mem::discriminant(&at) {
            rig.kill();
        }
    };
    client.frame();
    kill(rig, At::Acquire);
    // A runtime that is gone gives none.
    if let Some(targets) = client.xr.acquire(true).unwrap() {
        client.submit(&targets);
    }
    kill(rig, At::Locate);
    let views = client.xr.locate_views().unwrap();
    kill(rig, At::End);
    let shown = client.shown(views);
    client.xr.end(Some(&shown)).unwrap();
    kill(rig, At::Next);

    // A frame that was pipelined may still come.
    let begun = Instant::now();
    loop {
        assert!(begun.elapsed() < PATIENCE, "no loss: {at:?}");
        match client.xr.next().unwrap() {
            Turn::Lost { cause } => break eprintln!("{at:?}: {cause}"),
            Turn::Frame(_) => client.xr.end(None).unwrap(),
            Turn::Paused { .. } => {}
            turn => panic!("{turn:?}"),
        }
    }
    // The device goes on without the runtime: the experiment copies its data from it.
    let data = [1_u32, 2, 3, 4];
    let gpu = client.xr.gpu().clone();
    let buffer = Buffer::storage(&gpu, "particles", 16).unwrap();
    gpu.write(&buffer, &data).unwrap();
    assert_eq!(gpu.read::<u32>(&buffer).unwrap(), data);
    client.assert_silent();
    // The runtime is not there yet, and each turn reports that soon.
    for _ in 0..10 {
        let (turn, took) = own_time(|| client.xr.next().unwrap());
        assert!(matches!(turn, Turn::Lost { .. }));
        assert!(took < Duration::from_secs(2), "it took {took:?}");
    }
    rig.start();
    let (_, others) = client.frame();
    assert!(others.iter().any(|turn| turn == "renewed"), "{others:?}");
    assert_ne!(gpu.handles().device, client.xr.gpu().handles().device);
    assert_eq!(gpu.read::<u32>(&buffer).unwrap(), data);
    client.draw();
    client.focus()
}

fn open_handles() -> usize {
    std::fs::read_dir("/proc/self/fd").unwrap().count()
}

#[test]
fn a_killed_runtime_is_found_again() {
    let Some(mut rig) = monado::enter(&own_name()) else {
        return;
    };
    let mut client = Client::open();
    let hand = Controller {
        position: Vec3::new(0.25, 1.0, -0.5),
        ..Controller::default()
    };
    let drive = |rig: &Rig, client: &mut Client| {
        let mut remote = rig.remote();
        remote.controller(1, &hand);
        remote.send().unwrap();
        let mut frame = client.focus();
        for _ in 0..5 {
            frame = client.focus();
        }
        frame
    };
    let mut index = client.focus().index;
    drive(&rig, &mut client);
    let mut handles = Vec::new();
    for at in [At::Acquire, At::Locate, At::End, At::Next] {
        let frame = survive(&mut rig, &mut client, at);
        // Before the new controller's first report, the hand is where it was.
        let held = frame.poses.hand(Side::Right);
        assert!(held.active || held.stage_from_grip.position == hand.position);
        assert!(frame.index > index, "{} after {index}", frame.index);
        let frame = drive(&rig, &mut client);
        assert!(frame.poses.hand(Side::Right).active);
        assert_eq!(
            frame.poses.hand(Side::Right).stage_from_grip.position,
            hand.position
        );
        index = frame.index;
        client.assert_silent();
        handles.push(open_handles());
    }
    // The first rebuild may open what then stays open, such as the driver's cache.
    assert!(handles[3] <= handles[1], "handles grow: {handles:?}");
}
