//! Mouse and keyboard before a bench whose bodies follow the hands rigidly, as those of the simulation do.

#![allow(clippy::unwrap_used, clippy::panic)]
use std::f32::consts::{FRAC_PI_2, TAU};

use glam::{Quat, Vec3};
use vitriol_xr::{Around, Hand, Kind, Pointed, Pose, Side, Thing};

use super::{Controls, Hands};

mod glass;
mod others;
mod time;
mod wear;

const EYE: Vec3 = Vec3::new(0.0, 1.2, 0.0);
const TABLE: f32 = 0.75;
/// Of the flasks of `two-flasks`: the one that is poured from, and the one into which.
const SOURCE: usize = 0;
const TARGET: usize = 1;

fn thing([radius, rim, height]: [f32; 3], pose: Pose, kind: Kind) -> Thing {
    Thing {
        pose,
        radius,
        rim,
        height,
        kind,
        grips: true,
    }
}

fn standing(sizes: [f32; 3], x: f32, z: f32) -> Thing {
    let pose = Pose::new(Vec3::new(x, TABLE, z), Quat::IDENTITY);
    thing(sizes, pose, Kind::Flask)
}

/// Two beakers and the panel behind them.
fn two_flasks() -> Around {
    Around {
        table: TABLE,
        things: vec![
            standing([0.036, 0.036, 0.095], -0.12, -0.40),
            standing([0.040, 0.040, 0.110], 0.12, -0.40),
        ],
        holds: [None; 2],
        panel: (
            Pose::new(Vec3::new(0.0, 1.16, -0.80), Quat::from_rotation_x(-0.12)),
            [0.72, 0.6075],
        ),
        scene: 0,
        pace: 1.0,
        longest: 0.1,
        gloves: [false; 2],
    }
}

/// A tool that lies along x with its lower end to the right, as a scene puts it.
fn lying([radius, height]: [f32; 2], middle: Vec3, kind: Kind) -> Thing {
    let turned = Quat::from_rotation_z(FRAC_PI_2);
    let pose = Pose::new(middle - 0.5 * height * (turned * Vec3::Y), turned);
    thing([radius, radius, height], pose, kind)
}

/// The bench, and the hands over it.
struct Bench {
    hands: Hands,
    around: Around,
    closed: [bool; 2],
    thing_from_grip: [Pose; 2],
    /// By hand, whether it has hold of the other's glove.
    pulls: [bool; 2],
    /// Highest speed, m/s, and acceleration, m/s², of a palm.
    limits: [f32; 2],
    /// Seconds from frame to frame, and those that count.
    dt: f32,
    counts: f32,
    controls: Controls,
    /// The hands of the last frame, and their palms in the frames before.
    now: [Hand; 2],
    before: Vec<[Vec3; 2]>,
}

impl Bench {
    fn new(around: Around, dt: f32) -> Self {
        let head = Pose::new(EYE, Quat::from_rotation_x(-0.44));
        Self {
            hands: Hands::new(&head, around.table),
            around,
            closed: [false; 2],
            thing_from_grip: [Pose::IDENTITY; 2],
            pulls: [false; 2],
            // 0.6 m/s and 3 m/s². A step's length and its rounding allow for a twentieth more.
            limits: [0.63, 3.15],
            dt,
            counts: dt.min(0.1),
            controls: Controls {
                ray: (EYE, Vec3::NEG_Z),
                right: Vec3::X,
                away: Vec3::NEG_Z,
                ..Controls::default()
            },
            now: [Hand::default(), Hand::default()],
            before: Vec::new(),
        }
    }

    /// One frame, and what is true in each.
    fn frame(&mut self) {
        self.now = self.hands.advance(&self.controls, &self.around, self.dt);
        self.forget_edges();
        self.follow();
        let palms = self.now.each_ref().map(|hand| {
            assert!(hand.stage_from_grip.is_valid(), "{hand:?}");
            assert!(hand.stage_from_aim.is_valid(), "{hand:?}");
            hand.stage_from_grip.position
        });
        self.before.push(palms);
        self.is_smooth();
        self.touches_nothing();
    }

    /// A frame in which no time passes: the hands are as they were.
    fn still(&mut self) {
        let now = self.hands.advance(&self.controls, &self.around, 0.0);
        self.forget_edges();
        assert_eq!(now, self.now);
    }

