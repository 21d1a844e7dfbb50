//! The reference solver of a scene.

use super::chemistry::{DilutionLaw, ReferencePaper};
use super::state::Reference;
use super::surroundings::{Slab, Surroundings, Vessel};
use crate::chemistry::paper::{AntiViscosity, Boiling, Diffusion, Dilution};
use crate::chemistry::{Chemistry, OutOfRange};
use crate::fill::FillError;
use crate::parameters::Parameters;
use crate::scene::{Boundary, Scene, TableTop};
use thiserror::Error;

impl Surroundings {
    /// Flasks, table and floor of `scene`.
    pub fn of_scene(scene: &Scene) -> Self {
        let support = scene.scale.support();
        let profiles = scene.flasks.iter().map(|flask| flask.profile.clone());
        let vessels = match scene.solver.boundary {
            Boundary::Map => profiles
                .map(|profile| Vessel::with_maps(profile, support))
                .collect(),
            Boundary::Particles => profiles
                .zip(scene.boundary_particles())
                .map(|(profile, solids)| Vessel::with_particles(profile, solids, support))
                .collect(),
        };
        let thickness = TableTop::THICKNESS / scene.scale.length_scale;
        let table = scene.table.map(|table| Slab {
            top: table.top,
            under: table.top - thickness,
            centre: table.centre.into(),
            size: table.size.into(),
        });
        Self::new(vessels, table, Some(scene.floor.height), support)
    }
}

impl Reference {
    /// The start of `scene`; the seed is [`crate::fill::fill`]'s.
    ///
    /// # Errors
    /// [`FillError`] as for [`Scene::start`].
    pub fn of_scene(
        scene: &Scene,
        parameters: Parameters,
        seed: Option<u64>,
    ) -> Result<Self, FillError> {
        let positions = scene
            .start(seed)?
            .iter()
            .map(|start| start.position)
            .collect();
        let poses: Vec<_> = scene
            .flasks
            .iter()
            .map(|flask| flask.stage_from_flask)
            .collect();
        Ok(Self::new(
            parameters,
            Surroundings::of_scene(scene),
            positions,
            &poses,
        ))
    }
}

/// Why a scene's chemistry cannot start.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ChemistryError {
    /// Its liquids do not fit.
    #[error(transparent)]
    Fill(#[from] FillError),
    /// Its liquids or its boiling point are out of range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
}

impl ReferencePaper {
    /// The paper's chemistry as `scene` models it, by the `scheme` of Eq. 5
    /// and the kind of `boiling`; `None` without the feature `heat`. The
    /// particles are those of [`Reference::of_scene`] with the same seed.
    ///
    /// # Errors
    /// [`ChemistryError`] as for [`Scene::start`], or T_B ≤ 0 °C.
    pub fn of_scene(
        scene: &Scene,
        seed: Option<u64>,
        scheme: Diffusion,
        boiling: Boiling,
    ) -> Result<Option<Self>, ChemistryError> {
        let Some(Chemistry::Paper(paper)) = Chemistry::from_scene(scene) else {
            return Ok(None);
        };
        let particles: Vec<_> = scene
            .start(seed)?
            .iter()
            .map(|start| (start.temperature, start.acid_fraction))
            .collect();
        let dilution = paper.dilution.map(|table| DilutionLaw {
            heat: Dilution::new(table.heat_generation, scene.scale.particle_mass()),
            temperature_diffusivity: table.heat_diffusivity,
            acid_diffusivity: table.acid_diffusivity,
            ambient: table.ambient,
            scheme,
        });
        let anti_viscosity = match paper.boiling {
            Some(table) => {
                let law = AntiViscosity::new(table.boiling_point, table.intensity)?;
                Some((law, boiling))
            }
            None => None,
        };
        Ok(Some(Self::new(dilution, anti_viscosity, &particles)?))
    }
}
