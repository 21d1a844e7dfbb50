//! The students and pages that are connected, and the messages between them. Everything here is short: a lock is held for no longer than a
//! walk through the class takes, and no frame ever waits for it.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use axum::body::Bytes;
use axum::extract::ws::Utf8Bytes;

use super::mailbox::{Load, Looks, Mailbox, text};
use crate::auth::SessionId;
use crate::bounded::Text;
use crate::command::{Command, Order};
use crate::lock;
use crate::picture::{Codec, EncodedPicture};
use crate::port::{Inbox, Wanted};
use crate::student::{NAME, State, Student};
use crate::wire::{Brief, FromPage, ToPage};

/// Students at a time. Our choice: more than a class has.
pub(super) const STUDENTS: usize = 64;

/// Ticks of the hub between two pictures of a student's card: 4 s. Our choice: a glance shows who has stopped, and a class of 30 sends
/// 120 kB/s at most.
const CARD_TICKS: u64 = 16;

/// A student's connection: the student's number, and the connection's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Seat {
    student: u32,
    connection: u64,
}

struct Entry {
    instance: Text<NAME>,
    is: Student,
    inbox: Arc<Inbox>,
    /// `None` while it is not connected.
    connection: Option<u64>,
    state: Option<State>,
    ordered: u64,
    /// Whether a picture for its card was asked for and has not come.
    awaits_card: bool,
}

struct Page {
    session: SessionId,
    looks: Looks,
    mailbox: Arc<Mailbox>,
}

#[derive(Default)]
struct Inner {
    students: BTreeMap<u32, Entry>,
    pages: BTreeMap<u64, Page>,
    /// The last number given to a student, to a connection and to a page.
    numbers: [u64; 3],
    class: Utf8Bytes,
    ticks: u64,
}

/// The students and pages of a hub; routes states, pictures and orders between them.
#[derive(Default)]
pub(super) struct Registry(Mutex<Inner>);

impl Registry {
    /// Registers a student's program that has connected, or has connected again; `None` where there are too many.
    pub fn join(&self, instance: Text<NAME>, is: Student, inbox: Arc<Inbox>) -> Option<Seat> {
        let inner = &mut *lock(&self.0);
        let known = inner.students.iter();
        let known = known.filter(|(_, entry)| entry.instance == instance);
        let known = known.map(|(student, _)| *student).next();
        if known.is_none() && inner.students.len() >= STUDENTS {
            // A student that is not connected makes place.
            let mut away = inner
                .students
                .iter()
                .filter(|(_, e)| e.connection.is_none());
            let gone = away.next().map(|(student, _)| *student)?;
            inner.students.remove(&gone);
        }
        inner.numbers[1] += 1;
        let connection = inner.numbers[1];
        let student = known.unwrap_or_else(|| {
            inner.numbers[0] += 1;
            inner.numbers[0] as u32
        });
        let entry = Entry {
            instance,
            is,
            inbox,
            connection: Some(connection),
            state: None,
            // A program's states have the number of the last order that it did, over all its connections.
            ordered: inner.students.get(&student).map_or(0, |e| e.ordered),
            awaits_card: false,
        };
        inner.students.insert(student, entry);
        inner.open_again(student);
        inner.settle(student);
        Some(Seat {
            student,
            connection,
        })
    }

    /// Marks a student's program as not connected.
    pub fn left(&self, seat: Seat) {
        let inner = &mut *lock(&self.0);
        if let Some(entry) = inner.at(seat) {
            entry.connection = None;
        }
    }

    /// Takes a student's state. Returns whether this is still the student's present connection.
    pub fn state(&self, seat: Seat, state: State) -> bool {
        let inner = &mut *lock(&self.0);
        let Some(entry) = inner.at(seat) else {
            return false;
        };
        entry.state = Some(state.clone());
        let student = seat.student;
        let state = Box::new(state);
        let mut said = None;
        for page in inner.pages.values() {
            if page.looks.student == Some(student) {
                let said = said.get_or_insert_with(|| {
                    let state = state.clone();
                    text(&ToPage::State { student, state })
                });
                page.mailbox.state(said.clone());
            }
        }
        true
    }

