//! What the user hears, and reads of it.
//!
//! The mixer runs on the output's own thread. A frame hands it the head and what happened; it waits for nothing.

use glam::DVec3;
use serde::Serialize;
use vitriol_run::audible::Audible;
use vitriol_sim::solver::{Census, Skin};
use vitriol_sound::{Caption, Device, Ear, Event, Listener, Mixer, Output, State};
use vitriol_xr::Pose;

/// How a session's sound was played.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SoundReport {
    /// Whether it was played to the end.
    pub played: bool,
    /// Why not, where it was to be.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
    /// What the buffers of server and device hold, ms. To that come the wait for the frame's end, the frame or two until an observation is
    /// read (blows need none), and up to 20 ms in which uneven frames are evened out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub buffered_ms: Option<f64>,
    /// What they are asked to hold, ms: more after they have run dry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target_ms: Option<f64>,
    /// How often they have run dry: the machine was too busy, and there were gaps.
    pub underflows: u64,
    /// Events that were made, whether they can be heard or not.
    pub events: u64,
}

/// Hands the run's sounds to the mixer, and gives captions of them.
pub(super) struct Sounds {
    output: Output,
    /// Why there is no output, where one was asked for.
    cause: Option<String>,
    ear: Ear,
    /// Sounds of this frame.
    events: Vec<Event>,
    made: u64,
    buffered_ms: Option<f64>,
}

impl Sounds {
    /// Sounds that are played on that device. Without an output the session is silent, and its captions go on.
    pub fn new(device: Device, seed: u64) -> Self {
        let opened = Output::open(device, Mixer::new(seed));
        let (output, cause) = match opened {
            Ok(output) => (output, None),
            Err(error) => {
                tracing::warn!("no sound: {error}");
                (Output::silent(), Some(error.to_string()))
            }
        };
        Self {
            output,
            cause,
            ear: Ear::default(),
            events: Vec::new(),
            made: 0,
            buffered_ms: None,
        }
    }

    /// Another bench, or this one anew.
    pub fn begin(&mut self) {
        self.events.clear();
        self.ear.clear();
    }

    /// Takes in the run's sounds in the frame that is shown at `time` (s): each is heard with its picture, whenever it was simulated.
    pub fn add(&mut self, events: Vec<Event>, time: f64) {
        let shown = events.into_iter().map(|event| Event { time, ..event });
        self.events.extend(shown);
    }

    /// Adds the sounds of acid that reached these parts of the skin, in a scene with that length scale.
    pub fn burnt(&mut self, burnt: &[Skin], census: &Census, length_scale: f64, time: f64) {
        for skin in burnt {
            let at: DVec3 = length_scale * census.skin[*skin as usize].came.position;
            self.events.push(Audible::burns(*skin, at, time));
        }
    }

    /// Hands this frame's sounds to the mixer, with the listener's head in the scene's stage; without a head they are dropped.
    pub fn hear(&mut self, scene_from_head: Option<&Pose>) {
        let Some(head) = scene_from_head else {
            self.events.clear();
            return;
        };
        let listener = Listener {
            position: head.position,
            orientation: head.orientation,
        };
        for event in &self.events {
            self.ear.hear(event, &listener);
        }
        self.made += self.events.len() as u64;
        self.output
            .frame(listener, std::mem::take(&mut self.events));
        if let Some(latency) = self.output.latency() {
            self.buffered_ms = Some(1e3 * latency.as_secs_f64());
        }
    }

    /// Captions of the sounds that can be heard at `time` (s).
    pub fn captions(&self, time: f64) -> Vec<Caption> {
        self.ear.audible(time).collect()
    }

    /// How the sound was played.
    pub fn report(&self) -> SoundReport {
        let state = self.output.state();
        let ended = match &state {
            State::Ended { cause } => Some(cause.clone()),
            State::Silent | State::Playing => None,
        };
        SoundReport {
            played: state == State::Playing,
            cause: self.cause.clone().or(ended),
            buffered_ms: self.buffered_ms,
            target_ms: self.output.target().map(|it| 1e3 * it.as_secs_f64()),
            underflows: self.output.underflows(),
            events: self.made,
        }
    }
}
