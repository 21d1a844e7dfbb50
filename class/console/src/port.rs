//! The student's end of the console, for a loop of frames: nothing here waits.
//!
//! A frame takes a lock only where it is free ([`Mutex::try_lock`]), and otherwise goes on without: its state is replaced by the next
//! frame's anyway, a picture is left out, an order comes a frame later. Queues are bounded, and drop their oldest item. The other end is
//! woken by [`Thread::unpark`], which does not wait either.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock};
use std::thread::Thread;
use std::time::Duration;

use tokio::sync::Notify;

use crate::command::Order;
use crate::lock;
use crate::picture::{Codec, EncodedPicture};
use crate::student::State;

/// Most pictures that wait for the console. Our choice: a tenth of a second at 72 a second.
pub const PICTURES: usize = 8;
/// Most orders that wait for a frame. Our choice: more than anyone gives within one.
pub const ORDERS: usize = 32;

const WANT_H264: u8 = 1;
const WANT_JPEG: u8 = 2;
const WANT_CLOSE_UP: u8 = 4;

/// Which kinds of pictures some page shows: others need not be coded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// Whether pictures in H.264 are wanted.
    pub h264: bool,
    /// Whether pictures in JPEG are wanted.
    pub jpeg: bool,
    /// Whether pictures of the glass from close by are wanted.
    pub close_up: bool,
}

/// Orders and requests for pictures on their way to a student.
#[derive(Debug, Default)]
pub(crate) struct Inbox {
    orders: Mutex<VecDeque<Order>>,
    wanted: AtomicU8,
    key: AtomicBool,
    card: AtomicBool,
    /// Notified when something has come, for a student that is reached by a socket.
    pub changed: Notify,
}

/// The queue of orders is full: the student's program takes none.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Full;

impl Inbox {
    /// Queues an order.
    pub fn order(&self, order: Order) -> Result<(), Full> {
        let mut orders = lock(&self.orders);
        if orders.len() >= ORDERS {
            return Err(Full);
        }
        orders.push_back(order);
        drop(orders);
        self.changed.notify_one();
        Ok(())
    }

    /// Takes all orders that wait. For the console's side: it may wait for the lock.
    pub fn take_orders(&self) -> Vec<Order> {
        lock(&self.orders).drain(..).collect()
    }

    /// Sets which pictures are wanted.
    pub fn want(&self, wanted: Wanted) {
        let bits = (u8::from(wanted.h264) * WANT_H264)
            | (u8::from(wanted.jpeg) * WANT_JPEG)
            | (u8::from(wanted.close_up) * WANT_CLOSE_UP);
        if self.wanted.swap(bits, Ordering::Relaxed) != bits {
            self.changed.notify_one();
        }
    }

    /// Asks for a key frame.
    pub fn ask_key(&self) {
        if !self.key.swap(true, Ordering::Relaxed) {
            self.changed.notify_one();
        }
    }

    /// Asks for one picture for a card of the class.
    pub fn ask_card(&self) {
        if !self.card.swap(true, Ordering::Relaxed) {
            self.changed.notify_one();
        }
    }

    /// Which pictures are wanted.
    pub fn wanted(&self) -> Wanted {
        let bits = self.wanted.load(Ordering::Relaxed);
        Wanted {
            h264: bits & WANT_H264 != 0,
            jpeg: bits & WANT_JPEG != 0,
            close_up: bits & WANT_CLOSE_UP != 0,
        }
    }

    /// Whether a key frame was asked for since the last call.
    pub fn take_key(&self) -> bool {
        self.key.swap(false, Ordering::Relaxed)
    }

    /// Whether a picture for a card was asked for since the last call.
    pub fn take_card(&self) -> bool {
        self.card.swap(false, Ordering::Relaxed)
    }
}

/// State that both ends share.
#[derive(Debug, Default)]
struct Shared {
    state: Mutex<Option<State>>,
    pictures: Mutex<VecDeque<(u64, Arc<EncodedPicture>)>>,
    /// Number of H.264 pictures that were handed in, including those that were left out.
    sequence: AtomicU64,
    pump: OnceLock<Thread>,
    closed: AtomicBool,
}

impl Shared {
    fn wake(&self) {
        if let Some(pump) = self.pump.get() {
            pump.unpark();
        }
    }
}

/// Dropped with the last port.
#[derive(Debug)]
struct Alive(Arc<Shared>);

impl Drop for Alive {
    fn drop(&mut self) {
        self.0.closed.store(true, Ordering::Release);
        self.0.wake();
    }
}

