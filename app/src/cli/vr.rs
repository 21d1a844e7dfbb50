//! Arguments of `vitriol vr`.

use std::path::PathBuf;

use clap::Args;
use vitriol_lesson::{Language, Mode};
use vitriol_run::arguments::{MOST_FRAMES, between, file_of, positive, preset, size, whole};
use vitriol_run::units::pair;
use vitriol_sim::scene::Preset;

use super::arguments::rate;
use super::class::KeepArgs;
use super::drawn::DrawnArgs;
use vitriol_live::ConsoleArgs;
use vitriol_session::foveating::Foveating;
use vitriol_session::latch::Grip;
use vitriol_session::placement::Posture;

/// Arguments of `vitriol vr`.
#[derive(Debug, Args)]
pub struct VrArgs {
    /// A built-in scene's name (see `vitriol scenes`) or a TOML file
    #[arg(long, value_name = "SCENE", default_value = "acid-into-water")]
    pub scene: String,
    /// Go through this lesson, in its scene: a built-in one's name (see `vitriol lesson`) or a TOML file
    #[arg(long, value_name = "LESSON", conflicts_with = "scene")]
    pub lesson: Option<String>,
    /// How: guided, free or examination; without it as the lesson says
    #[arg(long, value_name = "MODE", requires = "lesson")]
    pub mode: Option<Mode>,
    /// Language of the panel, of the lesson and of what the console is told: en, de, es or zh
    #[arg(long, value_name = "LANGUAGE", default_value_t)]
    pub language: Language,
    /// Trade of speed for accuracy
    #[arg(long, value_parser = preset(), default_value = "balanced")]
    pub preset: Preset,
    /// In place of a preset: the most accurate setting by which a step's solution
    /// takes at most so many milliseconds on this device (99th percentile)
    #[arg(long, value_name = "MS", value_parser = positive, allow_negative_numbers = true, conflicts_with_all = ["preset", "solver"])]
    pub budget_ms: Option<f64>,
    /// Substeps and iterations of the scene to begin with in place of the preset's, such as 10x3
    #[arg(long, value_name = "SxI", value_parser = pair, allow_hyphen_values = true)]
    pub solver: Option<[u32; 2]>,
    /// How it is drawn
    #[command(flatten)]
    pub drawn: DrawnArgs,
    /// Keep solver and picture as they are asked for, whatever frames take;
    /// without it both do with less where the display would miss frames
    #[arg(long)]
    pub fixed: bool,
    /// Where the pictures are sharp; without it everywhere, and about the lenses' axes alone where frames would not fit and
    /// that helps
    #[arg(long, value_enum, value_name = "FOVEATION")]
    pub foveation: Option<Foveating>,
    /// Seed of the particles' initial jitter
    #[arg(long, default_value_t = 0, value_parser = whole::<u64>(0), allow_negative_numbers = true)]
    pub seed: u64,
    /// How you are at the bench
    #[arg(long, value_enum, default_value_t, value_name = "POSTURE")]
    pub posture: Posture,
    /// How a hand grips
    #[arg(long, value_enum, default_value_t, value_name = "GRIP")]
    pub grip: Grip,
    /// Glass that is struck too hard breaks: by a fall of half a metre and more
    #[arg(long)]
    pub breakable: bool,
    /// Keep the session as a pose track in this new file, for `vitriol replay`
    #[arg(long, value_name = "FILE", value_parser = file_of("mcap"))]
    pub record: Option<PathBuf>,
    /// What is kept of a student
    #[command(flatten)]
    pub keep: KeepArgs,
    /// No page for an instructor
    #[arg(long, conflicts_with_all = ["listen", "hub", "name"])]
    pub no_console: bool,
    /// Where an instructor directs it from
    #[command(flatten)]
    pub console: ConsoleArgs,
    /// Sound output, by its name or description (see `vitriol doctor`), or none; a stand-in
    /// has none without it
    #[arg(long, value_name = "OUTPUT")]
    pub sound: Option<String>,
    /// No window on the computer that shows what the left eye sees
    #[arg(long)]
    pub no_mirror: bool,
    /// No signs that show a first user how to take a flask, lift it, pour and put it down
    #[arg(long)]
    pub no_hints: bool,
    /// Measure that many frames, after some to warm up, and end
    #[arg(long, value_name = "N", value_parser = between::<u64>(1, MOST_FRAMES), allow_negative_numbers = true)]
    pub frames: Option<u64>,
    /// In place of a headset images and a clock, worn by who moves as in this
    /// track (by name or file), over and over: for measurements
    #[arg(long, value_name = "TRACK")]
    pub stand_in: Option<String>,
    /// Width and height of an eye's picture of the stand-in, pixels
    #[arg(long, value_name = "WxH", default_value = "2064x2208", value_parser = size, allow_hyphen_values = true, requires = "stand_in")]
    pub size: [u32; 2],
    /// Frames a second of the stand-in
    #[arg(long, value_name = "HZ", default_value_t = 90.0, value_parser = rate, allow_negative_numbers = true, requires = "stand_in")]
    pub rate: f64,
    /// So many pages that look at the console meanwhile, of which one sends messages: for measurements
    #[arg(long, value_name = "N", value_parser = between::<usize>(1, 256), allow_negative_numbers = true)]
    #[arg(requires_all = ["stand_in", "frames"], conflicts_with_all = ["no_console", "listen", "hub"])]
    pub watchers: Option<usize>,
    /// Device of the stand-in: its number or a part of its name (see `vitriol doctor`)
    #[arg(long, requires = "stand_in")]
    pub device: Option<String>,
}
