//! Waiting for conditions, however long it takes on a busy machine.

use std::time::{Duration, Instant};

/// Longest wait for anything: no machine is so busy that more is needed, so a longer wait means a hang.
pub const PATIENCE: Duration = Duration::from_secs(300);

/// Time between two tries.
const PAUSE: Duration = Duration::from_millis(20);

/// Calls `ask` until it returns a value.
///
/// # Panics
/// Where it returns none within [`PATIENCE`]; `what` names the condition in the message.
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

/// The result of `work`, and its duration without the time in which this thread waited for a processor that others had: so a limit on it
/// holds on a busy machine too.
///
/// Where the system does not report that wait, all the time that passed.
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