    /// Takes a picture of a student's view; `gap`: one of H.264 is missing before it. Returns whether this is still the student's present
    /// connection.
    pub fn picture(&self, seat: Seat, gap: bool, picture: &EncodedPicture) -> bool {
        let inner = &mut *lock(&self.0);
        let Some(entry) = inner.at(seat) else {
            return false;
        };
        if picture.codec == Codec::Card {
            // One that nobody asked for is not passed on, so that the bytes for a page have a bound.
            if std::mem::take(&mut entry.awaits_card) {
                inner.show_card(seat.student, picture);
            }
            return true;
        }
        let mut message = None;
        let mut needs_key = false;
        for page in inner.pages.values() {
            let looks = Looks {
                student: Some(seat.student),
                codec: Some(picture.codec),
            };
            if page.looks == looks {
                let message = message.get_or_insert_with(|| Bytes::from(picture.to_message()));
                needs_key |= page.mailbox.picture(gap, picture, message.clone());
            }
        }
        if needs_key && let Some(entry) = inner.at(seat) {
            entry.inbox.ask_key();
        }
        true
    }

    /// Registers a page.
    pub fn open(&self, session: SessionId) -> (u64, Arc<Mailbox>) {
        let inner = &mut *lock(&self.0);
        inner.numbers[2] += 1;
        let mailbox = Arc::new(Mailbox::default());
        mailbox.class(inner.class());
        let page = Page {
            session,
            looks: Looks::default(),
            mailbox: mailbox.clone(),
        };
        inner.pages.insert(inner.numbers[2], page);
        (inner.numbers[2], mailbox)
    }

    /// Removes a page.
    pub fn close(&self, page: u64) {
        let inner = &mut *lock(&self.0);
        if let Some(page) = inner.pages.remove(&page)
            && let Some(student) = page.looks.student
        {
            inner.settle(student);
        }
    }

    /// Handles a message of a page, other than [`FromPage::Invite`].
    pub fn said(&self, page: u64, said: FromPage) {
        let inner = &mut *lock(&self.0);
        let Some(looks) = inner.pages.get(&page).map(|page| page.looks) else {
            return;
        };
        match said {
            FromPage::Open { student } => inner.looks(page, Some(student), looks.codec),
            FromPage::Close {} => inner.looks(page, None, looks.codec),
            FromPage::Pictures { codec } => inner.looks(page, looks.student, codec),
            FromPage::Lost {} => inner.looks(page, looks.student, looks.codec),
            FromPage::Order {
                echo,
                student,
                command,
            } => {
                let answer = match inner.order(student, command) {
                    Ok(number) => ToPage::Ordered { echo, number },
                    Err(why) => ToPage::Refused {
                        echo: Some(echo),
                        why,
                    },
                };
                inner.answer(page, &answer);
            }
            FromPage::OrderAll { echo, command } => inner.order_all(page, echo, &command),
            FromPage::Invite {} => {}
        }
    }

    /// Sends the class to all pages if it has changed, closes those whose session is not open any more, and asks for pictures of cards.
    pub fn tick(&self, is_open: impl Fn(SessionId) -> bool) {
        let inner = &mut *lock(&self.0);
        let class = inner.class();
        let changed = class != inner.class;
        for page in inner.pages.values() {
            if !is_open(page.session) {
                page.mailbox.close();
            } else if changed {
                page.mailbox.class(class.clone());
            }
        }
        inner.class = class;
        inner.ask_cards();
    }

    /// Number of students, number of pages, and the load of each page.
    pub fn counts(&self) -> (usize, usize, Vec<Load>) {
        let inner = lock(&self.0);
        let here = inner.here();
        let loads: Vec<_> = inner
            .pages
            .values()
            .map(|page| page.mailbox.load())
            .collect();
        (here.count(), loads.len(), loads)
    }
}

impl Inner {
    /// The entry of a connection that has not been superseded.
    fn at(&mut self, seat: Seat) -> Option<&mut Entry> {
        let entry = self.students.get_mut(&seat.student)?;
        (entry.connection == Some(seat.connection)).then_some(entry)
    }

    fn class(&self) -> Utf8Bytes {
        let brief = |(student, entry): (&u32, &Entry)| {
            let here = entry.connection.is_some();
            Brief::new(*student, entry.is.name.clone(), here, entry.state.as_ref())
        };
        let mut offered = self.here().map(|(_, entry)| &entry.is.choices);
        let first = offered.next();
        let choices = first.filter(|first| offered.all(|other| other == *first));
        text(&ToPage::Class {
            students: self.students.iter().map(brief).collect(),
            choices: choices.cloned().unwrap_or_default(),
        })
    }

    /// Asks for pictures of the cards whose turn it is, where some page shows them. Students take turns, so that a class's pictures do not
    /// come at once.
    fn ask_cards(&mut self) {
        self.ticks += 1;
        if !self.pages.values().any(|page| page.looks.shows_cards()) {
            return;
        }
        for (student, entry) in &mut self.students {
            let is_due = (self.ticks + u64::from(*student)).is_multiple_of(CARD_TICKS);
            if is_due && entry.connection.is_some() {
                entry.awaits_card = true;
                entry.inbox.ask_card();
            }
        }
    }

