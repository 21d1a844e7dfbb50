//! The command line: the subcommands here, their arguments in `play` and `measure`.

mod measure;
pub(crate) mod parse;
mod play;

use clap::{Parser, Subcommand, ValueEnum};

use crate::console::Format;
pub use measure::{
    BenchArgs, CalorimeterArgs, DamBreakArgs, ExtremesArgs, FidelityArgs, Fig5Args, OrderName,
    RealChemistry, ScenesArgs, TradeArgs, TradePart,
};
pub use play::{CameraName, ColourName, FilterName, PictureArgs, ReplayArgs, TrackArgs, VrArgs};

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
    /// The trade of speed for accuracy: knobs, what each costs, and what it is off by
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

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn definition_is_consistent() {
        Cli::command().debug_assert();
    }
}
