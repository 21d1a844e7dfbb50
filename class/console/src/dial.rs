//! A student's program that dials out to a hub: TLS to the certificate of its [`HubAddress`], the students' key, and the same port as
//! beside a hub. A lost connection is tried again for as long as the program runs.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use axum::body::Bytes;
use futures_util::stream::{SplitSink, SplitStream};
use futures_util::{SinkExt, StreamExt};
use rustls::pki_types::ServerName;
use tokio::net::TcpStream;
use tokio::sync::{Notify, oneshot};
use tokio::time::{sleep, timeout};
use tokio_rustls::TlsConnector;
use tokio_rustls::client::TlsStream;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::http::{HeaderValue, StatusCode, header};
use tokio_tungstenite::tungstenite::protocol::WebSocketConfig;
use tokio_tungstenite::tungstenite::{self, Message};
use tokio_tungstenite::{WebSocketStream, client_async_with_config};

use crate::address::HubAddress;
use crate::auth::Secret;
use crate::bounded::Text;
use crate::error::Error;
use crate::picture::{Codec, EncodedPicture};
use crate::pictures::Pictures;
use crate::port::{self, Full, Inbox, Port, Wanted};
use crate::pump::{self, Sink};
use crate::student::{State, Student};
use crate::wire::{FromStudent, MOST_STATE, PROTOCOL, ToStudent, read};
use crate::{lock, tls};

/// The longest time to connect.
const PATIENCE: Duration = Duration::from_secs(10);
/// Time without a message after which the hub is gone: it sends a ping every 5 s.
const SILENCE: Duration = Duration::from_secs(15);
/// The pause before the first new try, and before the later ones. Our choice.
const PAUSES: [Duration; 2] = [Duration::from_millis(250), Duration::from_secs(5)];
/// The pause after which orders are handed on again that found the queue full: a few frames'.
const FULL_PAUSE: Duration = Duration::from_millis(50);

/// Status of the connection to a hub.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LinkStatus {
    /// It is being tried for the first time.
    Trying,
    /// It is connected.
    Connected,
    /// It is not connected, and is being tried again: the hub's host and port, and the reason.
    Lost(String),
}

/// Why there is no connection.
#[derive(Debug, thiserror::Error)]
enum Refused {
    #[error(
        "the hub cannot be reached ({0}); is it running, and does a firewall let its port through?"
    )]
    Network(std::io::Error),
    #[error(
        "this is not the hub whose fingerprint was given: copy its address anew, unless someone else answers in its place"
    )]
    OtherCertificate,
    #[error("the hub does not answer in time; is its network busy?")]
    Late,
    #[error("the hub refuses this program's key (403): copy the hub's address anew")]
    Key,
    #[error(
        "the hub has refused too many wrong keys from this address (429); it listens again in a while"
    )]
    LockedOut,
    #[error(
        "what answers is no hub of this version ({0}); is the address a hub's, and are both programs of one version?"
    )]
    NoHub(String),
}

/// A student's connection to a distant hub. It ends when this is dropped.
pub struct Link {
    port: Port,
    status: Arc<Mutex<LinkStatus>>,
    over: Arc<AtomicBool>,
    stop: Option<oneshot::Sender<()>>,
    threads: Vec<JoinHandle<()>>,
}

/// State and pictures that wait for the hub.
#[derive(Default)]
struct Outgoing {
    state: Mutex<Option<State>>,
    card: Mutex<Option<Bytes>>,
    /// Apart from the others: each stands alone, and among them would end a group of H.264.
    close_up: Mutex<Option<Bytes>>,
    pictures: Mutex<Pictures>,
    changed: Notify,
}

/// The console's end of the port.
struct Out {
    outgoing: Arc<Outgoing>,
    inbox: Arc<Inbox>,
}

impl Sink for Out {
    fn state(&mut self, state: State) {
        *lock(&self.outgoing.state) = Some(state);
        self.outgoing.changed.notify_one();
    }

    fn picture(&mut self, gap: bool, picture: Arc<EncodedPicture>) {
        let message = Bytes::from(picture.to_message());
        match picture.codec {
            Codec::Card => *lock(&self.outgoing.card) = Some(message),
            Codec::CloseUp => *lock(&self.outgoing.close_up) = Some(message),
            Codec::H264 | Codec::Jpeg => {
                if lock(&self.outgoing.pictures).push(gap, &picture, message) {
                    self.inbox.ask_key();
                }
            }
        }
        self.outgoing.changed.notify_one();
    }
}

