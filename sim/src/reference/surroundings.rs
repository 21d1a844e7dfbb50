//! Solids: flasks, table and floor, as terms of the density sum.

use super::neighbours::Cells;
use super::placement::{Motion, Placement};
use crate::flask::particles::BoundaryParticle;
use crate::flask::{PlaneMap, Profile, Side, VolumeMap};
use crate::kernel::Kernel;
use crate::scene::{Boundary, Scene, TableTop};
use glam::{DVec2, DVec3, Vec3Swizzles};

/// Representation of the glass in the density sum.
#[derive(Clone, Debug)]
enum Glass {
    Maps {
        inside: VolumeMap,
        outside: VolumeMap,
    },
    Particles {
        solids: Vec<BoundaryParticle>,
        cells: Cells,
    },
}

/// A flask as the solver represents it: its shape, and its glass as terms of the density sum.
#[derive(Clone, Debug)]
pub struct Vessel {
    /// Its shape.
    pub profile: Profile,
    glass: Glass,
}

impl Vessel {
    /// Vessel whose glass is a pair of volume maps for support radius
    /// `support` (metres).
    pub fn with_maps(profile: Profile, support: f64) -> Self {
        Self::with_refined_maps(profile, support, 1)
    }

    /// Vessel like that of [`Vessel::with_maps`], whose maps have nodes `refinement` times as close.
    pub(super) fn with_refined_maps(profile: Profile, support: f64, refinement: u32) -> Self {
        let map = |side| VolumeMap::refined(&profile, side, support, refinement);
        let glass = Glass::Maps {
            inside: map(Side::Inside),
            outside: map(Side::Outside),
        };
        Self { profile, glass }
    }

    /// Vessel whose glass is made of the paper's boundary particles.
    pub fn with_particles(profile: Profile, solids: Vec<BoundaryParticle>, support: f64) -> Self {
        let points: Vec<_> = solids.iter().map(|solid| solid.position).collect();
        let cells = Cells::new(&points, support);
        let glass = Glass::Particles { solids, cells };
        Self { profile, glass }
    }
}

/// The table top, a level slab.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// Height of its upper surface, metres.
    pub top: f64,
    /// Height of its lower surface, metres.
    pub under: f64,
    /// Centre (x, z), metres.
    pub centre: DVec2,
    /// Extent along x and z, metres.
    pub size: DVec2,
}

impl Slab {
    /// Whether `point` (stage, metres) is above, in or below it, and not
    /// beside it.
    pub fn covers(&self, point: DVec3) -> bool {
        let offset = (point.xz() - self.centre).abs();
        offset.cmple(0.5 * self.size).all()
    }
}

/// All that is solid.
#[derive(Clone, Debug)]
pub struct Surroundings {
    /// Flasks; membership counts them.
    pub vessels: Vec<Vessel>,
    /// The table, if there is one.
    pub table: Option<Slab>,
    /// Height of the floor, metres, if there is one.
    pub floor: Option<f64>,
    kernel: Kernel,
    plane: PlaneMap,
}

/// Contribution of one solid, or one solid particle, to a fluid particle's density sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// V_b: its part of a full density (ψ_b W/ρ₀ for a solid particle).
    pub volume: f64,
    /// ∇V_b by the fluid particle's position, 1/m.
    pub gradient: DVec3,
    /// Velocity of the solid at the fluid particle's place, m/s.
    pub velocity: DVec3,
    /// The flask that it belongs to; `None` for table and floor.
    pub flask: Option<usize>,
}