    /// Sends a student's picture to the pages that show its card.
    fn show_card(&self, student: u32, picture: &EncodedPicture) {
        let message = Bytes::from(picture.to_card(student));
        for page in self.pages.values() {
            if page.looks.shows_cards() {
                page.mailbox.card(student, message.clone());
            }
        }
    }

    /// Sets which pictures of a student are wanted, by the pages that show it.
    fn settle(&self, student: u32) {
        let Some(entry) = self.students.get(&student) else {
            return;
        };
        let looked_at = |codec| {
            let looks = Looks {
                student: Some(student),
                codec: Some(codec),
            };
            self.pages.values().any(|page| page.looks == looks)
        };
        entry.inbox.want(Wanted {
            h264: looked_at(Codec::H264),
            jpeg: looked_at(Codec::Jpeg),
            // A program that does not offer them would refuse the message.
            close_up: entry.is.close_up && looked_at(Codec::CloseUp),
        });
    }

    /// Sets the student and the pictures that a page shows from now on.
    fn looks(&mut self, page: u64, student: Option<u32>, codec: Option<Codec>) {
        let Some(page) = self.pages.get_mut(&page) else {
            return;
        };
        let before = std::mem::replace(&mut page.looks, Looks { student, codec });
        page.mailbox.restart();
        let entry = student.and_then(|student| Some((student, self.students.get(&student)?)));
        if let Some((student, entry)) = entry {
            if before.student != Some(student) {
                page.mailbox.answer(&opened(student, entry));
            }
            if let Some(state) = entry.state.clone() {
                let state = Box::new(state);
                page.mailbox.state(text(&ToPage::State { student, state }));
            }
            if codec == Some(Codec::H264) {
                entry.inbox.ask_key();
            }
        } else if student.is_some() {
            page.looks.student = None;
            page.mailbox.answer(&ToPage::Refused {
                echo: None,
                why: "there is no such student any more",
            });
        }
        for student in [before.student, student].into_iter().flatten() {
            self.settle(student);
        }
    }

    /// Opens a student that has connected again anew: it has a new stream, and may be another version.
    fn open_again(&self, student: u32) {
        let Some(entry) = self.students.get(&student) else {
            return;
        };
        for page in self.pages.values() {
            if page.looks.student == Some(student) {
                page.mailbox.restart();
                page.mailbox.answer(&opened(student, entry));
                entry.inbox.ask_key();
            }
        }
    }

    /// The students that are connected, by their numbers.
    fn here(&self) -> impl Iterator<Item = (u32, &Entry)> {
        let entries = self
            .students
            .iter()
            .map(|(student, entry)| (*student, entry));
        entries.filter(|(_, entry)| entry.connection.is_some())
    }

    fn answer(&self, page: u64, answer: &ToPage) {
        if let Some(page) = self.pages.get(&page) {
            page.mailbox.answer(answer);
        }
    }

    /// Passes an order on to a student; returns the order's number, or the reason why it is refused.
    fn order(&mut self, student: u32, command: Command) -> Result<u64, &'static str> {
        let entry = self.students.get_mut(&student);
        let entry = entry.filter(|entry| entry.connection.is_some());
        let entry = entry.ok_or("this student is not connected")?;
        command.check(&entry.is)?;
        // A program may have had orders of another hub before.
        let done = entry.state.as_ref().map_or(0, |state| state.done);
        let number = entry.ordered.max(done).saturating_add(1);
        let queued = entry.inbox.order(Order { number, command });
        queued.map_err(|_| "the student's program takes no orders at the moment")?;
        entry.ordered = number;
        Ok(number)
    }

    /// Passes an order on to each student that is connected.
    fn order_all(&mut self, page: u64, echo: u32, command: &Command) {
        let here: Vec<_> = self.here().map(|(student, _)| student).collect();
        let [mut given, mut refused] = [0, 0];
        for student in here {
            match self.order(student, command.clone()) {
                Ok(_) => given += 1,
                Err(_) => refused += 1,
            }
        }
        self.answer(
            page,
            &ToPage::OrderedAll {
                echo,
                given,
                refused,
            },
        );
    }
}

fn opened(student: u32, entry: &Entry) -> ToPage {
    ToPage::Opened {
        student,
        is: entry.is.clone(),
    }
}

#[cfg(test)]
#[path = "registry_tests.rs"]
mod tests;
