//! Arguments of what plays and looks: replays, pictures, the headset, tracks,
//! scenes.

use std::net::SocketAddr;
use std::path::PathBuf;

use clap::builder::TypedValueParser;
use clap::{Args, ValueEnum};
use vitriol_console::HubAddress;
use vitriol_experiment::Colour;
use vitriol_experiment::switches::pair;
use vitriol_lesson::{Language, Mode};
use vitriol_record::Pseudonym;
use vitriol_record::lrs::Endpoint;
use vitriol_sim::scene::{PictureFilter, Preset};
use vitriol_study::parse::{filter, named, positive, preset};

use super::drawn::DrawnArgs;
use super::lesson::JudgeArgs;
use crate::command::grade::Tolerance;
use crate::live::hub_address;
use crate::vr::foveating::Foveating;
use crate::vr::latch::Grip;
use crate::vr::placement::Posture;

/// Where a film is seen from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum CameraName {
    /// A tripod before the bench
    #[default]
    Fixed,
    /// The track's head, as the user saw it
    Head,
}

/// What a film's colours stand for.
pub(super) fn colour() -> impl TypedValueParser<Value = Colour> {
    const COLOURS: [(Colour, &str); 4] = [
        (Colour::Liquid, "Liquid in glass"),
        (Colour::Speed, "Speed of the particles"),
        (
            Colour::Temperature,
            "Temperature, where the scene models heat",
        ),
        (
            Colour::Acid,
            "Acid mass fraction, where the scene models heat",
        ),
    ];
    named(&COLOURS, Colour::name)
}

/// Arguments of `vitriol replay`.
#[derive(Debug, Args)]
pub struct ReplayArgs {
    /// Built-in tracks' names (see `vitriol track --list`) or MCAP files; of several, one that
    /// fails stops no other
    #[arg(required = true, value_name = "TRACK")]
    pub tracks: Vec<String>,
    /// A built-in scene's name (see `vitriol scenes`) or a TOML file; without
    /// it the scene that the track names
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<String>,
    /// Trade of speed for accuracy; without it the one that the track was
    /// recorded with, or else balanced
    #[arg(long, value_parser = preset())]
    pub preset: Option<Preset>,
    /// In place of a preset: the most accurate setting by which a frame's solution
    /// takes at most so many milliseconds on this device (99th percentile)
    #[arg(long, value_name = "MS", value_parser = positive, conflicts_with_all = ["preset", "solver"])]
    pub budget_ms: Option<f64>,
    /// Substeps and iterations in place of the preset's, such as 10x3
    #[arg(long, value_name = "SxI", value_parser = pair)]
    pub solver: Option<[u32; 2]>,
    /// Simulated seconds; without it the whole track
    #[arg(long, value_name = "S", value_parser = positive)]
    pub seconds: Option<f64>,
    /// Seed of the particles' initial jitter; without it the track's own
    #[arg(long)]
    pub seed: Option<u64>,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
    /// Folder for film and report, which may be new (of several tracks, for a folder each);
    /// without it out/TRACK-NUMBER
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Where the film is seen from; from the head, the film of the liquid shows the hands
    #[arg(long, value_enum, default_value_t, value_name = "CAMERA")]
    pub camera: CameraName,
    /// One film only, of the liquid or of particles coloured by this; without it
    /// one of the liquid, and where the scene models heat a second one by
    /// temperature
    #[arg(long, value_parser = colour(), value_name = "COLOUR", conflicts_with = "no_video")]
    pub colour: Option<Colour>,
    /// Filter of the liquid's surface; without it the scene's
    #[arg(long, value_parser = filter(), value_name = "FILTER", conflicts_with = "no_video")]
    pub filter: Option<PictureFilter>,
    /// How its film is drawn
    #[command(flatten)]
    pub drawn: DrawnArgs,
    /// Glass that is struck too hard breaks: by a fall of half a metre and more
    #[arg(long)]
    pub breakable: bool,
    /// What is judged
    #[command(flatten)]
    pub judge: JudgeArgs,
    /// What is kept of a student
    #[command(flatten)]
    pub keep: KeepArgs,
    /// Show it on the instructor's console meanwhile, no faster than it was
    #[arg(long, conflicts_with = "no_video")]
    pub live: bool,
    /// Where that console is
    #[command(flatten)]
    pub console: ConsoleArgs,
    /// Make the report without a film
    #[arg(long, conflicts_with_all = ["tint", "room"])]
    pub no_video: bool,
    /// Replay what is whole of a track that breaks off or lacks steps
    #[arg(long)]
    pub accept_truncated: bool,
}

