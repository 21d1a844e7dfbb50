//! What a hand holds: carried over all that is in the way, tilted, and put down.

use std::f32::consts::FRAC_PI_2;

use glam::{Quat, Vec2, Vec3};
use vitriol_xr::{Around, Kind, Pose};

use super::motion::{Motion, SPEED, turn_between};
use super::obstacles::{Bench, Clear, Shape, UPRIGHT, axis, level, slides};

mod steering;
mod swirl;

pub(super) use steering::Drag;
use swirl::Swirl;

/// Distances that a carried body keeps, m: our choice. Beside glass it covers what a hand that turns off its way needs.
const CARRIED: Clear = Clear {
    table: 0.02,
    glass: 0.03,
    aside: 0.015,
};
/// The same over glass while it is tilted: a pour falls no further than it must.
const TILTED_GLASS: f32 = 0.01;
/// Tilt from which on all of that holds, rad.
const TILTED: f32 = 0.25 * FRAC_PI_2;
/// How far over the table a cloth is moved, which wipes it, m; and how far from what it must not touch a body is at least.
const WIPES: f32 = 0.001;
/// The share of the distances that is enough to go on sideways while it still rises.
const ENOUGH: f32 = 0.4;
/// Speed at which something is put down, m/s.
const SINKS: f32 = 0.15;
/// How far over the table the foot stops, and from where on it stands, m.
const STOPS: f32 = 0.0005;
const STANDS: f32 = 0.0013;
/// A sideways way or a tilt (m, rad) from which on a body leaves the table.
const STIRS: f32 = 0.005;
/// How far a sash goes up from where its bar lies on the table, m (`SASH_TRAVEL` of `bodies`).
const SASH: f32 = 0.55;
/// Distance from the eyes, m, at which goggles are let go where they were dragged there, and where a click brought them there: less
/// than that in which they are put on (0.15 m, `bodies::wear`), however they are turned.
const WORN: f32 = 0.12;
const AT_EYES: f32 = 0.03;
/// Time in which a motion is looked ahead as it brakes, s, and how many times.
const BRAKE: f32 = 0.02;
const BRAKES: usize = 16;
/// Turn that is looked ahead, rad: more than a turn at full speed takes to stop.
const AHEAD: f32 = 0.2;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Putting {
    /// Goggles go to the eyes, so that the point by which they are held is there.
    Wearing(Vec3),
    /// It turns as it is to stand or lie.
    Turning,
    /// It sinks.
    Lowering,
}

/// How a body fares in a hand that puts it down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fares {
    /// It is held.
    Held,
    /// There is no place under it: it is held, and nobody moves it.
    Refused,
    /// It stands: the hand may open.
    Stands,
}

/// A body in a hand.
pub(super) struct Held {
    /// Its index.
    pub thing: usize,
    /// Whether the main button drags it.
    pub dragged: bool,
    /// Whether the pointer moves it without a button.
    pub follows: bool,
    kind: Kind,
    slides: bool,
    radius: f32,
    shape: Shape,
    /// From its foot along its axis to the held point, m.
    centre: f32,
    height: f32,
    thing_from_grip: Pose,
    clear: Clear,
    /// The held point, and the thing's orientation.
    motion: Motion,
    upright: Quat,
    laid: Quat,
    /// Whether it lies down as it was, once it is put down: a flask is put down upright.
    lays: bool,
    drag: Drag,
    /// Where it is to be, from above, m; of a sash, how high.
    aim: Vec2,
    slid: f32,
    /// Height of the held point that clears what is in the way, m, and the height over that.
    cleared: f32,
    lift: f32,
    /// Tilt to the left as the user sees it, rad, about an axis that looks at the user.
    tilt: f32,
    towards: Vec3,
    turning: bool,
    walking: bool,
    /// It has left its place.
    moved: bool,
    putting: Option<Putting>,
    swirl: Swirl,
}

impl Held {
    /// The body of that index, as a hand with this grip pose has taken it.
    pub fn new(around: &Around, thing: usize, grip: &Pose, drag: Drag) -> Option<Self> {
        let it = around.things.get(thing).filter(|it| it.pose.is_valid())?;
        let thing_from_grip = it.pose.inverse().compose(grip);
        let centre = thing_from_grip.position.y.clamp(0.0, it.height.max(0.0));
        let laid = it.pose.orientation.normalize();
        let at = it.pose.position + centre * (laid * Vec3::Y);
        let mut clear = CARRIED;
        if it.kind == Kind::Cloth {
            clear.table = WIPES;
        }
        Some(Self {
            thing,
            dragged: false,
            follows: false,
            kind: it.kind,
            slides: slides(it),
            radius: it.radius,
            shape: Shape::of(it, centre),
            centre,
            height: it.height,
            thing_from_grip,
            clear,
            motion: Motion::at(Pose::new(at, laid)),
            upright: (Quat::from_rotation_arc(axis(it), Vec3::Y) * laid).normalize(),
            laid,
            lays: false,
            drag,
            aim: level(at),
            slid: at.y,
            cleared: at.y,
            lift: 0.0,
            tilt: 0.0,
            towards: Vec3::Z,
            turning: false,
            walking: false,
            moved: false,
            putting: None,
            swirl: Swirl::default(),
        })
    }

