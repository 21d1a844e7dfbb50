//! Liquid that has left each flask, and liquid that flies above its rim.

use crate::bodies::is_nowhere;
use crate::pose::Pose;
use crate::scene::Flask;
use crate::solver::SolverState;
use glam::Vec3;
use vitriol_shaders::layout::Drops;

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
    /// Height of the highest particle or drop of a bubble that is in no flask, over the middle of the rim of the flask that it left
    /// last, m of the scene. Heights are over that rim and not over the bench: a stream is never high over the flask that it is
    /// poured from, however high that is held. `None` where nothing is above its rim.
    pub highest: Option<f64>,
}

/// Height of the middle of each flask's rim in the stage, m; `None` of a broken one.
struct Rims(Vec<Option<f64>>);

impl Rims {
    fn of(flasks: &[Flask], poses: &[Pose]) -> Self {
        let rim = |(flask, pose): (&Flask, &Pose)| {
            let middle = Vec3::Y * flask.profile.rim_height() as f32;
            (!is_nowhere(pose)).then(|| f64::from(pose.transform_point(middle).y))
        };
        Self(flasks.iter().zip(poses).map(rim).collect())
    }

    /// How far `height` in the stage is above the rim of that flask, m; `None` where it is not.
    fn above(&self, flask: usize, height: f32) -> Option<f64> {
        let rim = self.0.get(flask).copied().flatten()?;
        Some(f64::from(height) - rim).filter(|above| *above > 0.0)
    }

    /// That of the highest of these drops that are in no flask.
    fn highest(&self, drops: &[Drops]) -> Option<f64> {
        let fly = drops
            .iter()
            .filter(|drops| drops.mass > 0.0 && drops.memberships >> 16 == 0);
        let above = fly.filter_map(|drops| {
            let source = (drops.memberships & 0xffff) as usize;
            self.above(source.checked_sub(1)?, drops.position[1])
        });
        above.reduce(f64::max)
    }
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
        let rims = Rims::of(flasks, poses);
        let mut highest = rims.highest(state.drops());
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
                if now.is_none() {
                    let above = rims.above(flask, y);
                    highest = highest.into_iter().chain(above).reduce(f64::max);
                }
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
            highest,
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::flask::Profile;
    use crate::flask::glassware::Vessel;
    use crate::surface_tension::GLASS;

    /// Particles 0 and 1 as (height in metres, membership); by slot, in the order of `slots`.
    fn state(particles: [(f32, u32); 2], slots: [usize; 2]) -> SolverState {
        // Arrays that are not read are empty.
        let mut state = SolverState::default();
        state.positions = slots.map(|i| [0.0, particles[i].0, 0.0, 1.0]).to_vec();
        state.tags = slots.map(|i| [particles[i].1, i as u32]).to_vec();
        state
    }

    /// Its rim is 0.102 m high.
    fn glass() -> Flask {
        Flask {
            name: "glass".into(),
            vessel: Vessel::default(),
            profile: Profile::new(&[[0.0, 0.03], [0.1, 0.03]], 0.002).unwrap(),
            mass: 0.1,
            stage_from_flask: Pose::IDENTITY,
            fixed: true,
            contact_angle: GLASS,
            heater: 0.0,
            plate: false,
        }
    }

    #[test]
    fn what_leaves_counts_once_and_what_flies_while_it_does() {
        let flask = glass();
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

    /// Of particles the one that left the flask counts, and none that is in it or below its rim.
    #[test]
    fn the_highest_is_outside_and_above_the_rim() {
        let flask = glass();
        let mut departures = Departures::default();
        let mut look = |heights: [(f32, u32); 2], raised: f32| {
            let poses = [Pose::from_position(Vec3::Y * raised)];
            let state = state(heights, [0, 1]);
            let seen = departures.observe(&state, std::slice::from_ref(&flask), &poses, 0.5);
            seen.highest
        };
        assert_eq!(look([(0.3, 1), (0.4, 0)], 0.0), None);
        let highest = look([(0.3, 0), (0.4, 0)], 0.0).unwrap();
        assert!((highest - 0.198).abs() < 1e-6, "{highest}");
        let raised = look([(0.3, 0), (0.4, 0)], 0.1).unwrap();
        assert!((raised - 0.098).abs() < 1e-6, "{raised}");
        assert_eq!(look([(0.1, 0), (0.4, 0)], 0.0), None);
    }

    #[test]
    fn drops_count_over_the_rim_of_their_flask() {
        let drops = |height: f32, mass: f32, memberships: u32| Drops {
            position: [0.0, height, 0.0],
            mass,
            memberships,
            ..Drops::default()
        };
        let rims = Rims(vec![Some(0.1), None]);
        let within = 1 << 16;
        let all = [
            drops(0.25, 0.5, 1),
            drops(0.2, 0.5, 1),
            // None is there, in a flask, of a broken flask, of none.
            drops(0.9, 0.0, 1),
            drops(0.9, 0.5, 1 | within),
            drops(0.9, 0.5, 2),
            drops(0.9, 0.5, 0),
        ];
        let highest = rims.highest(&all).unwrap();
        assert!((highest - 0.15).abs() < 1e-6, "{highest}");
        assert_eq!(rims.highest(&all[2..]), None);
    }
}
