//! Two handles at the table's near edge: the hand that grips one moves the bench up and down.
//!
//! The bench's place in the room changes and nothing in the scene does, so no liquid stirs. It moves while a hand holds the
//! handle and as that hand does, and never by itself: a world that moves about a person who did not move it makes her sick.

use glam::Vec3;
use vitriol_render::{Bone, Finish};
use vitriol_sim::bodies::{GRIP_CLOSES, GRIP_OPENS, GRIP_REACH};
use vitriol_sim::scene::Scene;
use vitriol_sim::world::World;
use vitriol_xr::{Hand, Pose, PoseFrame, Side};

/// Least and greatest height of the eyes above the table's top that a handle gives, m: a bench at the chest of someone who
/// sits low, and one at the hips of a tall person (eyes 0.83 m above the hips: NASA-STD-3000).
pub const DROPS: [f32; 2] = [0.3, 0.8];
/// What a hand moves at least, m, for the bench to move: a tracker at rest is as noisy.
const STIRS: f32 = 2e-4;
/// From the table's middle to a handle's, m, where the table is wide enough: beside the elbows.
const ASIDE: f32 = 0.30;
/// Half a bar's length, what it stands off from the edge, how far it is below the top, and its radius, m: a hand is 84 mm
/// broad (NASA-STD-3000) and closes round 25 mm with a thumb to spare.
const HALF_LENGTH: f32 = 0.06;
const OFF: f32 = 0.035;
const BELOW: f32 = 0.015;
const RADIUS: f32 = 0.010;
const POST: f32 = 0.006;

/// The handles of a bench, and who holds one.
#[derive(Debug, Default)]
pub struct Handles {
    held: Option<Held>,
    /// By hand, whether it is closed.
    closed: [bool; 2],
    /// Of the left and the right handle, whether a hand is at it.
    touched: [bool; 2],
}

#[derive(Clone, Copy, Debug)]
struct Held {
    side: Side,
    handle: usize,
    /// Height of the bench over the hand when it was taken, m; `None` where that is to be taken anew.
    over_hand: Option<f32>,
}

/// The middle of the left and the right bar in the scene's stage, real metres; `None` where there is no table.
pub fn middles(scene: &Scene) -> Option<[Vec3; 2]> {
    let table = scene.table?;
    let scale = scene.scale.length_scale;
    let [x, z] = table.centre.map(|at| (at * scale) as f32);
    let [width, depth] = table.size.map(|side| (side * scale) as f32);
    let top = (table.top * scale) as f32;
    let aside = ASIDE.min(0.5 * width - HALF_LENGTH).max(0.0);
    Some([-1.0, 1.0].map(|side| Vec3::new(x + side * aside, top - BELOW, z + 0.5 * depth + OFF)))
}

/// Distance of a place from a bar, m.
fn distance(middle: Vec3, at: Vec3) -> f32 {
    let away = at - middle;
    let along = away.x.clamp(-HALF_LENGTH, HALF_LENGTH);
    (away - along * Vec3::X).length() - RADIUS
}

impl Handles {
    /// Whether that hand holds a handle.
    pub fn is_held_by(&self, side: Side) -> bool {
        self.held.is_some_and(|held| held.side == side)
    }

    /// The bench was put elsewhere: who holds a handle goes on from there.
    pub fn leap(&mut self) {
        if let Some(held) = &mut self.held {
            held.over_hand = None;
        }
    }

    /// Takes in the hands of a frame, with the bench at `stage_from_scene`: how far up it moves, m, if it does.
    pub fn update(
        &mut self,
        now: &PoseFrame,
        stage_from_scene: &Pose,
        world: &World,
    ) -> Option<f32> {
        self.touched = [false; 2];
        let middles = middles(world.scene())?;
        let scene_from_stage = stage_from_scene.inverse();
        let scale = world.scene().scale.length_scale as f32;
        for side in Side::BOTH {
            let hand = now.hand(side);
            // Of a hand that is not seen nothing is known.
            if !(hand.active && hand.valid) {
                if self.is_held_by(side) {
                    self.leap();
                }
                continue;
            }
            let closes = self.closes(side, hand);
            let at = scene_from_stage.transform_point(hand.stage_from_grip.position);
            let busy = world.holds(side as usize);
            let reaches = |&n: &usize| distance(middles[n], at) <= GRIP_REACH;
            let near = (0..2)
                .filter(reaches)
                .find(|_| !busy && !world.is_in_reach(at / scale));
            if let Some(handle) = near {
                self.touched[handle] = true;
            }
            if (closes && self.held.is_none())
                && let Some(handle) = near
            {
                self.held = Some(Held {
                    side,
                    handle,
                    over_hand: None,
                });
            } else if self.is_held_by(side) && (busy || !self.closed[side as usize]) {
                self.held = None;
            }
        }
        self.follow(now, stage_from_scene)
    }

    /// Whether a hand closes in this frame; the same limits as of one that grips a flask.
    fn closes(&mut self, side: Side, hand: &Hand) -> bool {
        let squeeze = hand.squeeze.max(hand.trigger);
        let closed = &mut self.closed[side as usize];
        let was = *closed;
        *closed = squeeze >= if was { GRIP_OPENS } else { GRIP_CLOSES };
        *closed && !was
    }

    /// How far up the bench moves, m, to stay at the hand that holds it.
    fn follow(&mut self, now: &PoseFrame, stage_from_scene: &Pose) -> Option<f32> {
        let held = self.held.as_mut()?;
        self.touched[held.handle] = true;
        let hand = now.hand(held.side);
        if !(hand.active && hand.valid) {
            return None;
        }
        let (hand, bench) = (hand.stage_from_grip.position.y, stage_from_scene.position.y);
        let over_hand = *held.over_hand.get_or_insert(bench - hand);
        let by = hand + over_hand - bench;
        (by.abs() >= STIRS).then_some(by)
    }

    /// The bench is at `stage_from_scene` now: from there it goes on with the hand that holds it. So what a hand moves beyond a
    /// limit is forgotten, and the bench does not follow the head there.
    pub fn settle(&mut self, now: &PoseFrame, stage_from_scene: &Pose) {
        if let Some(held) = &mut self.held {
            let hand = now.hand(held.side).stage_from_grip.position.y;
            held.over_hand = Some(stage_from_scene.position.y - hand);
        }
    }

    /// Left and right handle as they are drawn, in the scene's stage.
    pub fn bones(&self, scene: &Scene) -> [Vec<Bone>; 2] {
        let Some(middles) = middles(scene) else {
            return [Vec::new(), Vec::new()];
        };
        [0, 1].map(|n| {
            let finish = match self.touched[n] {
                true => Finish::HandleAtHand,
                false => Finish::Handle,
            };
            let bone = |ends: [Vec3; 2], radius: f32| {
                Bone::new(finish, ends.map(|end| middles[n] + end), [radius; 2])
            };
            let end = HALF_LENGTH * Vec3::X;
            let post = |x: Vec3| bone([x, x + OFF * Vec3::NEG_Z], POST);
            let inner = 0.8 * end;
            vec![bone([-end, end], RADIUS), post(-inner), post(inner)]
        })
    }
}
