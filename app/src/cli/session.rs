//! Arguments that all sessions have, in a headset or in a window.

use std::path::PathBuf;

use clap::Args;
use vitriol_lesson::{Language, Mode};
use vitriol_run::arguments::{MOST_FRAMES, between, effort, file_of, positive, preset, whole};
use vitriol_sim::scene::Preset;

use super::class::KeepArgs;
use super::drawn::DrawnArgs;
use vitriol_live::ConsoleArgs;
use vitriol_session::latch::Grip;

/// What a session is to be.
#[derive(Args, Clone, Debug)]
pub struct SessionArgs {
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
    /// Trade of speed for accuracy; without it balanced, but `vitriol desk` takes fast on an
    /// integrated, virtual or software device
    #[arg(long, value_parser = preset())]
    pub preset: Option<Preset>,
    /// In place of a preset: the most accurate setting by which a step's solution
    /// takes at most so many milliseconds on this device (99th percentile)
    #[arg(long, value_name = "MS", value_parser = positive, allow_negative_numbers = true, conflicts_with_all = ["preset", "solver"])]
    pub budget_ms: Option<f64>,
    /// Substeps and iterations of the scene to begin with in place of the preset's, such as 10x3
    #[arg(long, value_name = "SxI", value_parser = effort, allow_hyphen_values = true)]
    pub solver: Option<[u32; 2]>,
    /// How it is drawn
    #[command(flatten)]
    pub drawn: DrawnArgs,
    /// Keep solver and picture as they are asked for, whatever frames take;
    /// without it both do with less where the display would miss frames
    #[arg(long)]
    pub fixed: bool,
    /// Seed of the particles' initial jitter
    #[arg(long, default_value_t = 0, value_parser = whole::<u64>(0), allow_negative_numbers = true)]
    pub seed: u64,
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
    /// No page for an instructor; `--name` still names the student in a recording
    #[arg(long, conflicts_with_all = ["listen", "hub"])]
    pub no_console: bool,
    /// Where an instructor directs it from
    #[command(flatten)]
    pub console: ConsoleArgs,
    /// Sound output, by its name or description (see `vitriol doctor`), or none; without it the
    /// system's own, and of a stand-in none
    #[arg(long, value_name = "OUTPUT")]
    pub sound: Option<String>,
    /// No signs that show a first user how to take a flask, lift it, pour and put it down
    #[arg(long)]
    pub no_hints: bool,
    /// Measure that many frames, after some to warm up, and end
    #[arg(long, value_name = "N", value_parser = between::<u64>(1, MOST_FRAMES), allow_negative_numbers = true)]
    pub frames: Option<u64>,
}
