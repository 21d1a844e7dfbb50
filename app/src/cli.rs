//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::console::Format;
use crate::vr::placement::Posture;
use vitriol_render::SurfaceFilter;

/// Acid dilution in virtual glassware: particle fluid on Vulkan, driven by
/// recorded or live hands.
#[derive(Debug, Parser)]
#[command(name = "vitriol", version, propagate_version = true)]
#[command(after_help = "Exit codes: 0 done, 1 failed, 2 bad scene, track or \
                        argument, 3 no device or runtime.")]
pub struct Cli {
    /// Print one JSON object on standard output and nothing else there
    #[arg(long, global = true)]
    pub json: bool,

    /// Say more on standard error; twice for debugging
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,

    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

impl Cli {
    /// The form of the result on standard output.
    pub fn format(&self) -> Format {
        if self.json {
            Format::Json
        } else {
            Format::Text
        }
    }
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Replay a recorded pour and make its film and report
    Replay(ReplayArgs),
    /// Replay a recorded pour up to a time and take one picture
    Picture(PictureArgs),
    /// Pour by hand, in a headset
    Vr(VrArgs),
    /// Convert, list or look into pose tracks
    Track(TrackArgs),
    /// List the scenes, each with its scale and what it models
    Scenes(ScenesArgs),
    /// Measure the time of each pass, with the density error beside it
    Bench(BenchArgs),
    /// Fig. 5 of the paper: a flask moved violently, without and with the flask
    /// constraint
    Fig5(Fig5Args),
    /// The collapse of a column of water against Martin and Moyce's
    /// measurements of 1952
    DamBreak(DamBreakArgs),
    /// What the renderer draws against the surface that it stands for, marched
    /// on the CPU
    Fidelity(FidelityArgs),
    /// Mix water and acid in a closed, insulated vessel until it is even
    Calorimeter(CalorimeterArgs),
    /// The trade of speed for accuracy: knobs, what each costs, and what comes of it
    /// is off by
    Trade(TradeArgs),
    /// Cases at the extremes of scene, parameter and motion: whether each keeps what
    /// it has to, or is refused at load
    Extremes(ExtremesArgs),
    /// Look for devices, driver and OpenXR runtime; name what is missing
    Doctor,
}

/// Points on the trade of speed for accuracy: substeps, iterations and number
/// of particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum PresetName {
    /// Fewest particles and iterations
    Fast,
    /// The default
    #[default]
    Balanced,
    /// Smallest error, however long it takes
    Reference,
}

impl PresetName {
    /// The name as it is given and reported.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Balanced => "balanced",
            Self::Reference => "reference",
        }
    }
}

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
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ColourName {
    /// Liquid in glass
    Liquid,
    /// Speed of the particles
    Speed,
    /// Temperature, where the scene models heat
    Temperature,
    /// Acid mass fraction, where the scene models heat
    Acid,
}

impl ColourName {
    /// The name as it is given and reported.
    pub fn name(self) -> &'static str {
        match self {
            Self::Liquid => "liquid",
            Self::Speed => "speed",
            Self::Temperature => "temperature",
            Self::Acid => "acid",
        }
    }

    /// Whether only a scene that models heat has it.
    pub fn is_of_heat(self) -> bool {
        matches!(self, Self::Temperature | Self::Acid)
    }
}

/// How the splatted particles become a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FilterName {
    /// Truong and Yuksel's of 2018
    NarrowRange,
    /// Van der Laan's of 2009, the paper's
    CurvatureFlow,
}

impl FilterName {
    /// The name as it is given and reported.
    pub fn name(self) -> &'static str {
        match self {
            Self::NarrowRange => "narrow-range",
            Self::CurvatureFlow => "curvature-flow",
        }
    }
}

impl From<FilterName> for SurfaceFilter {
    fn from(name: FilterName) -> Self {
        match name {
            FilterName::NarrowRange => Self::NarrowRange,
            FilterName::CurvatureFlow => Self::CurvatureFlow,
        }
    }
}

/// Arguments of `vitriol replay`.
#[derive(Debug, Args)]
pub struct ReplayArgs {
    /// A built-in track's name (see `vitriol track --list`) or an MCAP file
    pub track: String,
    /// A built-in scene's name (see `vitriol scenes`) or a TOML file; without
    /// it the scene that the track names
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<String>,
    /// Trade of speed for accuracy; without it the one that the track was
    /// recorded with, or else balanced
    #[arg(long, value_enum)]
    pub preset: Option<PresetName>,
    /// In place of a preset: the most accurate setting by which a frame's solution
    /// takes at most so many milliseconds on this device (99th percentile)
    #[arg(long, value_name = "MS", value_parser = positive_seconds, conflicts_with_all = ["preset", "solver"])]
    pub budget_ms: Option<f64>,
    /// Substeps and iterations in place of the preset's, such as 10x3
    #[arg(long, value_name = "SxI", value_parser = size)]
    pub solver: Option<[u32; 2]>,
    /// Simulated seconds; without it the whole track
    #[arg(long, value_name = "S", value_parser = positive_seconds)]
    pub seconds: Option<f64>,
    /// Seed of the particles' initial jitter; without it the track's own
    #[arg(long)]
    pub seed: Option<u64>,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
    /// Folder for film and report, which may be new; without it
    /// out/TRACK-NUMBER
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Where the film is seen from
    #[arg(long, value_enum, default_value_t, value_name = "CAMERA")]
    pub camera: CameraName,
    /// One film only, of the liquid or of particles coloured by this; without it
    /// one of the liquid, and where the scene models heat a second one by
    /// temperature
    #[arg(long, value_enum, value_name = "COLOUR", conflicts_with = "no_video")]
    pub colour: Option<ColourName>,
    /// Filter of the liquid's surface; without it the scene's
    #[arg(long, value_enum, value_name = "FILTER", conflicts_with = "no_video")]
    pub filter: Option<FilterName>,
    /// Make the report without a film
    #[arg(long)]
    pub no_video: bool,
}

