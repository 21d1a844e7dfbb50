//! A mutex's value, whoever panicked with it.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Locks, ignoring poison: every guarded value is valid between statements.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
