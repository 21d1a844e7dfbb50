//! The reference solver of a scene.

use super::algorithm::Reference;
use super::chemistry::{DilutionLaw, Paper};
use super::surroundings::{Surroundings, Table, Vessel};
use crate::chemistry::OutOfRange;
use crate::chemistry::paper::{AntiViscosity, Boiling, Diffusion, Dilution};
use crate::fill::FillError;
use crate::parameters::Parameters;
use crate::scene::{Boundary, Scene, TableTop};
use thiserror::Error;

impl Surroundings {
    /// What is solid in `scene`.
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
        let table = scene.table.map(|table| Table {
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
    /// Its liquids or its boiling point are none.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
}

impl Paper {
    /// What `scene` models of the paper's chemistry, by the `scheme` of Eq. 5
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
        let Some(table) = &scene.paper else {
            return Ok(None);
        };
        let Some(ambient) = table.T_a else {
            return Ok(None);
        };
        let particles: Vec<_> = scene
            .start(seed)?
            .iter()
            .map(|start| (start.temperature, start.acid_fraction))
            .collect();
        let dilution = match (table.k_d, table.D_T, table.D_c) {
            (Some(k_d), Some(temperature_diffusivity), Some(acid_diffusivity)) => {
                Some(DilutionLaw {
                    heat: Dilution::new(k_d, scene.scale.particle_mass()),
                    temperature_diffusivity,
                    acid_diffusivity,
                    ambient,
                    scheme,
                })
            }
            _ => None,
        };
        let anti_viscosity = match (table.T_B, table.k_v) {
            (Some(boiling_point), Some(intensity)) => {
                Some((AntiViscosity::new(boiling_point, intensity)?, boiling))
            }
            _ => None,
        };
        Ok(Some(Self::new(dilution, anti_viscosity, &particles)?))
    }
}
