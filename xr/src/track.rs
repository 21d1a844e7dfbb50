//! Pose tracks: recordings of head, hands, inputs and switches in MCAP files, each message
//! with the simulation step that consumed it.
//!
//! A track is opened by any MCAP viewer; `/tf` holds `foxglove.FrameTransforms`, which viewers draw without configuration. Tracks
//! are written in lz4, and read in zstd and uncompressed too, as other programs write them. [`Keyframes`]
//! is the short text form that people write, and [`builtin`] holds the tracks made from it.

mod annex;
pub mod builtin;
mod check;
mod convert;
mod decode;
mod descriptor;
mod ease;
mod encode;
mod error;
mod keyframes;
mod lengths;
pub mod limits;
mod message;
mod metadata;
mod path;
mod read;
mod sample;
mod source;
mod stage;
mod write;
mod zstd;

use std::collections::BTreeMap;

use crate::{Pose, PoseFrame};

pub use annex::Annex;
pub use convert::{load, save};
pub use error::TrackError;
pub use keyframes::Keyframes;
pub use source::TrackSource;
pub use write::{Existing, TrackWriter, Written};

/// A whole pose track in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Scene, seed and parameters of its recording.
    pub metadata: TrackMetadata,
    /// The frames, steps and times strictly increasing; at least one.
    pub frames: Vec<PoseFrame>,
    /// For each frame the recorded `stage_from_flask` of each flask; empty where a frame recorded none. They are results of the
    /// simulation, kept for comparison and for viewers; a replay does not read them.
    pub stage_from_flasks: Vec<Vec<Pose>>,
    /// Whether the file had no end, as after a crash, and was read up to the last whole step of its whole chunks.
    pub recovered: bool,
    /// Results that its recorder wrote at the end, such as the final state's hash; empty where it wrote none.
    pub outcome: BTreeMap<String, String>,
    /// Events that were found in the session, in the order in which they were emitted: time of the track (ns), and an object as JSON. They
    /// are results, so a replay does not read them.
    pub events: Vec<(i64, String)>,
    /// Changes in the session's lesson, likewise.
    pub progress: Vec<(i64, String)>,
}

/// A gap in a recording: steps that are missing between two of its frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hole {
    /// The frame before it.
    pub index: usize,
    /// Steps missing.
    pub steps: u64,
}

impl Track {
    /// Time of the last frame, s.
    pub fn duration(&self) -> f64 {
        self.frames
            .last()
            .map_or(0.0, |frame| seconds(frame.time_ns))
    }

    /// Steps missing before its first frame, as in a file of which a part was cut out.
    pub fn missing_first(&self) -> u64 {
        self.frames.first().map_or(0, |frame| frame.step)
    }

    /// The gaps, in their order.
    pub fn holes(&self) -> impl Iterator<Item = Hole> + '_ {
        let pairs = self.frames.windows(2).enumerate();
        pairs.filter_map(|(index, pair)| {
            let steps = pair[1].step - pair[0].step - 1;
            (steps > 0).then_some(Hole { index, steps })
        })
    }

    /// The whole beginning of the track, up to the first hole.
    #[must_use]
    pub fn up_to_the_first_hole(mut self) -> Self {
        let first = self.holes().next();
        if let Some(Hole { index, .. }) = first {
            self.frames.truncate(index + 1);
            self.stage_from_flasks.truncate(index + 1);
            // The outcome is that of the whole recording, and later events are not of this part.
            self.outcome.clear();
            let end = self.frames.last().map_or(0, |frame| frame.time_ns);
            self.events.retain(|(time_ns, _)| *time_ns <= end);
            self.progress.retain(|(time_ns, _)| *time_ns <= end);
        }
        self
    }
}

/// Scene, seed and parameters of a track's recording.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TrackMetadata {
    /// Name of the scene; empty where the track belongs to none.
    pub scene: String,
    /// Seed of the scene's random numbers.
    pub seed: u64,
    /// Parameters of the run by name, such as preset and step; values as text.
    pub parameters: BTreeMap<String, String>,
    /// Version of the program that recorded.
    pub program_version: String,
    /// Texts of the scenes that it may start, by name; empty for a track that is no recording.
    pub scenes: BTreeMap<String, String>,
}

/// Topics, frames and names in a track's file.
mod names {
    pub const TF: &str = "/tf";
    pub const TF_STATIC: &str = "/tf_static";
    pub const FRAME: &str = "/xr/frame";
    pub const INPUT: [&str; 2] = ["/xr/input/left", "/xr/input/right"];
    pub const SCENARIO: &str = "/scenario";

    pub const WORLD: &str = "world";
    pub const STAGE: &str = "stage";
    pub const VIEW: &str = "view";
    pub const GRIP: [&str; 2] = ["left_grip", "right_grip"];
    pub const AIM: [&str; 2] = ["left_aim", "right_aim"];
    pub const FLASK: &str = "flask_";

    pub const METADATA: &str = "vitriol";
    pub const SCENE: &str = "scene";
    pub const SEED: &str = "seed";
    pub const PROGRAM_VERSION: &str = "program_version";
    pub const PARAMETER: &str = "parameter.";

    pub const SCENE_RECORD: &str = "vitriol.scene";
    pub const NAME: &str = "name";
    pub const TOML: &str = "toml";
    pub const HASH: &str = "xxh3_128";

    pub const OUTCOME: &str = "vitriol.outcome";

    pub const PARTICLES: &str = "/particles";
    pub const FILM: &str = "/film";
    pub const FLASKS: &str = "/flasks";
    pub const CAMERA: &str = "camera";
    pub const EVENTS: &str = "/events";
    pub const EVENT: &str = "vitriol.Event";
    pub const LESSON: &str = "/lesson";
    pub const PROGRESS: &str = "vitriol.Progress";
    /// Encodings of a schema and of messages.
    pub const JSON: [&str; 2] = ["jsonschema", "json"];
}

/// Nanoseconds to seconds. Divided: 9.6e9 · 1e-9 is 9.600000000000001.
fn seconds(ns: i64) -> f64 {
    ns as f64 / 1e9
}
