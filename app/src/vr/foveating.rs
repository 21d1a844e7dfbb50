//! Where a headset's pictures are sharp.

use serde::Serialize;
use vitriol_render::Foveation;

/// What is shaded of the pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Foveating {
    /// Every pixel
    Off,
    /// Every pixel within 10° of a lens's axis and of panel and signs; beyond, one of 4, and of
    /// bare room one of 16 beyond 30°
    #[default]
    Fixed,
}

impl Foveating {
    /// As the renderer takes it.
    pub fn foveation(self) -> Option<Foveation> {
        match self {
            Self::Off => None,
            Self::Fixed => Some(Foveation::fixed()),
        }
    }
}
