//! Arguments of commands that have a console.

use std::net::SocketAddr;

use clap::Args;
use vitriol_console::HubAddress;

use crate::serve::{hub_address, listen_address};

/// Where the instructor's console is. Without any of these it is a page that this computer alone can open; its address, good for one
/// browser, goes to standard error.
#[derive(Args, Clone, Debug, Default)]
pub struct ConsoleArgs {
    /// Serve the console there, for other computers too, by HTTPS: such as 0.0.0.0:8470; localhost:8470 or 8470 is for this one
    #[arg(long, value_name = "ADDRESS:PORT", value_parser = listen_address, conflicts_with = "hub")]
    pub listen: Option<SocketAddr>,
    /// Be one of the students of that hub: what `vitriol hub` prints, or a file that holds it
    #[arg(long, value_name = "HUB", value_parser = hub_address)]
    pub hub: Option<HubAddress>,
    /// This student's name, on the console, in a recording of `vitriol vr` or `vitriol desk` without a pseudonym, and so in
    /// grades; without it the console shows the computer's name
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
}

impl ConsoleArgs {
    /// Whether any of them is given.
    pub fn is_given(&self) -> bool {
        self.listen.is_some() || self.hub.is_some() || self.name.is_some()
    }
}
