//! From which side a glass is seen, so that hands hide as little of it as can be. Places alone decide, so a track's film is always the same.

use glam::{Affine3A, Quat, Vec3};
use vitriol_render::View;

/// Angles by which an eye may go about what it looks at, degrees; the first of those from which the least is hidden is taken. Chosen: those
/// between them hide about as much, and beyond them one beaker stands before the other.
const ASIDE: [f32; 5] = [0.0, -35.0, 35.0, -70.0, 70.0];
/// How many of them the bench as a whole is seen from.
const OF_BENCH: usize = 3;
/// A hand, a wrist and a cuff are a tube from the grip towards the elbow: its length and radius, m. A palm is 85 mm broad, and a cuff ends
/// 0.14 m behind the grip.
const LENGTH: f32 = 0.16;
const RADIUS: f32 = 0.045;
/// The right elbow of a user who sits at the bench, m; the left one is across. Chosen: it is a little over the bench, beside the trunk.
const ELBOW: Vec3 = Vec3::new(0.25, 0.85, -0.05);
/// Points across and up a glass that are looked for.
const POINTS: usize = 9;
/// Balls that stand for an arm's tube.
const BALLS: usize = 5;

/// A glass where it stands or is held, upright.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Glass {
    /// Its foot, m.
    pub foot: Vec3,
    /// Its height and radius, m.
    pub size: [f32; 2],
}

/// How far the eye, which is `eye` from the glass's foot (m), turns about it, radians.
pub(crate) fn turn(eye: Vec3, glass: &Glass, hands: [Vec3; 2]) -> f32 {
    let arms = arms(hands);
    least(&ASIDE, |turn| {
        hidden(glass.foot + Quat::from_rotation_y(turn) * eye, glass, &arms)
    })
}

/// The bench's view, turned about the middle of its glasses, and back so far that none of them is nearer than it may have been before.
pub(crate) fn beside(wide: View, glasses: &[Glass], hands: [Vec3; 2]) -> View {
    if glasses.is_empty() {
        return wide;
    }
    let feet = glasses.iter().map(|glass| glass.foot);
    let middle = feet.clone().sum::<Vec3>() / glasses.len() as f32;
    let reach = feet.map(|foot| (foot - middle).with_y(0.0).length());
    let reach = reach.fold(0.0, f32::max);
    let from = |turn: f32| {
        let about = Affine3A::from_translation(middle)
            * Affine3A::from_rotation_y(turn)
            * Affine3A::from_translation(-middle);
        let back = Affine3A::from_translation(reach * turn.sin().abs() * Vec3::Z);
        View {
            stage_from_eye: about * wide.stage_from_eye * back,
            ..wide
        }
    };
    let arms = arms(hands);
    from(least(&ASIDE[..OF_BENCH], |turn| {
        let eye = Vec3::from(from(turn).stage_from_eye.translation);
        glasses.iter().map(|glass| hidden(eye, glass, &arms)).sum()
    }))
}

/// The first of these angles (degrees) with the least of that, radians.
fn least(angles: &[f32], of: impl Fn(f32) -> usize) -> f32 {
    let angles = angles.iter().map(|angle| angle.to_radians());
    angles.min_by_key(|angle| of(*angle)).unwrap_or_default()
}

/// Middles of the balls that stand for both arms, of left and right hand.
fn arms(hands: [Vec3; 2]) -> Vec<Vec3> {
    let elbows = [ELBOW * Vec3::new(-1.0, 1.0, 1.0), ELBOW];
    let balls = hands.into_iter().zip(elbows).flat_map(|(hand, elbow)| {
        let along = LENGTH * (elbow - hand).normalize_or_zero();
        (0..BALLS).map(move |n| hand + n as f32 / (BALLS - 1) as f32 * along)
    });
    balls.collect()
}

