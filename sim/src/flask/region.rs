//! The flask constraint (section 5, Eqs 18–23 and Fig. 4), extended so that
//! it is two-sided: the paper keeps liquid inside in, and this also keeps
//! liquid outside out.

use super::profile::Profile;
use glam::DVec3;

/// The three regions of Eqs 21–23 in the flask's frame. The paper measures
/// heights from the flask's middle, here they are measured from its base.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// Ω_in: above the inner floor, below the rim, within the inner radius.
    Inside,
    /// Ω_above: at or above the rim's plane.
    Above,
    /// Ω_out: all else, the glass included.
    Outside,
}

impl Region {
    /// Region of `position` (flask's frame, metres).
    pub fn of(profile: &Profile, position: DVec3) -> Self {
        if position.y >= profile.rim_height() {
            Self::Above
        } else if profile.is_inside(radius(position), position.y) {
            Self::Inside
        } else {
            Self::Outside
        }
    }
}

/// Result of the flask constraint for a predicted position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Position that the particle may take (flask's frame, metres).
    pub position: DVec3,
    /// Whether a constraint was generated, that is the position was changed.
    pub constrained: bool,
    /// Whether the particle is the flask's after this: in Ω_in.
    pub inside: bool,
}

/// Flask constraint for a particle at `previous` (in the flask's frame of the
/// previous pose) that is predicted at `predicted` (in that of the current
/// pose), with the distance `margin` kept from the glass (0.001 h in the
/// paper); metres.
///
/// A previous position in the glass counts to the side whose surface is
/// nearer.
pub fn project(profile: &Profile, previous: DVec3, predicted: DVec3, margin: f64) -> Projection {
    let was_inside = match Region::of(profile, previous) {
        Region::Inside => true,
        Region::Above => false,
        Region::Outside => in_inner_half_of_glass(profile, previous),
    };
    project_from(profile, was_inside, previous, predicted, margin)
}

/// [`project`] with the side from which the particle comes stated by the
/// caller. A prediction that is not finite is returned as it is: the solver
/// takes such particles out and counts them.
pub fn project_from(
    profile: &Profile,
    was_inside: bool,
    previous: DVec3,
    predicted: DVec3,
    margin: f64,
) -> Projection {
    if !predicted.is_finite() {
        free(predicted, was_inside)
    } else if was_inside {
        from_inside(profile, previous, predicted, margin)
    } else {
        from_outside(profile, previous, predicted, margin)
    }
}

fn from_inside(profile: &Profile, previous: DVec3, predicted: DVec3, margin: f64) -> Projection {
    match Region::of(profile, predicted) {
        Region::Inside => free(predicted, true),
        Region::Above if crosses_mouth(profile, previous, predicted) => {
            let clear = profile.rim_height() + margin;
            let over_glass = profile.signed_distance_glass(radius(predicted), predicted.y);
            if over_glass < contact(margin) && predicted.y < clear {
                moved(predicted.with_y(clear), false)
            } else {
                free(predicted, false)
            }
        }
        _ => moved(into_liquid_space(profile, predicted, margin), true),
    }
}

/// Fig. 4: vertically to a proper height first, then the radius is looked up
/// at the corrected height, then radially.
fn into_liquid_space(profile: &Profile, predicted: DVec3, margin: f64) -> DVec3 {
    let low = profile.floor_height();
    let high = profile.rim_height();
    let gap = margin.min(0.25 * (high - low));
    let y = predicted.y.clamp(low + gap, high - gap);
    let glass = profile.inner_radius(y);
    // Where a pointed bottom is narrower than two margins, half way in.
    let limit = (glass - margin).max(0.5 * glass);
    let r = radius(predicted);
    let scale = if r > limit { limit / r } else { 1.0 };
    DVec3::new(predicted.x * scale, y, predicted.z * scale)
}

fn from_outside(profile: &Profile, previous: DVec3, predicted: DVec3, margin: f64) -> Projection {
    let start = out_of_glass(profile, previous, margin);
    if let Some(entered) = enter(profile, start, predicted, margin) {
        return entered;
    }
    let Some(hit) = first_hit(profile, start, predicted, margin) else {
        return free(predicted, false);
    };
    let slid = slide(profile, hit, predicted, margin);
    if let Some(entered) = enter(profile, start, slid, margin) {
        return Projection {
            constrained: true,
            ..entered
        };
    }
    // Only what can be reached straight from the start is safe on concave
    // glass; else the particle waits where it struck.
    match first_hit(profile, start, slid, margin) {
        None => moved(slid, false),
        Some(_) => moved(hit, false),
    }
}

/// Entering is legal only through the mouth; once through it, what lies
/// beyond the glass is put back as for any particle inside.
fn enter(profile: &Profile, start: DVec3, predicted: DVec3, margin: f64) -> Option<Projection> {
    if predicted.y >= profile.rim_height()
        || start.y < profile.rim_height()
        || !crosses_mouth(profile, start, predicted)
    {
        return None;
    }
    Some(match Region::of(profile, predicted) {
        Region::Inside => free(predicted, true),
        _ => moved(into_liquid_space(profile, predicted, margin), true),
    })
}

/// Whether the segment crosses the rim's plane within the mouth. One end is
/// below that plane, the other is not.
fn crosses_mouth(profile: &Profile, a: DVec3, b: DVec3) -> bool {
    let rim = profile.rim_height();
    let drop = b.y - a.y;
    if drop == 0.0 {
        return false;
    }
    let t = ((rim - a.y) / drop).clamp(0.0, 1.0);
    radius(a.lerp(b, t)) < profile.mouth_radius()
}

