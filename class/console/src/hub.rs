//! The hub: a server of pages, with students in this process and students that dial in.
//!
//! All sockets are served by one thread, so that they take one core at most from a simulation beside them.

mod accept;
mod browser;
mod connections;
mod distant;
mod mailbox;
mod registry;
mod routes;
mod shared;

use std::net::{IpAddr, Ipv4Addr, SocketAddr, UdpSocket};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use tokio::net::TcpListener;
use tokio::sync::oneshot;
use tokio_rustls::TlsAcceptor;

use crate::address::HubAddress;
use crate::auth::{Gate, NoRandomness, Secret, Site};
use crate::bounded::Text;
use crate::error::Error;
use crate::identity::{Fingerprint, Identity, students_key};
use crate::invitation::Invitation;
use crate::page::Page;
use crate::picture::EncodedPicture;
use crate::port::{self, Port};
use crate::pump::{self, Sink};
use crate::student::{State, Student};
use crate::{lock, tls};

use registry::{Registry, Seat};
use shared::Shared;

/// Time between two checks of the class for changes. Our choice: soon enough for a glance.
const TICK: Duration = Duration::from_millis(250);

/// Configuration of a hub.
#[derive(Clone, Debug)]
pub struct Config {
    /// The address to listen on. On loopback it uses plain HTTP, elsewhere HTTPS.
    pub listen: SocketAddr,
    /// Whether to use HTTPS on loopback too.
    pub always_tls: bool,
    /// Folder of the certificate and the students' key: the user's own folder for the program's data.
    pub folder: PathBuf,
    /// Names of this computer that browsers may use, beside its addresses and `localhost`.
    pub names: Vec<String>,
    /// Code of the page's language (ISO 639-1): `en`, `de`, `es` or `zh`. In place of another one the page is English.
    pub language: &'static str,
}

/// The present load of a hub.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HubCounts {
    /// Students that are connected.
    pub students: usize,
    /// Pages that are open.
    pub pages: usize,
    /// Most messages and pictures that wait for one of them.
    pub waiting: usize,
    /// Messages and pictures that were left out for open pages, because they take them too slowly.
    pub left_out: u64,
}

/// A running hub: pages connect to it, and students, in this process or dialling in. It ends when it is dropped.
pub struct Hub {
    shared: Arc<Shared>,
    address: SocketAddr,
    students: Option<HubAddress>,
    over: Arc<AtomicBool>,
    pumps: Mutex<Vec<JoinHandle<()>>>,
    server: Option<(oneshot::Sender<()>, JoinHandle<()>)>,
}

impl Hub {
    /// Listens from now on.
    ///
    /// # Errors
    /// [`Error`] where it cannot listen, or its certificate cannot be kept.
    pub fn start(config: Config) -> Result<Self, Error> {
        let has_tls = config.always_tls || !config.listen.ip().is_loopback();
        let (acceptor, fingerprint, key) = if has_tls {
            let identity = Identity::kept_in(&config.folder)?;
            let fingerprint = Fingerprint::of(&identity.certificate);
            let acceptor = TlsAcceptor::from(Arc::new(tls::server(identity)?));
            (
                Some(acceptor),
                Some(fingerprint),
                students_key(&config.folder)?,
            )
        } else {
            (None, None, Secret::new()?)
        };
        let failed = |cause| Error::Listen {
            address: config.listen,
            cause,
        };
        let listener = std::net::TcpListener::bind(config.listen).map_err(failed)?;
        listener.set_nonblocking(true).map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        let told = SocketAddr::new(told(address.ip()), address.port());
        let names = config.names.iter().map(|name| name.to_ascii_lowercase());
        let students = fingerprint.map(|fingerprint| HubAddress {
            host: told.to_string(),
            fingerprint,
            key: key.clone(),
        });
        let shared = Arc::new(Shared {
            site: Site {
                tls: has_tls,
                port: address.port(),
                names: names.chain(["localhost".to_owned()]).collect(),
            },
            gate: Gate::new(key),
            registry: Registry::default(),
            page: Page::new(config.language),
            host: told.to_string(),
        });
        let server = serve(listener, acceptor, shared.clone()).map_err(Error::Thread)?;
        Ok(Self {
            shared,
            address,
            students,
            over: Arc::default(),
            pumps: Mutex::default(),
            server: Some(server),
        })
    }

