//! Parameters of a scene's chemistry: physics beyond incompressible flow.

use super::error::Problem;
use super::feature::Feature;
use super::fields::{Field, Must};
use super::settings::SolverSettings;
use serde::{Deserialize, Serialize};

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
/// missing. Properties of the liquids come from tables; the parameters here are the
/// scene's own, or model processes smaller than a particle. A scene has
/// those that its features use.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PhysicalChemistry {
    /// Temperature of the surroundings, °C; with `heat`.
    pub ambient: Option<f64>,
    /// Mixing by eddies that are not resolved: their diffusivity over Δ²·|S|;
    /// with `dilution`.
    pub mixing: Option<f64>,
    /// Δ: width over which the flow is filtered for it, m; with `dilution`.
    pub eddy_width: Option<f64>,
    /// Time in which a superheat decays into vapour that particles hold, s; with `evaporation`, without `bubbles`.
    pub superheat_time: Option<f64>,
    /// Edge of the cube of liquid that has one nucleus of bubbles which grows at a superheat of 1 K, m: 0.01 of dirty liquid, 1 of
    /// clean; with `bubbles`. Without it each seed draws it.
    pub nuclei_spacing: Option<f64>,
    /// How long a bubble lasts at the surface, s; with `bubbles`. Without it: until its film has drained.
    pub foam_time: Option<f64>,
    /// Most bubbles at a time; with `bubbles`.
    pub most_bubbles: Option<u32>,
    /// δ: thickness of the lamellae that eddies leave to molecules, m; with `segregation`.
    pub lamella: Option<f64>,
    /// Heat transfer from glass to air, W/(m²·K); with `losses`.
    pub glass_loss: Option<f64>,
    /// Heat transfer at the free surface, W/(m²·K); with `losses`.
    pub surface_loss: Option<f64>,
}

/// Absolute zero, °C.
pub(super) const ABSOLUTE_ZERO: f64 = -273.15;

/// Highest boiling point of water and acid at one atmosphere, °C, rounded up:
/// that of the azeotrope, 98.3 % of acid (Perry's handbook).
pub(super) const HOTTEST_LIQUID: f64 = 340.0;

/// Most superheat that liquid has at the start, K. Water without air bore 12 K in a glass flask (De Luc, 1772), and 9 K before it burst in
/// Chang's repetition (Science Progress 91, 2008, p. 219). Our choice: three times that and more, so that a scene may go beyond what was
/// seen, and not so far that all of its liquid would be steam at once.
pub(super) const MOST_SUPERHEAT: f64 = 40.0;

/// Hottest that a scene without tables of liquids may have, °C: `vitriol extremes` tries as much. Single precision resolves 0.06 K there.
pub(super) const HOTTEST: f64 = 1e6;

/// Coldest that water with that fraction of acid is still liquid, °C. Clean water freezes of itself at −38 °C (Koop et al., Nature 406,
/// 2000, p. 611), and acid of 38 %, which freezes last, at −75 °C; between them in proportion. Stronger acid supercools: as that of 38 %.
pub(super) fn coldest_liquid(acid: f64) -> f64 {
    -38.0 - 37.0 * (acid / 0.38).min(1.0)
}

const TEMPERATURE: Must = (
    |value| value > ABSOLUTE_ZERO && value <= HOTTEST,
    "a temperature above −273.15 and up to 1000000 (°C)",
);
/// Records of the World Meteorological Organization: −89.2 °C (Vostok, 1983) and 56.7 °C (Furnace Creek, 1913).
const AIR: Must = (
    |value| (-90.0..=60.0).contains(&value),
    "from −90 to 60 (°C), as air on Earth is",
);
const BOILING_POINT: Must = (
    |value| value > 0.0 && value <= HOTTEST,
    "above 0 and up to 1000000 (°C; Eq. 17 divides by it)",
);
const DURATION: Must = (
    |value| value > 0.0 && value <= 3600.0,
    "above zero and up to 3600 (seconds)",
);
/// Lengths by which rates are divided. Below a micrometre liquid is no continuum to a particle, and a bench is not wider than 10 m.
const LENGTH: Must = (
    |value| (1e-6..=10.0).contains(&value),
    "above zero, from 0.000001 to 10 (m)",
);
/// Our choice: a thousand times the paper's, of which `vitriol extremes` tries a hundred times.
const INTENSITY: Must = (|value| (0.0..=1000.0).contains(&value), "from 0 to 1000");
/// A calorie warms a gram of water by 1 K. Our choice: that of a milligram.
const HEATING: Must = (
    |value| (0.0..=1000.0).contains(&value),
    "from 0 to 1000 (K/cal)",
);
/// Our choice: five times what `vitriol extremes` may draw, in worlds that are drawn large.
const DIFFUSIVITY: Must = (
    |value| (0.0..=1e6).contains(&value),
    "from 0 to 1000000 (m²/s)",
);
/// Flows have some 0.03. Our choice: ten times what `vitriol extremes` may draw.
const MIXING: Must = (
    |value| (0.0..=1e5).contains(&value),
    "from 0 to 100000 (over Δ²·|S|)",
);
/// Boiling water takes up no more (Incropera, Fundamentals of Heat and Mass Transfer, table 1.1).
const HEAT_TRANSFER: Must = (
    |value| (0.0..=1e5).contains(&value),
    "from 0 to 100000 (W/(m²·K)), as much as boiling water takes up",
);
const PLACES: Must = (
    |value| (1.0..=65_536.0).contains(&value),
    "from 1 to 65,536",
);