/// Distance at which a particle touches the outer glass. Half of the margin
/// at which it is put down, so that one at rest there is not struck anew by
/// rounding.
fn contact(margin: f64) -> f64 {
    0.5 * margin
}

/// Where the segment first comes within contact of the glass, by sphere
/// tracing; `None` if it does not. The segment does not pass the mouth. Steps
/// never fall below an eighth of the wall, so one along the glass ends; a
/// corner cut off by less does no harm, for the liquid space counts as struck.
fn first_hit(profile: &Profile, start: DVec3, end: DVec3, margin: f64) -> Option<DVec3> {
    let path = end - start;
    let length = path.length();
    let touches = 0.9 * contact(margin);
    let least = profile.wall() / 8.0;
    let mut clear = 0.0;
    while clear < length {
        let step = clearance(profile, start + path * (clear / length)).max(least);
        let at = (clear + step).min(length);
        if clearance(profile, start + path * (at / length)) < touches {
            return Some(bisect(profile, start, path / length, clear, at, margin));
        }
        clear = at;
    }
    None
}

fn bisect(
    profile: &Profile,
    start: DVec3,
    direction: DVec3,
    mut clear: f64,
    mut struck: f64,
    margin: f64,
) -> DVec3 {
    for _ in 0..50 {
        let middle = 0.5 * (clear + struck);
        if clearance(profile, start + direction * middle) < contact(margin) {
            struck = middle;
        } else {
            clear = middle;
        }
    }
    start + direction * clear
}

/// Distance to the glass from outside, negative in it and in the liquid
/// space; far off a lower bound that costs no walk along the outline.
fn clearance(profile: &Profile, point: DVec3) -> f64 {
    let r = radius(point);
    let rim = profile.rim_height();
    let beside = (r - profile.outer_radius()).max(0.0);
    let beyond = (point.y - rim).max(-point.y).max(0.0);
    let bound = beside.hypot(beyond);
    if bound > 0.25 * rim {
        return bound;
    }
    let distance = profile.signed_distance_glass(r, point.y);
    if profile.is_inside(r, point.y) {
        -distance
    } else {
        distance
    }
}

/// The rest of the motion along the glass that was struck at `hit`, so that a
/// drop on the outside runs down instead of sticking.
fn slide(profile: &Profile, hit: DVec3, predicted: DVec3, margin: f64) -> DVec3 {
    let normal = outward(profile, hit);
    let rest = predicted - hit;
    let along = hit + rest - normal * rest.dot(normal) + normal * (margin - contact(margin));
    let distance = profile.signed_distance_glass(radius(along), along.y);
    if distance < margin {
        along + outward(profile, along) * (margin - distance)
    } else {
        along
    }
}

/// `point`, moved out of the glass, to a margin before the nearest outer
/// surface, if it is in the glass or in the liquid space. In a groove of the
/// outline one surface's margin may lie within the other's contact, so it is
/// moved again.
fn out_of_glass(profile: &Profile, mut point: DVec3, margin: f64) -> DVec3 {
    for _ in 0..16 {
        let distance = clearance(profile, point);
        if distance >= 0.9 * contact(margin) {
            break;
        }
        let [near_r, near_y] = profile.nearest_outside(radius(point), point.y);
        let surface = at_radius(point, near_r, near_y);
        let normal = match ((point - surface).try_normalize(), distance > 0.0) {
            (Some(direction), true) => direction,
            (Some(direction), false) => -direction,
            (None, _) => outward(profile, surface),
        };
        point = surface + normal * margin;
    }
    point
}

/// Direction in which the distance to the glass grows fastest.
fn outward(profile: &Profile, point: DVec3) -> DVec3 {
    let r = radius(point);
    let step = 1e-4 * profile.wall();
    let distance = |r: f64, y: f64| profile.signed_distance_glass(r.abs(), y);
    let slope = DVec3::new(
        distance(r + step, point.y) - distance(r - step, point.y),
        distance(r, point.y + step) - distance(r, point.y - step),
        0.0,
    );
    let axis = at_radius(point, 1.0, 0.0);
    (axis * slope.x + DVec3::Y * slope.y).normalize_or(DVec3::Y)
}

fn in_inner_half_of_glass(profile: &Profile, point: DVec3) -> bool {
    let r = radius(point);
    if profile.signed_distance_glass(r, point.y) > 0.0 {
        return false;
    }
    let [near_r, near_y] = profile.nearest_outside(r, point.y);
    profile.signed_distance_inner(r, point.y).abs() < (near_r - r).hypot(near_y - point.y)
}

/// Distance from the axis.
fn radius(point: DVec3) -> f64 {
    point.x.hypot(point.z)
}

/// The point at radius `r` and height `y` in the half-plane of `point`.
fn at_radius(point: DVec3, r: f64, y: f64) -> DVec3 {
    let length = radius(point);
    if length > 0.0 {
        DVec3::new(point.x / length * r, y, point.z / length * r)
    } else {
        DVec3::new(r, y, 0.0)
    }
}

fn free(position: DVec3, inside: bool) -> Projection {
    Projection {
        position,
        constrained: false,
        inside,
    }
}

fn moved(position: DVec3, inside: bool) -> Projection {
    Projection {
        position,
        constrained: true,
        inside,
    }
}

#[cfg(test)]
#[path = "region_tests.rs"]
mod tests;
