//! The subcommands that measure, and their arguments.

use std::ops::Range;
use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use serde::{Deserialize, Serialize};
use vitriol_run::arguments::{
    MOST_FRAMES, between, file_of, filter, positive, preset, size, whole,
};
use vitriol_sim::scene::{PictureFilter, Preset};

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
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
    /// The trade of speed for accuracy: knobs, what each costs, and what it is off by
    Trade(TradeArgs),
    /// Cases at the extremes of scene, parameter and motion: whether each keeps what
    /// it has to, or is refused at load
    Extremes(ExtremesArgs),
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
    #[arg(long, value_parser = filter(), value_name = "FILTER", requires = "render")]
    pub filter: Option<PictureFilter>,
    /// With --render: one picture of that width and height alone, as on a screen
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true, requires = "render")]
    pub size: Option<[u32; 2]>,
    /// Another program, in turn with ours: as many particles, substeps and iterations. One in Python ends in .py; study/peers has some
    #[arg(long, value_name = "PROGRAM", conflicts_with_all = ["render", "features"])]
    pub against: Vec<PathBuf>,
    /// Time over the number of particles, of blocks at rest, and a figure of it
    #[arg(long, value_name = "FILE.svg", value_parser = file_of("svg"), conflicts_with_all = ["scene", "paper", "features", "render"])]
    pub scaling: Option<PathBuf>,
    /// With --scaling: most particles of a block
    #[arg(long, value_name = "N", default_value_t = 4_000_000, requires = "scaling", value_parser = between::<u64>(1000, 50_000_000), allow_negative_numbers = true)]
    pub most: u64,
    /// Trade of speed for accuracy
    #[arg(long, value_parser = preset(), default_value = "balanced")]
    pub preset: Preset,
    /// Frames to measure, after as many as it takes to warm up
    #[arg(long, default_value_t = 100, value_parser = between::<u32>(1, MOST_FRAMES), allow_negative_numbers = true)]
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
    #[arg(long, value_parser = preset(), default_value = "balanced")]
    pub preset: Preset,
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
    #[arg(long, value_parser = preset(), default_value = "fast")]
    pub preset: Preset,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

/// Which liquid is in the vessel when the other one comes in on top.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum OrderName {
    /// Acid onto water
    #[default]
    WaterFirst,
    /// Water onto acid
    AcidFirst,
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
    /// Trade of speed for accuracy
    #[arg(long, value_parser = preset(), default_value = "balanced")]
    pub preset: Preset,
    /// Seed of the particles' initial jitter
    #[arg(long, default_value_t = 0, value_parser = whole::<u64>(0), allow_negative_numbers = true)]
    pub seed: u64,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

/// Parts of `vitriol trade`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TradePart {
    /// Settings of the solver in a vessel of water
    Solver,
    /// Calorimeter, and water poured into acid
    Chemistry,
    /// What the constants of the physical chemistry change when they are halved and doubled
    Constants,
    /// Convergence, and the f64 reference
    Truth,
}

/// Arguments of `vitriol trade`.
#[derive(Debug, Args)]
pub struct TradeArgs {
    /// Few settings of 4,000 particles: minutes on two cores
    #[arg(long)]
    pub quick: bool,
    /// One part only; without it all four
    #[arg(long, value_enum, value_name = "PART")]
    pub part: Option<TradePart>,
    /// Seconds after which no further setting is begun
    #[arg(long, value_name = "S", value_parser = positive, allow_negative_numbers = true)]
    pub within: Option<f64>,
    /// These of the cases that there are: settings, mixes and runs of seeds, in the report's order; without it all of them
    #[arg(long, value_name = "A..B", value_parser = cases, allow_negative_numbers = true)]
    pub cases: Option<Range<usize>>,
    /// Run nothing, and make one report of those of ranges of cases: their trade.json
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["quick", "part", "within", "cases", "device"])]
    pub merge: Vec<PathBuf>,
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
    /// So many cases, those that were thought of first, then random ones; or a range of them, such as 100..200
    #[arg(long, value_name = "N|A..B", default_value = "2000", value_parser = cases, allow_negative_numbers = true)]
    pub cases: Range<usize>,
    /// Run nothing, and make one report of those of ranges of cases: their extremes.json
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["cases", "seed", "only", "jobs", "device"])]
    pub merge: Vec<PathBuf>,
    /// Seed of the random cases
    #[arg(long, default_value_t = 1, value_parser = whole::<u64>(0), allow_negative_numbers = true)]
    pub seed: u64,
    /// One case only, by its number
    #[arg(long, value_name = "CASE", value_parser = between::<usize>(0, MOST_CASES as u64 - 1), allow_negative_numbers = true)]
    pub only: Option<usize>,
    /// Cases at a time
    #[arg(long, default_value_t = 4, value_parser = whole::<u32>(1), allow_negative_numbers = true)]
    pub jobs: u32,
    /// Folder for extremes.json, and with --only for the case's scene; without it
    /// none are made
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

/// Most cases: those before the wanted ones are drawn too. Our choice: a hundred times as many as were ever run.
const MOST_CASES: usize = 1_000_000;

/// Cases from one number on and up to another one, such as `100..200`; or so many from the first on.
///
/// # Errors
/// A message with the valid form.
fn cases(text: &str) -> Result<Range<usize>, String> {
    let range = match text.split_once("..") {
        Some((from, to)) => from.parse().ok().zip(to.parse().ok()),
        None => text.parse().ok().map(|count| (0, count)),
    };
    match range {
        Some((from, to)) if from <= to && to <= MOST_CASES => Ok(from..to),
        _ => Err(format!(
            "give a number of cases, such as 2000, or a range of them, such as 100..200, up to {MOST_CASES}"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_a_number_or_a_range() {
        assert_eq!(cases("2000"), Ok(0..2000));
        assert_eq!(cases("100..200"), Ok(100..200));
        assert_eq!(cases("3..3"), Ok(3..3));
        assert_eq!(cases("1000000"), Ok(0..MOST_CASES));
        for wrong in [
            "",
            "-1",
            "2..1",
            "..",
            "1..",
            "a..b",
            "1...2",
            "1000001",
            "5..1000001",
        ] {
            assert!(cases(wrong).is_err(), "{wrong}");
        }
    }
}
