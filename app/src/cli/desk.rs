//! Arguments of `vitriol desk`.

use clap::Args;
use vitriol_run::arguments::size;

use super::session::SessionArgs;

/// Arguments of `vitriol desk`.
#[derive(Debug, Args)]
pub struct DeskArgs {
    /// What all sessions have
    #[command(flatten)]
    pub session: SessionArgs,
    /// Width and height of the window when it opens, pixels; a screen of high density scales them
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size, allow_hyphen_values = true)]
    pub size: [u32; 2],
    /// Let the window fill the screen; F11 changes that
    #[arg(long)]
    pub full_screen: bool,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}
