//! Flasks: their shape, the flask constraint (section 5) and their boundary
//! in the density sum.
//!
//! The flask's frame has its y axis along the axis of symmetry and its origin
//! at the centre of the *outer* base, so that the pose of a flask standing on
//! a table is a point of the table top. The inner floor is one wall thickness
//! above the origin. All lengths are metres.

pub mod glassware;
pub mod map;
mod outline;
pub mod particles;
pub mod profile;
pub mod region;

pub use map::{PlaneMap, Side, VolumeMap};
pub use profile::{Profile, ProfileError};
pub use region::{Projection, Region, project, project_from};
