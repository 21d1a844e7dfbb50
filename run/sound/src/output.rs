//! Plays a mixer on the system's loudspeakers or headphones, on a thread of its own.
//!
//! Sound is never needed: an output that cannot be opened returns the reason, one that is lost ends quietly, and neither blocks anything.

mod clock;
mod player;

#[cfg(not(any(target_os = "linux", windows)))]
mod nowhere;
#[cfg(target_os = "linux")]
mod pulse;
#[cfg(windows)]
mod windows;

#[cfg(not(any(target_os = "linux", windows)))]
use nowhere as system;
#[cfg(target_os = "linux")]
use pulse as system;
#[cfg(windows)]
use windows as system;

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, SyncSender, channel, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use crate::event::Event;
use crate::listener::Listener;
use crate::mixer::Mixer;
use player::Player;

/// Longest that opening may take.
const PATIENCE: Duration = Duration::from_secs(2);

/// Display frames that may wait for the audio thread: a second's. It takes all that are there every few milliseconds.
const FRAMES: usize = 128;

/// The output to play on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Device {
    /// The system's default output.
    #[default]
    Default,
    /// The output with this name or description ([`devices`] lists both).
    Named(String),
    /// No output: everything works, and nothing is heard.
    Silent,
}

/// An output of this system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeviceName {
    /// The system's name for it.
    pub name: String,
    /// Its description for people.
    pub description: String,
}

/// Why sound cannot be played.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// There is no way to play on this system.
    #[error("this system has no sound output that the program knows; it goes on without sound")]
    Unsupported,
    /// No server answers.
    #[error(
        "no sound server was found: start PulseAudio or PipeWire (pipewire-pulse), or name its socket in PULSE_SERVER"
    )]
    NoServer,
    /// The server or system refused.
    #[error("the sound server refused: {cause}; is another program using the output alone?")]
    Refused {
        /// Its message.
        cause: String,
    },
    /// The system did not answer in time.
    #[error("the sound server did not answer within 2 s: start it anew")]
    TimedOut,
    /// No output has this name.
    #[error("there is no sound output {name:?}; there are: {others}")]
    NoDevice {
        /// The name asked for.
        name: String,
        /// Names of the existing outputs.
        others: String,
    },
    /// The audio thread could not be made.
    #[error("no thread could be started for sound: are there too many processes?")]
    Thread(#[source] std::io::Error),
}

/// State of an output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// It was opened as silent.
    Silent,
    /// It plays.
    Playing,
    /// It has ended and will not play again; open another.
    Ended {
        /// The reason.
        cause: String,
    },
}

/// State of the audio thread that other threads read.
#[derive(Debug)]
struct Shared {
    /// Latency, microseconds; [`UNKNOWN`] before the system has reported it.
    latency: AtomicU64,
    /// Duration that the system's buffers are asked to hold, microseconds; [`UNKNOWN`] before it is set.
    target: AtomicU64,
    underflows: AtomicU64,
    state: Mutex<State>,
}

const UNKNOWN: u64 = u64::MAX;

impl Shared {
    fn new(state: State) -> Arc<Self> {
        Arc::new(Self {
            latency: AtomicU64::new(UNKNOWN),
            target: AtomicU64::new(UNKNOWN),
            underflows: AtomicU64::new(0),
            state: Mutex::new(state),
        })
    }

    fn set_latency(&self, latency: Duration) {
        self.latency.store(micros(latency), Ordering::Relaxed);
    }

    #[cfg(target_os = "linux")]
    fn set_target(&self, target: Duration) {
        self.target.store(micros(target), Ordering::Relaxed);
    }

    fn ran_dry(&self) {
        self.underflows.fetch_add(1, Ordering::Relaxed);
    }

    fn end(&self, cause: String) {
        *self.state.lock().unwrap_or_else(PoisonError::into_inner) = State::Ended { cause };
    }
}

fn micros(duration: Duration) -> u64 {
    u64::try_from(duration.as_micros()).unwrap_or(UNKNOWN)
}

