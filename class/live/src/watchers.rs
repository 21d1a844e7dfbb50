//! Pages that look at a session while it is measured, and how long a switch takes from one of them.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use serde::Serialize;
use vitriol_console::{Codec, Command, Heard, Hub, NotServed, Text, Watcher};
use vitriol_run::{Blame, Failure};

use vitriol_run::Spread;

/// Time between two switches. Our choice: a second has three.
const EVERY: Duration = Duration::from_millis(300);

/// The measurements of watching pages.
#[derive(Clone, Debug, Serialize)]
pub struct WatchReport {
    /// How many looked.
    pub watchers: usize,
    /// Pictures that came to all of them.
    pub pictures: u64,
    /// From an order to the first state in which it counts, as a page receives it, ms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub switch_ms: Option<Spread>,
}

/// Pages that watch a session, each on a thread of its own, until they are asked for their measurements.
pub struct Watchers {
    over: Arc<AtomicBool>,
    pictures: Arc<AtomicU64>,
    threads: Vec<JoinHandle<Vec<f64>>>,
}

impl Watchers {
    /// So many, each on a thread of its own; the first one gives orders.
    ///
    /// # Errors
    /// Where the hub does not serve them.
    pub fn start(hub: &Hub, count: usize) -> Result<Self, Failure> {
        let (over, pictures) = (Arc::new(AtomicBool::new(false)), Arc::default());
        let mut threads = Vec::new();
        for number in 0..count {
            let mut watcher = Watcher::enter(hub, Codec::H264).other()?;
            let (over, pictures) = (Arc::clone(&over), Arc::clone(&pictures));
            let orders = number == 0;
            threads.push(std::thread::spawn(move || {
                let mut took = Vec::new();
                // One whose session is over is served no more.
                let _ = watch(&mut watcher, orders, &over, &pictures, &mut took);
                took
            }));
        }
        Ok(Self {
            over,
            pictures,
            threads,
        })
    }

    /// What they saw.
    pub fn report(self) -> WatchReport {
        self.over.store(true, Ordering::Relaxed);
        let watchers = self.threads.len();
        let took: Vec<f64> = (self.threads.into_iter())
            // A thread that panicked has reported that itself.
            .filter_map(|thread| thread.join().ok())
            .flatten()
            .collect();
        WatchReport {
            watchers,
            pictures: self.pictures.load(Ordering::Relaxed),
            switch_ms: Spread::of(&took),
        }
    }
}

fn watch(
    watcher: &mut Watcher,
    orders: bool,
    over: &AtomicBool,
    pictures: &AtomicU64,
    took: &mut Vec<f64>,
) -> Result<(), NotServed> {
    let mut due = Instant::now() + EVERY;
    // When the last order was given, and its number once it is known.
    let mut given: Option<(Instant, Option<u64>)> = None;
    let mut count = 0;
    while !over.load(Ordering::Relaxed) {
        if orders && given.is_none() && Instant::now() >= due {
            count += 1;
            let text = Text::clipped(&format!("{count}"));
            given = Some((Instant::now(), None));
            watcher.order(&Command::Message { text })?;
        }
        match watcher.hear()? {
            Heard::Picture(_) => {
                pictures.fetch_add(1, Ordering::Relaxed);
            }
            Heard::Ordered(number) => {
                given = given.map(|(at, _)| (at, Some(number)));
            }
            Heard::State(done) => {
                if let Some((at, Some(number))) = given
                    && done >= number
                {
                    took.push(1e3 * at.elapsed().as_secs_f64());
                    (given, due) = (None, Instant::now() + EVERY);
                }
            }
            Heard::Other => {}
        }
    }
    Ok(())
}
