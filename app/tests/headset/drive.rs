//! A keyframed track as Monado's head and hands.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use vitriol_tests::monado::{Controller, Remote, Rig};
use vitriol_xr::track::Keyframes;
use vitriol_xr::{PoseFrame, Side};

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
    begun: Mutex<Option<Instant>>,
    remote: Mutex<Option<Remote>>,
    stop: AtomicBool,
}

impl Driver {
    pub fn start(rig: &Rig, track: Keyframes, speed: f64) -> Self {
        let shared = Arc::new(Shared {
            begun: Mutex::new(None),
            remote: Mutex::new(Some(rig.remote())),
            stop: AtomicBool::new(false),
        });
        let of = Arc::clone(&shared);
        let thread = std::thread::spawn(move || {
            while !of.stop.load(Ordering::Relaxed) {
                let begun = *of.begun.lock().unwrap();
                let t = begun.map_or(0.0, |begun| begun.elapsed().as_secs_f64() * speed);
                let frame = track.sample(0, t.min(track.duration));
                let mut remote = of.remote.lock().unwrap();
                if let Some(it) = remote.as_mut()
                    && send(it, &frame).is_err()
                {
                    // The service was killed.
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
        *self.shared.begun.lock().unwrap() = Some(Instant::now());
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
