//! Bubbles in the liquid, and the drops that they threw up, as clouds of points: finer than particles, and not in the surfaces.

use std::f64::consts::PI;

use glam::DVec3;
use vitriol_run::stage;
use vitriol_sim::measure::AIR_OVER_STEAM;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::SolverState;

/// Points with numbers, all in SI units as drawn, like the particles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cloud {
    /// Places in the stage, m.
    pub positions: Vec<DVec3>,
    /// The names of a point's numbers, and each point's number.
    pub columns: Vec<(&'static str, Vec<f64>)>,
}

impl Cloud {
    /// The bubbles of a state, with radius (m), steam and air (kg); `None` where a scene's vapour has no volume.
    pub fn of_bubbles(scene: &Scene, parameters: &Parameters, state: &SolverState) -> Option<Self> {
        parameters.bubbles()?;
        let scale = scene.scale.length_scale;
        let unit = parameters.particle_mass() * scale.powi(3);
        let all = || {
            let records = state.bubbles().iter();
            records.filter(|bubble| bubble.mass > 0.0 || bubble.air > 0.0)
        };
        let air = |moles: f32| unit * AIR_OVER_STEAM * f64::from(moles);
        Some(Self {
            positions: all().map(|b| place(scene, b.position)).collect(),
            columns: vec![
                (
                    "radius",
                    all().map(|b| scale * f64::from(b.radius)).collect(),
                ),
                ("steam", all().map(|b| unit * f64::from(b.mass)).collect()),
                ("air", all().map(|b| air(b.air)).collect()),
            ],
        })
    }

    /// The flights of drops of a state, with a drop's radius (m), the number of drops, how far about their place they lie (m; 0 of those
    /// behind one another) and velocity (m/s); `None` where a scene's bubbles throw up none.
    pub fn of_spray(scene: &Scene, parameters: &Parameters, state: &SolverState) -> Option<Self> {
        if parameters.bubbles()?.places_of_drops() == 0 {
            return None;
        }
        let scale = scene.scale.length_scale;
        let all = || {
            let flies = |mass: f32, radius: f32, density: f32| mass.min(radius).min(density) > 0.0;
            let records = state.drops().iter();
            records.filter(move |drops| flies(drops.mass, drops.radius, drops.density))
        };
        let mass = parameters.particle_mass();
        let number = |held: f32, radius: f32, density: f32| {
            let volume = 4.0 / 3.0 * PI * f64::from(radius).powi(3);
            mass * f64::from(held) / (f64::from(density) * volume)
        };
        let along = |axis: usize| all().map(move |d| scale * f64::from(d.velocity[axis]));
        Some(Self {
            positions: all().map(|d| place(scene, d.position)).collect(),
            columns: vec![
                (
                    "radius",
                    all().map(|d| scale * f64::from(d.radius)).collect(),
                ),
                (
                    "drops",
                    all().map(|d| number(d.mass, d.radius, d.density)).collect(),
                ),
                ("about", all().map(|d| scale * f64::from(d.about)).collect()),
                ("vx", along(0).collect()),
                ("vy", along(1).collect()),
                ("vz", along(2).collect()),
            ],
        })
    }
}

/// A place in the scene's unit as drawn.
fn place(scene: &Scene, [x, y, z]: [f32; 3]) -> DVec3 {
    stage::stage_from_scene(scene, DVec3::new(x.into(), y.into(), z.into()))
}

#[cfg(test)]
#[path = "tests/cloud.rs"]
mod tests;
