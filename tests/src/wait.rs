//! Waiting for what happens, however long it takes on a busy machine.

use std::time::{Duration, Instant};

/// Longest wait for anything: no machine is so busy, so what takes longer hangs.
pub const PATIENCE: Duration = Duration::from_secs(300);

/// Time between two questions.
const PAUSE: Duration = Duration::from_millis(20);

/// Asks until there is an answer.
///
/// # Panics
/// Where none comes within [`PATIENCE`]; `what` says in vain for what.
pub fn until<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    let begun = Instant::now();
    loop {
        if let Some(answer) = ask() {
            return answer;
        }
        assert!(begun.elapsed() < PATIENCE, "waited in vain: {what}");
        std::thread::sleep(PAUSE);
    }
}

/// What `work` gives, and how long it took but for the time in which this thread waited for a
/// processor that others had: a limit on it holds on a busy machine too.
///
/// Where the system does not tell that wait, all the time that passed.
pub fn own_time<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let (begun, before) = (Instant::now(), queued());
    let done = work();
    let queued = queued().saturating_sub(before);
    (done, begun.elapsed().saturating_sub(queued))
}

/// Time for which this thread has waited for a processor.
fn queued() -> Duration {
    // Time run and time waited, ns, and how often it ran (Linux, Documentation/scheduler/sched-stats.rst).
    let told = std::fs::read_to_string("/proc/thread-self/schedstat");
    let waited = told
        .ok()
        .and_then(|told| told.split_whitespace().nth(1)?.parse().ok());
    Duration::from_nanos(waited.unwrap_or_default())
}
