//! Programs that `./lab setup` installs in the user's cache for tests alone.

use std::path::PathBuf;

/// The folder of that `name`, whose contents are `what`; `None` if it is missing, with a message on standard error. With `CI=true` that is
/// a failure instead.
///
/// # Panics
/// Where it is missing and `CI=true`.
pub(crate) fn find(name: &str, what: &str, test: &str) -> Option<PathBuf> {
    let cache = std::env::var_os("XDG_CACHE_HOME").map(PathBuf::from);
    let home = || PathBuf::from(std::env::var_os("HOME").unwrap_or_else(|| "/root".into()));
    let cache = cache.unwrap_or_else(|| home().join(".cache"));
    let root = cache.join("vitriol").join(name);
    if root.join("complete").exists() {
        return Some(root);
    }
    not_tested(&format!(
        "{test}: {what} not installed (./lab setup does it)"
    ));
    None
}

/// Writes to standard error that something could not be tested.
///
/// # Panics
/// With `CI=true`.
pub(crate) fn not_tested(cause: &str) {
    assert!(std::env::var("CI").as_deref() != Ok("true"), "{cause}");
    eprintln!("NOT TESTED: {cause}");
}
