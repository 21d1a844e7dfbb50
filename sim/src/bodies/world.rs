//! The world of bodies and its fixed step.

use glam::Vec3;
use rapier3d::prelude::{PhysicsWorld, RigidBodyType};
use serde::{Deserialize, Serialize};

use super::body::Body;
use super::build::{self, SUBSTEPS};
use super::coupling::{self, PastPoses};
use super::grip::{self, GRIP_REACH, GripState, RELEASE_SPEED_MAX, RELEASE_SPIN_MAX};
use super::reach;
use super::rolling;
use super::shards::{BREAKS_AT, Break, Breakage, NOWHERE, Shard};
use super::spec::Worn;
use super::spec::{BodiesError, BodiesSpec, Hand, Load, Role, Velocity};
use super::strikes::{Memory, Strike, Strikes};
use super::units::Units;
use super::wear::Wearing;
use crate::pose::Pose;

/// Speed (m/s, at real size) above which a held flask's motion is a leap of the
/// tracker. A leap takes no time: nothing in between is struck, and the flask's contents go with it.
const HELD_SPEED_MAX: f32 = 20.0;

/// Highest speed (m/s, at real size) of a sash: as a hand pulls one. Our choice.
const SASH_SPEED_MAX: f32 = 2.0;

/// A leap of a held flask.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leap {
    /// Which flask.
    pub flask: usize,
    /// Rigid motion from the pose before the leap to the one after it, both in the stage.
    pub after_from_before: Pose,
}

/// State of the world that is not rapier's.
#[derive(Clone, Serialize, Deserialize)]
struct State {
    grips: [GripState; 2],
    past: Vec<PastPoses>,
    /// Whether the hands leap before the next step.
    hands_leap: bool,
    wearing: Wearing,
    glass: Breakage,
}

/// Flasks, table and floor under rapier, and the hands that grip the flasks.
///
/// Advanced by one simulation step at a time with that step's inputs; the same
/// inputs give the same bits, on every platform (rapier's
/// `enhanced-determinism`), and so does a world [restored](Bodies::restore)
/// from a [snapshot](Bodies::snapshot).
pub struct Bodies {
    rapier: PhysicsWorld,
    /// The flasks, then the tools.
    flasks: Vec<Body>,
    /// How many are flasks.
    count: usize,
    state: State,
    poses: Vec<Pose>,
    /// See [`Bodies::set_head`].
    head: Option<Pose>,
    leaps: Vec<Leap>,
    breaks: Vec<Break>,
    strikes: Strikes,
    gravity: Vec3,
    step: f32,
    units: Units,
    length_scale: f32,
}

impl Bodies {
    /// Builds the world.
    ///
    /// # Errors
    /// [`BodiesError::World`] and [`BodiesError::Flask`] name the value that is out of range.
    pub fn new(spec: &BodiesSpec) -> Result<Self, BodiesError> {
        let (rapier, flasks) = build::build(spec)?;
        let tools = spec.tools.iter().map(|it| &it.body);
        let all = spec.flasks.iter().chain(tools);
        let poses: Vec<Pose> = all.map(|body| body.stage_from_flask).collect();
        Ok(Self {
            rapier,
            flasks,
            count: spec.flasks.len(),
            state: State {
                grips: [GripState::default(); 2],
                past: poses.iter().map(|&pose| [pose; 4]).collect(),
                hands_leap: false,
                wearing: Wearing::of(spec.worn),
                glass: Breakage::of(poses.len()),
            },
            poses,
            head: None,
            leaps: Vec::new(),
            breaks: Vec::new(),
            strikes: Strikes::new(spec),
            gravity: spec.gravity,
            step: spec.step,
            units: Units::new(spec.length_scale),
            length_scale: spec.length_scale,
        })
    }

    /// Sets the pose of the middle between the user's eyes from the next step on; the user looks along −z. `None`, or a pose that is not
    /// [valid](Pose::is_valid), stands for a head that is not tracked. Only goggles use it.
    pub fn set_head(&mut self, head: Option<Pose>) {
        self.head = head.filter(|head| head.is_valid());
    }

