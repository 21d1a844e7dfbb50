//! Arguments of `vitriol vr`.

use clap::Args;
use vitriol_run::arguments::{between, size};

use super::arguments::rate;
use super::session::SessionArgs;
use vitriol_session::foveating::Foveating;
use vitriol_session::placement::Posture;

/// Arguments of `vitriol vr`.
#[derive(Debug, Args)]
pub struct VrArgs {
    /// What all sessions have
    #[command(flatten)]
    pub session: SessionArgs,
    /// Where the pictures are sharp; without it everywhere, and about the lenses' axes alone where frames would not fit and
    /// that helps
    #[arg(long, value_enum, value_name = "FOVEATION")]
    pub foveation: Option<Foveating>,
    /// How you are at the bench
    #[arg(long, value_enum, default_value_t, value_name = "POSTURE")]
    pub posture: Posture,
    /// No window on the computer that shows what the left eye sees
    #[arg(long)]
    pub no_mirror: bool,
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
