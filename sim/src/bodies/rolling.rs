//! Rolling resistance, which rapier does not model.

use glam::Vec3;
use rapier3d::prelude::{PhysicsWorld, RigidBody};

/// Rolling resistance coefficient (dimensionless): the moment about the line of
/// contact, by normal force and radius. Tables give 0.001 for steel on steel
/// and 0.01 and more for tyres on a road; glass with a spout, on wood, is
/// put at the upper end. Our choice: without any, a beaker knocked over on a level
/// table would never come to rest.
const COEFFICIENT: f32 = 0.01;

/// The torque that slows `body`, of outer radius `radius`, on the surface it rolls on, all
/// in rapier's unit; zero while it touches nothing, and never so much that it would
/// turn the body back within `step` (s).
///
/// The normal force is taken as the body's weight, as on a level surface.
pub(super) fn resistance(rapier: &PhysicsWorld, body: &RigidBody, radius: f32, step: f32) -> Vec3 {
    let touches = body.colliders().iter().any(|&collider| {
        rapier
            .narrow_phase
            .contact_pairs_with(collider)
            .any(|pair| pair.has_any_active_contact())
    });
    if !touches {
        return Vec3::ZERO;
    }
    let moment = COEFFICIENT * body.mass() * rapier.gravity.length() * radius;
    let inertia = body.mass_properties().local_mprops.principal_inertia();
    let spin = body.angvel();
    let stopping = inertia.min_element() * spin.length() / step;
    -spin.normalize_or_zero() * moment.min(stopping)
}