    /// Its pose (stage_from_thing).
    pub fn pose(&self) -> Pose {
        let Pose {
            position,
            orientation,
        } = self.motion.pose;
        Pose::new(
            position + self.swirl.offset() - self.centre * (orientation * Vec3::Y),
            orientation,
        )
    }

    /// The pose of the hand (stage_from_grip).
    pub fn grip(&self) -> Pose {
        self.pose().compose(&self.thing_from_grip)
    }

    /// The motion of the hand.
    pub fn hand(&self) -> Motion {
        let pose = self.grip();
        let arm = pose.position - self.motion.pose.position;
        Motion {
            pose,
            velocity: self.motion.velocity + self.motion.spin.cross(arm),
            spin: self.motion.spin,
        }
    }

    /// Whether it is put down now.
    pub fn is_put_down(&self) -> bool {
        self.putting.is_some()
    }

    /// Begins to put it down, if it is not put down already.
    pub fn put_down(&mut self, around: &Around, eyes: Vec3) -> Fares {
        let goggles = self.kind == Kind::Goggles;
        let middle = self.pose().transform_point(0.5 * self.height * Vec3::Y);
        if self.slides || (goggles && middle.distance(eyes) < WORN) {
            return Fares::Stands;
        }
        if goggles && self.putting.is_none() && !self.leaves_its_place() {
            self.moved = true;
            let middle = (0.5 * self.height - self.centre) * Vec3::Y;
            self.putting = Some(Putting::Wearing(eyes - middle));
        }
        if self.putting.is_none() {
            self.stop();
            self.tilt = 0.0;
            self.turning = false;
            let laid = self.laid * Vec3::Y;
            self.lays = self.kind != Kind::Flask && laid.y.abs() < 0.99;
            // What was taken only to be steadied stands.
            let stands = !self.moved || self.is_resting(around);
            self.putting = Some(match stands {
                true => Putting::Lowering,
                false => Putting::Turning,
            });
        }
        Fares::Held
    }

    /// Whether it was moved, or is asked to.
    fn leaves_its_place(&self) -> bool {
        let aside = level(self.motion.pose.position).distance(self.aim) > STIRS;
        let asked = self.lift != 0.0 || self.tilt.abs() > STIRS || self.swirl.wanted;
        self.moved || aside || asked
    }

    fn is_resting(&self, around: &Around) -> bool {
        let points = self.shape.turned(self.motion.pose.orientation);
        let bench = Bench::resting(around, self.thing);
        let at = self.motion.pose.position;
        let upright = turn_between(self.motion.pose.orientation, self.down()).length() < 0.02;
        upright && at.y < bench.floor(&points, level(at), &Clear::RESTING) + STANDS
    }

    /// The orientation in which it is put down.
    fn down(&self) -> Quat {
        if self.lays || !self.moved {
            self.laid
        } else {
            self.upright
        }
    }

    fn wanted(&self) -> Quat {
        if self.putting.is_some() || !self.moved {
            return self.down();
        }
        (Quat::from_axis_angle(self.towards, self.tilt) * self.upright).normalize()
    }

    /// The distances that it keeps now, m.
    fn kept(&self) -> Clear {
        let share = (self.tilt_now().abs() / TILTED).clamp(0.0, 1.0);
        Clear {
            glass: self.clear.glass + share * (TILTED_GLASS - self.clear.glass),
            aside: self.clear.aside + self.swirl.room(),
            ..self.clear
        }
    }

    /// The distances below which it never goes, with so much room aside, m.
    fn hard(room: f32) -> Clear {
        Clear {
            aside: Clear::HARD.aside + room,
            ..Clear::HARD
        }
    }

    /// The swirl goes on: it begins as soon as the flask has left the table and has room.
    fn go_round(&mut self, around: &Around, h: f32) {
        if !self.swirl.is_on() {
            return;
        }
        let Pose {
            position,
            orientation,
        } = self.motion.pose;
        let clear = Clear {
            table: 0.5 * WIPES,
            ..Self::hard(self.swirl.room())
        };
        let points = self.shape.turned(orientation);
        let floor = Bench::carrying(around, self.thing).floor(&points, level(position), &clear);
        let upright = (orientation * Vec3::Y).y > UPRIGHT;
        self.swirl.step(upright && position.y >= floor, h);
    }

