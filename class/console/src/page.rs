//! The page: one HTML, its style and its script within, nothing else to load.

use axum::body::Bytes;
use axum::http::HeaderValue;
use ring::digest::{SHA256, digest};

const HTML: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");
/// The scripts, in this order, in one function.
const SCRIPTS: [&str; 5] = [
    include_str!("page/base.js"),
    include_str!("page/class.js"),
    include_str!("page/view.js"),
    include_str!("page/controls.js"),
    include_str!("page/plots.js"),
];

/// The page as it is sent, with its policy.
pub(crate) struct Page {
    pub html: Bytes,
    /// What browsers may do with it (Content-Security-Policy): run this script, use this style, connect to this server, and nothing else.
    pub policy: HeaderValue,
}

impl Page {
    /// Puts the page together.
    pub fn new() -> Self {
        let script = format!("\"use strict\";(() => {{\n{}}})();\n", SCRIPTS.concat());
        let html = HTML
            .replacen("/*style*/", STYLE, 1)
            .replacen("/*script*/", &script, 1);
        let policy = format!(
            "default-src 'none'; script-src '{}'; style-src '{}'; connect-src 'self'; img-src data:; \
             base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
            source(&script),
            source(STYLE),
        );
        Self {
            html: Bytes::from(html),
            policy: HeaderValue::from_str(&policy)
                .unwrap_or(HeaderValue::from_static("default-src 'none'")),
        }
    }
}

/// The hash by which a policy allows a script or a style.
fn source(text: &str) -> String {
    format!(
        "sha256-{}",
        base64(digest(&SHA256, text.as_bytes()).as_ref())
    )
}

/// Encodes in base 64 (RFC 4648, 4).
fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let mut bits = 0;
        for at in 0..3 {
            bits = bits << 8 | u32::from(three.get(at).copied().unwrap_or(0));
        }
        for at in 0..4 {
            let digit = ALPHABET[(bits >> (18 - 6 * at) & 63) as usize];
            text.push(if at <= three.len() { digit.into() } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Test vectors of RFC 4648, 10.
    #[test]
    fn base64_is_that_of_the_rfc() {
        let pairs = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, coded) in pairs {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
