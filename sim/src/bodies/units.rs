//! Metres to rapier's unit of length and back.

use glam::{Quat, Vec3};
use rapier3d::math::Pose as RapierPose;
use rapier3d::prelude::MassProperties;

use crate::pose::Pose;

/// rapier's unit of length (m, at real size).
///
/// parry (0.31) drops a corner of its GJK simplex that adds less than 1.1e-3
/// square units, an absolute number: in metres the base of a beaker would be
/// below it, and flasks would touch centimetres beside where they are. In this unit
/// a flask measures about one, as the objects do for which rapier's
/// tolerances are meant. A power of two, so that at real size the conversion is exact.
pub(super) const UNIT: f32 = 0.125;

/// Converts between SI and rapier's units for a world of one length scale; mass
/// and time are the same in both.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    unit: f32,
}

impl Units {
    pub fn new(length_scale: f32) -> Self {
        Self {
            unit: UNIT * length_scale,
        }
    }

    /// As [`BodiesSpec::length_scale`](super::BodiesSpec).
    pub fn length_scale(self) -> f32 {
        self.unit / UNIT
    }

    pub fn length(self, metres: f32) -> f32 {
        metres / self.unit
    }

    /// A position, velocity, acceleration or force.
    pub fn vector(self, si: Vec3) -> Vec3 {
        si / self.unit
    }

    pub fn torque(self, si: Vec3) -> Vec3 {
        si / (self.unit * self.unit)
    }

    pub fn pose(self, pose: Pose) -> RapierPose {
        RapierPose::from_parts(self.vector(pose.position), pose.orientation.normalize())
    }

    pub fn mass_properties(self, si: MassProperties) -> MassProperties {
        MassProperties::with_principal_inertia_frame(
            self.vector(si.local_com),
            si.mass(),
            self.torque(si.principal_inertia()),
            si.principal_inertia_local_frame,
        )
    }

    pub fn to_si(self, vector: Vec3) -> Vec3 {
        vector * self.unit
    }

    pub fn pose_to_si(self, position: Vec3, orientation: Quat) -> Pose {
        Pose::new(self.to_si(position), orientation)
    }
}