impl Link {
    /// Dials `address` from now on.
    ///
    /// # Errors
    /// Where no thread can be started, or the system has no randomness. A hub that does not answer is no error: see [`Self::status`].
    pub fn start(address: HubAddress, student: Student) -> Result<Self, Error> {
        let (port, feed) = port::pair();
        let inbox = feed.inbox.clone();
        let outgoing = Arc::new(Outgoing::default());
        let status = Arc::new(Mutex::new(LinkStatus::Trying));
        let over = Arc::new(AtomicBool::new(false));
        let dialler = Dialler {
            tls: TlsConnector::from(Arc::new(tls::client(address.fingerprint)?)),
            address,
            hello: FromStudent::Hello {
                protocol: PROTOCOL,
                instance: Text::clipped(Secret::new()?.text()),
                student,
            },
            inbox: inbox.clone(),
            outgoing: outgoing.clone(),
            status: status.clone(),
        };
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_io()
            .enable_time()
            .build()
            .map_err(Error::Thread)?;
        let (stop, stopped) = oneshot::channel::<()>();
        let named = |name: &str| std::thread::Builder::new().name(name.to_owned());
        let dials = move || {
            runtime.block_on(async {
                tokio::select! {
                    () = dialler.keep() => {}
                    _ = stopped => {}
                }
            });
        };
        let ends = over.clone();
        let pumps = move || {
            let mut out = Out { outgoing, inbox };
            pump::run(feed, &mut out, || ends.load(Ordering::Acquire));
        };
        let mut link = Self {
            port,
            status,
            over,
            stop: Some(stop),
            threads: Vec::new(),
        };
        let dials = named("console-link").spawn(dials).map_err(Error::Thread)?;
        link.threads.push(dials);
        let pumps = named("console-port").spawn(pumps).map_err(Error::Thread)?;
        link.threads.push(pumps);
        Ok(link)
    }

    /// The student's end.
    pub fn port(&self) -> &Port {
        &self.port
    }

    /// Status of the connection to the hub.
    pub fn status(&self) -> LinkStatus {
        lock(&self.status).clone()
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Release);
        if let Some(stop) = self.stop.take() {
            let _ = stop.send(());
        }
        for thread in self.threads.drain(..) {
            thread.thread().unpark();
            // A thread that panicked has reported that itself.
            let _ = thread.join();
        }
    }
}

type Socket = WebSocketStream<TlsStream<TcpStream>>;

struct Dialler {
    address: HubAddress,
    tls: TlsConnector,
    hello: FromStudent,
    inbox: Arc<Inbox>,
    outgoing: Arc<Outgoing>,
    status: Arc<Mutex<LinkStatus>>,
}

impl Dialler {
    /// Connects, again and again, until it is dropped.
    async fn keep(&self) {
        let mut pause = PAUSES[0];
        loop {
            let why = match timeout(PATIENCE, self.connect()).await {
                Err(_) => Refused::Late.to_string(),
                Ok(Err(refused)) => refused.to_string(),
                Ok(Ok(socket)) => {
                    let begun = Instant::now();
                    lock(&self.outgoing.pictures).restart();
                    // A picture from before the connection was lost is old, and the hub would show it as new.
                    *lock(&self.outgoing.card) = None;
                    *lock(&self.outgoing.close_up) = None;
                    *lock(&self.status) = LinkStatus::Connected;
                    self.talk(socket).await;
                    // A hub that ends each connection at once is not asked several times a second.
                    if begun.elapsed() > PAUSES[1] {
                        pause = PAUSES[0];
                    }
                    // No page shows this student any more.
                    self.inbox.want(Wanted::default());
                    "the connection to the hub broke".to_owned()
                }
            };
            let lost = format!("{}: {why}", self.address.host());
            let now = LinkStatus::Lost(lost.clone());
            let before = std::mem::replace(&mut *lock(&self.status), now.clone());
            if before != now {
                tracing::warn!("nobody directs this program: {lost}; it is tried again");
            }
            sleep(pause).await;
            pause = (2 * pause).min(PAUSES[1]);
        }
    }

