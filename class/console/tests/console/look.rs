//! What tests of the page share: a tab beside a hub and its students, and expressions about the page's parts.

use serde_json::json;
use tempfile::TempDir;
use vitriol_console::Hub;
use vitriol_tests::browser::Look;
use vitriol_tests::devtools::Tab;

use crate::student::{FakeStudent, hub_in};

/// A hub of that language, students of these names in it, and an empty tab; `None` where there is no browser. The first of them keeps the
/// hub's folder.
pub fn class_of<const N: usize>(
    language: &'static str,
    names: [&str; N],
) -> Option<(TempDir, Hub, [FakeStudent; N], Tab)> {
    let folder = tempfile::tempdir().unwrap();
    let hub = hub_in(language, folder.path());
    let students = names.map(|name| FakeStudent::in_hub(&hub, name));
    let mut tab = Tab::new()?;
    tab.look([1280, 900], Look::Light);
    Some((folder, hub, students, tab))
}

/// Lets the tab in, and waits until it shows the hub's only student.
pub fn open(tab: &mut Tab, hub: &Hub) {
    tab.go(&hub.invite().unwrap().address);
    tab.until(&format!("!{}.hidden", at("student")));
}

/// The part with this id.
pub fn at(id: &str) -> String {
    format!("document.getElementById('{id}')")
}

pub fn click(tab: &mut Tab, id: &str) {
    tab.eval(&format!("{}.click()", at(id)));
}

/// The text of the part with this id.
pub fn text(tab: &mut Tab, id: &str) -> String {
    let text = tab.eval(&format!("{}.textContent", at(id)));
    text.as_str().unwrap().to_owned()
}

/// Whether the part with this id has this text.
pub fn reads(id: &str, text: &str) -> String {
    format!("{}.textContent === {}", at(id), json!(text))
}

/// Whether its text begins so.
pub fn begins(id: &str, text: &str) -> String {
    format!("{}.textContent.startsWith({})", at(id), json!(text))
}

/// Whether the control with this id has the state of the student's program, `aria-pressed`.
pub fn pressed(id: &str, on: bool) -> String {
    format!("{}.getAttribute('aria-pressed') === '{on}'", at(id))
}

/// Checks that the browser complains of nothing but answers that a test provokes.
pub fn no_complaints(tab: &mut Tab) {
    let mut all = tab.complaints();
    all.retain(|complaint| !complaint.contains("Failed to load resource"));
    assert_eq!(all, Vec::<String>::new());
}
