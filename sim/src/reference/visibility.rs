//! Nothing acts through a wall: which neighbours act on each other.

use super::placement::Motion;
use super::surroundings::Surroundings;
use crate::flask::Profile;
use glam::DVec3;

/// Whether the particles at `a` and `b` (stage, metres), members of `a_in`
/// and `b_in`, may act on each other.
///
/// Members of one flask do, and so do two that are in none; glass between
/// the latter is thinner than the support radius only where they touch it
/// from outside on both sides, as at a corner. Else each that is in a flask
/// must reach the other through that flask's open top.
pub fn see_each_other(
    surroundings: &Surroundings,
    motion: &[Motion],
    (a, a_in): (DVec3, Option<usize>),
    (b, b_in): (DVec3, Option<usize>),
) -> bool {
    let out_of = |flask: Option<usize>, from: DVec3, to: DVec3| {
        flask.is_none_or(|flask| {
            let placement = &motion[flask].after;
            let profile = &surroundings.vessels[flask].profile;
            leaves_through_mouth(profile, placement.to_flask(from), placement.to_flask(to))
        })
    };
    a_in == b_in || (out_of(a_in, a, b) && out_of(b_in, b, a))
}

/// Whether the way from `from`, in the flask, to `to` passes no glass; in the
/// flask's frame, metres.
pub fn leaves_through_mouth(profile: &Profile, from: DVec3, to: DVec3) -> bool {
    let radius = |point: DVec3| point.x.hypot(point.z);
    let rim = profile.rim_height();
    if to.y < rim {
        return radius(to) < profile.inner_radius(to.y);
    }
    // A member whose prediction is above the rim already has nothing
    // between itself and another above.
    if from.y >= rim {
        return true;
    }
    let crossing = from.lerp(to, (rim - from.y) / (to.y - from.y));
    radius(crossing) < profile.mouth_radius()
}
