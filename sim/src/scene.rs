//! Scenes as data: a TOML file with vessels, liquids, features and their
//! parameters.

mod base;
mod builtin;
mod chemistry;
mod contents;
mod error;
mod feature;
mod fields;
mod file;
mod limits;
mod overlap;
mod preset;
mod settings;
mod tool;

#[cfg(test)]
mod tests;

pub use base::missing_quote;
pub use chemistry::{PaperChemistry, PhysicalChemistry};
pub use contents::{Flask, Liquid, StartParticle};
pub use error::SceneError;
pub use feature::Feature;
pub use preset::Preset;
pub use settings::{
    Boundary, Floor, PictureFilter, PictureRoom, PictureSettings, PictureTint, PresetOverrides,
    RelaxationKind, Scale, SolverSettings, TableTop,
};

pub use tool::{PANE, Tool, ToolKind, sash_heights};

use crate::chemistry::bubbles::drawn_nuclei;
use crate::chemistry::table::SolutionTable;
use crate::fill::{self, FillError};
use crate::flask::particles::{self, BoundaryParticle};
use crate::surface_tension::{HYSTERESIS, SurfaceTension};
use error::Problem;
use glam::DVec3;
use std::collections::BTreeMap;

/// A scene, validated.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// What it shows, in a sentence or two, and which of its values are our choice.
    pub description: String,
    /// Where the scene's frame is in the stage, metres of the scene. All else
    /// here, and what is simulated, is relative to it: however far off the scene
    /// is, it has the bits that it has at the stage's own origin.
    pub origin: DVec3,
    /// Scale, time and gravity.
    pub scale: Scale,
    /// Parameters of the solver.
    pub solver: SolverSettings,
    /// Features that are modelled, each once.
    pub model: Vec<Feature>,
    /// Table 1's parameters, where the model uses any.
    pub paper: Option<PaperChemistry>,
    /// The physical chemistry's parameters, where the model uses any; a scene never has both.
    pub physical: Option<PhysicalChemistry>,
    /// Flasks, in the order that indices refer to.
    pub flasks: Vec<Flask>,
    /// Liquids, lower ones first where they share a flask.
    pub liquids: Vec<Liquid>,
    /// Tools beside the flasks, one of a kind at most.
    pub tools: Vec<Tool>,
    /// The table, if there is one.
    pub table: Option<TableTop>,
    /// The floor.
    pub floor: Floor,
    /// How it is drawn.
    pub picture: PictureSettings,
    /// Changes of each preset.
    pub presets: BTreeMap<Preset, PresetOverrides>,
}

