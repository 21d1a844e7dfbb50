//! The chemistry that a scene models, with its parameters.

use super::bubbles::{Bubbles, NUCLEI};
use super::eddies::Mixing;
use super::paper::Boiling;
use super::transport::Losses;
use crate::scene::{Feature, PaperChemistry, PhysicalChemistry, Scene};

/// Least acid fraction of the acid's layers, where all of a scene's liquids are weaker.
const WEAKEST_FEED: f64 = 0.05;

/// Chemistry of a scene that models heat.
#[derive(Clone, Debug, PartialEq)]
pub enum Chemistry {
    /// Sections 4.1 to 4.3 of the paper.
    Paper(Paper),
    /// The physical chemistry: what section 8 of the paper names as missing.
    Physical(Physical),
}

/// The paper's chemistry, Table 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Paper {
    /// Diffusion and heat of solution, where they are modelled.
    pub dilution: Option<PaperDilution>,
    /// Boiling above T_B, where it is modelled.
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
    /// Law of the energy that boiling injects.
    pub law: Boiling,
}

/// The physical chemistry at real size; parts that are off are not computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Physical {
    /// Mixing below the particles' size.
    pub mixing: Mixing,
    /// Acid fraction of the acid's layers: that of the scene's strongest liquid.
    pub feed: f64,
    /// Whether density follows composition and temperature.
    pub density: bool,
    /// Whether viscosity follows them.
    pub viscosity: bool,
    /// Time constant of boiling and condensing, s, where water evaporates and particles hold their vapour.
    pub superheat_time: Option<f64>,
    /// Bubbles that have volume, in place of vapour that particles hold.
    pub bubbles: Option<Bubbles>,
    /// δ: thickness of lamellae that no eddy engulfs any more, m, where
    /// liquid stays unmixed below a particle's size.
    pub lamella: Option<f64>,
    /// Heat losses to glass and air, where they are modelled.
    pub losses: Option<Losses>,
}

impl Physical {
    /// Whether water evaporates.
    pub fn evaporates(&self) -> bool {
        self.superheat_time.is_some() || self.bubbles.is_some()
    }
}

impl Chemistry {
    /// The chemistry of `scene`; a validated scene has all parameters of its features.
    pub fn from_scene(scene: &Scene) -> Option<Self> {
        if !scene.models(Feature::Heat) {
            return None;
        }
        match (&scene.paper, &scene.physical) {
            (Some(paper), _) => Some(Self::Paper(of_paper(scene, paper))),
            (None, Some(physical)) => of_physical(scene, physical).map(Self::Physical),
            (None, None) => None,
        }
    }
}

fn of_paper(scene: &Scene, paper: &PaperChemistry) -> Paper {
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
    Paper {
        dilution: dilution().filter(|_| scene.models(Feature::Dilution)),
        boiling: boiling().filter(|_| scene.models(Feature::Boiling)),
    }
}

fn of_physical(scene: &Scene, physical: &PhysicalChemistry) -> Option<Physical> {
    let where_modelled = |feature, value: Option<f64>| value.filter(|_| scene.models(feature));
    let losses = || {
        Some(Losses {
            ambient: physical.ambient?,
            glass: physical.glass_loss?,
            surface: physical.surface_loss?,
        })
    };
    let bubbles = || {
        Some(Bubbles {
            nuclei_spacing: physical.nuclei_spacing.unwrap_or(NUCLEI[0]),
            foam_time: physical.foam_time,
            most: physical.most_bubbles?,
            spray: scene.models(Feature::Spray),
            air: scene.models(Feature::Air),
        })
    };
    let acids = scene.liquids.iter().map(|liquid| liquid.acid_fraction);
    Some(Physical {
        feed: acids.fold(WEAKEST_FEED, f64::max),
        bubbles: bubbles().filter(|_| scene.models(Feature::Bubbles)),
        mixing: Mixing {
            turbulence: physical.mixing?,
            width: physical.eddy_width?,
        },
        density: scene.models(Feature::Density),
        viscosity: scene.models(Feature::Viscosity),
        superheat_time: where_modelled(Feature::Evaporation, physical.superheat_time),
        lamella: where_modelled(Feature::Segregation, physical.lamella),
        losses: losses().filter(|_| scene.models(Feature::Losses)),
    })
}