    /// Advances by one simulation step.
    ///
    /// `loads` has one entry per flask, or fewer where the rest bear none; that
    /// of a held or fixed flask is not read. A flask that is let go in
    /// this step already falls in it.
    pub fn step(&mut self, hands: &[Hand; 2], loads: &[Load]) {
        let reach = GRIP_REACH * self.length_scale;
        self.take_breaks();
        let grips = &mut self.state.grips;
        grip::advance(grips, hands, &self.flasks, &self.poses, reach);
        let all = (&self.flasks[..], &self.poses[..]);
        let wearing = &mut self.state.wearing;
        wearing.advance((grips, hands), self.head, all, self.length_scale);
        self.strikes.begin();
        self.take_leaps();
        for index in 0..self.flasks.len() {
            let load = coupling::checked(loads.get(index).copied().unwrap_or_default());
            if self.target(index).is_some() {
                self.hold(index);
            } else if !self.flasks[index].fixed && !self.is_broken(index) {
                self.free(index, &load);
            }
        }
        for substep in 1..=SUBSTEPS {
            self.move_held(substep as f32 / SUBSTEPS as f32);
            self.rapier.step();
            let flasks = &self.flasks[..self.count];
            self.strikes.take(&self.rapier, flasks, self.units);
        }
        self.read_poses();
        if self.state.glass.on {
            let least = BREAKS_AT * self.length_scale;
            let hard = self.strikes.found.iter().filter(|it| it.speed >= least);
            let struck = hard.flat_map(|it| [Some(it.flask), it.other]).flatten();
            let breaks = struck.filter(|&flask| !self.flasks[flask].fixed);
            self.state.glass.struck.extend(breaks);
        }
    }

    /// `stage_from_flask` of every flask after the last step.
    pub fn poses(&self) -> &[Pose] {
        &self.poses[..self.count]
    }

    /// `stage_from_tool` of every tool after the last step.
    pub fn tools(&self) -> &[Pose] {
        &self.poses[self.count..]
    }

    /// `stage_from_tool` of every tool before the last step.
    pub fn tools_before(&self) -> impl Iterator<Item = Pose> {
        self.state.past[self.count..].iter().map(|past| past[1])
    }

    /// The hand that holds a tool.
    pub fn tool_holder(&self, tool: usize) -> Option<usize> {
        self.holder(self.count + tool)
    }

    /// Goggles and gloves that the user wears.
    pub fn worn(&self) -> Worn {
        self.state.wearing.worn
    }

    /// Prescribed pose of a body at the step's end, which replaces rapier's: in a hand, on the head, or where a sash was slid. `None` for a
    /// body that moves freely.
    fn target(&self, index: usize) -> Option<Pose> {
        if let Some(Role::Sash { heights, .. }) = self.flasks.get(index)?.role {
            let before = *self.poses.get(index)?;
            let height = grip::slid(&self.state.grips, index).unwrap_or(before.position.y);
            // A hand that leaps drags it after, and throws nothing about with it.
            let most = SASH_SPEED_MAX * self.length_scale * self.step;
            let way = (height - before.position.y).clamp(-most, most);
            let height = (before.position.y + way).clamp(heights[0], heights[1]);
            let position = before.position.with_y(height);
            return Some(Pose::new(position, before.orientation));
        }
        let held = grip::holder(&self.state.grips, index).map(|(_, pose)| pose);
        held.or_else(|| self.state.wearing.place(self.flasks.get(index)?))
    }

    /// Declares that between the last step and the next the hands do not move to where they are: the bodies that they hold leap. Without
    /// this call, a held body leaps where its hand was absent before, and where it would move faster than hands do.
    pub fn hands_leap(&mut self) {
        self.state.hands_leap = true;
    }

    /// Held flasks that leapt in the last step.
    pub fn leaps(&self) -> &[Leap] {
        &self.leaps
    }

    /// Blows of the last step.
    pub fn strikes(&self) -> &[Strike] {
        &self.strikes.found
    }

    /// Whether flasks break by blows of [`BREAKS_AT`] and more from the next step on; they do not from the start.
    pub fn set_breakable(&mut self, on: bool) {
        self.state.glass.on = on;
        if !on {
            self.state.glass.struck.clear();
        }
    }

    /// Whether flasks break.
    pub fn is_breakable(&self) -> bool {
        self.state.glass.on
    }

    /// Flasks that broke in the last step. Their poses are [`NOWHERE`] from then on, and no hand holds them.
    pub fn breaks(&self) -> &[Break] {
        &self.breaks
    }

    /// Whether a flask has broken.
    pub fn is_broken(&self, flask: usize) -> bool {
        self.state.glass.broken.get(flask) == Some(&true)
    }

    /// Shards of the flasks that have broken.
    pub fn shards(&self) -> Vec<Shard> {
        self.state.glass.shards(&self.rapier, self.units)
    }

