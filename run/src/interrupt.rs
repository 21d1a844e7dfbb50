//! Whether the user wants the run to stop, as by Ctrl-C: it then ends as one that failed, and takes its files away.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::failure::{Blame, Failure};

static WANTED: AtomicBool = AtomicBool::new(false);

/// Asks for it; whether it was asked for already.
pub fn ask() -> bool {
    WANTED.swap(true, Ordering::Relaxed)
}

/// Whether a run may go on.
///
/// # Errors
/// [`Failure::Other`] where it is to stop.
pub fn check() -> Result<(), Failure> {
    if WANTED.load(Ordering::Relaxed) {
        return Err("stopped, as asked for; what was begun is taken away".to_owned()).other();
    }
    Ok(())
}
