//! A body of rapier's world: a flask, or a tool.

use rapier3d::prelude::{MassProperties, RigidBodyHandle};

use super::spec::Role;

/// The constant properties of a body.
pub(super) struct Body {
    /// Its rigid body.
    pub body: RigidBodyHandle,
    /// As in [`BodySpec::outline`](super::BodySpec::outline) (m).
    pub outline: Vec<[f32; 2]>,
    /// Mass properties of the empty flask, SI.
    pub glass: MassProperties,
    /// Greatest outer radius, in rapier's unit.
    pub radius: f32,
    pub fixed: bool,
    /// What kind of tool it is; `None` for a flask.
    pub role: Option<Role>,
}
