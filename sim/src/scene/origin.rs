//! Scenes far from the origin of their file, brought near to it.

use super::file::SceneFile;
use glam::DVec3;

/// Steps in which a scene is moved, metres: more than any built-in scene is
/// wide, so that none of those is moved, and a power of two, so that what is
/// left has lost no bit.
const STEP: f64 = 64.0;

/// Takes out of `raw`'s positions what whole steps there are in the first
/// flask's, and returns it.
pub(super) fn take(raw: &mut SceneFile) -> DVec3 {
    let Some(first) = raw.flask.first() else {
        return DVec3::ZERO;
    };
    let origin = (DVec3::from_array(first.position) / STEP).round() * STEP;
    if !origin.is_finite() {
        return DVec3::ZERO;
    }
    for flask in &mut raw.flask {
        flask.position = (DVec3::from_array(flask.position) - origin).to_array();
    }
    if let Some(table) = &mut raw.table {
        table.top -= origin.y;
        table.centre[0] -= origin.x;
        table.centre[1] -= origin.z;
    }
    raw.floor.height -= origin.y;
    origin
}