    async fn connect(&self) -> Result<Socket, Refused> {
        let host = self.address.host();
        let stream = TcpStream::connect(host).await.map_err(Refused::Network)?;
        let _ = stream.set_nodelay(true);
        let other = |what: &str| Refused::NoHub(what.to_owned());
        let name = host.rsplit_once(':').map_or(host, |(name, _)| name);
        let name = name.trim_matches(['[', ']']).to_owned();
        let name = ServerName::try_from(name).map_err(|_| other("its name is none"))?;
        let stream = self.tls.connect(name, stream).await.map_err(|error| {
            let cause = error.get_ref().and_then(|cause| cause.downcast_ref());
            match cause {
                Some(rustls::Error::InvalidCertificate(_)) => Refused::OtherCertificate,
                Some(other) => Refused::NoHub(other.to_string()),
                None => Refused::Network(error),
            }
        })?;
        let address = format!("wss://{host}/student");
        let mut request = address
            .into_client_request()
            .map_err(|error| other(&error.to_string()))?;
        let key = format!("Bearer {}", self.address.key.text());
        let mut key = HeaderValue::from_str(&key).map_err(|error| other(&error.to_string()))?;
        key.set_sensitive(true);
        request.headers_mut().insert(header::AUTHORIZATION, key);
        let config = WebSocketConfig::default()
            .write_buffer_size(0)
            .max_message_size(Some(MOST_STATE))
            .max_frame_size(Some(MOST_STATE));
        let answered = client_async_with_config(request, stream, Some(config)).await;
        answered
            .map(|(socket, _)| socket)
            .map_err(|error| match error {
                tungstenite::Error::Http(answer) => match answer.status() {
                    StatusCode::FORBIDDEN => Refused::Key,
                    StatusCode::TOO_MANY_REQUESTS => Refused::LockedOut,
                    status => other(status.as_str()),
                },
                error => other(&error.to_string()),
            })
    }

    /// Sends and receives until the connection breaks.
    async fn talk(&self, socket: Socket) {
        let (sender, receiver) = socket.split();
        tokio::select! {
            () = self.send(sender) => {}
            () = self.receive(receiver) => {}
        }
    }

    async fn send(&self, mut sender: SplitSink<Socket, Message>) {
        let text = |said: &FromStudent| serde_json::to_string(said).map(Message::text);
        let mut next = text(&self.hello).ok();
        loop {
            let message = match next.take() {
                Some(message) => message,
                None => {
                    let state = lock(&self.outgoing.state).take().map(Box::new);
                    let state = state.and_then(|state| text(&FromStudent::State { state }).ok());
                    let card = || lock(&self.outgoing.card).take().map(Message::Binary);
                    let close_up = || lock(&self.outgoing.close_up).take().map(Message::Binary);
                    let picture = || lock(&self.outgoing.pictures).pop().map(Message::Binary);
                    match state.or_else(card).or_else(close_up).or_else(picture) {
                        Some(message) => message,
                        None => {
                            self.outgoing.changed.notified().await;
                            continue;
                        }
                    }
                }
            };
            match timeout(SILENCE, sender.send(message)).await {
                Ok(Ok(())) => {}
                _ => return,
            }
        }
    }

    async fn receive(&self, mut receiver: SplitStream<Socket>) {
        while let Ok(Some(Ok(message))) = timeout(SILENCE, receiver.next()).await {
            let text = match message {
                Message::Text(text) => text,
                Message::Ping(_) | Message::Pong(_) => continue,
                _ => return,
            };
            match read::<ToStudent>(&text, MOST_STATE) {
                Some(ToStudent::Orders { orders }) => {
                    for order in orders.iter() {
                        // While the queue is full, the hub's own queue fills, and the hub refuses orders.
                        while self.inbox.order(order.clone()) == Err(Full) {
                            sleep(FULL_PAUSE).await;
                        }
                    }
                }
                Some(ToStudent::Wanted {
                    h264,
                    jpeg,
                    key,
                    card,
                    close_up,
                }) => {
                    self.inbox.want(Wanted {
                        h264,
                        jpeg,
                        close_up,
                    });
                    if key {
                        self.inbox.ask_key();
                    }
                    if card {
                        self.inbox.ask_card();
                    }
                }
                None => return,
            }
        }
    }
}
