//! Where a sign stands: over the flask that it is of, and facing the head. Beside it, the hand that comes would hide it.

use glam::{Affine3A, Mat3, Vec3};

use crate::first_minute::{Lesson, POURED};

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

/// The flask that a sign is at, and where the sign's middle is to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// The flask that it is at.
    pub flask: usize,
    /// The hand that is near it, if one is.
    pub side: Option<usize>,
    /// Scene's stage, m.
    pub middle: Vec3,
}

/// The spot for a lesson. `of` is the flask in the hand, `before` the one that the sign was at. `head` and
/// `hands` are places in the scene's stage, m; `None` of a hand that is not seen. `None` where no flask is there for it.
pub fn spot(
    lesson: Lesson,
    of: Option<usize>,
    before: Option<usize>,
    flasks: &[Stands],
    head: Vec3,
    hands: [Option<Vec3>; 2],
) -> Option<Spot> {
    let over = |flask: usize, room: f32| {
        let stands = flasks.get(flask)?;
        let up = 0.5 * stands.height + room + GAP + 0.5 * WIDTH;
        Some(Spot {
            flask,
            side: None,
            middle: stands.middle + up * Vec3::Y,
        })
    };
    match (lesson, of) {
        (Lesson::Take, _) | (_, None) => match nearest(before, flasks, hands) {
            Some((flask, side)) => Some(Spot {
                side: Some(side),
                ..over(flask, 0.0)?
            }),
            None => over(fullest(flasks)?, 0.0),
        },
        (Lesson::Lift | Lesson::PutDown, Some(flask)) => over(flask, 0.0),
        (Lesson::Pour, Some(from)) => {
            let from_there = flasks.get(from)?.middle;
            let others = flasks.iter().enumerate();
            let others = others.filter(|(n, it)| *n != from && !it.broken);
            let distance = |stands: &Stands| stands.middle.distance(from_there);
            let to = others.min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
            let mut spot = over(to?.0, ROOM_TO_POUR)?;
            let ahead = (spot.middle - head) * Vec3::new(1.0, 0.0, 1.0);
            spot.middle += BEHIND * ahead.normalize_or(Vec3::NEG_Z);
            Some(spot)
        }
    }
}

/// The flask that is nearest to a hand, and that hand, if it is near.
fn nearest(
    before: Option<usize>,
    flasks: &[Stands],
    hands: [Option<Vec3>; 2],
) -> Option<(usize, usize)> {
    let pairs = worth_taking(flasks).flat_map(|(flask, stands)| {
        let hands = hands.into_iter().enumerate();
        hands.filter_map(move |(side, hand)| {
            let distance = hand?.distance(stands.middle);
            let kept = f32::from(u8::from(before == Some(flask))) * NEARER;
            (distance < NEAR).then_some((distance - kept, flask, side))
        })
    });
    let nearest = pairs.min_by(|(a, ..), (b, ..)| a.total_cmp(b));
    nearest.map(|(_, flask, side)| (flask, side))
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
        let spot = spot(Lesson::Take, None, None, &flasks(), HEAD, far).unwrap();
        assert_eq!((spot.flask, spot.side), (0, None));
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
            spot(Lesson::Take, None, before, &both, HEAD, hands).unwrap()
        };
        let right = at(None, 0.15, 1);
        assert_eq!((right.flask, right.side), (1, Some(1)));
        assert!(right.middle.distance(Vec3::new(0.12, 0.93, -0.4)) < 1e-6);
        let left = at(None, -0.15, 0);
        assert_eq!((left.flask, left.side), (0, Some(0)));
        // There is nothing to pour in this one.
        let hands = [None, Some(Vec3::new(0.15, 0.85, -0.3))];
        let full = spot(Lesson::Take, None, None, &flasks(), HEAD, hands).unwrap();
        assert_eq!(full.flask, 0);
        // Between two it stays.
        assert_eq!(at(Some(0), 0.02, 1).flask, 0);
        assert_eq!(at(Some(1), -0.02, 1).flask, 1);
    }

    #[test]
    fn to_pour_it_is_over_the_other_flask() {
        let pour = |of| spot(Lesson::Pour, Some(of), None, &flasks(), HEAD, [None; 2]);
        let seen = pour(0).unwrap();
        assert_eq!(seen.flask, 1);
        assert!(seen.middle.y > 1.0 && seen.middle.z < -0.45, "{seen:?}");
        assert_eq!(pour(1).unwrap().flask, 0);
        // There is no other.
        assert_eq!(
            spot(Lesson::Pour, Some(0), None, &flasks()[..1], HEAD, [None; 2]),
            None
        );
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
