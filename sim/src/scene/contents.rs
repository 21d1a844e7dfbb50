//! Contents of a scene: flasks, their liquids, and the particles that represent these.

use super::error::Problem;
use super::settings::Scale;
use crate::fill;
use crate::flask::glassware::Vessel;
use crate::flask::{Profile, VolumeMap};
use crate::pose::Pose;
use glam::DVec3;

/// Most particles that all flasks of a scene may hold when they are full: a device's buffers
/// have room for them, and the lattice is walked in seconds.
const MOST_SITES: usize = 50_000_000;

/// Most nodes of a flask's table of distances and boundary volumes, 16 bytes each: eight
/// times as many as a cube of [`MOST_SITES`] takes.
const MOST_NODES: f64 = 5e6;

/// Most nodes of all flasks' tables.
const MOST_NODES_IN_ALL: f64 = 4.0 * MOST_NODES;

/// A vessel of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Flask {
    /// Name that liquids and tracks refer to.
    pub name: String,
    /// What kind of vessel it is.
    pub vessel: Vessel,
    /// Its shape, metres of the scene.
    pub profile: Profile,
    /// Mass of the empty vessel, kg.
    pub mass: f64,
    /// Where it stands at the start.
    pub stage_from_flask: Pose,
    /// Clamped to a stand.
    pub fixed: bool,
    /// Angle between the liquid's surface and its glass, measured in the liquid, radians.
    pub contact_angle: f64,
    /// Heat that a plate under it gives its base, W; 0 without one.
    pub heater: f64,
    /// Whether it stands on a hot plate at the start, which is drawn and gives nothing but [`Flask::heater`].
    pub plate: bool,
}

/// A liquid in a flask at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Liquid {
    /// Index of its flask.
    pub flask: usize,
    /// Volume, m³ of the scene.
    pub volume: f64,
    /// Temperature, °C.
    pub temperature: f64,
    /// Mass of acid over mass of liquid.
    pub acid_fraction: f64,
}

/// A fluid particle at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartParticle {
    /// Position in the stage, metres.
    pub position: DVec3,
    /// Index of the flask it is in.
    pub flask: usize,
    /// Temperature, °C.
    pub temperature: f64,
    /// Acid fraction.
    pub acid_fraction: f64,
}

impl Flask {
    /// Whether buffers hold full `flasks` and their tables at the scale's spacing.
    pub(super) fn check_sizes(flasks: &[Self], scale: &Scale) -> Result<(), Problem> {
        let spacing = scale.spacing;
        let (mut sites, mut nodes) = (0_usize, 0.0);
        for flask in flasks {
            let full = fill::count_for_volume(flask.profile.capacity(), spacing);
            sites = sites.saturating_add(full);
            if sites > MOST_SITES {
                let problem = format!(
                    "{spacing} m puts more than {MOST_SITES} particles into full flasks (up to \
                     {:?}); take a larger spacing",
                    flask.name
                );
                return Err(Problem::new("scale.spacing", problem));
            }
            nodes += flask.checked_nodes(scale)?;
        }
        if nodes > MOST_NODES_IN_ALL {
            let problem = format!(
                "{spacing} m is too small: the tables of all flasks' walls would have more than \
                 {MOST_NODES_IN_ALL} nodes; take fewer flasks or a larger spacing"
            );
            return Err(Problem::new("scale.spacing", problem));
        }
        Ok(())
    }

    /// Nodes of the flask's table, which are not too many.
    fn checked_nodes(&self, scale: &Scale) -> Result<f64, Problem> {
        let (name, spacing) = (&self.name, scale.spacing);
        let [columns, rows] = VolumeMap::size(&self.profile, scale.support());
        if columns * rows > MOST_NODES {
            let problem = format!(
                "{spacing} m is too small for flask {name:?}, {:.3e} m wide and {:.3e} m high with \
                 its wall: the table of its walls would have more than {MOST_NODES} nodes; take \
                 a smaller flask, a thinner wall or a larger spacing",
                2.0 * self.profile.outer_radius(),
                self.profile.rim_height()
            );
            return Err(Problem::new("scale.spacing", problem));
        }
        Ok(columns * rows)
    }
}
