//! Puts liquid into a flask before the first step.

use crate::flask::Profile;
use crate::pose::Pose;
use glam::DVec3;
use thiserror::Error;

/// The liquid does not fit.
#[derive(Clone, Debug, Error, PartialEq)]
#[error(
    "{wanted} particles are asked for, but only {sites} fit below the rim at spacing {spacing} m; \
     use less liquid, a larger flask or a smaller spacing"
)]
pub struct FillError {
    /// Particles asked for.
    pub wanted: usize,
    /// Lattice sites in the flask.
    pub sites: usize,
    /// Particle spacing d, metres.
    pub spacing: f64,
}

/// Number of particles that represent `volume` (m³) at spacing `d` (metres):
/// volume/d³, rounded.
pub fn count_for_volume(volume: f64, d: f64) -> usize {
    (volume / d.powi(3)).round() as usize
}

/// All sites of the cubic lattice of spacing `d` in the liquid space, in the
/// flask's frame and from the bottom up: d/2 from floor and wall at least,
/// where half a lattice step away from a full boundary the density is that
/// of the lattice.
pub fn sites(profile: &Profile, d: f64) -> Vec<Vec<DVec3>> {
    let mut layers = Vec::new();
    visit(profile, d, |layer, site| {
        layers.resize(layers.len().max(layer + 1), Vec::new());
        layers[layer].push(site);
    });
    layers
}

/// How many [`sites`] there are, without the memory for them.
pub fn count_sites(profile: &Profile, d: f64) -> usize {
    let mut count = 0;
    visit(profile, d, |_, _| count += 1);
    count
}

/// Calls `found` with each site and the number of its layer.
fn visit(profile: &Profile, d: f64, mut found: impl FnMut(usize, DVec3)) {
    let gap = 0.5 * d * (1.0 - 1e-9);
    let lowest = profile.floor_height() + 0.5 * d;
    let layers = ((profile.rim_height() - lowest - gap) / d).floor();
    for layer in 0..=layers.max(-1.0) as i64 {
        let y = lowest + layer as f64 * d;
        // No wall within the gap is nearer to the axis: what is clear of this needs no
        // distance to be found, which is most sites of a wide vessel.
        let narrowest = profile.narrowest(y - gap, y + gap);
        let reach = (profile.inner_radius(y) / d).ceil() as i64;
        for i in -reach..=reach {
            let x = i as f64 * d;
            for k in -reach..=reach {
                let z = k as f64 * d;
                let r = x.hypot(z);
                let clear = r + gap < narrowest
                    || (profile.is_inside(r, y) && profile.signed_distance_inner(r, y) >= gap);
                if clear {
                    found(layer as usize, DVec3::new(x, y, z));
                }
            }
        }
    }
}

/// Places `count` particles of spacing `d` (metres) in the flask and returns
/// their positions in the stage. They fill [`sites`] from the bottom up; the
/// sites of the last layer that are used are spread over all of it. Because a
/// wall cuts the lattice, the level is up to d/2 of wall higher than the
/// volume alone would have it, and sinks when the liquid settles.
///
/// With a `seed`, each position is moved by up to 10⁻³ d per axis, hashed
/// from the seed and its index, which breaks the lattice's symmetry without
/// changing its density. Without, the lattice is exact.
///
/// # Errors
/// [`FillError`] if the flask has fewer sites.
pub fn fill(
    profile: &Profile,
    stage_from_flask: Pose,
    count: usize,
    d: f64,
    seed: Option<u64>,
) -> Result<Vec<DVec3>, FillError> {
    let layers = sites(profile, d);
    let available: usize = layers.iter().map(Vec::len).sum();
    if count > available {
        return Err(FillError {
            wanted: count,
            sites: available,
            spacing: d,
        });
    }
    let rotation = stage_from_flask.orientation.as_dquat().normalize();
    let origin = stage_from_flask.position.as_dvec3();
    let mut positions = Vec::with_capacity(count);
    for layer in layers {
        let taken = layer.len().min(count - positions.len());
        for i in 0..taken {
            let site = layer[i * layer.len() / taken];
            let offset = seed.map_or(DVec3::ZERO, |seed| jitter(seed, positions.len() as u64));
            positions.push(rotation * (site + offset * 1e-3 * d) + origin);
        }
    }
    Ok(positions)
}

/// Vector with components in [−1, 1), hashed from seed and index.
fn jitter(seed: u64, index: u64) -> DVec3 {
    let component = |axis: u64| {
        let bits = split_mix(split_mix(seed) ^ (3 * index + axis));
        (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    DVec3::new(component(0), component(1), component(2))
}

/// SplitMix64's output function (Steele, Lea, Flood 2014): a number that looks random, from any.
pub fn split_mix(state: u64) -> u64 {
    let mut z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::flask::glassware;
    use glam::{Quat, Vec3};

    const D: f64 = 0.0025;

    #[test]
    fn beaker_holds_the_papers_13894() {
        let profile = glassware::find("beaker-250").unwrap().profile(1.0).unwrap();
        assert_eq!(count_for_volume(217.1e-6, D), 13894);
        let positions = fill(&profile, Pose::IDENTITY, 13894, D, None).unwrap();
        assert_eq!(positions.len(), 13894);
        let mut nearest_wall = f64::INFINITY;
        for p in &positions {
            nearest_wall = nearest_wall.min(profile.signed_distance_inner(p.x.hypot(p.z), p.y));
        }
        assert!(nearest_wall > 0.499 * D);
        let top = positions.iter().map(|p| p.y).fold(0.0, f64::max);
        let level = profile.level_for_volume(217.1e-6).unwrap();
        // The ring of half a spacing that the wall cuts off: 8 % of the area.
        assert!(top > level - D && top < 1.12 * level, "{top} {level}");
    }

    #[test]
    fn no_two_particles_are_closer_than_the_lattice() {
        let profile = glassware::find("round-bottom-250")
            .unwrap()
            .profile(1.0)
            .unwrap();
        let positions = fill(&profile, Pose::IDENTITY, 700, D, Some(3)).unwrap();
        for (i, a) in positions.iter().enumerate() {
            for b in &positions[..i] {
                assert!(a.distance(*b) > 0.996 * D);
            }
        }
    }

    #[test]
    fn pose_moves_it_rigidly_and_seed_repeats() {
        let profile = glassware::find("beaker-250").unwrap().profile(1.0).unwrap();
        let pose = Pose::new(Vec3::new(0.3, 0.75, -0.4), Quat::from_rotation_z(0.8));
        let local = fill(&profile, Pose::IDENTITY, 500, D, Some(9)).unwrap();
        let placed = fill(&profile, pose, 500, D, Some(9)).unwrap();
        for (a, b) in local.iter().zip(&placed) {
            let expected = pose.transform_point(a.as_vec3());
            // f32 rounding of coordinates below one.
            assert!((expected.as_dvec3() - *b).length() < 3e-7);
        }
        assert_ne!(
            local,
            fill(&profile, Pose::IDENTITY, 500, D, Some(10)).unwrap()
        );
        assert_ne!(local, fill(&profile, Pose::IDENTITY, 500, D, None).unwrap());
    }

    #[test]
    fn refuses_what_does_not_fit() {
        let profile = glassware::find("beaker-250").unwrap().profile(1.0).unwrap();
        let error = fill(&profile, Pose::IDENTITY, 25_000, D, None).unwrap_err();
        assert!(error.sites > 17_000 && error.sites < 21_000, "{error}");
        assert_eq!(fill(&profile, Pose::IDENTITY, 0, D, None), Ok(vec![]));
    }
}
