//! From which pages requests may come: from this server's own. A foreign page that a browser shows could use its cookie,
//! or reach this server by a name of its own (DNS rebinding), so names are known ones and addresses are plain.

use std::net::{IpAddr, Ipv6Addr};

/// This server's identity to browsers.
#[derive(Clone, Debug)]
pub(crate) struct Site {
    /// Whether it uses HTTPS.
    pub tls: bool,
    /// Its port.
    pub port: u16,
    /// Names that it is known by, in small letters.
    pub names: Vec<String>,
}

impl Site {
    /// `http` or `https`.
    pub fn scheme(&self) -> &'static str {
        if self.tls { "https" } else { "http" }
    }

    /// Whether a request with this `Host` is for this server: an address, which no name server gives away, or a name
    /// that it is known by, with its port.
    pub fn is_host(&self, host: &str) -> bool {
        let standard = if self.tls { 443 } else { 80 };
        let colon = host
            .rfind(':')
            .filter(|at| *at > host.rfind(']').unwrap_or(0));
        let (name, port) = match colon {
            Some(at) => match host[at + 1..].parse() {
                Ok(port) => (&host[..at], port),
                Err(_) => return false,
            },
            None => (host, standard),
        };
        let bracketed = name.strip_prefix('[').and_then(|n| n.strip_suffix(']'));
        let plain = match bracketed {
            Some(name) => name.parse::<Ipv6Addr>().is_ok(),
            None => name
                .parse::<IpAddr>()
                .is_ok_and(|address| address.is_ipv4()),
        };
        port == self.port && (plain || self.names.contains(&name.to_ascii_lowercase()))
    }

    /// Whether `origin` is the origin of pages from `host`.
    pub fn is_origin(&self, origin: &str, host: &str) -> bool {
        let rest = origin.strip_prefix(self.scheme());
        let rest = rest.and_then(|rest| rest.strip_prefix("://"));
        rest.is_some_and(|rest| rest.eq_ignore_ascii_case(host))
    }

    /// Name of the cookie. Cookies do not know ports, so it has the port; browsers take one with that prefix only from
    /// HTTPS, with `Secure` and for no other host (RFC 6265bis, 4.1.3).
    pub fn cookie(&self) -> String {
        let prefix = if self.tls { "__Host-" } else { "" };
        format!("{prefix}vitriol-{}", self.port)
    }

    /// The header that sets the cookie, or takes it away where `value` is empty.
    pub fn set_cookie(&self, value: &str) -> String {
        // Plain HTTP is on loopback alone, where some browsers keep no `Secure` cookie.
        let secure = if self.tls { "; Secure" } else { "" };
        let age = if value.is_empty() { "; Max-Age=0" } else { "" };
        let name = self.cookie();
        format!("{name}={value}; Path=/; HttpOnly; SameSite=Strict{secure}{age}")
    }

    /// The cookie's value in a `Cookie` header.
    pub fn value<'a>(&self, header: &'a str) -> Option<&'a str> {
        let name = self.cookie();
        let pairs = header
            .split(';')
            .filter_map(|pair| pair.trim().split_once('='));
        pairs
            .filter(|(key, _)| *key == name)
            .map(|(_, value)| value)
            .next()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn site(tls: bool, port: u16) -> Site {
        Site {
            tls,
            port,
            names: vec!["localhost".to_owned(), "lab-pc".to_owned()],
        }
    }

    #[test]
    fn hosts_are_addresses_or_known_names_with_the_port() {
        let here = site(false, 8080);
        for host in [
            "localhost:8080",
            "LocalHost:8080",
            "127.0.0.1:8080",
            "[::1]:8080",
            "lab-pc:8080",
        ] {
            assert!(here.is_host(host), "{host}");
        }
        for host in [
            "",
            "localhost",
            "localhost:80",
            "localhost:",
            "localhost:8080:8080",
            "evil.example:8080",
            "127.0.0.1.evil.example:8080",
            "[evil]:8080",
            "::1:8080",
            "localhost:8080@evil.example",
            "localhost.:8080",
        ] {
            assert!(!here.is_host(host), "{host}");
        }
        assert!(site(true, 443).is_host("192.0.2.1"));
        assert!(site(false, 80).is_host("[::1]"));
        assert!(!site(true, 443).is_host("192.0.2.1:80"));
    }

    #[test]
    fn origins_are_this_page() {
        let here = site(true, 8443);
        assert!(here.is_origin("https://192.0.2.1:8443", "192.0.2.1:8443"));
        for origin in [
            "http://192.0.2.1:8443",
            "https://192.0.2.1",
            "https://192.0.2.1:8444",
            "null",
            "",
            "https://evil.example",
            "https://192.0.2.1:8443.evil.example",
            "https://192.0.2.1:8443/",
        ] {
            assert!(!here.is_origin(origin, "192.0.2.1:8443"), "{origin}");
        }
    }

    #[test]
    fn cookies_are_kept_from_scripts_other_sites_and_plain_http() {
        let (plain, safe) = (site(false, 8080), site(true, 8443));
        assert_eq!(
            safe.set_cookie("ab"),
            "__Host-vitriol-8443=ab; Path=/; HttpOnly; SameSite=Strict; Secure"
        );
        assert_eq!(
            plain.set_cookie(""),
            "vitriol-8080=; Path=/; HttpOnly; SameSite=Strict; Max-Age=0"
        );
        let header = "vitriol-8081=x; vitriol-8080=ab; other=y";
        assert_eq!(plain.value(header), Some("ab"));
        assert_eq!(plain.value("vitriol-80800=x; xvitriol-8080=ab"), None);
    }
}
