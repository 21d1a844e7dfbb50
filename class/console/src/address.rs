//! The address of a student's hub, in one word: host and port, the certificate's fingerprint, and the students' key.

use std::fmt;
use std::str::FromStr;

use crate::auth::Secret;
use crate::identity::Fingerprint;

/// `HOST:PORT#FINGERPRINT.KEY`: the certificate's SHA-256 in 64 digits, the students' key in 32.
#[derive(Clone)]
pub struct HubAddress {
    pub(crate) host: String,
    pub(crate) fingerprint: Fingerprint,
    pub(crate) key: Secret,
}

/// The text is no hub's address. It is not repeated: it may have a key.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "this is no hub's address: copy what the hub prints, HOST:PORT#FINGERPRINT.KEY, whole and alone"
)]
pub struct NoHubAddress;

impl HubAddress {
    /// Host and port.
    pub fn host(&self) -> &str {
        &self.host
    }
}

impl fmt::Display for HubAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            host,
            fingerprint,
            key,
        } = self;
        write!(f, "{host}#{}.{}", fingerprint.plain(), key.text())
    }
}

impl fmt::Debug for HubAddress {
    /// Without the key.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}#{}", self.host, self.fingerprint.plain())
    }
}

impl FromStr for HubAddress {
    type Err = NoHubAddress;

    fn from_str(text: &str) -> Result<Self, NoHubAddress> {
        let parse = || {
            let (host, rest) = text.trim().split_once('#')?;
            let (fingerprint, key) = rest.split_once('.')?;
            let (name, port) = host.rsplit_once(':')?;
            port.parse::<u16>().ok()?;
            let sound = |c: char| c.is_ascii_alphanumeric() || "-.:[]".contains(c);
            if name.is_empty() || !name.chars().all(sound) || fingerprint.len() != 64 {
                return None;
            }
            let mut sum = [0; 32];
            for (at, byte) in sum.iter_mut().enumerate() {
                let digits = fingerprint.get(2 * at..2 * at + 2)?;
                // `from_str_radix` takes a sign too.
                if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
                    return None;
                }
                *byte = u8::from_str_radix(digits, 16).ok()?;
            }
            Some(Self {
                host: host.to_owned(),
                fingerprint: Fingerprint(sum),
                key: Secret::from_text(key)?,
            })
        };
        parse().ok_or(NoHubAddress)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn it_reads_what_it_writes() {
        let text = format!("lab-pc:8443#{}.{}", "0f".repeat(32), "a1".repeat(16));
        let address: HubAddress = text.parse().unwrap();
        assert_eq!(address.to_string(), text);
        assert!(!format!("{address:?}").contains("a1a1"), "no key in a log");
        for wrong in [
            text.replace('#', ""),
            text.replace("8443", "84430"),
            text.replace("lab-pc", ""),
            text.replace("lab-pc", "lab pc/"),
            text.replacen("0f", "+f", 1),
            text[..text.len() - 1].to_owned(),
            text.replace('.', "0."),
            String::new(),
        ] {
            assert!(wrong.parse::<HubAddress>().is_err(), "{wrong}");
        }
    }
}
