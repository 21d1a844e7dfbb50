//! What a scene models beyond incompressible flow, and with which numbers.

use super::error::Problem;
use super::settings::{SolverSettings, require};
use serde::{Deserialize, Serialize};

/// What a scene models beyond a fluid with viscosity. What is not named
/// costs nothing.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Feature {
    /// Temperature and its diffusion.
    Heat,
    /// Acid fraction, its diffusion and the heat of solution.
    Dilution,
    /// Anti-viscosity above the boiling point.
    Boiling,
    /// Cohesion between particles and adhesion to glass.
    Cohesion,
    /// Vorticity confinement.
    Vorticity,
    /// Density by composition and temperature: water floats on acid.
    Density,
    /// Viscosity by composition and temperature.
    Viscosity,
    /// Water that evaporates above the boiling point of the composition.
    Evaporation,
    /// Vapour that leaves the liquid, rises and condenses.
    Steam,
    /// Heat lost through glass and at the free surface.
    Losses,
}

impl Feature {
    /// The name as scenes have it.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}

/// Parameters of the paper's chemistry, Table 1 (its μ₀ is
/// [`SolverSettings::viscosity`]). A scene has those that its features use.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[allow(non_snake_case)]
pub struct PaperChemistry {
    /// Ambient temperature, °C; with `heat`.
    pub T_a: Option<f64>,
    /// Boiling point, °C; with `boiling`.
    pub T_B: Option<f64>,
    /// Heat generation coefficient, K/cal; with `dilution`.
    pub k_d: Option<f64>,
    /// Boiling intensity, dimensionless; with `boiling`.
    pub k_v: Option<f64>,
    /// Diffusion coefficient of temperature, m²/s of the scene; with
    /// `dilution`.
    pub D_T: Option<f64>,
    /// Diffusion coefficient of concentration, m²/s of the scene; with
    /// `dilution`.
    pub D_c: Option<f64>,
    /// Eq. 17 as printed, whose power depends on the number of substeps, in
    /// place of a stated power; with `boiling`. Without it: no.
    pub literal_boiling: Option<bool>,
}

/// Parameters of the physical chemistry: what section 8 of the paper names as
/// missing. Properties of the liquids come from tables; what is here is the
/// scene's own, or stands for what is smaller than a particle. A scene has
/// those that its features use.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PhysicalChemistry {
    /// Temperature of the surroundings, °C; with `heat`.
    pub ambient: Option<f64>,
    /// Mixing by motion finer than a particle: the acid's diffusivity in
    /// units of h·|v_ij|; with `dilution`.
    pub mixing: Option<f64>,
    /// Lewis number D_T/D_c of that mixing, at most 1; with `dilution`.
    pub lewis: Option<f64>,
    /// Time in which a superheat decays by evaporation, s; with `evaporation`.
    pub superheat_time: Option<f64>,
    /// Speed at which bubbles rise through the liquid, m/s; with `steam`.
    pub bubble_speed: Option<f64>,
    /// η: the share of the work R·T/M of the water that evaporates which
    /// becomes motion; with `boiling`.
    pub agitation: Option<f64>,
    /// Heat transfer through glass, W/(m²·K); with `losses`.
    pub glass_loss: Option<f64>,
    /// Heat transfer at the free surface, W/(m²·K); with `losses`.
    pub surface_loss: Option<f64>,
}

/// Absolute zero, °C.
pub(super) const ABSOLUTE_ZERO: f64 = -273.15;

/// Highest boiling point of water and acid at one atmosphere, °C, rounded up:
/// that of the azeotrope, 98.3 % of acid (Perry's handbook).
pub(super) const HOTTEST_LIQUID: f64 = 340.0;

