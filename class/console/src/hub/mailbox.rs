//! Messages that wait for a page: the last class, the last state and each card's last picture, and bounded queues of answers and
//! pictures. A browser that is slow, or dead, delays nothing, and no queue grows.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Mutex;

use axum::body::Bytes;
use axum::extract::ws::Utf8Bytes;
use tokio::sync::Notify;

use crate::lock;
use crate::picture::{Codec, EncodedPicture};
use crate::pictures::Pictures;
use crate::wire::ToPage;

/// Most answers that wait. Our choice: more than a person asks for while a picture is on its way.
pub(super) const ANSWERS: usize = 64;

/// A message for a page.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Letter {
    Text(Utf8Bytes),
    Picture(Bytes),
}

#[derive(Debug, Default)]
struct Letters {
    answers: VecDeque<Utf8Bytes>,
    class: Option<Utf8Bytes>,
    state: Option<Utf8Bytes>,
    /// Pictures for cards of the class, by the student's number.
    cards: BTreeMap<u32, Bytes>,
    pictures: Pictures,
    is_closed: bool,
    left_out: u64,
}

/// How many messages wait, and how many were left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Load {
    pub waiting: usize,
    pub left_out: u64,
}

/// The messages that wait for one page.
#[derive(Debug, Default)]
pub(super) struct Mailbox {
    letters: Mutex<Letters>,
    /// Notified when a message has come.
    pub changed: Notify,
}

/// A message as JSON. Serialising it cannot fail.
pub(super) fn text(said: &ToPage) -> Utf8Bytes {
    serde_json::to_string(said).unwrap_or_default().into()
}

impl Mailbox {
    fn put(&self, with: impl FnOnce(&mut Letters)) {
        with(&mut lock(&self.letters));
        self.changed.notify_one();
    }

    /// Queues an answer.
    pub fn answer(&self, said: &ToPage) {
        self.put(|letters| {
            if letters.answers.len() >= ANSWERS {
                letters.answers.pop_front();
                letters.left_out += 1;
            }
            letters.answers.push_back(text(said));
        });
    }

    /// Replaces the class that waits.
    pub fn class(&self, class: Utf8Bytes) {
        self.put(|letters| letters.class = Some(class));
    }

    /// Replaces the state that waits.
    pub fn state(&self, state: Utf8Bytes) {
        self.put(|letters| letters.left_out += u64::from(letters.state.replace(state).is_some()));
    }

    /// Queues a picture. Returns whether a key frame is needed.
    pub fn picture(&self, gap: bool, picture: &EncodedPicture, message: Bytes) -> bool {
        let needs_key = lock(&self.letters).pictures.push(gap, picture, message);
        self.changed.notify_one();
        needs_key
    }

    /// Replaces the picture of a student's card that waits.
    pub fn card(&self, student: u32, message: Bytes) {
        self.put(|letters| {
            let replaced = letters.cards.insert(student, message);
            letters.left_out += u64::from(replaced.is_some());
        });
    }

    /// Drops what waits of the last student or kind of pictures: from here on they are others.
    pub fn restart(&self) {
        let mut letters = lock(&self.letters);
        letters.state = None;
        letters.cards.clear();
        letters.pictures.restart();
    }

    /// Closes the mailbox: nothing more is sent.
    pub fn close(&self) {
        self.put(|letters| letters.is_closed = true);
    }

    /// Takes the next message to send, short ones first. `Err` once the mailbox is closed.
    pub fn next(&self) -> Result<Option<Letter>, ()> {
        let mut letters = lock(&self.letters);
        if letters.is_closed {
            return Err(());
        }
        let text = letters.answers.pop_front();
        let text = text.or_else(|| letters.class.take());
        let text = text.or_else(|| letters.state.take());
        if let Some(text) = text {
            return Ok(Some(Letter::Text(text)));
        }
        let card = letters.cards.pop_first().map(|(_, card)| card);
        let picture = card.or_else(|| letters.pictures.pop());
        Ok(picture.map(Letter::Picture))
    }

    /// How many messages wait, and how many were left out.
    pub fn load(&self) -> Load {
        let letters = lock(&self.letters);
        let slots = usize::from(letters.class.is_some()) + usize::from(letters.state.is_some());
        Load {
            waiting: letters.answers.len() + slots + letters.cards.len() + letters.pictures.len(),
            left_out: letters.left_out + letters.pictures.left_out,
        }
    }
}

/// The student and the pictures that a page shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Looks {
    /// The student that it opened.
    pub student: Option<u32>,
    /// The pictures that it wants; `None` while the mirror is hidden.
    pub codec: Option<Codec>,
}

impl Looks {
    /// Whether it shows the class, with pictures on the cards.
    pub fn shows_cards(&self) -> bool {
        self.student.is_none() && self.codec.is_some()
    }
}