/// How many points of the upright middle of a glass, as seen from that eye, are behind a ball.
fn hidden(eye: Vec3, glass: &Glass, balls: &[Vec3]) -> usize {
    let [height, radius] = glass.size;
    let right = (glass.foot - eye).with_y(0.0).cross(Vec3::Y);
    let right = radius * right.normalize_or(Vec3::X);
    let shares = || (0..POINTS).map(|n| (n as f32 + 0.5) / POINTS as f32);
    let points = shares().flat_map(|up| {
        let middle = glass.foot + up * height * Vec3::Y;
        shares().map(move |across| middle + (2.0 * across - 1.0) * right)
    });
    let hides = |point: Vec3, ball: Vec3| {
        let way = point - eye;
        let share = (ball - eye).dot(way) / way.length_squared();
        ball.distance(eye + share.clamp(0.0, 1.0) * way) < RADIUS
    };
    points
        .filter(|point| balls.iter().any(|ball| hides(*point, *ball)))
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use vitriol_render::Fov;

    const EYE: Vec3 = Vec3::new(0.0, 0.37, 0.76);
    /// A hand that hides nothing: at the floor, below the user.
    const AWAY: Vec3 = Vec3::ZERO;
    /// A beaker of 250 mL, ISO 3819.
    const BEAKER: Glass = Glass {
        foot: Vec3::new(0.0, 0.75, -0.4),
        size: [0.095, 0.035],
    };

    fn hides(turn: f32, glass: &Glass, hands: [Vec3; 2]) -> usize {
        let eye = glass.foot + Quat::from_rotation_y(turn) * EYE;
        hidden(eye, glass, &arms(hands))
    }

    /// A right hand that grips a glass from the user's side is not before it for an eye to the left, and the other way round; where no hand
    /// is near, the eye stays before the user.
    #[test]
    fn a_hand_does_not_hide_what_it_holds() {
        let grip = |x: f32| BEAKER.foot + Vec3::new(x, 0.05, 0.055);
        for (hands, sign) in [([AWAY, grip(0.02)], -1.0), ([grip(-0.02), AWAY], 1.0)] {
            let turned = turn(EYE, &BEAKER, hands);
            assert!(sign * turned > 1.0, "{turned}");
            let [before, beside] = [0.0, turned].map(|turn| hides(turn, &BEAKER, hands));
            assert!(2 * beside < before, "{beside} of {before}");
        }
        assert_eq!(turn(EYE, &BEAKER, [AWAY; 2]), 0.0);
    }

    /// The first keyframe of track `layer-and-swirl`: from before the bench the hand hides more than a third of both beakers' points. From
    /// the side it hides less than half of that, and both beakers are in the picture as a whole.
    #[test]
    fn a_hand_that_reaches_does_not_hide_the_bench() {
        let other = Glass {
            foot: Vec3::new(0.12, 0.75, -0.4),
            size: [0.110, 0.040],
        };
        let glasses = [
            Glass {
                foot: Vec3::new(-0.12, 0.75, -0.4),
                ..BEAKER
            },
            other,
        ];
        let hands = [AWAY, Vec3::new(0.056, 0.855, -0.25)];
        let wide = View::look_at(
            Vec3::new(0.0, 1.06, 0.36),
            Vec3::new(0.0, 0.865, -0.40),
            Fov::symmetric(20.5_f32.to_radians(), 16.0 / 9.0),
        );
        let hidden_from = |view: &View| -> usize {
            let eye = Vec3::from(view.stage_from_eye.translation);
            let glasses = glasses.iter();
            glasses.map(|it| hidden(eye, it, &arms(hands))).sum()
        };
        let view = beside(wide, &glasses, hands);
        let [before, aside] = [&wide, &view].map(hidden_from);
        assert!(3 * before > 2 * POINTS * POINTS, "{before}");
        assert!(2 * aside < before, "{aside} of {before}");
        assert!(view.stage_from_eye.translation.x < -0.3, "{view:?}");

        let clip = view.clip_from_scaled(1.0);
        for Glass { foot, size } in glasses {
            let [height, radius] = size;
            for n in 0..16 {
                let (sin, cos) = (n as f32 * std::f32::consts::TAU / 16.0).sin_cos();
                for level in [0.0, height] {
                    let at = foot + Vec3::new(radius * cos, level, radius * sin);
                    let at = clip.project_point3(at);
                    assert!(at.x.abs() < 1.0 && at.y.abs() < 1.0, "{at}");
                }
            }
        }
        // Nothing is before it: it stays where it was, but for rounding.
        let same = beside(wide, &glasses, [AWAY; 2]);
        assert!(same.stage_from_eye.abs_diff_eq(wide.stage_from_eye, 1e-6));
    }
}
