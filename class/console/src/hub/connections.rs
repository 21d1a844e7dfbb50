//! The number of connections, in all and from one address.

use std::collections::HashMap;
use std::net::IpAddr;
use std::sync::{Arc, Mutex};

use crate::lock;

/// Connections at a time. Our choice: a class of students and twice as many browsers.
const MOST: usize = 256;
/// Connections from one address. Our choice: a class behind one router.
const MOST_FROM_ONE: usize = 96;

/// Open connections by address, bounded in all and for each.
#[derive(Default)]
pub(super) struct Connections(Mutex<HashMap<IpAddr, usize>>);

/// A connection's share of the limit; it is free again when this is dropped.
pub(super) struct Place {
    of: Arc<Connections>,
    address: IpAddr,
}

/// The other end of a request and its place, which a WebSocket keeps.
#[derive(Clone)]
pub(super) struct Peer {
    pub address: IpAddr,
    pub place: Arc<Place>,
}

impl Connections {
    /// A place for one more connection, if there is one.
    pub fn place(self: &Arc<Self>, address: IpAddr) -> Option<Place> {
        let address = address.to_canonical();
        let mut counts = lock(&self.0);
        let in_all: usize = counts.values().sum();
        let count = counts.entry(address).or_default();
        if in_all >= MOST || *count >= MOST_FROM_ONE {
            if *count == 0 {
                counts.remove(&address);
            }
            return None;
        }
        *count += 1;
        Some(Place {
            of: self.clone(),
            address,
        })
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let mut counts = lock(&self.of.0);
        if let Some(count) = counts.get_mut(&self.address) {
            *count -= 1;
            if *count == 0 {
                counts.remove(&self.address);
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn places_are_bounded_and_come_back() {
        let connections = Arc::new(Connections::default());
        let address = |n: u32| IpAddr::from(n.to_be_bytes());
        let mut places: Vec<_> = (0..1000)
            .map_while(|_| connections.place(address(1)))
            .collect();
        assert_eq!(places.len(), MOST_FROM_ONE);
        places.extend((2..1000).map_while(|n| connections.place(address(n))));
        assert_eq!(places.len(), MOST);
        assert!(
            connections
                .place("::ffff:0.0.0.1".parse().unwrap())
                .is_none()
        );
        places.clear();
        assert!(lock(&connections.0).is_empty());
    }
}
