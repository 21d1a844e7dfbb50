//! State that all connections share.

use super::registry::Registry;
use crate::auth::{Gate, NoRandomness, Site};
use crate::invitation::Invitation;
use crate::page::Page;

/// State that all connections of a hub share.
pub(super) struct Shared {
    pub site: Site,
    pub gate: Gate,
    pub registry: Registry,
    pub page: Page,
    /// The host and port for people.
    pub host: String,
}

impl Shared {
    /// Makes a new code, with the address that has it.
    pub fn invite(&self) -> Result<Invitation, NoRandomness> {
        let code = self.gate.invite()?.shown();
        let address = format!("{}://{}/#{code}", self.site.scheme(), self.host);
        Ok(Invitation { address, code })
    }
}
