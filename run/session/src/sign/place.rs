//! Where a sign stands: over the flask that it is of, and facing the head. Beside it, the hand that comes would hide it.

use glam::{Affine3A, Mat3, Vec3};
use vitriol_xr::Side;

use crate::first_minute::POURED;

/// Width of the sign, m: 11° at 0.6 m.
pub const WIDTH: f32 = 0.12;
/// Between the sign and what it is at, m. Ours.
const GAP: f32 = 0.02;
/// A hand is at a flask from this distance on, m: what an arm reaches without the shoulder. Ours.
const NEAR: f32 = 0.30;
/// How much nearer another flask has to be for the sign to go there, m, so that it does not flutter between two. Ours.
const NEARER: f32 = 0.05;
/// Over a beaker that is poured into, m, and behind it as seen from the head: the flask that pours is between. A beaker of 250 mL is
/// 0.095 m high.
const ROOM_TO_POUR: f32 = 0.14;
const BEHIND: f32 = 0.06;

/// A flask as signs are put over it; scene's stage, real metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stands {
    /// Middle of its axis.
    pub middle: Vec3,
    /// Its height, m.
    pub height: f32,
    /// What is in it, mL.
    pub millilitres: f64,
    /// Whether a hand can take it.
    pub can_be_taken: bool,
    /// Whether it has broken.
    pub broken: bool,
}

impl Stands {
    /// Whether a hand can pour from it what counts as poured.
    pub fn can_be_poured(&self) -> bool {
        self.can_be_taken && self.millilitres >= POURED
    }
}

/// What a sign is at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// The flask that a hand is nearest to, else the one that holds most.
    Any,
    /// This flask.
    Flask(usize),
    /// The flask that `from` is poured into; `None` for the nearest one.
    Into {
        /// The flask in the hand.
        from: usize,
        /// The one that is poured into.
        into: Option<usize>,
    },
    /// A thing that is no flask.
    Thing(Stands),
}

/// Where a sign's middle is to be, and what it is at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// The flask that it is at; `None` at something else.
    pub flask: Option<usize>,
    /// The hand that is near it, if one is.
    pub side: Option<usize>,
    /// Scene's stage, m.
    pub middle: Vec3,
}

/// The spot for a sign at `target`. `before` is the flask that the sign was at. `head` and `hands` are places in the scene's stage, m;
/// `None` of a hand that is not seen. `None` where no flask is there for it.
pub fn spot(
    target: Target,
    before: Option<usize>,
    flasks: &[Stands],
    head: Vec3,
    hands: [Option<Vec3>; 2],
) -> Option<Spot> {
    let over = |flask: Option<usize>, stands: &Stands, room: f32| {
        let up = 0.5 * stands.height + room + GAP + 0.5 * WIDTH;
        Spot {
            flask,
            side: near(stands, hands).map(|(_, side)| side),
            middle: stands.middle + up * Vec3::Y,
        }
    };
    match target {
        Target::Any => {
            let flask = nearest(before, flasks, hands).or_else(|| fullest(flasks))?;
            Some(over(Some(flask), flasks.get(flask)?, 0.0))
        }
        Target::Flask(flask) => Some(over(Some(flask), flasks.get(flask)?, 0.0)),
        Target::Thing(stands) => Some(over(None, &stands, 0.0)),
        Target::Into { from, into } => {
            let from_there = flasks.get(from)?.middle;
            let others = flasks.iter().enumerate();
            let others = others.filter(|(n, it)| *n != from && !it.broken);
            let others = others.filter(|(n, _)| into.is_none_or(|into| into == *n));
            let distance = |stands: &Stands| stands.middle.distance(from_there);
            let to = others.min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
            let (to, stands) = to?;
            let mut spot = over(Some(to), stands, ROOM_TO_POUR);
            let ahead = (spot.middle - head) * Vec3::new(1.0, 0.0, 1.0);
            spot.middle += BEHIND * ahead.normalize_or(Vec3::NEG_Z);
            Some(spot)
        }
    }
}