impl PaperChemistry {
    pub(super) fn fields(&self) -> [Field; 6] {
        use Feature::{Boiling, Dilution, Heat};
        [
            ("T_a", Heat, self.T_a, TEMPERATURE),
            ("T_B", Boiling, self.T_B, BOILING_POINT),
            ("k_v", Boiling, self.k_v, INTENSITY),
            ("k_d", Dilution, self.k_d, HEATING),
            ("D_T", Dilution, self.D_T, DIFFUSIVITY),
            ("D_c", Dilution, self.D_c, DIFFUSIVITY),
        ]
    }
}

impl PhysicalChemistry {
    pub(super) fn fields(&self, bubbles: bool) -> Vec<Field> {
        use Feature::{Bubbles, Dilution, Evaporation, Heat, Losses, Segregation};
        let p = self;
        let mut fields = vec![
            ("ambient", Heat, p.ambient, AIR),
            ("mixing", Dilution, p.mixing, MIXING),
            ("eddy_width", Dilution, p.eddy_width, LENGTH),
            (
                "most_bubbles",
                Bubbles,
                p.most_bubbles.map(f64::from),
                PLACES,
            ),
            ("lamella", Segregation, p.lamella, LENGTH),
            ("glass_loss", Losses, p.glass_loss, HEAT_TRANSFER),
            ("surface_loss", Losses, p.surface_loss, HEAT_TRANSFER),
        ];
        // Without them bubbles have them by lot and by a law.
        if p.nuclei_spacing.is_some() {
            fields.push(("nuclei_spacing", Bubbles, p.nuclei_spacing, LENGTH));
        }
        if p.foam_time.is_some() {
            fields.push(("foam_time", Bubbles, p.foam_time, DURATION));
        }
        // Bubbles themselves are how a superheat decays.
        if !bubbles {
            fields.push(("superheat_time", Evaporation, p.superheat_time, DURATION));
        }
        fields
    }
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
        .find(|feature| !matches!(feature, Feature::Tension | Feature::Vorticity));
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
    let solver = solver.fields().map(|field| ("solver", field));
    let of_paper = paper.map(|paper| paper.fields().map(|field| ("paper", field)));
    let bubbles = model.contains(&Feature::Bubbles);
    let of_physical = physical.map(|physical| {
        let fields = physical.fields(bubbles).into_iter();
        fields.map(|field| ("physical", field))
    });
    let fields = solver
        .into_iter()
        .chain(of_paper.into_iter().flatten())
        .chain(of_physical.into_iter().flatten());
    for (table, (name, feature, value, _)) in fields {
        let (field, present) = (format!("{table}.{name}"), value.is_some());
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
    if bubbles && physical.is_some_and(|physical| physical.superheat_time.is_some()) {
        let problem = "not used; bubbles are how a superheat decays, leave it out".to_owned();
        return Err(Problem::new("physical.superheat_time", problem));
    }
    check_needs(model, physical.is_some())
}

/// Dependencies of features: (feature, the feature that it needs).
fn needs(physical: bool) -> Vec<(Feature, Feature)> {
    let mut needs = vec![
        (Feature::Dilution, Feature::Heat),
        (Feature::Boiling, Feature::Heat),
        (Feature::Density, Feature::Dilution),
        (Feature::Viscosity, Feature::Dilution),
        (Feature::Evaporation, Feature::Dilution),
        (Feature::Losses, Feature::Dilution),
        (Feature::Segregation, Feature::Dilution),
    ];
    if physical {
        needs.extend([
            (Feature::Heat, Feature::Dilution),
            (Feature::Bubbles, Feature::Evaporation),
            // They swell the liquid as a change of its density does.
            (Feature::Bubbles, Feature::Density),
            (Feature::Spray, Feature::Bubbles),
            (Feature::Air, Feature::Bubbles),
        ]);
    }
    needs
}

/// `feature` and the features of `model` that depend on it.
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
    if physical && model.contains(&Feature::Boiling) {
        let problem = "\"boiling\" is the paper's; [physical] boils by \"bubbles\"";
        return Err(Problem::new("model", problem.to_owned()));
    }
    let beyond_paper = [
        Feature::Density,
        Feature::Viscosity,
        Feature::Evaporation,
        Feature::Bubbles,
        Feature::Spray,
        Feature::Air,
        Feature::Losses,
        Feature::Segregation,
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