    fn forget_edges(&mut self) {
        for edge in [
            &mut self.controls.press,
            &mut self.controls.release,
            &mut self.controls.pointed,
            &mut self.controls.grip,
            &mut self.controls.other,
            &mut self.controls.panel_press,
            &mut self.controls.gloves,
        ] {
            *edge = false;
        }
        (self.controls.wheel, self.controls.tilt_drag) = (0.0, 0.0);
    }

    /// The bodies as the simulation has them: a hand takes what is within 5 cm as it closes.
    fn follow(&mut self) {
        for side in 0..2 {
            let hand = &self.now[side];
            let squeeze = hand.squeeze.max(hand.trigger);
            let was = self.closed[side];
            self.closed[side] = squeeze >= if was { 0.4 } else { 0.6 };
            let grip = hand.stage_from_grip;
            let palms = self.now.each_ref().map(|it| it.stage_from_grip.position);
            let palms_apart = palms[0].distance(palms[1]);
            if !self.closed[side] {
                self.pulls[side] = false;
                let let_go = self.around.holds[side].take();
                if let Some(n) = let_go {
                    let it = &mut self.around.things[n];
                    let middle = it.pose.transform_point(0.5 * it.height * Vec3::Y);
                    // Worn, within 0.15 m of the eyes, no hand can take them.
                    it.grips &= it.kind != Kind::Goggles || middle.distance(EYE) > 0.15;
                }
            } else if !was {
                let all = self.around.things.iter().enumerate();
                let near = all
                    .filter(|(_, it)| it.grips)
                    .map(|(n, it)| (n, apart(it, grip.position)))
                    .filter(|&(_, apart)| apart <= 0.05)
                    .min_by(|a, b| a.1.total_cmp(&b.1));
                self.around.holds[side] = near.map(|(n, _)| n);
                if let Some((n, _)) = near {
                    let pose = self.around.things[n].pose;
                    self.thing_from_grip[side] = pose.inverse().compose(&grip);
                }
                let gloved = self.around.gloves[1 - side];
                self.pulls[side] = near.is_none() && gloved && palms_apart <= 0.12;
            } else if self.pulls[side] && palms_apart > 0.22 {
                (self.pulls[side], self.around.gloves[1 - side]) = (false, false);
            }
            if let Some(n) = self.around.holds[side] {
                let it = &mut self.around.things[n];
                let pose = grip.compose(&self.thing_from_grip[side].inverse());
                it.pose = match it.kind {
                    Kind::Sash => Pose::new(
                        it.pose.position.with_y(pose.position.y),
                        it.pose.orientation,
                    ),
                    _ => pose,
                };
            }
        }
    }

    fn is_smooth(&self) {
        let [.., a, b, c] = self.before[..] else {
            return;
        };
        for side in 0..2 {
            let was = (b[side] - a[side]) / self.counts;
            let is = (c[side] - b[side]) / self.counts;
            assert!(is.length() <= self.limits[0], "{} m/s", is.length());
            let changes = (is - was).length() / self.counts;
            assert!(changes <= self.limits[1], "{changes} m/s²");
        }
    }

    /// No held glass is in the table or in other glass: by points on both surfaces, 3 mm apart and less.
    fn touches_nothing(&self) {
        for held in self.around.holds.into_iter().flatten() {
            let it = &self.around.things[held];
            if it.kind == Kind::Rod {
                self.is_in_the_mouth(it);
            }
            if !it.is_flask() {
                continue;
            }
            let lowest = surface(it).fold(f32::INFINITY, |low, at| low.min(at.y));
            assert!(lowest > TABLE - 2e-4, "{} m in the table", TABLE - lowest);
            for (n, other) in self.around.things.iter().enumerate() {
                if n != held && other.is_flask() {
                    let depth = |of: &Thing, within: &Thing| {
                        let depths = surface(of).map(|at| apart(within, at));
                        depths.fold(f32::INFINITY, f32::min)
                    };
                    let nearest = depth(it, other).min(depth(other, it));
                    assert!(nearest > -1e-4, "{nearest} m from the glass {n}");
                }
            }
        }
    }