/// The hand beside which a pour of `from` into `into` falls, for a user who has `right` to the right: that of the other side.
pub fn beside_pour(from: &Stands, into: &Stands, right: Vec3) -> Side {
    match (into.middle - from.middle).dot(right) > 0.0 {
        true => Side::Left,
        false => Side::Right,
    }
}

/// The hand that is nearest to it, and how far off that is, m, if it is near.
fn near(stands: &Stands, hands: [Option<Vec3>; 2]) -> Option<(f32, usize)> {
    let hands = hands.into_iter().enumerate();
    let distances = hands.filter_map(|(side, hand)| Some((hand?.distance(stands.middle), side)));
    let nearest = distances.min_by(|(a, _), (b, _)| a.total_cmp(b));
    nearest.filter(|(distance, _)| *distance < NEAR)
}

/// The flask that is nearest to a hand that is near.
fn nearest(before: Option<usize>, flasks: &[Stands], hands: [Option<Vec3>; 2]) -> Option<usize> {
    let distances = worth_taking(flasks).filter_map(|(flask, stands)| {
        let (distance, _) = near(stands, hands)?;
        let kept = f32::from(u8::from(before == Some(flask))) * NEARER;
        Some((distance - kept, flask))
    });
    let nearest = distances.min_by(|(a, _), (b, _)| a.total_cmp(b));
    nearest.map(|(_, flask)| flask)
}

/// Flasks that a hand can take; where one of them has something to be poured, those alone.
fn worth_taking(flasks: &[Stands]) -> impl DoubleEndedIterator<Item = (usize, &Stands)> {
    let any = flasks.iter().any(Stands::can_be_poured);
    let all = flasks.iter().enumerate();
    all.filter(move |(_, it)| it.can_be_taken && (!any || it.can_be_poured()))
}

/// Of these the one that holds most.
fn fullest(flasks: &[Stands]) -> Option<usize> {
    // Of several the first.
    let fullest = worth_taking(flasks)
        .rev()
        .max_by(|(_, a), (_, b)| a.millilitres.total_cmp(&b.millilitres));
    fullest.map(|(flask, _)| flask)
}

