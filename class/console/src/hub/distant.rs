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
use crate::wire::{FromStudent, MOST_STATE, PROTOCOL, ToStudent, read};

/// Time between two pings to a program.
const PING: Duration = Duration::from_secs(5);
/// Time without a message after which a program is gone.
const SILENCE: Duration = Duration::from_secs(15);

/// Serves a program's socket to its end. An invalid message ends it: it comes from a program, not from a person.
pub(super) async fn serve(socket: WebSocket, hub: Arc<Shared>, place: Arc<Place>) {
    let (sender, mut receiver) = socket.split();
    let Some((instance, student)) = hello(&mut receiver).await else {
        return;
    };
    let inbox = Arc::new(Inbox::default());
    let Some(seat) = hub.registry.join(instance, student, inbox.clone()) else {
        return;
    };
    tokio::select! {
        () = send(sender, &inbox) => {}
        () = receive(receiver, &hub, seat) => {}
    }
    hub.registry.left(seat);
    drop(place);
}

type Hello = (crate::Text<{ crate::NAME }>, crate::Student);

async fn hello(receiver: &mut SplitStream<WebSocket>) -> Option<Hello> {
    let first = timeout(SILENCE, receiver.next()).await.ok()??.ok()?;
    let Message::Text(text) = first else {
        return None;
    };
    match read(&text, MOST_STATE)? {
        FromStudent::Hello {
            protocol: PROTOCOL,
            instance,
            student,
        } => Some((instance, student)),
        _ => None,
    }
}

async fn send(mut sender: SplitSink<WebSocket, Message>, inbox: &Inbox) {
    let mut told = None;
    loop {
        let orders = inbox.take_orders();
        let (wanted, key) = (inbox.wanted(), inbox.take_key());
        let mut messages = Vec::new();
        if !orders.is_empty() {
            messages.push(ToStudent::Orders {
                orders: List::clipped(orders),
            });
        }
        if told != Some(wanted) || key {
            told = Some(wanted);
            messages.push(ToStudent::Wanted {
                h264: wanted.h264,
                jpeg: wanted.jpeg,
                key,
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