    /// The address that it listens on.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// The address that students' programs dial; `None` where it uses plain HTTP, which they do not.
    pub fn students(&self) -> Option<&HubAddress> {
        self.students.as_ref()
    }

    /// Fingerprint of its certificate, as browsers show it; `None` where it uses plain HTTP.
    pub fn fingerprint(&self) -> Option<Fingerprint> {
        self.students.as_ref().map(|students| students.fingerprint)
    }

    /// Makes a new code for one browser. Four are valid at a time.
    ///
    /// # Errors
    /// Where the system has no randomness.
    pub fn invite(&self) -> Result<Invitation, NoRandomness> {
        self.shared.invite()
    }

    /// How many codes are valid: at 0, only a page that is open can let another one in, or [`Self::invite`].
    pub fn codes(&self) -> usize {
        self.shared.gate.codes()
    }

    /// The present load.
    pub fn counts(&self) -> HubCounts {
        let (students, pages, loads) = self.shared.registry.counts();
        HubCounts {
            students,
            pages,
            waiting: loads.iter().map(|load| load.waiting).max().unwrap_or(0),
            left_out: loads.iter().map(|load| load.left_out).sum(),
        }
    }

    /// Adds a student in this process; `None` where there are 64 already.
    ///
    /// # Errors
    /// Where no thread can be started.
    pub fn student(&self, student: Student) -> Result<Option<Port>, Error> {
        let (port, feed) = port::pair();
        let instance = Text::clipped(Secret::new()?.text());
        let joined = (self.shared.registry).join(instance, student, feed.inbox.clone());
        let Some(seat) = joined else {
            return Ok(None);
        };
        let (shared, over) = (self.shared.clone(), self.over.clone());
        let pump = std::thread::Builder::new()
            .name("console-port".to_owned())
            .spawn(move || {
                let mut inside = Inside { shared, seat };
                pump::run(feed, &mut inside, || over.load(Ordering::Acquire));
                inside.shared.registry.left(seat);
            });
        lock(&self.pumps).push(pump.map_err(Error::Thread)?);
        Ok(Some(port))
    }
}

impl Drop for Hub {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Release);
        for pump in std::mem::take(&mut *lock(&self.pumps)) {
            pump.thread().unpark();
            // A thread that panicked has reported that itself.
            let _ = pump.join();
        }
        if let Some((stop, server)) = self.server.take() {
            let _ = stop.send(());
            let _ = server.join();
        }
    }
}

/// The hub's end of a student in this process.
struct Inside {
    shared: Arc<Shared>,
    seat: Seat,
}

impl Sink for Inside {
    fn state(&mut self, state: State) {
        self.shared.registry.state(self.seat, state);
    }

    fn picture(&mut self, gap: bool, picture: Arc<EncodedPicture>) {
        self.shared.registry.picture(self.seat, gap, &picture);
    }
}

/// The thread of all sockets, and the sender that ends it.
fn serve(
    listener: std::net::TcpListener,
    tls: Option<TlsAcceptor>,
    shared: Arc<Shared>,
) -> std::io::Result<(oneshot::Sender<()>, JoinHandle<()>)> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_io()
        .enable_time()
        .build()?;
    let listener = {
        let _inside = runtime.enter();
        TcpListener::from_std(listener)?
    };
    let (stop, stopped) = oneshot::channel::<()>();
    let work = move || {
        runtime.block_on(async {
            tokio::select! {
                () = accept::run(listener, tls, shared.clone()) => {}
                () = tick(&shared) => {}
                _ = stopped => {}
            }
        });
    };
    let thread = std::thread::Builder::new().name("console".to_owned());
    Ok((stop, thread.spawn(work)?))
}

async fn tick(shared: &Shared) {
    loop {
        tokio::time::sleep(TICK).await;
        shared.registry.tick(|session| shared.gate.is_open(session));
    }
}

/// The address for people of a hub that listens on `address`.
fn told(address: IpAddr) -> IpAddr {
    if !address.is_unspecified() {
        return address;
    }
    // Nothing is sent: the system only chooses which of its addresses it would send from. The other end is one of those that documents use
    // (RFC 5737).
    let outward = || {
        let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).ok()?;
        socket.connect((Ipv4Addr::new(192, 0, 2, 1), 9)).ok()?;
        socket.local_addr().ok()
    };
    outward().map_or(Ipv4Addr::LOCALHOST.into(), |address| address.ip())
}