/// The sign's frame in the scene's stage: its middle there, its face to the head, upright.
pub fn facing(middle: Vec3, head: Vec3) -> Affine3A {
    let out = (head - middle).normalize_or(Vec3::Z);
    let right = Vec3::Y.cross(out).normalize_or(Vec3::X);
    Affine3A::from_mat3_translation(Mat3::from_cols(right, out.cross(right), out), middle)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const HEAD: Vec3 = Vec3::new(0.0, 1.2, 0.0);

    /// Two beakers on a table at 0.75 m, the left one full.
    fn flasks() -> [Stands; 2] {
        [(-0.12, 150.0), (0.12, 0.0)].map(|(x, millilitres)| Stands {
            middle: Vec3::new(x, 0.80, -0.4),
            height: 0.1,
            millilitres,
            can_be_taken: true,
            broken: false,
        })
    }

    #[test]
    fn without_a_hand_it_is_over_the_full_flask() {
        let far = [None, Some(Vec3::new(0.3, 1.0, 0.0))];
        let spot = spot(Target::Any, None, &flasks(), HEAD, far).unwrap();
        assert_eq!((spot.flask, spot.side), (Some(0), None));
        // Rim at 0.85 m, gap, half of the sign.
        let expected = Vec3::new(-0.12, 0.93, -0.4);
        assert!(spot.middle.distance(expected) < 1e-6, "{spot:?}");
    }

    #[test]
    fn it_is_over_the_flask_that_a_hand_is_near_to() {
        let mut both = flasks();
        both[1].millilitres = 100.0;
        let at = |before, x: f32, side: usize| {
            let mut hands = [None; 2];
            hands[side] = Some(Vec3::new(x, 0.85, -0.3));
            spot(Target::Any, before, &both, HEAD, hands).unwrap()
        };
        let right = at(None, 0.15, 1);
        assert_eq!((right.flask, right.side), (Some(1), Some(1)));
        assert!(right.middle.distance(Vec3::new(0.12, 0.93, -0.4)) < 1e-6);
        let left = at(None, -0.15, 0);
        assert_eq!((left.flask, left.side), (Some(0), Some(0)));
        // There is nothing to pour in this one.
        let hands = [None, Some(Vec3::new(0.15, 0.85, -0.3))];
        let full = spot(Target::Any, None, &flasks(), HEAD, hands).unwrap();
        assert_eq!(full.flask, Some(0));
        // Between two it stays.
        assert_eq!(at(Some(0), 0.02, 1).flask, Some(0));
        assert_eq!(at(Some(1), -0.02, 1).flask, Some(1));
    }

    /// However near a hand is to the other flask, and however much that holds.
    #[test]
    fn what_is_asked_for_has_the_sign() {
        let hands = [None, Some(Vec3::new(-0.15, 0.85, -0.3))];
        let asked = spot(Target::Flask(1), Some(0), &flasks(), HEAD, hands).unwrap();
        assert_eq!(asked.flask, Some(1));
        assert!(asked.middle.distance(Vec3::new(0.12, 0.93, -0.4)) < 1e-6);
        // Goggles: 0.06 m high, then the gap and half of the sign.
        let thing = Stands {
            middle: Vec3::new(-0.4, 0.78, -0.28),
            height: 0.06,
            millilitres: 0.0,
            ..flasks()[0]
        };
        let asked = spot(Target::Thing(thing), Some(0), &flasks(), HEAD, hands).unwrap();
        assert_eq!((asked.flask, asked.side), (None, Some(1)));
        assert!(asked.middle.distance(Vec3::new(-0.4, 0.89, -0.28)) < 1e-6);
    }

    /// The hand of the other side, which is the right one where the target is at the left; from behind the bench the other way about.
    #[test]
    fn a_pour_falls_beside_the_hand_of_the_other_side() {
        let [left, right] = flasks();
        assert_eq!(beside_pour(&left, &right, Vec3::X), Side::Left);
        assert_eq!(beside_pour(&right, &left, Vec3::X), Side::Right);
        assert_eq!(beside_pour(&left, &right, Vec3::NEG_X), Side::Right);
    }

    #[test]
    fn to_pour_it_is_over_the_other_flask() {
        let [full, empty] = flasks();
        let third = Stands {
            middle: full.middle - 0.3 * Vec3::X,
            ..full
        };
        let pour = |from, into, flasks: &[Stands]| {
            let target = Target::Into { from, into };
            spot(target, None, flasks, HEAD, [None; 2])
        };
        let three = [full, empty, third];
        let seen = pour(0, None, &three).unwrap();
        assert_eq!(seen.flask, Some(1));
        assert!(seen.middle.y > 1.0 && seen.middle.z < -0.45, "{seen:?}");
        assert_eq!(pour(1, None, &three).unwrap().flask, Some(0));
        // The one that is asked for, though another is nearer.
        assert_eq!(pour(0, Some(2), &three).unwrap().flask, Some(2));
        // There is no other.
        assert_eq!(pour(0, None, &three[..1]), None);
        assert_eq!(pour(0, Some(1), &three[..1]), None);
    }

    #[test]
    fn it_faces_the_head_upright() {
        let middle = Vec3::new(0.3, 0.9, -0.5);
        let stage_from_sign = facing(middle, HEAD);
        let out = stage_from_sign.transform_vector3(Vec3::Z);
        assert!(out.dot((HEAD - middle).normalize()) > 0.9999);
        assert!(stage_from_sign.transform_vector3(Vec3::X).y.abs() < 1e-6);
        assert!(stage_from_sign.transform_vector3(Vec3::Y).y > 0.5);
        assert!((stage_from_sign.matrix3.determinant() - 1.0).abs() < 1e-5);
    }
}