/// Arguments of `vitriol picture`.
#[derive(Debug, Args)]
pub struct PictureArgs {
    /// A built-in track's name (see `vitriol track --list`) or an MCAP file
    pub track: String,
    /// A built-in scene's name (see `vitriol scenes`) or a TOML file; without
    /// it the scene that the track names
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<String>,
    /// Trade of speed for accuracy; without it the one that the track was
    /// recorded with, or else balanced
    #[arg(long, value_enum)]
    pub preset: Option<PresetName>,
    /// Simulated time of the picture, seconds
    #[arg(long, value_name = "S", value_parser = positive_seconds)]
    pub at: f64,
    /// PNG file to be made
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Width and height of a view, pixels
    #[arg(long, value_name = "WxH", default_value = "960x540", value_parser = size)]
    pub size: [u32; 2],
    /// Both eyes, side by side
    #[arg(long)]
    pub stereo: bool,
    /// Where it is seen from
    #[arg(long, value_enum, default_value_t, value_name = "CAMERA")]
    pub camera: CameraName,
    /// Liquid, or particles coloured by this
    #[arg(long, value_enum, default_value = "liquid", value_name = "COLOUR")]
    pub colour: ColourName,
    /// Filter of the liquid's surface; without it the scene's
    #[arg(long, value_enum, value_name = "FILTER")]
    pub filter: Option<FilterName>,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

/// Arguments of `vitriol vr`.
#[derive(Debug, Args)]
pub struct VrArgs {
    /// A built-in scene's name (see `vitriol scenes`) or a TOML file
    #[arg(long, value_name = "SCENE", default_value = "acid-into-water")]
    pub scene: String,
    /// Trade of speed for accuracy
    #[arg(long, value_enum, default_value_t)]
    pub preset: PresetName,
    /// Seed of the particles' initial jitter
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// How you are at the bench
    #[arg(long, value_enum, default_value_t, value_name = "POSTURE")]
    pub posture: Posture,
    /// Keep the session as a pose track in this new file, for `vitriol replay`
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// Measure that many frames, after some to warm up, and end
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub frames: Option<u64>,
    /// In place of a headset images and a clock, worn by who moves as in this
    /// track (by name or file), over and over: for measurements
    #[arg(long, value_name = "TRACK")]
    pub stand_in: Option<String>,
    /// Width and height of an eye's picture of the stand-in, pixels
    #[arg(long, value_name = "WxH", default_value = "2064x2208", value_parser = size, requires = "stand_in")]
    pub size: [u32; 2],
    /// Frames a second of the stand-in
    #[arg(long, value_name = "HZ", default_value_t = 90.0, value_parser = rate, requires = "stand_in")]
    pub rate: f64,
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

/// Arguments of `vitriol bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// A built-in scene's name or a TOML file
    #[arg(long, value_name = "SCENE", conflicts_with = "paper")]
    pub scene: Option<String>,
    /// Table 2 of the paper: its rows as far as they exist, beside its times
    #[arg(long)]
    pub paper: bool,
    /// What each feature of the scene costs: with it, and without it and what
    /// is built upon it
    #[arg(long, conflicts_with = "paper")]
    pub features: bool,
    /// What each pass of the picture takes, for a headset's two views at two
    /// resolutions and for a screen
    #[arg(long, conflicts_with_all = ["paper", "features"])]
    pub render: bool,
    /// With --render: filter of the liquid's surface; without it the scene's
    #[arg(long, value_enum, value_name = "FILTER", requires = "render")]
    pub filter: Option<FilterName>,
    /// Trade of speed for accuracy
    #[arg(long, value_enum, default_value_t)]
    pub preset: PresetName,
    /// Frames to measure, after as many as it takes to warm up
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..))]
    pub frames: u32,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