/// Sum over the [`Contact`]s of a particle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WallSum {
    /// V_b.
    pub volume: f64,
    /// ∇V_b, 1/m.
    pub gradient: DVec3,
}

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

    /// Surroundings for support radius `support`; metres.
    pub fn new(
        vessels: Vec<Vessel>,
        table: Option<Slab>,
        floor: Option<f64>,
        support: f64,
    ) -> Self {
        Self {
            vessels,
            table,
            floor,
            kernel: Kernel::new(support),
            plane: PlaneMap::new(support),
        }
    }

    /// Whether some vessel's glass is made of boundary particles.
    pub(super) fn has_boundary_particles(&self) -> bool {
        let of_particles = |vessel: &Vessel| matches!(vessel.glass, Glass::Particles { .. });
        self.vessels.iter().any(of_particles)
    }

    /// Calls `visit` for every solid in reach of a particle at `position`
    /// (stage, metres).
    ///
    /// Nothing acts through a wall: on a particle in a flask that flask alone
    /// acts, with everything that is not liquid space as solid, since
    /// the glass is thinner than the support radius; on one that is in none
    /// the glass of all flasks, table and floor act.
    pub fn contacts(
        &self,
        position: DVec3,
        member_of: Option<usize>,
        motion: &[Motion],
        mut visit: impl FnMut(Contact),
    ) {
        if let Some(flask) = member_of {
            self.touch(flask, &motion[flask], Side::Inside, position, &mut visit);
            return;
        }
        for (flask, motion) in motion.iter().enumerate().take(self.vessels.len()) {
            self.touch(flask, motion, Side::Outside, position, &mut visit);
        }
        if let Some(floor) = self.floor {
            self.touch_plane(position.y - floor, &mut visit);
        }
        if let Some(table) = &self.table {
            // A half space up to its edge: the error at the edge is below a
            // particle's resolution.
            if table.covers(position) && position.y > table.under {
                self.touch_plane(position.y - table.top, &mut visit);
            }
        }
    }

    /// V_b and ∇V_b of every particle.
    pub fn sums(
        &self,
        positions: &[DVec3],
        membership: &[Option<usize>],
        motion: &[Motion],
    ) -> Vec<WallSum> {
        let sum = |(&position, &member_of)| {
            let mut sum = WallSum::default();
            self.contacts(position, member_of, motion, |contact| {
                sum.volume += contact.volume;
                sum.gradient += contact.gradient;
            });
            sum
        };
        positions.iter().zip(membership).map(sum).collect()
    }

    fn touch_plane(&self, distance: f64, visit: &mut impl FnMut(Contact)) {
        if distance < self.kernel.support() {
            visit(Contact {
                volume: self.plane.volume(distance),
                gradient: DVec3::Y * self.plane.slope(distance),
                velocity: DVec3::ZERO,
                flask: None,
            });
        }
    }

    fn touch(
        &self,
        flask: usize,
        motion: &Motion,
        side: Side,
        position: DVec3,
        visit: &mut impl FnMut(Contact),
    ) {
        let local = motion.after.to_flask(position);
        let velocity = motion.velocity_at(position);
        match (&self.vessels[flask].glass, side) {
            (Glass::Maps { inside: map, .. }, Side::Inside)
            | (Glass::Maps { outside: map, .. }, Side::Outside) => {
                self.touch_map((flask, map), &motion.after, local, velocity, visit);
            }
            // One sheet of particles stands for the glass on either side.
            (Glass::Particles { solids, cells }, _) => cells.near(local, |index| {
                let solid = &solids[index as usize];
                let apart = local - solid.position;
                let distance = apart.length();
                if distance < self.kernel.support() {
                    let away = motion.after.direction_to_stage(apart.normalize_or_zero());
                    visit(Contact {
                        volume: solid.volume * self.kernel.w(distance),
                        gradient: away * (solid.volume * self.kernel.dw(distance)),
                        velocity,
                        flask: Some(flask),
                    });
                }
            }),
        }
    }

    fn touch_map(
        &self,
        (flask, map): (usize, &VolumeMap),
        stage_from_flask: &Placement,
        local: DVec3,
        velocity: DVec3,
        visit: &mut impl FnMut(Contact),
    ) {
        let r = local.x.hypot(local.z);
        let sample = map.sample(r, local.y);
        if sample.volume <= 0.0 {
            return;
        }
        // On the axis ∂V/∂r is zero, whatever direction it is given.
        let axis = DVec3::new(local.x, 0.0, local.z).normalize_or_zero();
        let gradient = stage_from_flask
            .direction_to_stage(axis * sample.volume_dr + DVec3::Y * sample.volume_dy);
        visit(Contact {
            volume: sample.volume,
            gradient,
            velocity,
            flask: Some(flask),
        });
    }
}
