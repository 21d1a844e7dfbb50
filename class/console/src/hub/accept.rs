//! Connections: accepted, bounded in number, encrypted, and each served with HTTP/1.1 alone.

use std::convert::Infallible;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use axum::body::Body;
use axum::extract::Request;
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, header};
use axum::response::{IntoResponse, Response};
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::net::{TcpListener, TcpStream};
use tokio::time::timeout;
use tokio_rustls::TlsAcceptor;
use tower_service::Service;

use super::connections::{Connections, Peer, Place};
use super::routes;
use super::shared::Shared;

/// The longest time for a handshake, a request's head, or its body and answer. Our choice: a slow telephone has a second.
const PATIENCE: Duration = Duration::from_secs(10);
/// Bytes of a request's head: the least that hyper takes.
const HEAD: usize = 8 << 10;
/// Header fields of a request. Our choice: browsers send some 20.
const FIELDS: usize = 64;
/// The pause where the system has no more files for connections.
const PAUSE: Duration = Duration::from_millis(100);

/// Accepts connections until it is dropped.
pub(super) async fn run(listener: TcpListener, tls: Option<TlsAcceptor>, shared: Arc<Shared>) {
    let connections = Arc::new(Connections::default());
    loop {
        let (stream, peer) = match listener.accept().await {
            Ok(accepted) => accepted,
            Err(error) => {
                tracing::debug!(%error, "a connection to the console could not be accepted");
                tokio::time::sleep(PAUSE).await;
                continue;
            }
        };
        let Some(place) = connections.place(peer.ip()) else {
            continue;
        };
        tokio::spawn(one(stream, peer, place, tls.clone(), shared.clone()));
    }
}

async fn one(
    stream: TcpStream,
    peer: SocketAddr,
    place: Place,
    tls: Option<TlsAcceptor>,
    shared: Arc<Shared>,
) {
    // Orders and states are small, and would be late if they were gathered.
    let _ = stream.set_nodelay(true);
    let peer = Peer {
        address: peer.ip().to_canonical(),
        place: Arc::new(place),
    };
    match tls {
        None => serve(stream, peer, shared).await,
        Some(acceptor) => {
            if let Ok(Ok(stream)) = timeout(PATIENCE, acceptor.accept(stream)).await {
                serve(stream, peer, shared).await;
            }
        }
    }
}

async fn serve<S>(stream: S, peer: Peer, shared: Arc<Shared>)
where
    S: AsyncRead + AsyncWrite + Unpin + Send + 'static,
{
    let router = routes::router(shared.clone());
    let service = service_fn(move |request: hyper::Request<Incoming>| {
        answer(request, peer.clone(), router.clone(), shared.clone())
    });
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(PATIENCE)
        .max_buf_size(HEAD)
        .max_headers(FIELDS)
        .serve_connection(TokioIo::new(stream), service)
        .with_upgrades();
    // Errors of a browser are not reported.
    let _ = connection.await;
}

async fn answer(
    request: hyper::Request<Incoming>,
    peer: Peer,
    mut router: axum::Router,
    shared: Arc<Shared>,
) -> Result<Response, Infallible> {
    let answer = match refusal(&request, &shared) {
        Some(why) => (StatusCode::FORBIDDEN, why).into_response(),
        None => {
            let mut request: Request = request.map(Body::new);
            request.extensions_mut().insert(peer);
            match timeout(PATIENCE, router.call(request)).await {
                Ok(Ok(answer)) => answer,
                Ok(Err(never)) => match never {},
                Err(_) => StatusCode::REQUEST_TIMEOUT.into_response(),
            }
        }
    };
    let mut answer = answer;
    protect(answer.headers_mut(), &shared);
    Ok(answer)
}

/// Why a request is refused: it is for another host, or a foreign page makes it.
fn refusal<B>(request: &hyper::Request<B>, shared: &Shared) -> Option<&'static str> {
    // Students' programs come by any name; they are no browsers, which always send the origin of the page that opens a WebSocket.
    let has_origin = request.headers().contains_key(header::ORIGIN);
    if request.uri().path() == routes::STUDENT {
        return has_origin.then_some("this is for programs\n");
    }
    let Some(host) = single(request.headers(), header::HOST) else {
        return Some("a request needs one Host\n");
    };
    if !shared.site.is_host(host) {
        return Some("this is another host\n");
    }
    let needs_origin = request.method() != Method::GET || request.uri().path() == routes::SOCKET;
    match single(request.headers(), header::ORIGIN) {
        Some(origin) if shared.site.is_origin(origin, host) => None,
        None if !has_origin && !needs_origin => None,
        _ => Some("this comes from another page\n"),
    }
}

/// The value of a field that is there once.
fn single(headers: &HeaderMap, name: header::HeaderName) -> Option<&str> {
    let mut values = headers.get_all(name).iter();
    let value = values.next()?.to_str().ok()?;
    values.next().is_none().then_some(value)
}

/// Adds the security headers that each answer has. No `Strict-Transport-Security`: with it a browser would let nobody past the warning of
/// a certificate that no authority has signed.
fn protect(headers: &mut HeaderMap, shared: &Shared) {
    let fixed = [
        (header::CACHE_CONTROL, "no-store"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::X_FRAME_OPTIONS, "DENY"),
    ];
    for (name, value) in fixed {
        headers.insert(name, HeaderValue::from_static(value));
    }
    for name in ["cross-origin-opener-policy", "cross-origin-resource-policy"] {
        headers.insert(name, HeaderValue::from_static("same-origin"));
    }
    headers.insert(header::CONTENT_SECURITY_POLICY, shared.page.policy.clone());
}
