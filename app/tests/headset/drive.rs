//! A keyframed track as Monado's head and hands.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use vitriol_tests::monado::{Controller, Remote, Rig};
use vitriol_xr::track::Keyframes;
use vitriol_xr::{Hand, PoseFrame, Side};

/// Time between packets: an eighth of the runtime's display period.
const TICK: Duration = Duration::from_millis(6);

/// The pour that is driven.
pub fn track() -> Keyframes {
    let text = include_str!("../../../xr/tracks/two-flasks.toml");
    Keyframes::parse(text, Path::new("two-flasks.toml")).unwrap()
}

/// A thread that sends a track's poses at some of its speed. It stands at the start until it is
/// let go, and at the end when it is through.
pub struct Driver {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

struct Shared {
    track: Keyframes,
    speed: f64,
    clock: Mutex<Clock>,
    remote: Mutex<Option<Remote>>,
    /// The controllers are switched off.
    asleep: AtomicBool,
    stop: AtomicBool,
}

/// Where the track is.
#[derive(Default)]
struct Clock {
    /// Track time until it was last halted, s.
    before: f64,
    /// Since when it runs.
    since: Option<Instant>,
}

impl Shared {
    fn time(&self) -> f64 {
        let clock = self.clock.lock().unwrap();
        let since = clock
            .since
            .map_or(0.0, |since| since.elapsed().as_secs_f64());
        (clock.before + self.speed * since).min(self.track.duration)
    }
}

impl Driver {
    pub fn start(rig: &Rig, track: Keyframes, speed: f64) -> Self {
        let shared = Arc::new(Shared {
            track,
            speed,
            clock: Mutex::default(),
            remote: Mutex::new(Some(rig.remote())),
            asleep: AtomicBool::new(false),
            stop: AtomicBool::new(false),
        });
        let of = Arc::clone(&shared);
        let thread = std::thread::spawn(move || {
            while !of.stop.load(Ordering::Relaxed) {
                let mut frame = of.track.sample(0, of.time());
                if of.asleep.load(Ordering::Relaxed) {
                    frame.hands = [Hand::default(), Hand::default()];
                }
                let mut remote = of.remote.lock().unwrap();
                // Without an answer the service was killed.
                if remote.as_mut().is_some_and(|it| send(it, &frame).is_err()) {
                    *remote = None;
                }
                drop(remote);
                std::thread::sleep(TICK);
            }
        });
        Self {
            shared,
            thread: Some(thread),
        }
    }

    /// Lets the track run.
    pub fn go(&self) {
        self.shared.clock.lock().unwrap().since = Some(Instant::now());
    }

    /// Stops it where it is.
    pub fn halt(&self) {
        let before = self.shared.time();
        *self.shared.clock.lock().unwrap() = Clock {
            before,
            since: None,
        };
    }

    /// Lets it run from its start.
    pub fn restart(&self) {
        *self.shared.clock.lock().unwrap() = Clock {
            before: 0.0,
            since: Some(Instant::now()),
        };
    }

    /// Switches the controllers off, or on again.
    pub fn sleep(&self, asleep: bool) {
        self.shared.asleep.store(asleep, Ordering::Relaxed);
    }

    /// Waits until the track is there, s.
    pub fn reach(&self, time: f64) {
        while self.shared.time() < time {
            std::thread::sleep(TICK);
        }
    }

    /// Waits until the track is through.
    pub fn wait(&self) {
        self.reach(self.shared.track.duration);
    }

    /// Takes hold of a service that was started again.
    pub fn connect(&self, rig: &Rig) {
        *self.shared.remote.lock().unwrap() = Some(rig.remote());
    }
}

impl Drop for Driver {
    fn drop(&mut self) {
        self.shared.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn send(remote: &mut Remote, frame: &PoseFrame) -> std::io::Result<()> {
    let head = &frame.stage_from_view;
    remote.head(head.position, head.orientation);
    for side in Side::BOTH {
        let hand = frame.hand(side);
        let grip = &hand.stage_from_grip;
        remote.controller(
            side as usize,
            &Controller {
                position: grip.position,
                orientation: grip.orientation,
                squeeze: hand.squeeze,
                trigger: hand.trigger,
                active: hand.active,
                ..Controller::default()
            },
        );
    }
    remote.send()
}