/// Arguments of `vitriol fig5`.
#[derive(Debug, Args)]
pub struct Fig5Args {
    /// Folder for the two pictures; without it none are made
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

/// Arguments of `vitriol dam-break`.
#[derive(Debug, Args)]
pub struct DamBreakArgs {
    /// Folder for the figure; without it none is made
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Trade of speed for accuracy
    #[arg(long, value_enum, default_value_t)]
    pub preset: PresetName,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

/// Arguments of `vitriol fidelity`.
#[derive(Debug, Args)]
pub struct FidelityArgs {
    /// Folder for fidelity.json and the picture of the difference; without it
    /// none are made
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// The two lower resolutions only
    #[arg(long)]
    pub quick: bool,
    /// Trade of speed for accuracy
    #[arg(long, value_enum, default_value_t = PresetName::Fast)]
    pub preset: PresetName,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

/// Which liquid is in the vessel when the other one comes in on top.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum OrderName {
    /// Acid onto water
    #[default]
    WaterFirst,
    /// Water onto acid
    AcidFirst,
}

impl OrderName {
    /// The name as it is given and reported.
    pub fn name(self) -> &'static str {
        match self {
            Self::WaterFirst => "water-first",
            Self::AcidFirst => "acid-first",
        }
    }
}

/// The chemistries that have real amounts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum RealChemistry {
    /// Enthalpy, evaporation and densities from tables
    #[default]
    Physical,
}

/// Arguments of `vitriol calorimeter`.
#[derive(Debug, Args)]
pub struct CalorimeterArgs {
    /// Water, millilitres
    #[arg(long, value_name = "ML", allow_negative_numbers = true)]
    pub water_ml: f64,
    /// Acid, millilitres
    #[arg(long, value_name = "ML", allow_negative_numbers = true)]
    pub acid_ml: f64,
    /// Acid in it, per cent by mass
    #[arg(
        long,
        value_name = "PERCENT",
        default_value_t = 98.0,
        allow_negative_numbers = true
    )]
    pub acid_percent: f64,
    /// Temperature of the water, °C
    #[arg(
        long,
        value_name = "C",
        default_value_t = 20.0,
        allow_negative_numbers = true
    )]
    pub water_c: f64,
    /// Temperature of the acid, °C
    #[arg(
        long,
        value_name = "C",
        default_value_t = 20.0,
        allow_negative_numbers = true
    )]
    pub acid_c: f64,
    /// Which liquid is in the vessel when the other one comes in on top
    #[arg(long, value_enum, default_value_t)]
    pub order: OrderName,
    /// Chemistry: the paper's has no real amounts
    #[arg(long, value_enum, default_value_t)]
    pub chemistry: RealChemistry,
    /// Trade of speed for accuracy
    #[arg(long, value_enum, default_value_t)]
    pub preset: PresetName,
    /// Seed of the particles' initial jitter
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

/// Arguments of `vitriol scenes`.
#[derive(Debug, Args)]
pub struct ScenesArgs {
    /// What each scene takes: passes of a frame, bytes a particle; and what is left
    /// out of it
    #[arg(long)]
    pub cost: bool,
    /// With --cost: trade of speed for accuracy
    #[arg(long, value_enum, default_value_t, requires = "cost")]
    pub preset: PresetName,
    /// With --cost: device to use, its number or a part of its name
    #[arg(long, requires = "cost")]
    pub device: Option<String>,
}

/// Parts of `vitriol trade`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum TradePart {
    /// Settings of the solver in a vessel of water
    Solver,
    /// Calorimeter, and water poured into acid
    Chemistry,
    /// Convergence, and the f64 reference
    Truth,
}

/// Arguments of `vitriol trade`.
#[derive(Debug, Args)]
pub struct TradeArgs {
    /// Few settings of 4,000 particles: minutes on two cores
    #[arg(long)]
    pub quick: bool,
    /// One part only; without it all three
    #[arg(long, value_enum, value_name = "PART")]
    pub part: Option<TradePart>,
    /// Seconds after which no further setting is begun
    #[arg(long, value_name = "S", value_parser = positive_seconds)]
    pub within: Option<f64>,
    /// Folder for trade.json and trade.html; without it none are made
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

/// Arguments of `vitriol extremes`.
#[derive(Debug, Args)]
pub struct ExtremesArgs {
    /// Cases: those that were thought of first, then random ones
    #[arg(long, default_value_t = 2000)]
    pub cases: usize,
    /// Seed of the random cases
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// One case only, by its number
    #[arg(long, value_name = "CASE")]
    pub only: Option<usize>,
    /// Cases at a time
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..))]
    pub jobs: u32,
    /// Folder for extremes.json, and with --only for the case's scene; without it
    /// none are made
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x').map(|(w, h)| [w.parse(), h.parse()]);
    match sides {
        Some([Ok(width), Ok(height)]) if width > 0 && height > 0 => Ok([width, height]),
        _ => Err("give two whole numbers above 0, such as 960x540".into()),
    }
}

fn rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(rate) if (1.0..=1000.0).contains(&rate) => Ok(rate),
        _ => Err("give a rate of 1 to 1000 frames a second, such as 90".into()),
    }
}

fn positive_seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds.is_finite() && seconds > 0.0 => Ok(seconds),
        _ => Err("give a number of seconds above 0, such as 2.5".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn sizes_are_two_numbers_above_zero() {
        assert_eq!(size("960x540"), Ok([960, 540]));
        for wrong in ["960", "960x", "0x540", "960,540", "-1x2", "axb"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn definition_is_consistent() {
        Cli::command().debug_assert();
    }
}