/// Arguments of `vitriol export`.
#[derive(Debug, Args)]
#[command(
    after_help = "Moments are 30 a second of the whole run, without --rate, --from, --seconds or --at. Files of a \
                        moment have its number in their names. A run's folder is simulated again for all but csv and \
                        parquet."
)]
pub struct ExportArgs {
    /// A run's folder (with its report.json), a built-in track's name, or an MCAP file
    #[arg(value_name = "RUN|TRACK")]
    pub input: String,
    /// The track of a run, where its report names a file that is elsewhere now
    #[arg(long, value_name = "TRACK")]
    pub track: Option<String>,
    /// What is written: vtk particles; ply and gltf surfaces, glass, room and cameras, ply bubbles and spray too;
    /// csv and parquet measurements; mcap a recording with particles, film and measurements beside the track
    #[arg(long, required = true, value_delimiter = ',', value_parser = export_format(), value_name = "FORMAT")]
    pub format: Vec<vitriol_export::Format>,
    /// Folder for the files, which may be new; without it out/NAME-NUMBER
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Moments a second, where the simulation has so many; tables have a row each tenth of a second
    #[arg(long, value_name = "HZ", value_parser = rate, default_value_t = 30.0, conflicts_with = "at")]
    pub rate: f64,
    /// The first moment, s
    #[arg(long, value_name = "S", value_parser = positive, conflicts_with = "at")]
    pub from: Option<f64>,
    /// Simulated seconds; without it the whole track or run
    #[arg(long, value_name = "S", value_parser = positive, conflicts_with = "at")]
    pub seconds: Option<f64>,
    /// One moment alone, at this time, s
    #[arg(long, value_name = "S", value_parser = positive)]
    pub at: Option<f64>,
    /// A built-in scene's name or a TOML file; without it the scene that the track or run names
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<String>,
    /// Trade of speed for accuracy; without it that of the track or run, or else balanced
    #[arg(long, value_parser = preset())]
    pub preset: Option<Preset>,
    /// Substeps and iterations in place of the preset's, such as 10x3
    #[arg(long, value_name = "SxI", value_parser = pair)]
    pub solver: Option<[u32; 2]>,
    /// Seed of the particles' initial jitter; without it that of the track or run
    #[arg(long)]
    pub seed: Option<u64>,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
    /// Take what is whole of a track that breaks off or lacks steps
    #[arg(long)]
    pub accept_truncated: bool,
}

/// What is exported.
fn export_format() -> impl TypedValueParser<Value = vitriol_export::Format> {
    use vitriol_export::Format;
    const FORMATS: [(Format, &str); 6] = [
        (Format::Vtk, "Particles, for ParaView and PyVista"),
        (
            Format::Ply,
            "Surfaces, glass, room, cameras, bubbles, spray",
        ),
        (
            Format::Gltf,
            "Surfaces, glass, room, cameras in one file a moment",
        ),
        (Format::Csv, "Measurements, a row a sample"),
        (Format::Parquet, "The same"),
        (Format::Mcap, "A recording for Foxglove and Rerun"),
    ];
    named(&FORMATS, Format::name)
}

