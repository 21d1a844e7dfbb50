//! Arguments of `vitriol export`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::TypedValueParser;
use vitriol_run::arguments::{effort, named, not_negative, positive, preset, whole};
use vitriol_sim::scene::Preset;

use super::arguments::rate;

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
    #[arg(long, value_name = "HZ", value_parser = rate, allow_negative_numbers = true, default_value_t = 30.0, conflicts_with = "at")]
    pub rate: f64,
    /// The first moment, s
    #[arg(long, value_name = "S", value_parser = not_negative, allow_negative_numbers = true, conflicts_with = "at")]
    pub from: Option<f64>,
    /// Simulated seconds; without it the whole track or run
    #[arg(long, value_name = "S", value_parser = positive, allow_negative_numbers = true, conflicts_with = "at")]
    pub seconds: Option<f64>,
    /// One moment alone, at this time, s
    #[arg(long, value_name = "S", value_parser = not_negative, allow_negative_numbers = true)]
    pub at: Option<f64>,
    /// A built-in scene's name or a TOML file; without it the scene that the track or run names
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<String>,
    /// Trade of speed for accuracy; without it that of the track or run, or else balanced
    #[arg(long, value_parser = preset())]
    pub preset: Option<Preset>,
    /// Substeps and iterations in place of the preset's, such as 10x3
    #[arg(long, value_name = "SxI", value_parser = effort, allow_hyphen_values = true)]
    pub solver: Option<[u32; 2]>,
    /// Seed of the particles' initial jitter; without it that of the track or run
    #[arg(long, value_parser = whole::<u64>(0), allow_negative_numbers = true)]
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
    use vitriol_export::{Format, TableFormat};
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
        (
            Format::Table(TableFormat::Csv),
            "Measurements, a row a sample",
        ),
        (Format::Table(TableFormat::Parquet), "The same"),
        (Format::Mcap, "A recording for Foxglove and Rerun"),
    ];
    named(&FORMATS, Format::name)
}
