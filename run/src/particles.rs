//! The particles as other programs want them: in the stage's real metres, each with its numbers.

use glam::DVec3;
use vitriol_sim::solver::SolverState;
use vitriol_sim::world::World;

use crate::stage::stage_from_scene;

/// The particles that are there at one moment, a row each, in the order of their identities.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Particles {
    /// Identity: the particle's number at the start.
    pub id: Vec<u32>,
    /// Position in the stage, m.
    pub position: Vec<DVec3>,
    /// Velocity, m/s.
    pub velocity: Vec<DVec3>,
    /// Volume, m³.
    pub volume: Vec<f64>,
    /// Mass of the real one, kg: in a scene drawn smaller than it is simulated, less than in its report.
    pub mass: Vec<f64>,
    /// Number of the flask that it is in; −1 for none.
    pub flask: Vec<i32>,
    /// Temperature, °C; empty where no heat is modelled.
    pub temperature: Vec<f32>,
    /// Acid mass fraction; likewise.
    pub acid: Vec<f32>,
}

impl Particles {
    /// The particles of a state of that world.
    pub fn of(world: &World, state: &SolverState) -> Self {
        let scene = world.scene();
        let scale = scene.scale.length_scale;
        let (d3, cubed) = (scene.scale.spacing.powi(3), scale.powi(3));
        let rest_mass = world.solver().parameters().particle_mass();
        let mut order: Vec<usize> = (0..state.positions.len())
            .filter(|&slot| state.is_present(slot))
            .collect();
        order.sort_by_key(|&slot| state.tags[slot][1]);
        let vector = |[x, y, z, _]: [f32; 4]| DVec3::new(x.into(), y.into(), z.into());
        let all = || order.iter().copied();
        let heat = |index: usize| {
            let of = move |slot| state.heat.get(slot).map(|heat: &[f32; 4]| heat[index]);
            all().filter_map(of).collect()
        };
        Self {
            id: all().map(|slot| state.tags[slot][1]).collect(),
            position: all()
                .map(|slot| stage_from_scene(scene, vector(state.positions[slot])))
                .collect(),
            velocity: all()
                .map(|slot| vector(state.velocities[slot]) * scale)
                .collect(),
            volume: all()
                .map(|slot| d3 * state.volume_of(slot) * cubed)
                .collect(),
            mass: all()
                .map(|slot| rest_mass * state.mass_of(slot) * cubed)
                .collect(),
            flask: all()
                .map(|slot| state.flask_of(slot).map_or(-1, |flask| flask as i32))
                .collect(),
            temperature: heat(0),
            acid: heat(1),
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }
}
