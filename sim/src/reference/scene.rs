//! The reference solver of a scene.

use super::Reference;
use super::surroundings::{Surroundings, Table, Vessel};
use crate::fill::FillError;
use crate::parameters::Parameters;
use crate::scene::{Boundary, Scene, TableTop};

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
