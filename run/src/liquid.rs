//! A liquid's particles on the host, for what makes a surface of them.

use glam::DVec3;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::SolverState;

/// The particles that are there, in the scene's frame and unit.
#[derive(Debug, Clone, Default)]
pub struct Liquid {
    /// Where each is.
    pub positions: Vec<DVec3>,
    /// Its volume.
    pub volumes: Vec<f64>,
    /// The flask that it is in.
    pub members: Vec<Option<usize>>,
}

impl Liquid {
    /// The particles of a state of that scene.
    pub fn of(scene: &Scene, state: &SolverState) -> Self {
        let present: Vec<usize> = (0..state.positions.len())
            .filter(|&slot| state.is_present(slot))
            .collect();
        let volume = scene.scale.spacing.powi(3);
        let all = || present.iter().copied();
        let position = |slot: usize| {
            let [x, y, z, _] = state.positions[slot];
            DVec3::new(x.into(), y.into(), z.into())
        };
        Self {
            positions: all().map(position).collect(),
            volumes: all().map(|slot| volume * state.volume_of(slot)).collect(),
            members: all().map(|slot| state.flask_of(slot)).collect(),
        }
    }
}
