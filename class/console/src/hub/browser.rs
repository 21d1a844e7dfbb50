//! A page's socket. Reading and sending do not wait for each other.

use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::extract::ws::{Message, WebSocket};
use futures_util::stream::{SplitSink, SplitStream};
use futures_util::{SinkExt, StreamExt};
use tokio::time::{sleep, timeout};

use super::connections::Place;
use super::mailbox::{Letter, Mailbox};
use super::shared::Shared;
use crate::auth::SessionId;
use crate::wire::{FromPage, MOST_FROM_PAGE, ToPage, read};

/// Time between two pings to a browser.
const PING: Duration = Duration::from_secs(10);
/// Time without a message after which a browser is gone.
const SILENCE: Duration = Duration::from_secs(30);
/// Longest time to send a message; the socket is closed after it.
const SLOWEST_SEND: Duration = Duration::from_secs(20);
/// Invalid messages in a row after which a socket is closed. Our choice: a page of another version has fewer.
const BAD: u32 = 16;
/// Messages a second that are read. Our choice: nobody presses faster.
const A_SECOND: u32 = 50;

/// Serves a page's socket to its end.
pub(super) async fn serve(
    socket: WebSocket,
    hub: Arc<Shared>,
    session: SessionId,
    place: Arc<Place>,
) {
    let (page, mailbox) = hub.registry.open(session);
    let (sender, receiver) = socket.split();
    tokio::select! {
        () = send(sender, &mailbox) => {}
        () = receive(receiver, &hub, page, &mailbox) => {}
    }
    hub.registry.close(page);
    drop(place);
}

/// Sends what waits, and a ping in between however much that is: who only reads answers nothing else.
async fn send(mut sender: SplitSink<WebSocket, Message>, mailbox: &Mailbox) {
    let mut pinged = Instant::now();
    loop {
        let left = PING.saturating_sub(pinged.elapsed());
        let message = if left.is_zero() {
            pinged = Instant::now();
            Message::Ping(axum::body::Bytes::new())
        } else {
            match mailbox.next() {
                Err(()) => return,
                Ok(Some(Letter::Text(text))) => Message::Text(text),
                Ok(Some(Letter::Picture(bytes))) => Message::Binary(bytes),
                Ok(None) => {
                    let _ = timeout(left, mailbox.changed.notified()).await;
                    continue;
                }
            }
        };
        match timeout(SLOWEST_SEND, sender.send(message)).await {
            Ok(Ok(())) => {}
            _ => return,
        }
    }
}

async fn receive(mut receiver: SplitStream<WebSocket>, hub: &Shared, page: u64, mailbox: &Mailbox) {
    let mut bad = 0;
    let mut pace = Pace::new(A_SECOND);
    while let Ok(Some(Ok(message))) = timeout(SILENCE, receiver.next()).await {
        // Faster messages are read slowly, and the network holds the rest back.
        if let Some(wait) = pace.wait(Instant::now()) {
            sleep(wait).await;
        }
        let said = match &message {
            Message::Text(text) => read::<FromPage>(text, MOST_FROM_PAGE),
            Message::Binary(_) => None,
            Message::Ping(_) | Message::Pong(_) => continue,
            Message::Close(_) => return,
        };
        match said {
            Some(FromPage::Invite {}) => mailbox.answer(&invitation(hub)),
            Some(said) => hub.registry.said(page, said),
            None => {
                bad += 1;
                if bad >= BAD {
                    return;
                }
                mailbox.answer(&ToPage::Refused {
                    echo: None,
                    why: "the hub did not understand the page: reload it",
                });
                continue;
            }
        }
        bad = 0;
    }
}

fn invitation(hub: &Shared) -> ToPage {
    match hub.invite() {
        Ok(invitation) => ToPage::Invited {
            rows: invitation.rows(),
            address: invitation.address,
            code: invitation.code,
        },
        Err(_) => ToPage::Refused {
            echo: None,
            why: "the computer gives no random numbers for a code",
        },
    }
}

/// A limit of messages: a number a second on average, and a number at once.
struct Pace {
    most: u32,
    left: f64,
    last: Instant,
}

impl Pace {
    fn new(most: u32) -> Self {
        Self {
            most,
            left: most.into(),
            last: Instant::now(),
        }
    }

    /// The time that the next message has to wait.
    fn wait(&mut self, now: Instant) -> Option<Duration> {
        let most = f64::from(self.most);
        let gained = most * now.saturating_duration_since(self.last).as_secs_f64();
        self.left = (self.left + gained).min(most) - 1.0;
        self.last = now;
        (self.left < 0.0).then(|| Duration::from_secs_f64(-self.left / most))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fifty_at_once_and_fifty_a_second() {
        let mut pace = Pace::new(50);
        let mut now = pace.last;
        assert!((0..50).all(|_| pace.wait(now).is_none()));
        let begun = now;
        for _ in 0..500 {
            now += pace.wait(now).unwrap_or_default();
        }
        let took = (now - begun).as_secs_f64();
        assert!((took - 10.0).abs() < 0.05, "{took}");
    }
}
