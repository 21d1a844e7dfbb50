//! Liquid that has left each flask, and liquid that flies above its rim.

use crate::bodies::is_nowhere;
use crate::pose::Pose;
use crate::scene::Flask;
use crate::solver::SolverState;
use glam::Vec3;

/// Follows the particles of a run from look to look.
///
/// A particle belongs to the flask whose member it last was. One that leaves and
/// comes back between two looks is not counted.
#[derive(Clone, Debug, Default)]
pub struct Departures {
    /// By identity: the flask whose member it was last.
    last: Vec<Option<usize>>,
    /// By flask: whether each identity has left it.
    left: Vec<Vec<bool>>,
    /// By flask: mass of those, over that of a particle at rest density.
    masses: Vec<f64>,
}

/// Mass that is not in its flask, by flask, kg of the scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Departed {
    /// Has left at any time so far, each particle once: poured, thrown or
    /// splashed, whether it came back or not; and drops of bubbles that came to rest elsewhere.
    pub left: Vec<f64>,
    /// Is above the rim's plane now and in no flask, having left this one last.
    pub above_rim: Vec<f64>,
}

impl Departures {
    /// Takes a state into account, in which flasks are at `poses`; a particle at
    /// rest density has `particle_mass` kg.
    pub fn observe(
        &mut self,
        state: &SolverState,
        flasks: &[Flask],
        poses: &[Pose],
        particle_mass: f64,
    ) -> Departed {
        let count = state.tags.len();
        self.last.resize(count, None);
        self.left.resize(flasks.len(), vec![false; count]);
        self.masses.resize(flasks.len(), 0.0);
        let mut above_rim = vec![0.0; flasks.len()];
        let flask_from_stage: Vec<Pose> = poses.iter().map(|pose| pose.inverse()).collect();
        for slot in (0..count).filter(|&slot| state.is_present(slot)) {
            let identity = state.tags[slot][1] as usize;
            let now = state.flask_of(slot);
            if let Some(flask) = self.last[identity]
                && now != Some(flask)
            {
                if !self.left[flask][identity] {
                    self.left[flask][identity] = true;
                    self.masses[flask] += state.mass_of(slot);
                }
                let [x, y, z, _] = state.positions[slot];
                let local = flask_from_stage[flask].transform_point(Vec3::new(x, y, z));
                let is_over = f64::from(local.y) > flasks[flask].profile.rim_height();
                // A broken flask has no rim any more.
                if now.is_none() && is_over && !is_nowhere(&poses[flask]) {
                    above_rim[flask] += particle_mass * state.mass_of(slot);
                }
            }
            self.last[identity] = now.or(self.last[identity]);
        }
        Departed {
            left: self
                .masses
                .iter()
                .enumerate()
                .map(|(flask, mass)| particle_mass * (mass + state.spray_left(flask)))
                .collect(),
            above_rim,
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::flask::Profile;
    use crate::surface_tension::GLASS;

    /// Particles 0 and 1 as (height in metres, membership); by slot, in the order of `slots`.
    fn state(particles: [(f32, u32); 2], slots: [usize; 2]) -> SolverState {
        // Arrays that are not read are empty.
        let mut state = SolverState::default();
        state.positions = slots.map(|i| [0.0, particles[i].0, 0.0, 1.0]).to_vec();
        state.tags = slots.map(|i| [particles[i].1, i as u32]).to_vec();
        state
    }

    #[test]
    fn what_leaves_counts_once_and_what_flies_while_it_does() {
        let flask = Flask {
            name: "glass".into(),
            profile: Profile::new(&[[0.0, 0.03], [0.1, 0.03]], 0.002).unwrap(),
            mass: 0.1,
            stage_from_flask: Pose::IDENTITY,
            fixed: true,
            contact_angle: GLASS,
            heater: 0.0,
        };
        let poses = [flask.stage_from_flask];
        let mut departures = Departures::default();
        let mut look = |particles, slots| {
            let seen = departures.observe(
                &state(particles, slots),
                std::slice::from_ref(&flask),
                &poses,
                0.5,
            );
            (seen.left[0], seen.above_rim[0])
        };
        assert_eq!(look([(0.05, 1), (0.05, 1)], [0, 1]), (0.0, 0.0));
        // One flies; slots change, identities do not.
        assert_eq!(look([(0.2, 0), (0.05, 1)], [1, 0]), (0.5, 0.5));
        // It falls beside, then the other flies while the first is back in.
        assert_eq!(look([(0.01, 0), (0.05, 1)], [0, 1]), (0.5, 0.0));
        assert_eq!(look([(0.05, 1), (0.2, 0)], [1, 0]), (1.0, 0.5));
        // It leaves again: not counted twice.
        assert_eq!(look([(0.2, 0), (0.2, 0)], [0, 1]), (1.0, 1.0));
    }
}
