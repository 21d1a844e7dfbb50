//! Where the bench stands in the room: before the user, at the height of her hands.
//!
//! A scene has its own stage, with the table's top at 0.75 m and a user at the origin who looks along
//! −Z. It is laid into the headset's stage, `stage_from_scene`, so that the table's top lies as far
//! below the eyes as it does for a grown person who sits or stands at a bench, and turned to where
//! she looks. A handle at its edge changes its height (`handle`), and recentring keeps that. Bodies, liquid, picture and recording are in the scene's stage: a recording holds what the steps
//! consumed, and a replay needs no placement. The track keeps it all the same, so that one can tell
//! where in the room the bench was.

use std::f32::consts::TAU;

use glam::{EulerRot, Quat, Vec3};
use vitriol_run::Action;
use vitriol_xr::{Pose, PoseFrame};

use super::handle::DROPS;

/// Height of the eyes above a table at which one sits, m: a seated grown person's eyes are some
/// 1.20 m above the floor (0.79 m above a seat of 0.42 m: NASA-STD-3000, eye height, sitting), a
/// table is 0.75 m high.
pub const SEATED: f32 = 0.45;
/// Height of the eyes above a bench at which one stands, m: eyes at 1.58 m (mean of men and women:
/// NASA-STD-3000, eye height, standing), a laboratory bench at 0.90 m.
pub const STANDING: f32 = 0.68;
/// Height of the eyes above the floor from which on the user is taken to stand, m: between tall people who sit and
/// small ones who stand.
const STANDS: f32 = 1.38;
/// Height of the table's top in a scene, real metres.
pub const SCENE_TABLE: f32 = 0.75;
/// How far a head may have gone while no frame was shown, m and rad, for the bench to stay: as far as one leans and looks
/// round. Farther off, someone else wears the headset, or the runtime has moved the stage.
const LEANT: f32 = 0.7;
const TURNED: f32 = 1.05;

/// Whether the user sits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Posture {
    /// By the height of the head above the floor; where the runtime knows no floor, seated
    #[default]
    Auto,
    /// At a table
    Seated,
    /// At a laboratory bench
    Standing,
}

/// Where the bench stands in the room, and where the user was in the last frame.
#[derive(Clone, Debug)]
pub struct Placement {
    posture: Posture,
    /// Height of the eyes above the table's top, m, where the user has chosen it by a handle.
    chosen: Option<f32>,
    /// `None` until the user has been seen.
    stage_from_scene: Option<Pose>,
    /// The last frame in the headset's stage, where this one's steps begin; `None` where that would be
    /// somewhere else: before the first frame, after a recentring and on another device.
    pub last: Option<PoseFrame>,
    /// Where the head was in the last frame that was shown, if some were not.
    interrupted: Option<Pose>,
    /// The bench stays where it is, wherever the head goes.
    fixed: bool,
}

impl Placement {
    /// Of a user who has not been seen yet.
    pub fn new(posture: Posture) -> Self {
        Self {
            posture,
            chosen: None,
            stage_from_scene: None,
            last: None,
            interrupted: None,
            fixed: false,
        }
    }

    /// Of an eye that goes round a bench, which stays where its scene has it.
    pub fn of_scene() -> Self {
        Self {
            stage_from_scene: Some(Pose::IDENTITY),
            fixed: true,
            ..Self::new(Posture::default())
        }
    }

    /// Whether the bench has a place.
    pub fn is_known(&self) -> bool {
        self.stage_from_scene.is_some()
    }

    /// The bench's place; the stage's origin as long as nobody has been seen.
    pub fn stage_from_scene(&self) -> Pose {
        self.stage_from_scene.unwrap_or(Pose::IDENTITY)
    }

    /// No frame is shown for a while, and the user goes on moving.
    pub fn interrupt(&mut self) {
        if let Some(last) = &self.last {
            self.interrupted.get_or_insert(last.stage_from_view);
        }
    }

    /// Lays the bench before the user where that is `asked`, where she has not been seen yet, and where she is elsewhere
    /// after an interruption. `Some` where, seen from the bench, the hands leap in the next step, with the action that a recording keeps of
    /// it; then the last frame is forgotten, since between it and the next one lies the leap.
    pub fn place(&mut self, now: &PoseFrame, asked: bool) -> Option<Action> {
        let interrupted = self.interrupted.take();
        let elsewhere = interrupted.is_some_and(|then| is_elsewhere(&then, &now.stage_from_view));
        if (!self.fixed && (asked || elsewhere)) || !self.is_known() {
            self.stage_from_scene = Some(before(&now.stage_from_view, self.posture, self.chosen));
        } else if interrupted.is_none() {
            return None;
        }
        self.last = None;
        Some(self.leap())
    }