/// Arguments of `vitriol pages`.
#[derive(Debug, Args)]
pub struct PagesArgs {
    /// Folder for them, which may be new
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

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
    /// Language of the panel and of the lesson: en, de, es or zh
    #[arg(long, value_name = "LANGUAGE", default_value_t)]
    pub language: Language,
    /// Trade of speed for accuracy
    #[arg(long, value_parser = preset(), default_value = "balanced")]
    pub preset: Preset,
    /// In place of a preset: the most accurate setting by which a step's solution
    /// takes at most so many milliseconds on this device (99th percentile)
    #[arg(long, value_name = "MS", value_parser = positive, conflicts_with_all = ["preset", "solver"])]
    pub budget_ms: Option<f64>,
    /// Substeps and iterations of the scene to begin with in place of the preset's, such as 10x3
    #[arg(long, value_name = "SxI", value_parser = pair)]
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
    #[arg(long, default_value_t = 0)]
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
    #[arg(long, value_name = "FILE")]
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
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub frames: Option<u64>,
    /// In place of a headset images and a clock, worn by who moves as in this
    /// track (by name or file), over and over: for measurements
    #[arg(long, value_name = "TRACK")]
    pub stand_in: Option<String>,
    /// Width and height of an eye's picture of the stand-in, pixels
    #[arg(long, value_name = "WxH", default_value = "2064x2208", value_parser = pair, requires = "stand_in")]
    pub size: [u32; 2],
    /// Frames a second of the stand-in
    #[arg(long, value_name = "HZ", default_value_t = 90.0, value_parser = rate, requires = "stand_in")]
    pub rate: f64,
    /// So many pages that look at the console meanwhile, of which one sends messages: for measurements
    #[arg(long, value_name = "N", requires_all = ["stand_in", "frames"], conflicts_with_all = ["no_console", "listen", "hub"])]
    pub watchers: Option<usize>,
    /// Device of the stand-in: its number or a part of its name (see `vitriol doctor`)
    #[arg(long, requires = "stand_in")]
    pub device: Option<String>,
}

/// Arguments of `vitriol track`.
#[derive(Debug, Args)]
#[command(arg_required_else_help = true)]
pub struct TrackArgs {
    /// Keyframes (TOML) to convert with -o; or a track, by name or file, to
    /// look into
    #[arg(required_unless_present = "list")]
    pub input: Option<String>,
    /// Write the track of these keyframes to this new MCAP file
    #[arg(short, long, value_name = "FILE", requires = "input")]
    pub output: Option<PathBuf>,
    /// List the built-in tracks
    #[arg(long, conflicts_with_all = ["input", "output"])]
    pub list: bool,
}

/// Arguments of `vitriol scenes`.
#[derive(Debug, Args)]
pub struct ScenesArgs {
    /// What each scene takes: passes of a frame, bytes a particle; and what is left
    /// out of it
    #[arg(long)]
    pub cost: bool,
    /// With --cost: trade of speed for accuracy
    #[arg(long, value_parser = preset(), default_value = "balanced", requires = "cost")]
    pub preset: Preset,
    /// With --cost: device to use, its number or a part of its name
    #[arg(long, requires = "cost")]
    pub device: Option<String>,
}

