//! The page: one HTML in one language, its style and its script within, nothing else to load.

use std::collections::BTreeMap;

use axum::body::Bytes;
use axum::http::HeaderValue;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use ring::digest::{SHA256, digest};

const HTML: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");
/// The scripts, in this order, in one function.
const SCRIPTS: [&str; 6] = [
    include_str!("page/base.js"),
    include_str!("page/class.js"),
    include_str!("page/view.js"),
    include_str!("page/zoom.js"),
    include_str!("page/controls.js"),
    include_str!("page/plots.js"),
];

/// Texts of the page, by the language's code. The first is English.
static TEXTS: [(&str, &str); 4] = [
    ("en", include_str!("page/texts/en.json")),
    ("de", include_str!("page/texts/de.json")),
    ("es", include_str!("page/texts/es.json")),
    ("zh", include_str!("page/texts/zh.json")),
];

/// The page as it is sent, with its policy.
pub(crate) struct Page {
    pub html: Bytes,
    /// What browsers may do with it (Content-Security-Policy): run this script, use this style, connect to this server, and nothing else.
    pub policy: HeaderValue,
}

impl Page {
    /// Puts the page together in that language, or in English where it has no texts in it.
    pub fn new(language: &str) -> Self {
        let known = TEXTS.iter().find(|(code, _)| *code == language);
        let (code, table) = known.unwrap_or(&TEXTS[0]);
        // In a script a tag's begin could end it.
        let table = table.replace('<', "\\u003c");
        // A table that cannot be read is ruled out by a test.
        let texts: BTreeMap<String, String> = serde_json::from_str(&table).unwrap_or_default();
        let mut html = HTML.replace("{{lang}}", code);
        for (key, text) in &texts {
            html = html.replace(&format!("{{{{{key}}}}}"), &escaped(text));
        }
        let script = format!(
            "\"use strict\";(() => {{\nconst TEXTS = {table};\n{}}})();\n",
            SCRIPTS.concat()
        );
        let html = html
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

/// Text in HTML, also within quotes.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('"', "&quot;")
}

/// The hash by which a policy allows a script or a style.
fn source(text: &str) -> String {
    let hash = digest(&SHA256, text.as_bytes());
    format!("sha256-{}", STANDARD.encode(hash))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn texts(table: &str) -> BTreeMap<String, String> {
        serde_json::from_str(table).unwrap()
    }

    /// A text's holes.
    fn holes(text: &str) -> BTreeSet<&str> {
        let parts = text.split('{').skip(1);
        parts.map(|part| part.split('}').next().unwrap()).collect()
    }

    /// Each language has each key of English, with its holes, and in words of its own.
    #[test]
    fn each_language_says_all_that_english_says() {
        let english = texts(TEXTS[0].1);
        for (language, table) in &TEXTS[1..] {
            let other = texts(table);
            assert!(other.keys().eq(english.keys()), "{language}");
            for (key, text) in &english {
                assert_eq!(holes(&other[key]), holes(text), "{language} {key}");
                assert_ne!(&other[key], text, "{language} {key}");
            }
        }
    }

    /// All scripts are one: of two functions of a name the later one would count.
    #[test]
    fn no_function_is_declared_twice() {
        let scripts = SCRIPTS.concat();
        let heads = scripts
            .lines()
            .map(|line| line.trim_start_matches("async "));
        let names = heads.filter_map(|line| line.strip_prefix("function ")?.split('(').next());
        let names: Vec<&str> = names.collect();
        let different: BTreeSet<_> = names.iter().collect();
        assert_eq!(names.len(), different.len(), "{names:?}");
    }

    /// Each text is used, and each that is used is there: in the page by `{{key}}`, in the scripts by its key in quotes, and with
    /// `_one` and `_more` by what is counted.
    #[test]
    fn each_text_is_used() {
        let scripts = SCRIPTS.concat();
        let english = texts(TEXTS[0].1);
        for key in english.keys() {
            let counted = ["_one", "_more"].iter().find_map(|it| key.strip_suffix(it));
            let quoted = format!("\"{}\"", counted.unwrap_or(key));
            let used = HTML.contains(&format!("{{{{{key}}}}}")) || scripts.contains(&quoted);
            assert!(used, "{key}");
        }
        let asked = scripts.split("tr(\"").skip(1);
        for key in asked.map(|it| it.split('"').next().unwrap()) {
            assert!(english.contains_key(key), "{key}");
        }
    }

    /// The page has its language, no hole that is not filled, and loads nothing from elsewhere.
    #[test]
    fn a_page_is_whole_in_each_language() {
        for (language, table) in TEXTS {
            let page = Page::new(language);
            let html = String::from_utf8(page.html.to_vec()).unwrap();
            assert!(html.contains(&format!("<html lang=\"{language}\">")));
            assert!(!html.contains("{{") && !html.contains("://"), "{language}");
            let title = format!("<title>{}</title>", texts(table)["title"]);
            assert!(html.contains(&title), "{language}");
            assert!(page.policy.to_str().unwrap().contains("sha256-"));
        }
        // One without texts is English.
        assert_eq!(Page::new("fr").html, Page::new("en").html);
    }
}