    /// Moves it for `h` seconds.
    pub fn step(&mut self, around: &Around, h: f32) -> Fares {
        if self.slides {
            let bar = around.things.get(self.thing).map_or(0.0, |it| it.radius);
            let low = around.table + bar;
            self.slid = self.slid.clamp(low, low + SASH);
            let now = self.motion.pose;
            let target = Pose::new(now.position.with_y(self.slid), now.orientation);
            self.motion = self.motion.towards(&target, SPEED, h);
            return Fares::Held;
        }
        self.moved |= self.putting.is_none() && self.leaves_its_place();
        self.go_round(around, h);
        if self.putting.is_none() && !self.moved {
            self.motion = self.motion.braked(h);
            return Fares::Held;
        }
        if self.putting == Some(Putting::Lowering) {
            return self.lower(around, h);
        }
        self.carry(around, h);
        if let Some(Putting::Wearing(at)) = self.putting {
            let near = self.motion.pose.position.distance(at) < AT_EYES;
            return match near && self.motion.is_slow() {
                true => Fares::Stands,
                false => Fares::Held,
            };
        }
        let apart = turn_between(self.motion.pose.orientation, self.down()).length();
        if self.putting == Some(Putting::Turning) && apart < 0.01 && self.motion.turns_no_more() {
            let points = self.shape.turned(self.motion.pose.orientation);
            let place = level(self.motion.pose.position);
            if !Bench::resting(around, self.thing).is_free(&points, place) {
                self.putting = None;
                self.lays = false;
                self.leave();
                return Fares::Refused;
            }
            self.putting = Some(Putting::Lowering);
        }
        Fares::Held
    }

    fn carry(&mut self, around: &Around, h: f32) {
        let bench = Bench::carrying(around, self.thing);
        let now = self.motion.pose;
        let at = level(now.position);
        let aim = match (self.putting, self.kind) {
            (Some(Putting::Wearing(at)), _) => level(at),
            (_, Kind::Rod) => bench.within_mouth(self.pose().position, self.aim, self.radius),
            _ => self.aim,
        };
        let wanted = self.wanted();
        let ahead = now.orientation.rotate_towards(wanted, AHEAD);
        let here = self.shape.turned(now.orientation);
        let soon = self.shape.turned(ahead);
        let kept = self.kept();
        // As it turns: with what it keeps now and will keep then.
        let clears = bench
            .path(&here, at, aim, &kept)
            .max(bench.path(&soon, at, aim, &kept));
        let roomy = Self::hard(self.swirl.room());
        let least = bench
            .floor(&here, at, &roomy)
            .max(bench.floor(&soon, at, &roomy));
        self.lift = self.lift.max(WIPES - kept.table);
        // What is tilted does not sink by itself: keys that are tapped bring it over a rim bit by bit, and a pour is left where it is.
        let stays = self.putting.is_none() && self.tilt_now().abs() > TILTED;
        self.cleared = if stays {
            clears.max(self.cleared)
        } else {
            clears
        };
        let mut height = (self.cleared + self.lift).max(least + WIPES);
        if let Some(Putting::Wearing(at)) = self.putting {
            height = height.max(at.y);
        }
        // What the user lowered is carried on as low as that.
        let low = |kept: f32, least: f32| {
            let lowered = kept + self.lift - 0.5 * WIPES;
            (ENOUGH * kept).min(lowered.max(least))
        };
        let enough = Clear {
            table: low(kept.table, Clear::HARD.table),
            glass: low(kept.glass, Clear::HARD.glass),
            ..kept
        };
        let free = bench.farthest(&here, [at, aim], now.position.y, &enough);
        let turns = now.position.y >= least;
        let target = Pose::new(
            Vec3::new(free.x, height, free.y),
            if turns { wanted } else { now.orientation },
        );
        // It rises, at least.
        let rises = Pose::new(now.position.with_y(height), now.orientation);
        let hard = Self::hard(self.swirl.radius());
        let depth = |pose: &Pose| {
            let points = self.shape.turned(pose.orientation);
            bench.floor(&points, level(pose.position), &hard) - pose.position.y
        };
        let allowed = depth(&now).max(1e-4);
        let found = [target, rises]
            .iter()
            .map(|target| self.motion.towards(target, SPEED, h))
            .find(|motion| stops_free(motion, allowed, depth));
        self.motion = found.unwrap_or_else(|| self.motion.braked(h));
    }

    fn lower(&mut self, around: &Around, h: f32) -> Fares {
        if self.swirl.is_on() {
            self.motion = self.motion.braked(h);
            return Fares::Held;
        }
        let now = self.motion.pose;
        let bench = Bench::resting(around, self.thing);
        let points = self.shape.turned(now.orientation);
        let at = level(now.position);
        let floor = bench.floor(&points, at, &Clear::RESTING);
        // What stands there already is not lifted.
        let height = (floor + STOPS).min(now.position.y.max(floor));
        let target = Pose::new(Vec3::new(at.x, height, at.y), self.down());
        self.motion = self.motion.towards(&target, SINKS, h);
        let still = self.motion.is_still();
        if still && self.motion.pose.position.y < floor + STANDS {
            Fares::Stands
        } else {
            Fares::Held
        }
    }
}

/// Whether a motion that brakes from here on stays out of everything: so there is always a way to stop. `depth` is how deep it is in
/// something, m; it may be as deep as `allowed`, since what a hand takes may touch its neighbour.
fn stops_free(motion: &Motion, allowed: f32, depth: impl Fn(&Pose) -> f32) -> bool {
    let mut motion = *motion;
    for _ in 0..BRAKES {
        if depth(&motion.pose) > allowed {
            return false;
        }
        if motion.velocity == Vec3::ZERO && motion.spin == Vec3::ZERO {
            break;
        }
        motion = motion.braked(BRAKE);
    }
    true
}
