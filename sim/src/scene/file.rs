//! A scene file as it stands, before flasks and liquids are made of it.

use super::chemistry::{
    ABSOLUTE_ZERO, HOTTEST, HOTTEST_LIQUID, MOST_SUPERHEAT, PaperChemistry, PhysicalChemistry,
    coldest_liquid,
};
use super::contents::{Flask, Liquid};
use super::error::Problem;
use super::feature::Feature;
use super::fields::{TURN, TURN_IN_WORDS, exactly, require, within};
use super::preset::Preset;
use super::settings::{
    Floor, HEAVIEST, PictureSettings, PresetOverrides, Scale, SolverSettings, TableTop,
};
use super::tool::ToolEntry;
use crate::chemistry::table::SolutionTable;
use crate::fill;
use crate::flask::Profile;
use crate::flask::glassware::{self, Vessel};
use crate::pose::Pose;
use crate::surface_tension;
use glam::{DQuat, DVec3, EulerRot};
use serde::Deserialize;
use std::collections::BTreeMap;

/// Most heat of a plate, W: more than a laboratory's.
const MOST_HEAT: f64 = 5000.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneFile {
    pub name: String,
    pub description: String,
    /// Where the scene is in the stage, metres of the scene.
    #[serde(default, deserialize_with = "exactly")]
    pub origin: [f64; 3],
    pub scale: Scale,
    pub solver: SolverSettings,
    pub model: Vec<Feature>,
    pub paper: Option<PaperChemistry>,
    pub physical: Option<PhysicalChemistry>,
    #[serde(default)]
    pub flask: Vec<FlaskEntry>,
    #[serde(default)]
    pub liquid: Vec<LiquidEntry>,
    #[serde(default)]
    pub tool: Vec<ToolEntry>,
    pub table: Option<TableTop>,
    pub floor: Floor,
    #[serde(default)]
    pub picture: PictureSettings,
    #[serde(default)]
    pub preset: BTreeMap<Preset, PresetOverrides>,
}

