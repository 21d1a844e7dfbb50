//! The address of a Learning Record Store.

use std::net::IpAddr;
use std::str::FromStr;

// The sender's own type, so that both find the same host in an address.
use ureq::http::Uri;

/// An address that pseudonyms and a token may go to: `https`, or this machine itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Endpoint {
    /// The address, without the slash at its end and without the resource of statements behind it.
    address: String,
    /// Whether it is unencrypted; then it is on this machine.
    plain: bool,
}

/// Why an address cannot be a Learning Record Store's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EndpointError {
    /// The text is no address.
    #[error("'{0}' is no address: {RIGHT}")]
    NoAddress(String),
    /// Neither http nor https.
    #[error("'{0}' begins with neither https:// nor http://: {RIGHT}")]
    Scheme(String),
    /// It has a name or password, which would be in the list of processes and hides the host.
    #[error("an '@' in the address: name and password belong into the token's file; {RIGHT}")]
    User,
    /// It has a part after the path.
    #[error("'{0}' has a '?' or '#' in it: {RIGHT}")]
    Query(String),
    /// It is unencrypted on another machine: everybody on the way could read the statements.
    #[error(
        "http://{0} is another machine, and everybody on the way could read what is sent: use https; http is for localhost, 127.0.0.1 and [::1] alone"
    )]
    Plain(String),
}

/// Remedy for messages.
pub(super) const RIGHT: &str = "an address is such as https://lrs.example.org/xAPI";

/// The resource at which statements are stored and queried (xAPI 1.0.3, Communication, 2.1).
const STATEMENTS: &str = "/statements";

impl Endpoint {
    /// The address, without the slash at its end and without `/statements`.
    pub fn as_str(&self) -> &str {
        &self.address
    }

    /// Whether it is `http`, and so on this machine.
    pub(super) fn is_plain(&self) -> bool {
        self.plain
    }

    /// Address at which statements are stored and queried.
    pub(super) fn statements(&self) -> String {
        format!("{}{STATEMENTS}", self.address)
    }
}

impl FromStr for Endpoint {
    type Err = EndpointError;

    fn from_str(text: &str) -> Result<Self, EndpointError> {
        // Checked first: the text before it may be a password, which no message repeats.
        if text.contains('@') {
            return Err(EndpointError::User);
        }
        // The parser drops the text after a '#'.
        if text.contains(['?', '#']) {
            return Err(EndpointError::Query(text.into()));
        }
        let no_address = || EndpointError::NoAddress(text.into());
        let uri: Uri = text.parse().map_err(|_| no_address())?;
        let plain = match uri.scheme_str() {
            Some("https") => false,
            Some("http") => true,
            _ => return Err(EndpointError::Scheme(text.into())),
        };
        let authority = uri.authority().ok_or_else(no_address)?;
        let host = authority.host();
        let port = authority.as_str().strip_prefix(host);
        let port_is_one = match port.map(|port| port.strip_prefix(':')) {
            Some(None) => port == Some(""),
            Some(Some(port)) => port.parse::<u16>().is_ok_and(|port| port > 0),
            None => false,
        };
        if host.is_empty() || !port_is_one {
            return Err(no_address());
        }
        if plain && !is_loopback(host) {
            return Err(EndpointError::Plain(authority.to_string()));
        }
        let scheme = if plain { "http" } else { "https" };
        let path = uri.path().trim_end_matches('/');
        // Some stores show their users the address of this resource.
        let path = path.strip_suffix(STATEMENTS).unwrap_or(path);
        let path = path.trim_end_matches('/');
        Ok(Self {
            address: format!("{scheme}://{}{path}", authority.as_str().to_lowercase()),
            plain,
        })
    }
}

/// Whether a host is this machine by what it is called: `localhost` is by RFC 6761, section 6.3, and an address by its number.
fn is_loopback(host: &str) -> bool {
    let number = host.trim_start_matches('[').trim_end_matches(']');
    host.eq_ignore_ascii_case("localhost")
        || number.parse().is_ok_and(|it: IpAddr| it.is_loopback())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// What was given, and the address that it is.
    const ADDRESSES: &str = "
https://lrs.example.org/xAPI/ https://lrs.example.org/xAPI
HTTPS://LRS.example.org:8443 https://lrs.example.org:8443
http://localhost:8100/xAPI http://localhost:8100/xAPI
http://127.0.0.1 http://127.0.0.1
http://127.9.9.9:1/a/b http://127.9.9.9:1/a/b
http://[::1]:8100 http://[::1]:8100
https://lrs.example.org/xAPI/statements https://lrs.example.org/xAPI
https://lrs.example.org/xAPI//statements// https://lrs.example.org/xAPI
http://localhost/statements http://localhost
https://lrs.example.org/my-statements https://lrs.example.org/my-statements
";

    #[test]
    fn encrypted_or_this_machine() {
        for pair in ADDRESSES.trim().lines() {
            let (text, address) = pair.split_once(' ').unwrap();
            let endpoint: Endpoint = text.parse().unwrap();
            assert_eq!(endpoint.as_str(), address);
            assert_eq!(endpoint.statements(), format!("{address}/statements"));
            assert_eq!(endpoint.is_plain(), address.starts_with("http:"));
        }
        for elsewhere in [
            "http://lrs.example.org",
            "http://localhost.evil.com/xAPI",
            "http://localhost.",
            "http://127.0.0.1.evil.com",
            "http://127.1",
            "http://2130706433",
            "http://0x7f000001",
            "http://0.0.0.0:8100",
            "http://10.0.0.1",
            "http://[::ffff:10.0.0.1]",
            "http://[2001:db8::1]:80",
            "http://evil.com:80/127.0.0.1",
        ] {
            let error = elsewhere.parse::<Endpoint>().unwrap_err();
            assert!(
                matches!(error, EndpointError::Plain(_)),
                "{elsewhere}: {error}"
            );
        }
        for hidden in [
            "http://127.0.0.1@evil",
            "http://localhost:80@evil.com/",
            "https://user:secret@lrs.example.org",
            "http://evil.com/@127.0.0.1",
        ] {
            let error = hidden.parse::<Endpoint>().unwrap_err();
            assert_eq!(error, EndpointError::User);
            assert!(!error.to_string().contains("secret"));
        }
        for none in [
            "",
            "lrs",
            "localhost:8100",
            "/xAPI",
            "ftp://localhost",
            "file:///etc",
            "http://",
            "http:///xAPI",
            "https://a b",
            "http://localhost:99999",
            "http://localhost:",
            "https://:443",
            "http://localhost\\.evil.com",
            "http://localhost:8100?x",
            "http://localhost#.evil.com",
            "http:\\\\localhost",
            "http://[::1",
            "http://local\thost",
            "https://lrs:80:80",
        ] {
            assert!(none.parse::<Endpoint>().is_err(), "{none}");
        }
    }
}
