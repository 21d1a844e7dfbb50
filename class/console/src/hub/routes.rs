//! Routes of the hub: the page, a session for a code, and the sockets of pages and of students' programs.

use std::sync::Arc;
use std::time::Instant;

use axum::body::Bytes;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{DefaultBodyLimit, Extension, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{get, post};

use super::connections::Peer;
use super::shared::Shared;
use super::{browser, distant};
use crate::auth::{Refusal, SessionId};
use crate::wire::{MOST_FROM_PAGE, MOST_STATE};

/// The page's socket.
pub(super) const SOCKET: &str = "/socket";
/// The socket of students' programs.
pub(super) const STUDENT: &str = "/student";

/// Bytes of a code, however it is typed.
const CODE: usize = 64;
/// Bytes that wait in a socket before it stops sending or gives up. The system buffers more.
const SOCKET_BUFFER: usize = 64 << 10;

pub(super) fn router(shared: Arc<Shared>) -> axum::Router {
    axum::Router::new()
        .route("/", get(page))
        .route("/session", get(session))
        .route("/enter", post(enter))
        .route("/leave", post(leave))
        .route(SOCKET, get(socket))
        .route(STUDENT, get(student))
        .layer(DefaultBodyLimit::max(CODE))
        .with_state(shared)
}

type Hub = State<Arc<Shared>>;

async fn page(State(hub): Hub) -> Html<Bytes> {
    Html(hub.page.html.clone())
}

/// The session whose cookie a request has.
fn session_of(hub: &Shared, headers: &HeaderMap) -> Option<SessionId> {
    let fields = headers.get_all(header::COOKIE).iter();
    let mut values = fields.filter_map(|field| hub.site.value(field.to_str().ok()?));
    hub.gate.session(values.next()?)
}

/// Whether this browser has a session: a refused socket gives a page no reason.
async fn session(State(hub): Hub, headers: HeaderMap) -> StatusCode {
    match session_of(&hub, &headers) {
        Some(_) => StatusCode::NO_CONTENT,
        None => StatusCode::UNAUTHORIZED,
    }
}

async fn enter(State(hub): Hub, Extension(peer): Extension<Peer>, code: Bytes) -> Response {
    let code = String::from_utf8_lossy(&code);
    match hub.gate.enter(&code, peer.address, Instant::now()) {
        Ok(secret) => {
            let cookie = hub.site.set_cookie(secret.text());
            (StatusCode::NO_CONTENT, [(header::SET_COOKIE, cookie)]).into_response()
        }
        Err(refusal) => refused(refusal),
    }
}

async fn leave(State(hub): Hub, headers: HeaderMap) -> Response {
    if let Some(session) = session_of(&hub, &headers) {
        hub.gate.leave(session);
    }
    let cookie = hub.site.set_cookie("");
    (StatusCode::NO_CONTENT, [(header::SET_COOKIE, cookie)]).into_response()
}

fn refused(refusal: Refusal) -> Response {
    match refusal {
        Refusal::Wrong => StatusCode::FORBIDDEN.into_response(),
        Refusal::Wait(wait) => {
            let seconds = (wait.as_secs() + 1).to_string();
            (
                StatusCode::TOO_MANY_REQUESTS,
                [(header::RETRY_AFTER, seconds)],
            )
                .into_response()
        }
        Refusal::NoRandomness => StatusCode::INTERNAL_SERVER_ERROR.into_response(),
    }
}

async fn socket(
    State(hub): Hub,
    Extension(peer): Extension<Peer>,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    let Some(session) = session_of(&hub, &headers) else {
        return StatusCode::UNAUTHORIZED.into_response();
    };
    bounded(upgrade, MOST_FROM_PAGE)
        .on_upgrade(move |socket| browser::serve(socket, hub, session, peer.place))
}

async fn student(
    State(hub): Hub,
    Extension(peer): Extension<Peer>,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    if !hub.site.tls {
        return StatusCode::NOT_FOUND.into_response();
    }
    let said = headers.get(header::AUTHORIZATION);
    let said = said.and_then(|said| said.to_str().ok()?.strip_prefix("Bearer "));
    let admitted = (hub.gate).admit(said.unwrap_or_default(), peer.address, Instant::now());
    if let Err(refusal) = admitted {
        return refused(refusal);
    }
    let longest = MOST_STATE.max(crate::picture::MOST_PICTURE + crate::picture::HEAD);
    bounded(upgrade, longest).on_upgrade(move |socket| distant::serve(socket, hub, peer.place))
}

fn bounded(upgrade: WebSocketUpgrade, longest: usize) -> WebSocketUpgrade {
    upgrade
        .read_buffer_size(SOCKET_BUFFER.min(longest))
        .write_buffer_size(0)
        .max_message_size(longest)
        .max_frame_size(longest)
}