/// The student's end. Its clones are the same end, for an encoder's thread say; when the last one is dropped, the student has left.
#[derive(Clone, Debug)]
pub struct Port {
    shared: Arc<Shared>,
    inbox: Arc<Inbox>,
    _alive: Arc<Alive>,
}

impl Port {
    /// Publishes the state of this frame, in place of the last one if the console has not taken that. Does not wait.
    pub fn publish(&self, state: State) {
        if let Ok(mut slot) = self.shared.state.try_lock() {
            *slot = Some(state);
        }
        self.shared.wake();
    }

    /// Hands in a picture; the oldest one that waits is dropped where there are [`PICTURES`]. Does not wait.
    pub fn picture(&self, picture: Arc<EncodedPicture>) {
        let number = match picture.codec {
            Codec::H264 => self.shared.sequence.fetch_add(1, Ordering::Relaxed),
            Codec::Jpeg | Codec::Card | Codec::CloseUp => 0,
        };
        if picture.bytes.len() > picture.codec.most() {
            return;
        }
        let mut oldest = None;
        if let Ok(mut queue) = self.shared.pictures.try_lock() {
            if queue.len() >= PICTURES {
                oldest = queue.pop_front();
            }
            queue.push_back((number, picture));
        }
        // Freed here: the lock is released.
        drop(oldest);
        self.shared.wake();
    }

    /// The orders that have come, oldest first, at most [`ORDERS`]. Does not wait: some may come with the next frame.
    pub fn commands(&self) -> Vec<Order> {
        match self.inbox.orders.try_lock() {
            Ok(mut orders) => orders.drain(..).collect(),
            Err(_) => Vec::new(),
        }
    }

    /// Which pictures are wanted. Does not wait.
    pub fn wanted(&self) -> Wanted {
        self.inbox.wanted()
    }

    /// Whether the next picture of H.264 has to be a key frame: a page began to show it, or a picture was left out. It is true once for
    /// each request. Does not wait.
    pub fn take_key_request(&self) -> bool {
        self.inbox.take_key()
    }

    /// Whether one picture for a card of the class is wanted. Does not wait.
    pub fn wants_card(&self) -> bool {
        self.inbox.card.load(Ordering::Relaxed)
    }

    /// As [`Self::wants_card`], once for each request: who calls it makes the picture. Does not wait.
    pub fn take_card_request(&self) -> bool {
        self.inbox.take_card()
    }
}

/// The console's end.
#[derive(Debug)]
pub(crate) struct Feed {
    shared: Arc<Shared>,
    pub inbox: Arc<Inbox>,
    /// Number of the next H.264 picture, if none is left out.
    next: u64,
}

/// Makes both ends.
pub(crate) fn pair() -> (Port, Feed) {
    let shared = Arc::new(Shared::default());
    let inbox = Arc::new(Inbox::default());
    let port = Port {
        shared: shared.clone(),
        inbox: inbox.clone(),
        _alive: Arc::new(Alive(shared.clone())),
    };
    let feed = Feed {
        shared,
        inbox,
        next: 0,
    };
    (port, feed)
}

impl Feed {
    /// Wakes this thread from now on when something comes. Only the first call counts.
    pub fn wake_this_thread(&self) {
        // A second call would be of the same thread: a feed has one pump.
        let _ = self.shared.pump.set(std::thread::current());
    }

    /// Sleeps until something comes, for at most `longest`. It may wake without.
    pub fn wait(&self, longest: Duration) {
        std::thread::park_timeout(longest);
    }

    /// Takes the last state, if it is new.
    pub fn take_state(&self) -> Option<State> {
        lock(&self.shared.state).take()
    }

    /// Takes the pictures that wait, each with whether one of H.264 is missing before it.
    pub fn take_pictures(&mut self) -> Vec<(bool, Arc<EncodedPicture>)> {
        let taken: Vec<_> = lock(&self.shared.pictures).drain(..).collect();
        let mut told = Vec::with_capacity(taken.len());
        for (number, picture) in taken {
            let gap = picture.codec == Codec::H264 && number != self.next;
            if picture.codec == Codec::H264 {
                self.next = number + 1;
            }
            told.push((gap, picture));
        }
        told
    }

    /// Whether the last port is gone.
    pub fn closed(&self) -> bool {
        self.shared.closed.load(Ordering::Acquire)
    }
}

#[cfg(test)]
#[path = "port_tests.rs"]
mod tests;