/// Arguments of `vitriol grade`.
#[derive(Debug, Args)]
pub struct GradeArgs {
    /// Recordings (MCAP), or folders of them; one that cannot be graded stops no other
    #[arg(required = true, value_name = "DIR|TRACK")]
    pub tracks: Vec<PathBuf>,
    /// The scene that they are graded by: a built-in one's name (see `vitriol scenes`) or a TOML file. A track that was
    /// made with another is listed as such
    #[arg(long, value_name = "SCENE")]
    pub scene: String,
    /// Likewise the preset; without it any will do
    #[arg(long, value_parser = preset())]
    pub preset: Option<Preset>,
    /// Likewise the lesson
    #[command(flatten)]
    pub judge: JudgeArgs,
    /// Tracks at a time; without it as many as there are cores, and one with --verify
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub jobs: Option<u32>,
    /// Folder for a result of each track and the table grades.csv, which is written anew each time; results that are there
    /// and of the same track, scene and preset are taken as they are
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Simulate each track again, and say whether what happens is what it says
    #[arg(long)]
    pub verify: bool,
    /// How far what happens on another device may be from what a track says: a moment, a share of a volume, and a volume
    /// beside that; without it 0.2,5,0.1
    #[arg(long, value_name = "S,%,ML", requires = "verify")]
    pub tolerance: Option<Tolerance>,
    /// Device for that: its number or a part of its name (see `vitriol doctor`)
    #[arg(long, requires = "verify")]
    pub device: Option<String>,
    /// The class's file, which tells whose tracks they are; without it their files' names stand for students
    #[arg(long, value_name = "FILE")]
    pub class: Option<PathBuf>,
    /// Grade what is whole of a track that breaks off or lacks steps
    #[arg(long)]
    pub accept_truncated: bool,
}

/// Arguments of `vitriol forget`.
#[derive(Debug, Args)]
pub struct ForgetArgs {
    /// Whose attempts and statements are deleted: one word, such as p07
    #[arg(value_name = "PSEUDONYM")]
    pub pseudonym: Pseudonym,
    /// The class's file; without it the one in your folder for data
    #[arg(long, value_name = "FILE")]
    pub class: Option<PathBuf>,
}

/// What is kept of a student. Nothing is without a pseudonym.
#[derive(Args, Clone, Debug, Default)]
pub struct KeepArgs {
    /// Keep the attempts in the class's file under this pseudonym: one word, such as p07
    #[arg(long, value_name = "PSEUDONYM")]
    pub pseudonym: Option<Pseudonym>,
    /// The class's file; without it the one in your folder for data
    #[arg(long, value_name = "FILE", requires = "pseudonym")]
    pub class: Option<PathBuf>,
    /// Send the statements to this Learning Record Store: https, or http on this machine
    #[arg(long, value_name = "URL", requires_all = ["pseudonym", "lrs_token"])]
    pub lrs: Option<Endpoint>,
    /// File with its token, which you alone may read: `Bearer TOKEN`, `Basic BASE64` or `NAME:PASSWORD`
    #[arg(long, value_name = "FILE", requires = "lrs")]
    pub lrs_token: Option<PathBuf>,
}

/// Where the instructor's console is. Without any of these it is a page that this computer alone can open; its address, good for one
/// browser, goes to standard error.
#[derive(Args, Clone, Debug, Default)]
pub struct ConsoleArgs {
    /// Serve the console there, for other computers too, by HTTPS: such as 0.0.0.0:8470
    #[arg(long, value_name = "ADDRESS:PORT", conflicts_with = "hub")]
    pub listen: Option<SocketAddr>,
    /// Be one of the students of that hub: what `vitriol hub` prints, or a file that holds it
    #[arg(long, value_name = "HUB", value_parser = hub_address)]
    pub hub: Option<HubAddress>,
    /// What the console calls this student; without it the computer's name
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
}

impl ConsoleArgs {
    /// Whether any of them is given.
    pub fn is_given(&self) -> bool {
        self.listen.is_some() || self.hub.is_some() || self.name.is_some()
    }
}

/// Arguments of `vitriol hub`.
#[derive(Debug, Args)]
pub struct HubArgs {
    /// Where it listens, by HTTPS; 0.0.0.0:8470 for a class
    #[arg(long, value_name = "ADDRESS:PORT", default_value = "127.0.0.1:8470")]
    pub listen: SocketAddr,
}

/// Frames a second.
fn rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(rate) if (1.0..=1000.0).contains(&rate) => Ok(rate),
        _ => Err("give a rate of 1 to 1000 frames a second, such as 90".into()),
    }
}