/// Two numbers.
#[derive(Clone, Copy, Deserialize)]
struct Point(#[serde(deserialize_with = "exactly")] [f64; 2]);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FlaskEntry {
    name: String,
    /// What kind of vessel own points are.
    vessel: Option<Vessel>,
    /// A name of [`glass`], made larger by 1/length_scale.
    profile: Option<String>,
    /// Or its own (height, radius) points, metres of the scene.
    points: Option<Vec<Point>>,
    /// Wall of own points, metres of the scene.
    wall: Option<f64>,
    /// Density of the wall of own points, kg/m³.
    density: Option<f64>,
    #[serde(deserialize_with = "exactly")]
    position: [f64; 3],
    /// Yaw about y, pitch about x, roll about z, degrees, in this order from
    /// the stage to the flask.
    #[serde(default, deserialize_with = "exactly")]
    rotation: [f64; 3],
    fixed: bool,
    /// Contact angle of its glass, degrees.
    contact_angle: Option<f64>,
    /// Heat that a plate under it gives its base, W; with `losses`, which model the glass.
    heater: Option<f64>,
    /// Whether a hot plate is under it that may be switched off; one that heats is there without it.
    #[serde(default)]
    plate: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LiquidEntry {
    flask: String,
    /// Volume as drawn, millilitres.
    volume_ml: Option<f64>,
    particles: Option<u32>,
    /// Share of the particles that fit below the rim: 1 is brim-full.
    fraction: Option<f64>,
    temperature: f64,
    acid_fraction: f64,
}

impl FlaskEntry {
    /// `models_losses`: whether the scene models the heat of its glass.
    pub fn build(self, index: usize, scale: &Scale, models_losses: bool) -> Result<Flask, Problem> {
        let field = |name: &str| format!("flask[{index}].{name}");
        if self.name.is_empty() {
            return Err(Problem::new(field("name"), "empty; give the flask a name"));
        }
        let (profile, density, vessel) = match (&self.profile, &self.points) {
            (Some(name), None) => named(name, &self, index, scale)?,
            (None, Some(points)) => {
                let points: Vec<_> = points.iter().map(|Point(at)| *at).collect();
                let Some(wall) = self.wall else {
                    let problem = "missing; own points need the wall's thickness (metres)";
                    return Err(Problem::new(field("wall"), problem));
                };
                let place = if wall > 0.0 { "points" } else { "wall" };
                let profile = Profile::new(&points, wall)
                    .map_err(|error| Problem::new(field(place), error))?;
                let density = self.density.unwrap_or(glassware::BOROSILICATE);
                (profile, density, self.vessel.unwrap_or_default())
            }
            _ => {
                let problem = "give either `profile` (a name) or `points` ([[height, radius], …])";
                return Err(Problem::new(field("profile"), problem));
            }
        };
        let must = "from 1 to 25000 (kg/m³): the heaviest metal has 22600";
        within(&field("density"), density, 1.0..=HEAVIEST, must)?;
        profile
            .check_particle(scale.spacing)
            .map_err(|error| Problem::new(field("points"), error))?;
        for value in self.position {
            require(&field("position"), value, true, "a finite number (metres)")?;
        }
        for angle in self.rotation {
            within(&field("rotation"), angle, TURN, TURN_IN_WORDS)?;
        }
        let angle = self
            .contact_angle
            .unwrap_or(surface_tension::GLASS.to_degrees());
        let must = "from 0 to 180 (degrees)";
        within(&field("contact_angle"), angle, 0.0..=180.0, must)?;
        let heater = self.heater.unwrap_or(0.0);
        let must = "from 0 to 5000 (W)";
        within(&field("heater"), heater, 0.0..=MOST_HEAT, must)?;
        if heater > 0.0 && !models_losses {
            let problem = "heats glass that is not modelled; name \"losses\" in `model`";
            return Err(Problem::new(field("heater"), problem));
        }
        let [yaw, pitch, roll] = self.rotation.map(f64::to_radians);
        let orientation = DQuat::from_euler(EulerRot::YXZ, yaw, pitch, roll);
        let flask = Flask {
            mass: profile.glass_volume() * density,
            name: self.name,
            vessel,
            profile,
            stage_from_flask: Pose::new(
                DVec3::from_array(self.position).as_vec3(),
                orientation.as_quat(),
            ),
            fixed: self.fixed,
            contact_angle: angle.to_radians(),
            heater,
            plate: self.plate || heater > 0.0,
        };
        Flask::check_sizes(std::slice::from_ref(&flask), scale)?;
        Ok(flask)
    }
}

fn named(
    name: &str,
    entry: &FlaskEntry,
    index: usize,
    scale: &Scale,
) -> Result<(Profile, f64, Vessel), Problem> {
    let field = |name: &str| format!("flask[{index}].{name}");
    for (key, present) in [
        ("vessel", entry.vessel.is_some()),
        ("wall", entry.wall.is_some()),
        ("density", entry.density.is_some()),
    ] {
        if present {
            let problem = format!("{name:?} has its own; leave it out or give `points`");
            return Err(Problem::new(field(key), problem));
        }
    }
    let Some(glass) = glassware::find(name) else {
        let known: Vec<_> = glassware::GLASSWARE
            .iter()
            .map(|glass| glass.name)
            .collect();
        let problem = format!(
            "no vessel is named {name:?}; known are {}",
            known.join(", ")
        );
        return Err(Problem::new(field("profile"), problem));
    };
    let profile = glass
        .profile(1.0 / scale.length_scale)
        .map_err(|error| Problem::new(field("profile"), error))?;
    Ok((profile, glass.density, glass.vessel))
}

impl LiquidEntry {
    /// `solutions` are what the program has for liquids; `None` where the scene has the paper's chemistry.
    pub fn build(
        self,
        index: usize,
        scale: &Scale,
        flasks: &[Flask],
        solutions: Option<&SolutionTable>,
    ) -> Result<Liquid, Problem> {
        let field = |name: &str| format!("liquid[{index}].{name}");
        let Some(flask) = flasks.iter().position(|flask| flask.name == self.flask) else {
            let names: Vec<_> = flasks.iter().map(|flask| flask.name.as_str()).collect();
            let problem = format!(
                "no flask is named {:?}; there are: {}",
                self.flask,
                names.join(", ")
            );
            return Err(Problem::new(field("flask"), problem));
        };
        let volume = match (self.volume_ml, self.particles, self.fraction) {
            (Some(millilitres), None, None) => {
                let must = "zero or more (mL as drawn)";
                require(&field("volume_ml"), millilitres, millilitres >= 0.0, must)?;
                millilitres * 1e-6 / scale.length_scale.powi(3)
            }
            (None, Some(count), None) => f64::from(count) * scale.spacing.powi(3),
            (None, None, Some(fraction)) => {
                let must = "between 0 and 1 (1: to the brim)";
                within(&field("fraction"), fraction, 0.0..=1.0, must)?;
                let profile = &flasks[flask].profile;
                let fitting = fill::count_sites(profile, scale.spacing);
                (fraction * fitting as f64).floor() * scale.spacing.powi(3)
            }
            _ => {
                let problem = "give exactly one of `volume_ml`, `particles` and `fraction`";
                return Err(Problem::new(field("volume_ml"), problem));
            }
        };
        let must = "between 0 and 1 (mass of acid over all)";
        within(&field("acid_fraction"), self.acid_fraction, 0.0..=1.0, must)?;
        let celsius = self.temperature;
        let ok = celsius > ABSOLUTE_ZERO && celsius <= HOTTEST;
        let must = "above −273.15 and up to 1000000 (°C)";
        require(&field("temperature"), celsius, ok, must)?;
        if let Some(solutions) = solutions {
            let boils = solutions.at(self.acid_fraction).boiling_point;
            let most = (boils + MOST_SUPERHEAT).min(HOTTEST_LIQUID).round();
            if celsius > most {
                let problem = format!(
                    "{celsius} °C: liquid of this acid fraction boils at {boils:.0} °C and bears no superheat of more than \
                     {MOST_SUPERHEAT} K in a flask, and the tables of liquids end at {HOTTEST_LIQUID} °C; take {most} or less"
                );
                return Err(Problem::new(field("temperature"), problem));
            }
            let least = coldest_liquid(self.acid_fraction).ceil();
            if celsius < least {
                let problem = format!(
                    "{celsius} °C: liquid of this acid fraction is ice, which is not modelled: clean water freezes of itself at \
                     −38 °C, and acid of 38 %, which freezes last, at −75 °C; take {least} or more"
                );
                return Err(Problem::new(field("temperature"), problem));
            }
        }
        Ok(Liquid {
            flask,
            volume,
            temperature: celsius,
            acid_fraction: self.acid_fraction,
        })
    }
}
