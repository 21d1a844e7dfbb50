//! Rigid bodies: flasks and tools, the table and the floor, and the hands that grip them.
//!
//! rapier3d does the mechanics; this module gives it the flasks (each a
//! solid of convex pieces with the inertia of a glass shell), the action of
//! hands on them, and the liquid's push. It does not depend on
//! particles, scenes or devices.
//!
//! A hand has no collider of its own. It acts by gripping alone: a solid hand
//! would push a flask away in the very moment in which it reaches for it.

mod body;
mod build;
mod coupling;
mod grip;
mod reach;
mod rolling;
mod shards;
mod shell;
mod solid;
mod spec;
mod strikes;
mod units;
mod wear;
mod world;

#[cfg(test)]
mod tests;

pub use grip::{GRIP_CLOSES, GRIP_OPENS, GRIP_REACH, RELEASE_SPEED_MAX, RELEASE_SPIN_MAX};
pub use shards::{BASE_SHARE, BREAKS_AT, Break, NOWHERE, SHARDS, Shard, is_nowhere};
pub use spec::{
    BodiesError, BodiesSpec, BodySpec, Hand, Load, Role, Table, ToolSpec, Velocity, Worn,
};
pub use strikes::Strike;
pub use world::{Bodies, Leap};
