//! Addresses from which wrong codes come have to wait, in bounded memory.

use std::collections::HashMap;
use std::net::{IpAddr, Ipv6Addr};
use std::time::{Duration, Instant};

/// Wrong codes before an address has to wait. Our choice: a code is easily mistyped twice.
const TRIES: u32 = 5;
/// The first wait; each further wrong code doubles it.
const FIRST: Duration = Duration::from_secs(30);
/// The longest wait.
const LONGEST: Duration = Duration::from_secs(3600);
/// Addresses that are remembered. Our choice: more than a school's network has.
const MOST: usize = 1024;

#[derive(Clone, Copy)]
struct Failures {
    count: u32,
    last: Instant,
    /// Time until which it has to wait.
    until: Instant,
}

/// Wrong codes by address, and how long each address has to wait.
#[derive(Default)]
pub(super) struct Lockout(HashMap<IpAddr, Failures>);

impl Lockout {
    /// The time that `address` still has to wait.
    pub fn wait(&self, address: IpAddr, now: Instant) -> Option<Duration> {
        let failures = self.0.get(&network(address))?;
        let left = failures.until.checked_duration_since(now)?;
        (!left.is_zero()).then_some(left)
    }

    /// Counts a wrong code from `address`.
    pub fn failed(&mut self, address: IpAddr, now: Instant) {
        let address = network(address);
        if self.0.len() >= MOST && !self.0.contains_key(&address) {
            // The one that has to wait the least, and of those the one that failed first.
            let least = self.0.iter().min_by_key(|(_, f)| (f.until, f.last));
            if let Some(least) = least.map(|(address, _)| *address) {
                self.0.remove(&least);
            }
        }
        let failures = self.0.entry(address).or_insert(Failures {
            count: 0,
            last: now,
            until: now,
        });
        if now.saturating_duration_since(failures.last) > LONGEST {
            failures.count = 0;
        }
        failures.count += 1;
        failures.last = now;
        if let Some(doublings) = failures.count.checked_sub(TRIES) {
            let wait = FIRST.saturating_mul(1 << doublings.min(10)).min(LONGEST);
            failures.until = now + wait;
        }
    }

    /// Clears the count of `address`, from which a right code came.
    pub fn passed(&mut self, address: IpAddr) {
        self.0.remove(&network(address));
    }
}

/// The range of addresses that counts as one: an owner of one IPv6 address has 2^64 of them (RFC 4291, 2.5.4).
fn network(address: IpAddr) -> IpAddr {
    match address.to_canonical() {
        IpAddr::V6(v6) => IpAddr::V6(Ipv6Addr::from_bits(v6.to_bits() >> 64 << 64)),
        v4 => v4,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn v4(n: u32) -> IpAddr {
        IpAddr::from(n.to_be_bytes())
    }

    #[test]
    fn waits_double() {
        let (mut lockout, mut now) = (Lockout::default(), Instant::now());
        for _ in 0..4 {
            lockout.failed(v4(1), now);
            assert_eq!(lockout.wait(v4(1), now), None);
        }
        for seconds in [30, 60, 120, 240, 480, 960, 1920, 3600, 3600] {
            lockout.failed(v4(1), now);
            assert_eq!(lockout.wait(v4(1), now).unwrap().as_secs(), seconds);
            assert_eq!(lockout.wait(v4(2), now), None, "another address");
            now += Duration::from_secs(seconds);
            assert_eq!(lockout.wait(v4(1), now), None, "over");
        }
        lockout.passed(v4(1));
        lockout.failed(v4(1), now);
        assert_eq!(lockout.wait(v4(1), now), None);
        // Wrong codes that are older than the longest wait are forgotten.
        for _ in 0..3 {
            lockout.failed(v4(1), now);
        }
        now += LONGEST + Duration::from_secs(1);
        lockout.failed(v4(1), now);
        assert_eq!(lockout.wait(v4(1), now), None);
    }

    #[test]
    fn memory_is_bounded_and_who_waits_is_kept() {
        let (mut lockout, now) = (Lockout::default(), Instant::now());
        for _ in 0..TRIES {
            lockout.failed(v4(0), now);
        }
        for n in 1..5_000 {
            lockout.failed(v4(n), now + Duration::from_micros(n.into()));
        }
        assert_eq!(lockout.0.len(), MOST);
        assert!(lockout.wait(v4(0), now).is_some());
    }

    #[test]
    fn a_network_is_one_address() {
        let (mut lockout, now) = (Lockout::default(), Instant::now());
        for host in 1..=5_u128 {
            let address = Ipv6Addr::from_bits((0x2001_0db8_u128 << 96) | host);
            lockout.failed(address.into(), now);
        }
        let other = |text: &str| lockout.wait(text.parse().unwrap(), now);
        assert!(other("2001:db8::ffff").is_some());
        assert!(other("2001:db8:0:1::1").is_none());
        // The same address as IPv4, by a socket that takes both.
        lockout.failed("::ffff:10.0.0.1".parse().unwrap(), now);
        assert!(lockout.0.contains_key(&"10.0.0.1".parse().unwrap()));
    }
}