impl PaperChemistry {
    pub(super) fn check(&self) -> Result<(), Problem> {
        temperature("paper.T_a", self.T_a)?;
        if let Some(boiling_point) = self.T_B {
            let must = "above 0 (°C; Eq. 17 divides by it)";
            require("paper.T_B", boiling_point, boiling_point > 0.0, must)?;
        }
        for (field, value) in [
            ("k_d", self.k_d),
            ("k_v", self.k_v),
            ("D_T", self.D_T),
            ("D_c", self.D_c),
        ] {
            not_negative(&format!("paper.{field}"), value)?;
        }
        Ok(())
    }
}

impl PhysicalChemistry {
    pub(super) fn check(&self) -> Result<(), Problem> {
        temperature("physical.ambient", self.ambient)?;
        for (field, value) in [
            ("mixing", self.mixing),
            ("agitation", self.agitation),
            ("glass_loss", self.glass_loss),
            ("surface_loss", self.surface_loss),
        ] {
            not_negative(&format!("physical.{field}"), value)?;
        }
        if let Some(lewis) = self.lewis {
            let ok = (0.0..=1.0).contains(&lewis);
            require("physical.lewis", lewis, ok, "between 0 and 1")?;
        }
        for (field, value, unit) in [
            ("physical.superheat_time", self.superheat_time, "seconds"),
            ("physical.bubble_speed", self.bubble_speed, "m/s"),
        ] {
            if let Some(value) = value {
                require(field, value, value > 0.0, &format!("above zero ({unit})"))?;
            }
        }
        Ok(())
    }
}

fn temperature(field: &str, value: Option<f64>) -> Result<(), Problem> {
    let must = "a temperature above −273.15 (°C)";
    value.map_or(Ok(()), |value| {
        require(field, value, value > ABSOLUTE_ZERO, must)
    })
}

fn not_negative(field: &str, value: Option<f64>) -> Result<(), Problem> {
    value.map_or(Ok(()), |value| {
        require(field, value, value >= 0.0, "zero or more")
    })
}

/// Each feature's parameters are there, and none whose feature is absent.
pub(super) fn check_features(
    model: &[Feature],
    solver: &SolverSettings,
    paper: Option<&PaperChemistry>,
    physical: Option<&PhysicalChemistry>,
) -> Result<(), Problem> {
    for (i, feature) in model.iter().enumerate() {
        if model[..i].contains(feature) {
            let problem = format!("names {:?} twice; once is enough", feature.name());
            return Err(Problem::new(format!("model[{i}]"), problem));
        }
    }
    let chemical = model
        .iter()
        .find(|feature| !matches!(feature, Feature::Cohesion | Feature::Vorticity));
    match (paper, physical) {
        (Some(_), Some(_)) => {
            let problem = "the scene has [paper] and [physical]; keep one chemistry";
            return Err(Problem::new("physical", problem.to_owned()));
        }
        (None, None) => {
            if let Some(feature) = chemical {
                let problem = format!(
                    "missing; `model` names {:?}, which needs [paper] or [physical]",
                    feature.name()
                );
                return Err(Problem::new("paper", problem));
            }
        }
        _ => {}
    }
    for (field, feature, present) in solver_fields(solver)
        .into_iter()
        .chain(paper.map(paper_fields).into_iter().flatten())
        .chain(physical.map(physical_fields).into_iter().flatten())
    {
        let named = model.contains(&feature);
        let name = feature.name();
        if named && !present {
            return Err(Problem::new(
                field,
                format!("missing; `model` names {name:?}, which needs it"),
            ));
        }
        if !named && present {
            let problem = format!("not used; name {name:?} in `model` or leave it out");
            return Err(Problem::new(field, problem));
        }
    }
    if paper.is_some_and(|paper| paper.literal_boiling.is_some())
        && !model.contains(&Feature::Boiling)
    {
        let problem = "not used; name \"boiling\" in `model` or leave it out".to_owned();
        return Err(Problem::new("paper.literal_boiling", problem));
    }
    check_needs(model, physical.is_some())
}

