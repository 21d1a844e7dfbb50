//! The socket of a student's program that dials in.

use std::sync::Arc;
use std::time::Duration;

use axum::extract::ws::{Message, WebSocket};
use futures_util::stream::{SplitSink, SplitStream};
use futures_util::{SinkExt, StreamExt};
use tokio::time::timeout;

use super::connections::Place;
use super::registry::Seat;
use super::shared::Shared;
use crate::bounded::List;
use crate::picture::EncodedPicture;
use crate::port::Inbox;
use crate::wire::{FromStudent, MOST_STATE, OLDEST_PROTOCOL, PROTOCOL, ToStudent, read};

/// Time between two pings to a program.
const PING: Duration = Duration::from_secs(5);
/// Time without a message after which a program is gone.
const SILENCE: Duration = Duration::from_secs(15);

/// Serves a program's socket to its end. An invalid message ends it: it comes from a program, not from a person.
pub(super) async fn serve(socket: WebSocket, hub: Arc<Shared>, place: Arc<Place>) {
    let (sender, mut receiver) = socket.split();
    let Some((protocol, instance, student)) = hello(&mut receiver).await else {
        return;
    };
    let inbox = Arc::new(Inbox::default());
    let Some(seat) = hub.registry.join(instance, student, inbox.clone()) else {
        return;
    };
    tokio::select! {
        () = send(sender, &inbox, protocol) => {}
        () = receive(receiver, &hub, seat) => {}
    }
    hub.registry.left(seat);
    drop(place);
}

/// The version of a program's messages, its run's number, and its description.
type Hello = (u32, crate::Text<{ crate::NAME }>, crate::Student);

async fn hello(receiver: &mut SplitStream<WebSocket>) -> Option<Hello> {
    let first = timeout(SILENCE, receiver.next()).await.ok()??.ok()?;
    let Message::Text(text) = first else {
        return None;
    };
    introduced(&text)
}

/// A program's first message; `None` of anything else, and of a version that this hub does not read.
fn introduced(text: &str) -> Option<Hello> {
    match read(text, MOST_STATE)? {
        FromStudent::Hello {
            protocol: protocol @ OLDEST_PROTOCOL..=PROTOCOL,
            instance,
            student,
        } => Some((protocol, instance, student)),
        _ => None,
    }
}

async fn send(mut sender: SplitSink<WebSocket, Message>, inbox: &Inbox, protocol: u32) {
    let mut told = None;
    loop {
        let orders = inbox.take_orders();
        let (wanted, key) = (inbox.wanted(), inbox.take_key());
        let card = inbox.take_card() && protocol > OLDEST_PROTOCOL;
        let mut messages = Vec::new();
        if !orders.is_empty() {
            messages.push(ToStudent::Orders {
                orders: List::clipped(orders),
            });
        }
        if told != Some(wanted) || key || card {
            told = Some(wanted);
            messages.push(ToStudent::Wanted {
                h264: wanted.h264,
                jpeg: wanted.jpeg,
                key,
                card,
                close_up: wanted.close_up,
            });
        }
        let mut messages: Vec<_> = (messages.iter())
            .filter_map(|said| serde_json::to_string(said).ok())
            .map(|text| Message::Text(text.into()))
            .collect();
        if messages.is_empty() && timeout(PING, inbox.changed.notified()).await.is_err() {
            messages.push(Message::Ping(axum::body::Bytes::new()));
        }
        for message in messages {
            match timeout(SILENCE, sender.send(message)).await {
                Ok(Ok(())) => {}
                _ => return,
            }
        }
    }
}

async fn receive(mut receiver: SplitStream<WebSocket>, hub: &Shared, seat: Seat) {
    while let Ok(Some(Ok(message))) = timeout(SILENCE, receiver.next()).await {
        let is_seated = match message {
            Message::Text(text) => match read(&text, MOST_STATE) {
                Some(FromStudent::State { state }) => hub.registry.state(seat, *state),
                _ => return,
            },
            Message::Binary(bytes) => match EncodedPicture::from_message(&bytes) {
                // Its program leaves out whole groups of pictures alone, as it does for a page.
                Some(picture) => hub.registry.picture(seat, false, &picture),
                None => return,
            },
            Message::Ping(_) | Message::Pong(_) => true,
            Message::Close(_) => return,
        };
        // Another connection of the same program has come.
        if !is_seated {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A class need not change all its programs on one day.
    #[test]
    fn programs_of_versions_before_come_in() {
        let hello = |protocol: u32| {
            introduced(&format!(
                r#"{{"say":"hello","protocol":{protocol},"instance":"a","student":{{"name":"Ada","version":"0.1.0",
                "choices":[],"k_v":null,"replays":false}}}}"#
            ))
        };
        let admitted = (0..9).filter(|protocol| hello(*protocol).is_some());
        assert_eq!(admitted.collect::<Vec<_>>(), [3, 4, 5]);
        let (protocol, _, student) = hello(3).unwrap_or_default();
        assert_eq!((protocol, &*student.name), (3, "Ada"));
        assert!(!student.close_up, "they have no second camera");
        assert_eq!(introduced(r#"{"say":"state","state":{}}"#), None);
    }
}