    /// Moves the bench up by so much (m), as far as the table's top stays as far below the eyes as it may; further off
    /// than that it only comes nearer. `Some` where it moves: seen from the bench, the hands leap by as much in the next step.
    pub fn raise(&mut self, now: &PoseFrame, by: f32) -> Option<Action> {
        let placed = self.stage_from_scene.as_mut()?;
        let eyes = now.stage_from_view.position.y;
        let drop = eyes - placed.position.y - SCENE_TABLE;
        let [least, most] = [DROPS[0].min(drop), DROPS[1].max(drop)];
        let wanted = (drop - by).clamp(least, most);
        if !wanted.is_finite() || wanted == drop {
            return None;
        }
        placed.position.y = eyes - wanted - SCENE_TABLE;
        self.chosen = Some(wanted);
        Some(self.leap())
    }

    fn leap(&self) -> Action {
        Action::Leap(as_text(&self.stage_from_scene()))
    }

    /// The last frame, in the scene's stage.
    pub fn seen(&self) -> Option<PoseFrame> {
        let placed = self.stage_from_scene();
        self.last.as_ref().map(|last| in_scene(last, &placed))
    }
}

/// Whether a head has gone so far that the bench is to follow.
fn is_elsewhere(then: &Pose, now: &Pose) -> bool {
    let away = now.position.distance(then.position);
    let turned = (yaw_of(now) - yaw_of(then)).rem_euclid(TAU);
    away > LEANT || turned.min(TAU - turned) > TURNED
}

/// The angle about Y of where a head looks, or of where its top points if it looks straight down.
fn yaw_of(stage_from_view: &Pose) -> f32 {
    let ahead = stage_from_view.orientation * Vec3::NEG_Z;
    let up = stage_from_view.orientation * Vec3::Y;
    let level = if ahead.y.abs() < 0.99 {
        ahead
    } else {
        up * -ahead.y.signum()
    };
    (-level.x).atan2(-level.z)
}

/// `stage_from_scene` for a user whose head is at `stage_from_view`.
fn before(stage_from_view: &Pose, posture: Posture, chosen: Option<f32>) -> Pose {
    let head = stage_from_view.position;
    let stands = match posture {
        Posture::Auto => head.y > STANDS,
        Posture::Seated => false,
        Posture::Standing => true,
    };
    let usual = if stands { STANDING } else { SEATED };
    let drop = chosen.unwrap_or(usual);
    Pose::new(
        Vec3::new(head.x, head.y - drop - SCENE_TABLE, head.z),
        Quat::from_rotation_y(yaw_of(stage_from_view)),
    )
}

/// `frame` in the scene's stage.
pub fn in_scene(frame: &PoseFrame, stage_from_scene: &Pose) -> PoseFrame {
    let scene_from_stage = stage_from_scene.inverse();
    let moved = |stage_from_it: &Pose| {
        let pose = scene_from_stage.compose(stage_from_it);
        Pose::new(pose.position, pose.orientation.normalize())
    };
    let mut frame = frame.clone();
    frame.stage_from_view = moved(&frame.stage_from_view);
    for hand in &mut frame.hands {
        hand.stage_from_grip = moved(&hand.stage_from_grip);
        hand.stage_from_aim = moved(&hand.stage_from_aim);
    }
    frame
}