    /// What of a rod is between foot and rim of a flask is in its mouth or beside it.
    fn is_in_the_mouth(&self, rod: &Thing) {
        for n in 0..=100 {
            let at = rod
                .pose
                .transform_point(0.01 * n as f32 * rod.height * Vec3::Y);
            for flask in self.around.things.iter().filter(|it| it.is_flask()) {
                let at = flask.pose.inverse().transform_point(at);
                let out = at.x.hypot(at.z);
                let level = (0.0..flask.height).contains(&at.y);
                let within = out <= flask.rim - rod.radius;
                assert!(!level || within || out >= flask.radius + rod.radius, "{at}");
            }
        }
    }

    fn wait(&mut self, seconds: f32) {
        for _ in 0..(seconds / self.counts).ceil() as usize {
            self.frame();
        }
    }

    fn point(&mut self, at: Vec3) {
        self.controls.ray = (EYE, (at - EYE).normalize());
        self.controls.pointed = true;
        self.frame();
    }

    /// The pointer goes from place to place in a second.
    fn drag(&mut self, from: Vec3, to: Vec3) {
        let frames = (1.0 / self.counts).ceil() as usize;
        for n in 1..=frames {
            self.point(from.lerp(to, n as f32 / frames as f32));
        }
    }

    fn press(&mut self) {
        (self.controls.press, self.controls.pressed) = (true, true);
        self.frame();
    }

    fn release(&mut self) {
        (self.controls.release, self.controls.pressed) = (true, false);
        self.frame();
    }

    fn click(&mut self) {
        self.press();
        self.release();
    }

    fn grip(&mut self) {
        self.controls.grip = true;
        self.frame();
    }

    /// Points at a place, and waits until a hand is there.
    fn go_to(&mut self, at: Vec3) {
        self.point(at);
        self.wait(3.0);
    }

    /// Takes hold of what is at that place with the main button, which stays down.
    fn take_at(&mut self, at: Vec3) {
        self.go_to(at);
        self.press();
        self.wait(1.0);
    }

    fn take(&mut self) {
        self.take_at(at_source());
        assert_eq!(self.around.holds, [None, Some(SOURCE)]);
    }

    fn tilt(&mut self, keys: f32, seconds: f32) {
        self.controls.tilt = keys;
        self.wait(seconds);
        self.controls.tilt = 0.0;
        self.wait(0.5);
    }

    fn up(&self, thing: usize) -> Vec3 {
        self.around.things[thing].pose.orientation * Vec3::Y
    }

    /// That it stands on the table, within 2 mm and a degree, and no hand holds it.
    fn stands(&self, thing: usize) {
        let foot = self.around.things[thing].pose.position.y - TABLE;
        assert!(foot.abs() < 0.002, "{foot} m over the table");
        assert!(self.up(thing).y > 0.9998, "{}", self.up(thing));
        assert!(!self.around.holds.contains(&Some(thing)));
    }
}

/// How far a point is from a cylinder along its axis or across it, m; negative within.
fn apart(it: &Thing, point: Vec3) -> f32 {
    let at = it.pose.inverse().transform_point(point);
    let across = at.x.hypot(at.z) - it.radius;
    across.max(at.y - it.height).max(-at.y)
}

/// Points on the outside of a closed cylinder.
fn surface(it: &Thing) -> impl Iterator<Item = Vec3> {
    let (pose, radius, height) = (it.pose, it.radius, it.height);
    let point = move |n: usize, share: [f32; 2]| {
        let (sin, cos) = (TAU * n as f32 / 80.0).sin_cos();
        let out = share[0] * radius;
        pose.transform_point(Vec3::new(out * cos, share[1] * height, out * sin))
    };
    let shares = (0..=40).flat_map(|n| {
        let share = n as f32 / 40.0;
        [[1.0, share], [share, 0.0], [share, 1.0]]
    });
    shares.flat_map(move |share| (0..80).map(move |n| point(n, share)))
}

fn at_source() -> Vec3 {
    Vec3::new(-0.12, TABLE + 0.05225, -0.40)
}

fn at_target() -> Vec3 {
    Vec3::new(0.12, TABLE + 0.05225, -0.40)
}

/// Sixty frames a second, and two.
const RATES: [f32; 2] = [1.0 / 60.0, 0.5];
