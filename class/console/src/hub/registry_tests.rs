//! Pictures for cards of the class: who is asked for them, how often, and who gets them.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::hub::mailbox::Letter;
use crate::picture::MOST_CARD;

/// So many students, each with the inbox of its program.
fn class(registry: &Registry, count: usize) -> Vec<(Seat, Arc<Inbox>)> {
    let join = |number: usize| {
        let inbox = Arc::new(Inbox::default());
        let instance = Text::clipped(&number.to_string());
        let seat = registry.join(instance, Student::default(), inbox.clone());
        (seat.unwrap(), inbox)
    };
    (0..count).map(join).collect()
}

fn card(bytes: usize) -> EncodedPicture {
    EncodedPicture {
        codec: Codec::Card,
        is_key: true,
        size: [160, 90],
        time_us: 0,
        bytes: vec![0; bytes],
    }
}

/// A page that shows the class with pictures on the cards.
fn page(registry: &Registry) -> (u64, Arc<Mailbox>) {
    let (page, mailbox) = registry.open(1);
    let codec = Some(Codec::Jpeg);
    registry.said(page, FromPage::Pictures { codec });
    (page, mailbox)
}

/// So many ticks, in which each program answers each request with the longest picture; returns the number of requests in each.
fn tick(registry: &Registry, students: &[(Seat, Arc<Inbox>)], ticks: u64) -> Vec<usize> {
    let once = |_| {
        registry.tick(|_| true);
        let mut asked = 0;
        for (seat, inbox) in students {
            if inbox.take_card() {
                registry.picture(*seat, false, &card(MOST_CARD));
                asked += 1;
            }
        }
        asked
    };
    (0..ticks).map(once).collect()
}

/// The pictures that wait for a page.
fn taken(mailbox: &Mailbox) -> Vec<Bytes> {
    let letters = std::iter::from_fn(|| mailbox.next().unwrap());
    let pictures = letters.filter_map(|letter| match letter {
        Letter::Picture(bytes) => Some(bytes),
        Letter::Text(_) => None,
    });
    pictures.collect()
}

/// The bound that docs/console.md states: 30 pictures of 16,000 bytes in 4 s, each with 8 bytes before it, and never more than two
/// at once.
#[test]
fn a_class_of_thirty_sends_so_many_bytes_at_most() {
    let registry = Registry::default();
    let students = class(&registry, 30);
    let (_, mailbox) = page(&registry);
    let mut bytes = 0;
    for _ in 0..10 {
        let asked = tick(&registry, &students, CARD_TICKS);
        assert_eq!(asked.iter().sum::<usize>(), 30);
        assert!(asked.iter().all(|asked| *asked <= 2), "{asked:?}");
        let pictures = taken(&mailbox);
        assert_eq!(pictures.len(), 30);
        bytes += pictures.iter().map(Bytes::len).sum::<usize>();
    }
    let seconds = 10.0 * CARD_TICKS as f64 * crate::hub::TICK.as_secs_f64();
    assert_eq!(seconds, 40.0);
    assert_eq!(bytes, 10 * 30 * (16_000 + 8));
}

#[test]
fn nobody_is_asked_unless_somebody_looks() {
    let registry = Registry::default();
    let students = class(&registry, 2);
    let asked = || -> usize { tick(&registry, &students, 2 * CARD_TICKS).iter().sum() };
    assert_eq!(asked(), 0, "there is no page");
    let (page, _mailbox) = page(&registry);
    assert_eq!(asked(), 4);
    let student = students[0].0.student;
    registry.said(page, FromPage::Open { student });
    assert_eq!(asked(), 0, "it shows a student");
    registry.said(page, FromPage::Close {});
    assert_eq!(asked(), 4);
    registry.said(page, FromPage::Pictures { codec: None });
    assert_eq!(asked(), 0, "its pictures are hidden");
    let codec = Some(Codec::H264);
    registry.said(page, FromPage::Pictures { codec });
    registry.left(students[1].0);
    assert_eq!(asked(), 2, "one is not connected");
    registry.close(page);
    assert_eq!(asked(), 0, "the page is gone");
}

#[test]
fn a_picture_goes_once_for_each_request_to_who_shows_the_class() {
    let registry = Registry::default();
    let students = class(&registry, 2);
    let (_, shows) = page(&registry);
    let (other, opened) = page(&registry);
    let seat = students[0].0;
    let student = seat.student;
    registry.said(other, FromPage::Open { student });
    registry.picture(seat, false, &card(1));
    assert!(taken(&shows).is_empty(), "nobody asked for it");
    (0..CARD_TICKS).for_each(|_| registry.tick(|_| true));
    for bytes in [2, 3] {
        assert!(registry.picture(seat, false, &card(bytes)));
    }
    let pictures = taken(&shows);
    let expected = card(2).to_card(student);
    assert_eq!(pictures, [Bytes::from(expected)]);
    assert!(taken(&opened).is_empty(), "it shows a student");
}

/// The camera close to the glass is asked for while a page shows it, and only of programs that have one.
#[test]
fn a_close_up_is_wanted_of_who_offers_it() {
    let registry = Registry::default();
    let (page, _mailbox) = page(&registry);
    let codec = Some(Codec::CloseUp);
    registry.said(page, FromPage::Pictures { codec });
    for (name, close_up) in [("new", true), ("old", false)] {
        let inbox = Arc::new(Inbox::default());
        let is = Student {
            close_up,
            ..Student::default()
        };
        let seat = registry.join(Text::clipped(name), is, inbox.clone());
        let student = seat.unwrap().student;
        assert_eq!(inbox.wanted(), Wanted::default(), "{name}: it is not shown");
        registry.said(page, FromPage::Open { student });
        let wanted = Wanted {
            close_up,
            ..Wanted::default()
        };
        assert_eq!(inbox.wanted(), wanted, "{name}");
        registry.said(page, FromPage::Close {});
        assert_eq!(inbox.wanted(), Wanted::default(), "{name}: no more");
    }
}