    /// The velocity of a flask: of a held one by its last two poses. `None` where there
    /// is no such flask, and of one that is broken.
    pub fn velocity(&self, flask: usize) -> Option<Velocity> {
        if self.is_broken(flask) {
            return None;
        }
        let body = self.rapier.bodies.get(self.flasks.get(flask)?.body)?;
        if self.holder(flask).is_some() {
            let past = &self.state.past[flask];
            let (linear, angular) = grip::velocity_between(past[1], past[0], Vec3::ZERO, self.step);
            return Some(Velocity { linear, angular });
        }
        Some(Velocity {
            linear: self.units.to_si(body.velocity_at_point(body.translation())),
            angular: body.angvel(),
        })
    }

    /// The hand (index into the hands of [`step`](Self::step)) that holds a flask.
    pub fn holder(&self, flask: usize) -> Option<usize> {
        grip::holder(&self.state.grips, flask).map(|(hand, _)| hand)
    }

    /// Distance (m) of a point of the stage from the outer surface, closed at the rim, of a flask or, counted behind the flasks, a tool;
    /// negative within. `None` of a body that no hand can grip, of a broken flask, and of an index without a body.
    pub fn distance(&self, flask: usize, point: Vec3) -> Option<f32> {
        let shape = self.flasks.get(flask).filter(|shape| !shape.fixed)?;
        if self.is_broken(flask) {
            return None;
        }
        let flask_from_stage = self.poses.get(flask)?.inverse();
        let point = flask_from_stage.transform_point(point);
        Some(reach::signed_distance(&shape.outline, point))
    }

    /// The whole state as bytes, for [`restore`](Self::restore).
    ///
    /// # Errors
    /// [`BodiesError::Snapshot`] where memory does not suffice.
    pub fn snapshot(&self) -> Result<Vec<u8>, BodiesError> {
        postcard::to_allocvec(&(&self.rapier, &self.state, &self.strikes.memory))
            .map_err(|error| BodiesError::Snapshot(error.to_string()))
    }

    /// Takes up a snapshot of a world that was made from the same
    /// [`BodiesSpec`]; the steps that follow have the bits that they would have
    /// had without the interruption.
    ///
    /// # Errors
    /// [`BodiesError::Snapshot`] or [`BodiesError::OtherWorld`]; the world is then as before.
    pub fn restore(&mut self, snapshot: &[u8]) -> Result<(), BodiesError> {
        let (rapier, state, strikes): (PhysicsWorld, State, Memory) =
            postcard::from_bytes(snapshot)
                .map_err(|error| BodiesError::Snapshot(error.to_string()))?;
        let count = self.flasks.len();
        let same = state.past.len() == count
            && state.glass.is_of(count)
            && strikes.is_of(self.count)
            && self
                .flasks
                .iter()
                .all(|flask| rapier.bodies.contains(flask.body));
        if !same {
            return Err(BodiesError::OtherWorld {
                found: state.past.len(),
                expected: self.flasks.len(),
            });
        }
        self.poses = state.past.iter().map(|past| past[0]).collect();
        self.rapier = rapier;
        self.state = state;
        self.strikes.memory = strikes;
        // They belong to steps of the state before.
        self.strikes.begin();
        self.leaps.clear();
        self.breaks.clear();
        Ok(())
    }

    /// Makes a gripped flask follow its hand, if it does not yet.
    fn hold(&mut self, index: usize) {
        if let Some(body) = self.rapier.bodies.get_mut(self.flasks[index].body)
            && body.is_dynamic()
        {
            body.set_body_type(RigidBodyType::KinematicPositionBased, true);
            body.reset_forces(false);
            body.reset_torques(false);
        }
    }

    /// Makes a flask free if a hand has just let it go, and applies its load to it.
    fn free(&mut self, index: usize, load: &Load) {
        let flask = &self.flasks[index];
        let past = &self.state.past[index];
        let units = self.units;
        let loaded = coupling::loaded_mass(flask.glass, load);
        let Some(body) = self.rapier.bodies.get_mut(flask.body) else {
            return;
        };
        if flask.role.is_some() && body.is_dynamic() {
            return;
        }
        let (linear, angular) = if body.is_dynamic() {
            // rapier's velocity is that of the centre of mass, which the liquid moves.
            let centre = past[0].transform_point(loaded.local_com);
            (body.velocity_at_point(units.vector(centre)), body.angvel())
        } else {
            body.set_body_type(RigidBodyType::Dynamic, true);
            let (linear, angular) =
                grip::velocity_between(past[1], past[0], loaded.local_com, self.step);
            let linear = linear.clamp_length_max(RELEASE_SPEED_MAX * self.length_scale);
            (
                units.vector(linear),
                angular.clamp_length_max(RELEASE_SPIN_MAX),
            )
        };
        body.set_additional_mass_properties(units.mass_properties(loaded), true);
        body.recompute_mass_properties_from_colliders(&self.rapier.colliders);
        body.set_linvel(linear, true);
        body.set_angvel(angular, true);
        // Forces last until they are reset, and a tool bears none.
        if flask.role.is_some() {
            return;
        }

        let (force, torque) = coupling::push(
            load,
            past,
            loaded.local_com,
            self.gravity,
            self.step,
            self.length_scale,
        );
        body.reset_forces(false);
        body.reset_torques(false);
        body.add_force(units.vector(force), true);
        body.add_torque(units.torque(torque), true);
        let Some(body) = self.rapier.bodies.get(flask.body) else {
            return;
        };
        let torque = rolling::resistance(&self.rapier, body, flask.radius, self.step);
        if let Some(body) = self.rapier.bodies.get_mut(flask.body) {
            body.add_torque(torque, true);
        }
    }

