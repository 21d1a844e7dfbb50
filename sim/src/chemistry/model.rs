//! What of the chemistry a scene models, and with which numbers.

use super::paper::Boiling;
use crate::scene::{Feature, Scene};

/// Chemistry of a scene that models heat.
#[derive(Clone, Debug, PartialEq)]
pub enum Chemistry {
    /// Sections 4.1 to 4.3 of the paper.
    Paper(Paper),
}

/// The paper's chemistry, Table 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Paper {
    /// Where acid and heat diffuse.
    pub dilution: Option<PaperDilution>,
    /// Where what is hotter than T_B boils.
    pub boiling: Option<PaperBoiling>,
}

/// Eqs 5 to 13.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperDilution {
    /// Temperature T_a of the walls, °C.
    pub ambient: f64,
    /// D_T, m²/s.
    pub heat_diffusivity: f64,
    /// D_c, m²/s.
    pub acid_diffusivity: f64,
    /// k_d, K/cal.
    pub heat_generation: f64,
}

/// Eq. 17.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperBoiling {
    /// T_B, °C.
    pub boiling_point: f64,
    /// k_v.
    pub intensity: f64,
    /// What it injects.
    pub law: Boiling,
}

impl Chemistry {
    /// What `scene` models; a scene that is validated has all of the numbers.
    pub fn from_scene(scene: &Scene) -> Option<Self> {
        if !scene.models(Feature::Heat) {
            return None;
        }
        let paper = scene.paper?;
        let dilution = || {
            Some(PaperDilution {
                ambient: paper.T_a?,
                heat_diffusivity: paper.D_T?,
                acid_diffusivity: paper.D_c?,
                heat_generation: paper.k_d?,
            })
        };
        let boiling = || {
            let literal = paper.literal_boiling.unwrap_or(false);
            Some(PaperBoiling {
                boiling_point: paper.T_B?,
                intensity: paper.k_v?,
                law: if literal {
                    Boiling::Literal
                } else {
                    Boiling::Power
                },
            })
        };
        Some(Self::Paper(Paper {
            dilution: dilution().filter(|_| scene.models(Feature::Dilution)),
            boiling: boiling().filter(|_| scene.models(Feature::Boiling)),
        }))
    }
}
