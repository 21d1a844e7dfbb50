//! Coupling of a flask with the liquid's load of two steps ago, without instability.
//!
//! The liquid weighs more than the glass: 250 g in 100 g. Applied as it comes,
//! its reaction is unstable. Liquid that moves with the flask pushes back with
//! F = m_l (g − a), so with the delay a free flask of mass m_g obeys
//! m_g a_n = m_g g + m_l (g − a_{n−2}), and a_n − g = −(m_l/m_g)(a_{n−2} − g)
//! grows with every turn where m_l > m_g. Let go in the air, the flask would
//! first be thrown down, away from its water.
//!
//! The remedy is that of partitioned fluid–structure coupling, an added mass
//! (Causin, Gerbeau, Nobile 2005): the flask is given the liquid's mass at the
//! liquid's centre, and the force that this mass would have taken for the
//! acceleration of that same earlier step is given back,
//!
//! (m_g + m_l) a_n = m_g g + F_{n−2} + m_l a_{n−2}.
//!
//! Liquid that moves along cancels it exactly (a_n = g when let go); at rest
//! and in any steady motion it is no force at all; and what remains of a
//! disturbance shrinks by m_l/(m_g + m_l) at worst.

use glam::Vec3;
use rapier3d::prelude::MassProperties;

use super::spec::Load;
use crate::pose::Pose;

/// Highest acceleration (m/s², at real size) of a flask that is given back,
/// three times gravity. Carrying, tipping, sliding and rolling stay below; an
/// impact, which lies above, is over in one step while the liquid's answer to it takes
/// several, and given back in whole would make the flask hop.
const GIVEN_BACK_MAX: f32 = 30.0;

/// A flask's last poses, the newest first.
pub(super) type PastPoses = [Pose; 4];

/// `load`, or none where it holds something that is not finite or a negative mass:
/// one step without the liquid is harmless, one NaN in a body is for good.
pub(super) fn checked(load: Load) -> Load {
    let finite = load.impulse.is_finite()
        && load.angular_impulse.is_finite()
        && load.liquid_mass.is_finite()
        && load.liquid_centre.is_finite();
    if finite && load.liquid_mass >= 0.0 {
        load
    } else {
        Load::default()
    }
}

/// The flask's mass properties with the liquid of `load` in it, as a point: what
/// turns with the glass of an inviscid liquid is little, and the point errs to that side.
pub(super) fn loaded_mass(glass: MassProperties, load: &Load) -> MassProperties {
    if load.liquid_mass > 0.0 {
        glass + MassProperties::new(load.liquid_centre, load.liquid_mass, Vec3::ZERO)
    } else {
        glass
    }
}

/// Force (N) and torque (N m, about the flask's centre of mass) on a free flask during the
/// coming step besides gravity on its [loaded](loaded_mass) mass and contacts.
pub(super) fn push(
    load: &Load,
    past: &PastPoses,
    loaded_centre: Vec3,
    gravity: Vec3,
    step: f32,
    length_scale: f32,
) -> (Vec3, Vec3) {
    let centre = past[0].transform_point(loaded_centre);
    let mut force = load.impulse / step;
    let mut torque = load.angular_impulse / step + (past[0].position - centre).cross(force);
    if load.liquid_mass > 0.0 {
        let [_, newer, middle, older] = past.map(|pose| pose.transform_point(load.liquid_centre));
        let acceleration = ((newer - middle) - (middle - older)) / (step * step);
        let acceleration = acceleration.clamp_length_max(GIVEN_BACK_MAX * length_scale);
        // Less gravity, because rapier lets it act on the liquid's mass, too,
        // while the liquid's weight is in the load already.
        let given_back = load.liquid_mass * (acceleration - gravity);
        let lever = past[0].transform_point(load.liquid_centre) - centre;
        force += given_back;
        torque += lever.cross(given_back);
    }
    (force, torque)
}