type Field = (&'static str, Feature, bool);

fn solver_fields(solver: &SolverSettings) -> [Field; 3] {
    [
        (
            "solver.vorticity",
            Feature::Vorticity,
            solver.vorticity.is_some(),
        ),
        (
            "solver.cohesion",
            Feature::Cohesion,
            solver.cohesion.is_some(),
        ),
        (
            "solver.adhesion",
            Feature::Cohesion,
            solver.adhesion.is_some(),
        ),
    ]
}

fn paper_fields(p: &PaperChemistry) -> [Field; 6] {
    [
        ("paper.T_a", Feature::Heat, p.T_a.is_some()),
        ("paper.T_B", Feature::Boiling, p.T_B.is_some()),
        ("paper.k_v", Feature::Boiling, p.k_v.is_some()),
        ("paper.k_d", Feature::Dilution, p.k_d.is_some()),
        ("paper.D_T", Feature::Dilution, p.D_T.is_some()),
        ("paper.D_c", Feature::Dilution, p.D_c.is_some()),
    ]
}

fn physical_fields(p: &PhysicalChemistry) -> [Field; 8] {
    [
        ("physical.ambient", Feature::Heat, p.ambient.is_some()),
        ("physical.mixing", Feature::Dilution, p.mixing.is_some()),
        ("physical.lewis", Feature::Dilution, p.lewis.is_some()),
        (
            "physical.superheat_time",
            Feature::Evaporation,
            p.superheat_time.is_some(),
        ),
        (
            "physical.bubble_speed",
            Feature::Steam,
            p.bubble_speed.is_some(),
        ),
        (
            "physical.agitation",
            Feature::Boiling,
            p.agitation.is_some(),
        ),
        (
            "physical.glass_loss",
            Feature::Losses,
            p.glass_loss.is_some(),
        ),
        (
            "physical.surface_loss",
            Feature::Losses,
            p.surface_loss.is_some(),
        ),
    ]
}

/// What features are built upon: (one, what it needs).
fn needs(physical: bool) -> Vec<(Feature, Feature)> {
    let mut needs = vec![
        (Feature::Dilution, Feature::Heat),
        (Feature::Boiling, Feature::Heat),
        (Feature::Density, Feature::Dilution),
        (Feature::Viscosity, Feature::Dilution),
        (Feature::Evaporation, Feature::Dilution),
        (Feature::Losses, Feature::Dilution),
    ];
    if physical {
        needs.extend([
            (Feature::Heat, Feature::Dilution),
            // Only vapour that leaves does work that can become motion.
            (Feature::Boiling, Feature::Steam),
            (Feature::Steam, Feature::Evaporation),
        ]);
    }
    needs
}

/// `feature` and what of `model` cannot be without it.
pub(super) fn built_upon(model: &[Feature], feature: Feature, physical: bool) -> Vec<Feature> {
    let mut gone = vec![feature];
    let mut known = 0;
    while known < gone.len() {
        let lost = gone[known];
        known += 1;
        for (one, needed) in needs(physical) {
            if needed == lost && model.contains(&one) && !gone.contains(&one) {
                gone.push(one);
            }
        }
    }
    gone
}

fn check_needs(model: &[Feature], physical: bool) -> Result<(), Problem> {
    let all = needs(physical);
    for (feature, needed) in all {
        if model.contains(&feature) && !model.contains(&needed) {
            let (feature, needed) = (feature.name(), needed.name());
            let problem = format!("{feature:?} needs {needed:?}; name it too");
            return Err(Problem::new("model", problem));
        }
    }
    let beyond_paper = [
        Feature::Density,
        Feature::Viscosity,
        Feature::Evaporation,
        Feature::Steam,
        Feature::Losses,
    ];
    for feature in beyond_paper {
        if model.contains(&feature) && !physical {
            let problem = format!(
                "{:?} is part of [physical]; give that in place of [paper]",
                feature.name()
            );
            return Err(Problem::new("model", problem));
        }
    }
    Ok(())
}
