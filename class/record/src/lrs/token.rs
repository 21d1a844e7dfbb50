//! The sender's credentials for a Learning Record Store.

use std::fmt;
#[cfg(unix)]
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// The value of the header `Authorization`. It is printed in no message.
#[derive(Clone, PartialEq, Eq)]
pub struct Token(String);

/// Why a file has no usable token.
#[derive(Debug, thiserror::Error)]
pub enum TokenError {
    /// The system does not tell who may read the file.
    #[error(
        "{path}: who may read the token cannot be found out: {source}; is the file there and yours?"
    )]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// Other users may read the file.
    #[error(
        "{path}: other users of this machine may read the token ({mode:o}); run 'chmod 600' on the file"
    )]
    Open {
        /// The file.
        path: PathBuf,
        /// Its permissions.
        mode: u32,
    },
    /// The file has other contents than a token.
    #[error(
        "{path}: holds no token; it has one line, 'Bearer TOKEN', 'Basic BASE64' or 'NAME:PASSWORD'"
    )]
    None {
        /// The file.
        path: PathBuf,
    },
}

impl Token {
    /// The token of the file `path`, which holds that one line: `Bearer TOKEN`, `Basic BASE64` or `NAME:PASSWORD`. On Unix only the file's
    /// owner may read it, as OpenSSH requires of a key.
    ///
    /// # Errors
    /// [`TokenError`].
    pub fn held(path: &Path, line: &str) -> Result<Self, TokenError> {
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let file = fs::metadata(path).map_err(|source| TokenError::Read {
                path: path.to_owned(),
                source,
            })?;
            let mode = file.permissions().mode() & 0o777;
            if mode & 0o077 != 0 {
                return Err(TokenError::Open {
                    path: path.to_owned(),
                    mode,
                });
            }
        }
        Self::of(line).ok_or_else(|| TokenError::None {
            path: path.to_owned(),
        })
    }

    pub(super) fn of(line: &str) -> Option<Self> {
        // One line break would begin another header.
        if line.is_empty() || line.contains(char::is_control) {
            return None;
        }
        let graphic = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_graphic());
        match line.split_once(' ') {
            Some((scheme @ ("Bearer" | "Basic"), rest)) => {
                graphic(rest).then(|| Self(format!("{scheme} {rest}")))
            }
            _ if line.contains(':') => Some(Self(format!("Basic {}", STANDARD.encode(line)))),
            _ => None,
        }
    }

    pub(super) fn header(&self) -> &str {
        &self.0
    }
}

impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token(…)")
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn a_line_is_a_header() {
        let header = |line| Token::of(line).map(|token| token.0);
        // RFC 7617, section 2, and RFC 6750, section 2.1.
        let basic = Some("Basic QWxhZGRpbjpvcGVuIHNlc2FtZQ==".to_owned());
        assert_eq!(header("Aladdin:open sesame"), basic);
        assert_eq!(header("Basic QWxhZGRpbjpvcGVuIHNlc2FtZQ=="), basic);
        assert_eq!(
            header("Bearer mF_9.B5f-4.1JqM"),
            Some("Bearer mF_9.B5f-4.1JqM".into())
        );
        for none in [
            "",
            "secret",
            "Bearer ",
            "Bearer a b",
            "a:b\nX: y",
            "Basic a\r\nb",
        ] {
            assert_eq!(header(none), None, "{none:?}");
        }
        assert!(!format!("{:?}", Token::of("a:secret")).contains("secret"));
    }

    #[cfg(unix)]
    #[test]
    fn what_others_may_read_is_no_secret() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("token");
        fs::write(&path, "name:password\n").unwrap();
        for (mode, secret) in [
            (0o644, false),
            (0o640, false),
            (0o602, false),
            (0o600, true),
            (0o400, true),
        ] {
            fs::set_permissions(&path, fs::Permissions::from_mode(mode)).unwrap();
            let read = Token::held(&path, "name:password");
            assert_eq!(read.is_ok(), secret, "{mode:o}");
            if let Err(error) = read {
                assert!(error.to_string().contains("chmod 600"), "{error}");
            }
        }
    }
}