fn known(micros: &AtomicU64) -> Option<Duration> {
    let micros = micros.load(Ordering::Relaxed);
    (micros != UNKNOWN).then(|| Duration::from_micros(micros))
}

/// A mixer that is played. It ends when this is dropped.
#[derive(Debug)]
pub struct Output {
    frames: Option<SyncSender<(Listener, Vec<Event>)>>,
    shared: Arc<Shared>,
    _stop: Option<system::Stop>,
}

impl Output {
    /// Opens an output within two seconds. The mixer should be new: its time advances with the samples played.
    ///
    /// # Errors
    /// [`OutputError`] where nothing can be played; [`Device::Silent`] always can.
    pub fn open(device: Device, mixer: Mixer) -> Result<Self, OutputError> {
        let name = match device {
            Device::Silent => return Ok(Self::silent()),
            Device::Default => None,
            Device::Named(name) => Some(name),
        };
        let (frames, waiting) = sync_channel(FRAMES);
        let shared = Shared::new(State::Playing);
        let (ready, opened) = channel();
        let (player, told) = (Player::new(mixer, waiting), Arc::clone(&shared));
        let work = move || system::play(name.as_deref(), player, &told, &ready);
        let thread = std::thread::Builder::new().name("sound".into());
        thread.spawn(work).map_err(OutputError::Thread)?;
        let stop = match opened.recv_timeout(PATIENCE) {
            Ok(opened) => opened?,
            Err(RecvTimeoutError::Timeout) => return Err(OutputError::TimedOut),
            Err(RecvTimeoutError::Disconnected) => {
                let cause = "the audio thread ended".into();
                return Err(OutputError::Refused { cause });
            }
        };
        Ok(Self {
            frames: Some(frames),
            shared,
            _stop: Some(stop),
        })
    }

    /// An output that plays nothing.
    pub fn silent() -> Self {
        Self {
            frames: None,
            shared: Shared::new(State::Silent),
            _stop: None,
        }
    }

    /// Hands over a display frame: the head's pose, and the new events. Times are those of the display's clock; new events sound as soon
    /// as possible. Never waits: where the audio thread is a second behind, the frame is dropped.
    pub fn frame(&self, listener: Listener, events: Vec<Event>) {
        if let Some(frames) = &self.frames {
            // A full queue or an ended thread: nothing can be heard anyway.
            let _ = frames.try_send((listener, events));
        }
    }

    /// Its state.
    pub fn state(&self) -> State {
        let state = self.shared.state.lock();
        state.unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Time from the handing over of a frame to its sound: the system's buffers and the device's delay. `None` before the system has
    /// reported it, which it does ten times a second.
    pub fn latency(&self) -> Option<Duration> {
        known(&self.shared.latency)
    }

    /// Duration that the system's buffers are asked to hold: longer after they have run dry. `None` where the system chooses it.
    pub fn target(&self) -> Option<Duration> {
        known(&self.shared.target)
    }

    /// How often the buffers have run dry: this machine was too busy, and there were gaps.
    pub fn underflows(&self) -> u64 {
        self.shared.underflows.load(Ordering::Relaxed)
    }
}

/// Outputs of this system, found within two seconds.
///
/// # Errors
/// [`OutputError`] where the system cannot be queried.
pub fn devices() -> Result<Vec<DeviceName>, OutputError> {
    let (found, answer) = channel();
    let work = move || {
        // This fails where the caller no longer waits.
        let _ = found.send(system::devices());
    };
    let thread = std::thread::Builder::new().name("sounds".into());
    thread.spawn(work).map_err(OutputError::Thread)?;
    match answer.recv_timeout(PATIENCE) {
        Ok(found) => found,
        Err(_) => Err(OutputError::TimedOut),
    }
}

/// The error of a name that no output has.
#[cfg(any(target_os = "linux", windows))]
fn no_device(name: &str, all: &[DeviceName]) -> OutputError {
    let others: Vec<&str> = all.iter().map(|it| it.name.as_str()).collect();
    let others = match others.is_empty() {
        true => "none".to_owned(),
        false => others.join(", "),
    };
    let name = name.to_owned();
    OutputError::NoDevice { name, others }
}