impl Scene {
    /// The names of the scenes that come with the program.
    pub fn builtin_names() -> Vec<&'static str> {
        builtin::BUILTIN.iter().map(|(name, _)| *name).collect()
    }

    /// Text of the built-in scene of that name.
    pub fn builtin_text(name: &str) -> Option<&'static str> {
        let found = builtin::BUILTIN.iter().find(|(known, _)| *known == name);
        found.map(|(_, text)| *text)
    }

    /// The built-in scene of that name. A user may also name a file, which `vitriol_run::scenes` resolves.
    ///
    /// # Errors
    /// [`SceneError`] as for [`Scene::parse`], or `NotFound`.
    pub fn builtin(name: &str) -> Result<Self, SceneError> {
        let Some(text) = Self::builtin_text(name) else {
            return Err(SceneError::NotFound {
                name: name.to_owned(),
                known: Self::builtin_names().join(", "),
            });
        };
        Self::parse(text, &format!("{name}.toml"))
    }

    /// A scene from its TOML `text`; `file` is its name in messages. What a scene leaves out it takes from the built-in one that its key
    /// `base` names: tables by key, lists as a whole.
    ///
    /// # Errors
    /// [`SceneError`] where the text is not TOML, a key is missing or
    /// unknown, a value is out of its range, a flask is narrower than a
    /// particle, flasks overlap or a liquid does not fit, under any of the
    /// scene's presets.
    pub fn parse(text: &str, file: &str) -> Result<Self, SceneError> {
        Self::build(base::read(text, file)?).map_err(|problem| problem.in_file(file))
    }

    /// The scene under a preset. Volumes stay, so the number of particles
    /// follows the preset's spacing.
    pub fn with_preset(&self, preset: Preset) -> Self {
        let mut scene = self.clone();
        if let Some(overrides) = self.presets.get(&preset) {
            let PresetOverrides {
                substeps,
                iterations,
                omega,
                carry_rate,
                spacing,
                sleep,
            } = *overrides;
            scene.solver.substeps = substeps.unwrap_or(scene.solver.substeps);
            scene.solver.iterations = iterations.unwrap_or(scene.solver.iterations);
            scene.solver.omega = omega.unwrap_or(scene.solver.omega);
            scene.solver.carry_rate = carry_rate.unwrap_or(scene.solver.carry_rate);
            scene.scale.spacing = spacing.unwrap_or(scene.scale.spacing);
            scene.solver.sleep = sleep.unwrap_or(scene.solver.sleep);
        }
        scene
    }

    /// Its tool of that kind.
    pub fn tool(&self, kind: ToolKind) -> Option<&Tool> {
        self.tools.iter().find(|tool| tool.kind == kind)
    }

    /// Whether `feature` is modelled.
    pub fn models(&self, feature: Feature) -> bool {
        self.model.contains(&feature)
    }

    /// Its surface tension and contact angles, where they are modelled.
    pub fn surface_tension(&self) -> Option<SurfaceTension> {
        let tension = self
            .solver
            .surface_tension
            .filter(|&tension| tension > 0.0)?;
        Some(SurfaceTension {
            glass: self
                .flasks
                .iter()
                .map(|flask| flask.contact_angle)
                .collect(),
            hysteresis: self.solver.hysteresis.map_or(HYSTERESIS, f64::to_radians),
            ..SurfaceTension::new(tension)
        })
    }

    /// The scene without `feature` and the features that depend on it, and the list of those.
    pub fn without(&self, feature: Feature) -> (Self, Vec<Feature>) {
        let gone = chemistry::built_upon(&self.model, feature, self.physical.is_some());
        let mut scene = self.clone();
        scene.model.retain(|feature| !gone.contains(feature));
        if gone.contains(&Feature::Vorticity) {
            scene.solver.vorticity = None;
        }
        if gone.contains(&Feature::Tension) {
            (scene.solver.surface_tension, scene.solver.hysteresis) = (None, None);
        }
        (scene, gone)
    }

    /// The scene in which no liquid sleeps.
    pub fn without_sleep(&self) -> Self {
        let mut scene = self.clone();
        scene.solver.sleep = false;
        scene
    }

    /// Fluid particles that represent `liquid`.
    pub fn particle_count(&self, liquid: &Liquid) -> usize {
        fill::count_for_volume(liquid.volume, self.scale.spacing)
    }

    /// This scene with the nuclei of bubbles that `seed` draws, where it has bubbles and does not say how many nuclei.
    pub fn with_nuclei(&self, seed: u64) -> Self {
        let mut scene = self.clone();
        if scene.models(Feature::Bubbles)
            && let Some(physical) = &mut scene.physical
        {
            let spacing = &mut physical.nuclei_spacing;
            *spacing = spacing.or_else(|| Some(drawn_nuclei(seed)));
        }
        scene
    }

    /// The fluid at the start; the seed is [`fill::fill`]'s.
    ///
    /// # Errors
    /// [`FillError`] where the spacing was changed since validation such that
    /// a liquid no longer fits.
    pub fn start(&self, seed: Option<u64>) -> Result<Vec<StartParticle>, FillError> {
        let mut particles = Vec::new();
        for (index, flask) in self.flasks.iter().enumerate() {
            let liquids = || self.liquids.iter().filter(|liquid| liquid.flask == index);
            let count = liquids().map(|liquid| self.particle_count(liquid)).sum();
            let d = self.scale.spacing;
            let positions = fill::fill(&flask.profile, flask.stage_from_flask, count, d, seed)?;
            let of = liquids()
                .flat_map(|liquid| std::iter::repeat_n(liquid, self.particle_count(liquid)));
            particles.extend(positions.into_iter().zip(of).map(|(position, liquid)| {
                StartParticle {
                    position,
                    flask: index,
                    temperature: liquid.temperature,
                    acid_fraction: liquid.acid_fraction,
                }
            }));
        }
        Ok(particles)
    }

    /// The paper's boundary particles of each flask, in its frame.
    pub fn boundary_particles(&self) -> Vec<Vec<BoundaryParticle>> {
        let (spacing, support) = (self.scale.boundary_spacing(), self.scale.support());
        self.flasks
            .iter()
            .map(|flask| particles::sample(&flask.profile, spacing, support))
            .collect()
    }

    fn build(raw: file::SceneFile) -> Result<Self, Problem> {
        raw.scale.check()?;
        raw.solver.check()?;
        if let Some(paper) = &raw.paper {
            fields::check_fields("paper", &paper.fields())?;
        }
        if let Some(physical) = &raw.physical {
            let bubbles = raw.model.contains(&Feature::Bubbles);
            fields::check_fields("physical", &physical.fields(bubbles))?;
        }
        chemistry::check_features(
            &raw.model,
            &raw.solver,
            raw.paper.as_ref(),
            raw.physical.as_ref(),
        )?;
        if let Some(table) = &raw.table {
            table.check()?;
        }
        let height = raw.floor.height;
        let must = "within 10 km of the origin (metres)";
        fields::require("floor.height", height, height.abs() <= tool::FARTHEST, must)?;
        for value in raw.origin {
            let must = "a finite number, up to 1000000000 either way (metres)";
            fields::require("origin", value, value.abs() <= MOST_ORIGIN, must)?;
        }
        for (field, count, most) in [
            ("flask", raw.flask.len(), MOST_FLASKS),
            ("liquid", raw.liquid.len(), MOST_LIQUIDS),
        ] {
            if count > most {
                return Err(Problem::new(
                    field,
                    format!("there are {count}; give {most} at most"),
                ));
            }
        }
        let origin = DVec3::from_array(raw.origin);
        let scale = raw.scale;
        let models_losses = raw.model.contains(&Feature::Losses);
        let flasks = (0..)
            .zip(raw.flask)
            .map(|(index, entry)| entry.build(index, &scale, models_losses))
            .collect::<Result<Vec<_>, _>>()?;
        check_flasks(&flasks)?;
        // The paper's liquids boil where the scene says. Without heat they are water and acid as well, though nothing shows it.
        let is_real = raw.physical.is_some() || raw.paper.is_none();
        let solutions = is_real.then(SolutionTable::new);
        let liquids = (0..)
            .zip(raw.liquid)
            .map(|(index, entry)| entry.build(index, &scale, &flasks, solutions.as_ref()))
            .collect::<Result<Vec<_>, _>>()?;
        let tools = (0..)
            .zip(raw.tool)
            .map(|(index, entry)| entry.build(index, &scale))
            .collect::<Result<Vec<_>, _>>()?;
        tool::check_tools(&tools, raw.table.as_ref(), &scale)?;
        let scene = Self {
            name: raw.name,
            description: raw.description,
            origin,
            scale,
            solver: raw.solver,
            model: raw.model,
            paper: raw.paper,
            physical: raw.physical,
            flasks,
            liquids,
            tools,
            table: raw.table,
            floor: raw.floor,
            picture: raw.picture,
            presets: raw.preset,
        };
        scene.check_fall()?;
        scene.check_fill("liquid")?;
        scene.check_reach()?;
        scene.check_carry()?;
        scene.check_suction()?;
        scene.check_substep()?;
        for (preset, overrides) in &scene.presets {
            let changed = scene.with_preset(*preset);
            let name = format!("{preset:?}").to_lowercase();
            let within = |problem: Problem| {
                Problem::new(format!("preset.{name}: {}", problem.field), problem.problem)
            };
            changed.scale.check().map_err(within)?;
            changed.solver.check().map_err(within)?;
            if let Some(spacing) = overrides.spacing {
                let field = format!("preset.{name}.spacing");
                for flask in &changed.flasks {
                    let narrow = flask.profile.check_particle(spacing);
                    narrow.map_err(|error| Problem::new(&field, error))?;
                }
                changed.check_fill(&field)?;
            }
            changed.check_carry().map_err(within)?;
            changed.check_substep().map_err(within)?;
        }
        Ok(scene)
    }

    /// Whether v_max is above what a fall to the floor reaches: slower, and
    /// liquid would float down.
    fn check_fall(&self) -> Result<(), Problem> {
        let tops = self.flasks.iter().map(|flask| {
            let height = f64::from(flask.stage_from_flask.position.y);
            height + flask.profile.rim_height()
        });
        let drop = tops.fold(0.0, f64::max) - self.floor.height;
        let speed = (2.0 * self.scale.gravity.abs() * drop.max(0.0)).sqrt();
        if self.solver.v_max < speed {
            let problem = format!(
                "{} m/s is below the {speed:.2} m/s of a fall from the highest flask's rim to the \
                 floor; take more",
                self.solver.v_max
            );
            return Err(Problem::new("solver.v_max", problem));
        }
        Ok(())
    }

    /// Whether each flask has room for its liquids.
    fn check_fill(&self, field: &str) -> Result<(), Problem> {
        Flask::check_sizes(&self.flasks, &self.scale)?;
        for (index, flask) in self.flasks.iter().enumerate() {
            let of = || self.liquids.iter().filter(|liquid| liquid.flask == index);
            let wanted: usize = of().map(|liquid| self.particle_count(liquid)).sum();
            let spacing = self.scale.spacing;
            let volume: f64 = of().map(|liquid| liquid.volume).sum();
            let capacity = flask.profile.capacity();
            // Before the lattice is walked: a volume that is absurd must not
            // cost memory.
            let sites = if volume > capacity {
                fill::count_for_volume(capacity, spacing)
            } else {
                fill::count_sites(&flask.profile, spacing)
            };
            if wanted > sites {
                // As drawn, as the file gives volumes, to 0.01 mL.
                let drawn = 1e6 * self.scale.length_scale.powi(3);
                let rounded = |volume: f64| (volume * drawn * 100.0).round() / 100.0;
                let fits = rounded(sites as f64 * spacing.powi(3));
                let problem = format!(
                    "in flask {:?}: {} mL are asked for, but only {fits} mL fit below the rim with particles of {spacing} m; use less \
                     liquid, a larger flask or a smaller spacing",
                    flask.name,
                    rounded(volume)
                );
                return Err(Problem::new(field, problem));
            }
        }
        Ok(())
    }
}

/// Farthest that a scene's origin may be off along an axis, m. Our choice: single precision, in which stages are drawn, holds its square by
/// far.
const MOST_ORIGIN: f64 = 1e9;

/// Flasks of a scene, as many as a pose track holds: each two are compared.
const MOST_FLASKS: usize = 64;

/// Liquids of a scene.
const MOST_LIQUIDS: usize = 256;

fn check_flasks(flasks: &[Flask]) -> Result<(), Problem> {
    for (j, b) in flasks.iter().enumerate() {
        for (i, a) in flasks[..j].iter().enumerate() {
            if a.name == b.name {
                let problem = format!("{:?} is flask[{i}]'s name already; give another", b.name);
                return Err(Problem::new(format!("flask[{j}].name"), problem));
            }
            if overlap::overlap(a, b) {
                let problem = format!("overlaps flask[{i}] ({:?}); move them apart", a.name);
                return Err(Problem::new(format!("flask[{j}].position"), problem));
            }
        }
    }
    Ok(())
}
