//! Access to a mutex's value even if a thread panicked with it; and the time that threads wait for those that they share.

use std::cell::Cell;
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::{Duration, Instant};

/// Waits for one kind of lock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Waits {
    /// Number of times that another thread held the lock.
    pub count: u64,
    /// Time of all waits together.
    pub total: Duration,
    /// Time of the longest wait.
    pub longest: Duration,
}

impl Waits {
    /// Adds the waits of `others`.
    pub fn add(&mut self, others: &Self) {
        self.count += others.count;
        self.total += others.total;
        self.longest = self.longest.max(others.longest);
    }
}

/// How long a thread waited for other threads of this program that use the same device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LockWaits {
    /// For a queue: to submit, and to recycle finished submissions.
    pub queue: Waits,
    /// For the device's memory: to allocate and to free.
    pub memory: Waits,
}

impl LockWaits {
    /// Waits of the calling thread since its last call of this function.
    pub fn take() -> Self {
        WAITED.take()
    }

    /// Adds the waits of `others`.
    pub fn add(&mut self, others: &Self) {
        self.queue.add(&others.queue);
        self.memory.add(&others.memory);
    }
}

thread_local! {
    static WAITED: Cell<LockWaits> = Cell::default();
}

/// Locks, ignoring poison: every guarded value is valid between statements.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// As [`lock`], for a queue's state.
pub(crate) fn lock_queue<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    counted(mutex, |waits| &mut waits.queue)
}

/// As [`lock`], for the allocator.
pub(crate) fn lock_memory<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    counted(mutex, |waits| &mut waits.memory)
}

/// Locks, and counts and times the wait only where another thread holds the lock: otherwise no clock is read.
fn counted<T>(mutex: &Mutex<T>, of: fn(&mut LockWaits) -> &mut Waits) -> MutexGuard<'_, T> {
    match mutex.try_lock() {
        Ok(guard) => return guard,
        Err(TryLockError::Poisoned(poisoned)) => return poisoned.into_inner(),
        Err(TryLockError::WouldBlock) => {}
    }
    let begun = Instant::now();
    let guard = lock(mutex);
    let waited = begun.elapsed();
    let mut all = WAITED.get();
    of(&mut all).add(&Waits {
        count: 1,
        total: waited,
        longest: waited,
    });
    WAITED.set(all);
    guard
}
