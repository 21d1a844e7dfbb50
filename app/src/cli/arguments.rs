//! Arguments of what plays and looks: replays, tracks, scenes.

use std::path::PathBuf;

use clap::builder::TypedValueParser;
use clap::{Args, ValueEnum};
use vitriol_lesson::Language;
use vitriol_run::Colour;
use vitriol_run::arguments::{effort, file_of, filter, named, positive, preset, whole};
use vitriol_sim::scene::{PictureFilter, Preset};

#[cfg(feature = "class")]
use super::class::KeepArgs;
use super::drawn::DrawnArgs;
use super::lesson::JudgeArgs;
#[cfg(feature = "class")]
use vitriol_live::ConsoleArgs;

/// Where a film is seen from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum CameraName {
    /// A director: wide for the grip, close where liquid meets liquid or boils, with an inset in slow motion; idle moments
    /// are left out
    #[default]
    Director,
    /// A tripod before the bench
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

/// Two scenes, which differ.
fn two_scenes(text: &str) -> Result<[String; 2], String> {
    const REMEDY: &str = "such as acid-into-water,water-into-acid";
    let names: Vec<&str> = text.split(',').map(str::trim).collect();
    match names[..] {
        [one, other] if one == other && !one.is_empty() => Err(format!(
            "both are {one}; give two scenes that differ, {REMEDY}"
        )),
        [one, other] if !one.is_empty() && !other.is_empty() => {
            Ok([one.to_owned(), other.to_owned()])
        }
        _ => Err(format!(
            "give two scenes with a comma between them, {REMEDY}"
        )),
    }
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
    /// In place of a report: these two scenes at the same time, side by side in a film and an animated picture, with
    /// highest temperatures, steam and thrown masses as captions
    #[arg(long, value_name = "SCENE,SCENE", value_parser = two_scenes)]
    #[arg(conflicts_with_all = ["scene", "budget_ms", "camera", "colour", "language", "lesson", "mode", "no_video"])]
    #[cfg_attr(feature = "class", arg(conflicts_with_all = ["pseudonym", "live"]))]
    pub compare: Option<[String; 2]>,
    /// Trade of speed for accuracy; without it the one that the track was
    /// recorded with, or else balanced
    #[arg(long, value_parser = preset())]
    pub preset: Option<Preset>,
    /// In place of a preset: the most accurate setting by which a frame's solution
    /// takes at most so many milliseconds on this device (99th percentile)
    #[arg(long, value_name = "MS", value_parser = positive, allow_negative_numbers = true, conflicts_with_all = ["preset", "solver"])]
    pub budget_ms: Option<f64>,
    /// Substeps and iterations in place of the preset's, such as 10x3
    #[arg(long, value_name = "SxI", value_parser = effort, allow_hyphen_values = true)]
    pub solver: Option<[u32; 2]>,
    /// Simulated seconds, for which hands hold still after the track's end; without it the whole track
    #[arg(long, value_name = "S", value_parser = positive, allow_negative_numbers = true)]
    pub seconds: Option<f64>,
    /// Seed of the particles' initial jitter; without it the track's own
    #[arg(long, value_parser = whole::<u64>(0), allow_negative_numbers = true)]
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
    /// Language of what the report and the console say of the attempt, and of the lesson's faults: en, de, es or zh
    #[arg(long, value_name = "LANGUAGE", default_value_t)]
    pub language: Language,
    /// What is kept of a student
    #[cfg(feature = "class")]
    #[command(flatten)]
    pub keep: KeepArgs,
    /// Show it on the instructor's console meanwhile, no faster than it was
    #[cfg(feature = "class")]
    #[arg(long, conflicts_with = "no_video")]
    pub live: bool,
    /// Where that console is
    #[cfg(feature = "class")]
    #[command(flatten)]
    pub console: ConsoleArgs,
    /// Make the report without a film
    #[arg(long, conflicts_with_all = ["tint", "room"])]
    pub no_video: bool,
    /// Replay what is whole of a track that breaks off or lacks steps
    #[arg(long)]
    pub accept_truncated: bool,
}

/// Arguments of `vitriol pages`.
#[derive(Debug, Args)]
pub struct PagesArgs {
    /// Folder for them, which may be new
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
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
    #[arg(short, long, value_name = "FILE", value_parser = file_of("mcap"), requires = "input")]
    pub output: Option<PathBuf>,
    /// List the built-in tracks
    #[arg(long, conflicts_with_all = ["input", "output"])]
    pub list: bool,
}

/// Arguments of `vitriol scenes`.
#[derive(Debug, Args)]
pub struct ScenesArgs {
    /// Language of the scenes' titles: en, de, es or zh
    #[arg(
        long,
        value_name = "LANGUAGE",
        default_value_t,
        conflicts_with = "cost"
    )]
    pub language: Language,
    /// What each scene takes: passes of a frame, bytes a particle; and what is left
    /// out of it
    #[arg(long)]
    pub cost: bool,
    /// Under this trade of speed for accuracy alone; without it all three are listed, and --cost is of balanced
    #[arg(long, value_parser = preset())]
    pub preset: Option<Preset>,
    /// With --cost: device to use, its number or a part of its name
    #[arg(long, requires = "cost")]
    pub device: Option<String>,
}

/// Frames a second.
#[cfg(any(feature = "export", feature = "session"))]
pub(super) fn rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(rate) if (1.0..=1000.0).contains(&rate) => Ok(rate),
        _ => Err("give a rate of 1 to 1000 frames a second, such as 90".into()),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::cli::Cli;

    #[test]
    fn two_scenes_are_compared() {
        let two = two_scenes("acid-into-water, water-into-acid").unwrap();
        assert_eq!(two, ["acid-into-water", "water-into-acid"]);
        for wrong in ["beaker", "", ",", "beaker,", "a,b,c"] {
            let said = two_scenes(wrong).unwrap_err();
            assert!(said.contains("comma between them, such as"), "{said}");
        }
        let said = two_scenes("beaker,beaker").unwrap_err();
        assert!(
            said.contains("both are beaker") && said.contains("differ, such as"),
            "{said}"
        );
    }

    /// What would make it a run of another kind is refused beside it.
    #[test]
    fn a_comparison_is_nothing_else() {
        let parsed = |more: &str| {
            let line = format!("vitriol replay two-flasks --compare beaker,dam-break{more}");
            Cli::try_parse_from(line.split(' '))
        };
        for goes in ["", " --preset fast --seconds 1 --tint none --out x"] {
            assert!(parsed(goes).is_ok(), "{goes}");
        }
        let others = [
            "--scene beaker",
            "--budget-ms 5",
            "--camera head",
            "--colour speed",
            "--lesson dilute",
            "--no-video",
        ];
        for other in others {
            assert!(parsed(&format!(" {other}")).is_err(), "{other}");
        }
        if cfg!(feature = "class") {
            for other in ["--live", "--pseudonym p07"] {
                assert!(parsed(&format!(" {other}")).is_err(), "{other}");
            }
        }
    }
}
