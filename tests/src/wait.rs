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

/// What `work` gives, and how long this thread stood still in it: asleep, or waiting for another
/// thread, a program or a disk. That it waited for a processor which others had does not count, so
/// that a limit on it holds on a busy machine too.
///
/// Elsewhere than on Linux, all the time that passed.
pub fn standing<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let (begun, before) = (Instant::now(), busy());
    let done = work();
    let busy = busy().saturating_sub(before);
    (done, begun.elapsed().saturating_sub(busy))
}

/// Time that this thread has run or waited for a processor, where the system says.
fn busy() -> Duration {
    if cfg!(not(target_os = "linux")) {
        return Duration::ZERO;
    }
    // Both in ns, and how often it ran (Linux, Documentation/scheduler/sched-stats.rst).
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").expect("schedstat");
    let times = told.split_whitespace().take(2);
    times
        .map(|time| Duration::from_nanos(time.parse().expect("a time")))
        .sum()
}
