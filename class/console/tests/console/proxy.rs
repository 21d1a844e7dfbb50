//! A network that can be cut: the hub's port at another address of loopback.

use std::io::copy;
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::{Arc, Mutex};

#[derive(Default)]
struct Wires {
    is_cut: bool,
    streams: Vec<TcpStream>,
}

/// A proxy on another address of loopback, between a student's program and the hub's port.
pub struct Proxy {
    pub address: SocketAddr,
    wires: Arc<Mutex<Wires>>,
}

impl Proxy {
    pub fn new(to: SocketAddr) -> Self {
        let listener = TcpListener::bind(("127.0.0.2", to.port())).unwrap();
        let address = listener.local_addr().unwrap();
        let wires = Arc::new(Mutex::new(Wires::default()));
        let shared = wires.clone();
        std::thread::spawn(move || {
            for near in listener.incoming().map_while(Result::ok) {
                let mut wires = shared.lock().unwrap();
                if wires.is_cut {
                    continue;
                }
                let Ok(far) = TcpStream::connect(to) else {
                    continue;
                };
                for (from, into) in [(&near, &far), (&far, &near)] {
                    let (mut from, mut into) =
                        (from.try_clone().unwrap(), into.try_clone().unwrap());
                    std::thread::spawn(move || {
                        let _ = copy(&mut from, &mut into);
                        let _ = into.shutdown(Shutdown::Both);
                    });
                }
                wires.streams.extend([near, far]);
            }
        });
        Self { address, wires }
    }

    /// Ends all connections and lets none through, or lets them through again.
    pub fn cut(&self, is_cut: bool) {
        let mut wires = self.wires.lock().unwrap();
        wires.is_cut = is_cut;
        for stream in wires.streams.drain(..) {
            let _ = stream.shutdown(Shutdown::Both);
        }
    }
}