    /// Breaks the flasks that were struck too hard in the last step.
    fn take_breaks(&mut self) {
        self.breaks.clear();
        for index in std::mem::take(&mut self.state.glass.struck) {
            if self.is_broken(index) {
                continue;
            }
            let pose = self.poses[index];
            let velocity = self.velocity(index).unwrap_or_default();
            let (flask, units) = (&self.flasks[index], self.units);
            let glass = &mut self.state.glass;
            glass.shatter(&mut self.rapier, index, flask, (pose, velocity), units);
            for grip in &mut self.state.grips {
                grip.lose(index);
            }
            let nowhere = Pose::from_position(NOWHERE * self.length_scale);
            (self.poses[index], self.state.past[index]) = (nowhere, [nowhere; 4]);
            self.strikes.forget_held(index);
            self.breaks.push(Break {
                flask: index,
                stage_from_flask: pose,
            });
        }
    }

    /// Puts the held flasks that leap where their hands hold them, as if they had always been there: the leap ends one step before the
    /// hand's pose, at the velocity that the flask had before it.
    fn take_leaps(&mut self) {
        let all = std::mem::take(&mut self.state.hands_leap);
        self.leaps.clear();
        for (index, flask) in self.flasks.iter().enumerate() {
            let Some((hand, target)) = grip::holder(&self.state.grips, index) else {
                continue;
            };
            // The rails and the hand's height alone determine where a sash is.
            if matches!(flask.role, Some(Role::Sash { .. })) {
                continue;
            }
            let before = self.poses[index];
            let (linear, _) = grip::velocity_between(before, target, Vec3::ZERO, self.step);
            let fast = linear.length() > HELD_SPEED_MAX * self.length_scale;
            let grip = &self.state.grips[hand];
            if grip.took || !(all || fast || grip.back) {
                continue;
            }
            let past = &mut self.state.past[index];
            let turned = past[0].orientation * past[1].orientation.conjugate();
            let would_be = Pose::new(
                before.position + (past[0].position - past[1].position),
                (turned * before.orientation).normalize(),
            );
            let after_from_before = target.compose(would_be.inverse());
            for pose in past.iter_mut() {
                *pose = after_from_before.compose(*pose);
            }
            self.poses[index] = past[0];
            if let Some(body) = self.rapier.bodies.get_mut(flask.body) {
                body.set_position(self.units.pose(past[0]), true);
            }
            // A tool has no contents that would leap with it.
            if index >= self.count {
                continue;
            }
            self.strikes.forget_held(index);
            self.leaps.push(Leap {
                flask: index,
                after_from_before,
            });
        }
    }

    /// Brings the held flasks to `fraction` of the way of this step.
    fn move_held(&mut self, fraction: f32) {
        for (index, flask) in self.flasks.iter().enumerate() {
            let Some(target) = self.target(index) else {
                continue;
            };
            let Some(body) = self.rapier.bodies.get_mut(flask.body) else {
                continue;
            };
            let pose = self.poses[index].interpolate(target, fraction);
            body.set_next_kinematic_position(self.units.pose(pose));
        }
    }

    fn read_poses(&mut self) {
        for (index, flask) in self.flasks.iter().enumerate() {
            if self.state.glass.broken[index] {
                continue;
            }
            // A held flask is exactly where its hand has it, without rapier's rounding.
            let held = self.target(index);
            if index < self.count {
                self.strikes.take_held(index, flask, held, self.step);
            }
            let pose = held.or_else(|| {
                let body = self.rapier.bodies.get(flask.body)?;
                (!flask.fixed).then(|| self.units.pose_to_si(body.translation(), *body.rotation()))
            });
            if let Some(pose) = pose {
                self.poses[index] = pose;
            }
            let past = &mut self.state.past[index];
            past.rotate_right(1);
            past[0] = self.poses[index];
        }
    }
}