/// The bench's place as the text of [`Action::Leap`].
fn as_text(stage_from_scene: &Pose) -> String {
    let Vec3 { x, y, z } = stage_from_scene.position;
    let (yaw, _, _) = stage_from_scene.orientation.to_euler(EulerRot::YXZ);
    format!("{x} {y} {z} {yaw}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use vitriol_xr::Hand;

    fn head(y: f32, yaw: f32, pitch: f32) -> Pose {
        let turned = Quat::from_rotation_y(yaw) * Quat::from_rotation_x(pitch);
        Pose::new(Vec3::new(0.3, y, -0.2), turned)
    }

    #[test]
    fn the_bench_is_before_the_user_at_her_height() {
        for (y, posture, top) in [
            (1.20, Posture::Auto, 0.75),
            (1.60, Posture::Auto, 0.92),
            (1.60, Posture::Seated, 1.15),
            (1.20, Posture::Standing, 0.52),
            // A stage whose floor is unknown begins at the head.
            (0.0, Posture::Auto, -0.45),
        ] {
            for (yaw, pitch) in [(0.0, 0.0), (0.7, -0.6), (-2.5, 0.4), (3.0, -1.57)] {
                let placed = before(&head(y, yaw, pitch), posture, None);
                let table = placed.transform_point(Vec3::new(0.0, SCENE_TABLE, -0.4));
                assert!((table.y - top).abs() < 1e-5, "{y} {posture:?}: {table}");
                let ahead = Quat::from_rotation_y(yaw) * Vec3::NEG_Z * 0.4;
                let expected = Vec3::new(0.3 + ahead.x, top, -0.2 + ahead.z);
                // Straight down, the direction is what rounding leaves of it.
                assert!((table - expected).length() < 2e-3, "{table} {expected}");
            }
        }
    }

    /// An eye that goes round the bench does not take it along, nor after an interruption, nor where that is asked for.
    #[test]
    fn a_bench_of_the_scene_stays() {
        let mut placement = Placement::of_scene();
        for (far, asked) in [(0.0, false), (2.0, false), (0.0, true)] {
            placement.last = Some(seen(head(1.2, 0.0, 0.0)));
            if far > 0.0 {
                placement.interrupt();
            }
            placement.place(&seen(head(1.2 + far, 2.0, 0.0)), asked);
            assert_eq!(
                placement.stage_from_scene(),
                Pose::IDENTITY,
                "{far} {asked}"
            );
        }
    }

    fn seen(stage_from_view: Pose) -> PoseFrame {
        PoseFrame {
            stage_from_view,
            ..PoseFrame::default()
        }
    }

    #[test]
    fn the_bench_stays_unless_its_user_is_elsewhere_after_an_interruption() {
        let there = |x: f32, yaw: f32| {
            seen(Pose::new(
                Vec3::new(x, 1.2, 0.0),
                Quat::from_rotation_y(yaw),
            ))
        };
        // Across π too.
        for yaw in [0.0, 3.1] {
            let mut placement = Placement::new(Posture::Auto);
            let mut go = |x: f32, turned: f32, interrupt: bool, asked: bool| {
                if interrupt {
                    placement.interrupt();
                    placement.interrupt();
                }
                let now = there(x, yaw + turned);
                let leaps = placement.place(&now, asked).is_some();
                assert!(!leaps || placement.last.is_none());
                placement.last = Some(now);
                (leaps, placement.stage_from_scene().position.x)
            };
            assert_eq!(go(0.0, 0.0, true, false), (true, 0.0), "the first");
            assert_eq!(go(0.5, 0.0, false, false), (false, 0.0));
            assert_eq!(go(2.0, 2.0, false, false), (false, 0.0), "she walks");
            assert_eq!(go(2.5, 1.5, true, false), (true, 0.0), "she leans");
            assert_eq!(go(2.6, 1.5, false, false), (false, 0.0));
            assert_eq!(go(2.7, 1.5, false, true), (true, 2.7), "she asks");
            assert_eq!(go(4.0, 1.5, true, false), (true, 4.0), "another place");
            assert_eq!(go(4.1, 0.3, true, false), (true, 4.1), "another way");
            assert_eq!(go(4.2, -0.6, true, false), (true, 4.1));
        }
    }

    /// By as much as the hand moves, within its limits, and from beyond them only towards them. Recentring keeps it.
    #[test]
    fn the_bench_is_raised_within_reach() {
        let sits = |y: f32| seen(Pose::new(Vec3::Y * y, Quat::IDENTITY));
        let mut placement = Placement::new(Posture::Seated);
        assert!(placement.raise(&sits(1.2), 0.1).is_none(), "no bench yet");
        placement.place(&sits(1.2), false);
        placement.last = Some(sits(1.2));
        let mut raise = |eyes: f32, by: f32| {
            let leaps = placement.raise(&sits(eyes), by).is_some();
            assert!(placement.last.is_some(), "steps go on");
            let table = placement.stage_from_scene().position.y + SCENE_TABLE;
            (leaps, (1000.0 * (eyes - table)).round())
        };
        assert_eq!(raise(1.2, 0.1), (true, 350.0));
        assert_eq!(raise(1.2, 0.1), (true, 300.0));
        assert_eq!(raise(1.2, 0.1), (false, 300.0));
        assert_eq!(raise(1.2, f32::NAN), (false, 300.0));
        assert_eq!(raise(1.2, -2.0), (true, 800.0));
        // She gets up, and stoops.
        assert_eq!(raise(1.6, -0.1), (false, 1200.0));
        assert_eq!(raise(1.6, 0.1), (true, 1100.0));
        assert_eq!(raise(0.7, 0.1), (false, 200.0));
        assert_eq!(raise(0.7, -0.2), (true, 400.0));
        placement.place(&sits(1.1), true);
        let table = placement.stage_from_scene().position.y + SCENE_TABLE;
        assert!((table - 0.7).abs() < 1e-5, "{table}");
    }

    #[test]
    fn the_scene_sees_what_the_stage_sees() {
        let placed = before(&head(1.3, 1.0, 0.0), Posture::Auto, None);
        let hand = Hand {
            stage_from_grip: Pose::new(Vec3::new(0.1, 0.9, -0.5), Quat::from_rotation_z(0.4)),
            ..Hand::default()
        };
        let frame = PoseFrame {
            hands: [hand.clone(), Hand::default()],
            ..seen(head(1.3, 1.0, 0.0))
        };
        let seen = in_scene(&frame, &placed);
        let back = placed.compose(&seen.hands[0].stage_from_grip);
        assert!((back.position - hand.stage_from_grip.position).length() < 1e-6);
        assert!(back.orientation.dot(hand.stage_from_grip.orientation).abs() > 1.0 - 1e-6);
        // The head is over the scene's origin and looks along its −Z.
        let view = seen.stage_from_view;
        assert!(view.position.x.abs() < 1e-6 && view.position.z.abs() < 1e-6);
        assert!((view.orientation * Vec3::NEG_Z - Vec3::NEG_Z).length() < 1e-5);
    }
}
