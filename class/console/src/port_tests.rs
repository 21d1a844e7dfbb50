//! Where nobody takes anything, and where every lock is held: a frame goes on, and the rest is left out.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::command::Command;
use crate::picture::MOST_PICTURE;
use crate::student::Frames;

fn state(frame: u64) -> State {
    State {
        frame,
        frames: Frames::default(),
        ..State::default()
    }
}

fn picture(codec: Codec, time_us: u64) -> Arc<EncodedPicture> {
    Arc::new(EncodedPicture {
        codec,
        is_key: false,
        size: [2, 2],
        time_us,
        bytes: vec![0; 3],
    })
}

#[test]
fn nobody_takes_anything() {
    let (port, mut feed) = pair();
    for frame in 0..100_000 {
        port.publish(state(frame));
        port.picture(picture(Codec::H264, frame));
    }
    assert_eq!(feed.take_state(), Some(state(99_999)));
    assert_eq!(feed.take_state(), None);
    let pictures = feed.take_pictures();
    let times: Vec<_> = pictures.iter().map(|(gap, p)| (*gap, p.time_us)).collect();
    let last = 100_000 - PICTURES as u64..100_000;
    // The first one that is left comes after a gap.
    let expected: Vec<_> = last
        .clone()
        .map(|time| (time == last.start, time))
        .collect();
    assert_eq!(times, expected);
}

#[test]
fn somebody_holds_every_lock() {
    let (port, mut feed) = pair();
    feed.inbox
        .order(Order {
            number: 1,
            command: Command::Reset {},
        })
        .unwrap();
    {
        let _state = lock(&feed.shared.state);
        let _pictures = lock(&feed.shared.pictures);
        let _orders = lock(&feed.inbox.orders);
        // In this very thread: a call that waited would wait for ever.
        port.publish(state(1));
        port.picture(picture(Codec::H264, 1));
        assert_eq!(port.commands(), []);
        port.wanted();
        port.take_key_request();
        port.wants_card();
        port.take_card_request();
    }
    assert_eq!(feed.take_state(), None);
    assert_eq!(port.commands().len(), 1, "the order comes a frame later");
    port.picture(picture(Codec::H264, 2));
    port.picture(picture(Codec::Jpeg, 3));
    port.picture(picture(Codec::H264, 4));
    let gaps: Vec<_> = feed.take_pictures().iter().map(|(gap, _)| *gap).collect();
    assert_eq!(gaps, [true, false, false]);
}

#[test]
fn a_student_that_takes_no_orders_has_some_refused() {
    let (port, feed) = pair();
    let order = |number| Order {
        number,
        command: Command::Reset {},
    };
    let taken = (0..1000).filter(|n| feed.inbox.order(order(*n)).is_ok());
    assert_eq!(taken.count(), ORDERS);
    let numbers: Vec<_> = port.commands().iter().map(|order| order.number).collect();
    assert_eq!(numbers, (0..ORDERS as u64).collect::<Vec<_>>());
    assert_eq!(port.commands(), []);
}

#[test]
fn a_picture_that_is_too_big_is_left_out() {
    let (port, mut feed) = pair();
    let mut big = picture(Codec::Jpeg, 0);
    Arc::get_mut(&mut big).unwrap().bytes = vec![0; MOST_PICTURE + 1];
    port.picture(big);
    assert!(feed.take_pictures().is_empty());
}

#[test]
fn the_last_port_closes() {
    let (port, feed) = pair();
    let other = port.clone();
    drop(port);
    assert!(!feed.closed());
    drop(other);
    assert!(feed.closed());
}
