//! Blows: of flasks on each other, on the table and on the floor. They are played as sounds, and may break the glass.

use glam::Vec3;
use rapier3d::prelude::{PhysicsWorld, RigidBodyHandle};
use serde::{Deserialize, Serialize};

use super::body::Body;
use super::spec::{BodiesSpec, Table};
use super::units::Units;
use crate::pose::Pose;

/// A blow in the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strike {
    /// The flask that was struck.
    pub flask: usize,
    /// The other one; `None` for table, floor and sash.
    pub other: Option<usize>,
    /// Momentum that the flask took, N s.
    pub impulse: f32,
    /// How fast the two came together, m/s.
    pub speed: f32,
    /// Approximate position of the blow in the stage, m.
    pub position: Vec3,
}

/// Least momentum of a blow, N s at real size: glass of 100 g that falls by a millimetre has 14 mN s.
const LEAST: f32 = 2e-3;
/// Factor by which a blow's impulse must exceed the contact's in the step before plus that of the flask's weight: a contact that lasts is
/// no blow, nor is a flask that comes to rest on the table as a hand lets go.
const TIMES: f32 = 2.0;
/// Height over table or floor below which a held flask touches it, m at real size.
const TOUCHES: f32 = 5e-4;

/// A contact: the flask, the other flask if it is one, and the impulse in the last of rapier's steps.
type Contact = (usize, Option<usize>, f32);

/// Where a held flask is.
#[derive(Clone, Copy, Serialize, Deserialize)]
struct Clear {
    /// Whether it came over the table from above, so that it would meet the table; else the floor.
    over_table: bool,
    /// Height of its lowest point above the surface that it would meet, m.
    height: f32,
    /// How fast it comes down, m/s; 0 where it was over something else before.
    speed: f32,
}

/// Memory from one step to the next: part of the bodies' state, since the breaking of glass depends on it.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Memory {
    contacts: Vec<Contact>,
    /// By flask, how fast it was before, m/s.
    velocities: Vec<Vec3>,
    /// By flask, where a held one was in the last step.
    clear: Vec<Option<Clear>>,
    /// Whether the contacts of the step before are unknown, as at the start, where the flasks did not move to where they are.
    begins: bool,
}

impl Memory {
    pub fn of(flasks: usize) -> Self {
        Self {
            contacts: Vec::new(),
            velocities: vec![Vec3::ZERO; flasks],
            clear: vec![None; flasks],
            begins: true,
        }
    }

    /// Whether it is of so many flasks.
    pub fn is_of(&self, flasks: usize) -> bool {
        self.velocities.len() == flasks && self.clear.len() == flasks
    }
}

/// Finds blows.
pub(super) struct Strikes {
    table: Option<Table>,
    floor: f32,
    scale: f32,
    pub memory: Memory,
    /// Blows of the step.
    pub found: Vec<Strike>,
}

impl Strikes {
    pub fn new(spec: &BodiesSpec) -> Self {
        Self {
            table: spec.table,
            floor: spec.floor,
            scale: spec.length_scale,
            memory: Memory::of(spec.flasks.len()),
            found: Vec::new(),
        }
    }

    /// Begins a step: drops the blows of the one before.
    pub fn begin(&mut self) {
        self.found.clear();
    }

    /// Forgets where a held flask was, since it was put elsewhere.
    pub fn forget_held(&mut self, flask: usize) {
        self.memory.clear[flask] = None;
    }

    /// Finds the blows of one of rapier's steps, after it was taken.
    pub fn take(&mut self, rapier: &PhysicsWorld, flasks: &[Body], units: Units) {
        let contacts = contacts(rapier, flasks, units);
        let velocity = |flask: &Body| {
            let body = rapier.bodies.get(flask.body);
            body.map_or(Vec3::ZERO, |body| units.to_si(body.linvel()))
        };
        let velocities: Vec<Vec3> = flasks.iter().map(velocity).collect();
        let came = std::mem::replace(&mut self.memory.velocities, velocities);
        let before = std::mem::replace(&mut self.memory.contacts, contacts.clone());
        if std::mem::take(&mut self.memory.begins) {
            return;
        }
        let least = LEAST * self.scale.powi(4);
        for &(flask, other, impulse) in &contacts {
            let same = |it: &&Contact| (it.0, it.1) == (flask, other);
            let was = before.iter().find(same).map_or(0.0, |it| it.2);
            let Some(body) = rapier.bodies.get(flasks[flask].body) else {
                continue;
            };
            let step = rapier.integration_parameters.dt;
            let weight = step * body.mass() * units.to_si(rapier.gravity).length();
            if impulse > TIMES * (was + weight) + least {
                let position = units.to_si(body.translation());
                self.strike(Strike {
                    flask,
                    other,
                    impulse: impulse - was,
                    speed: self.closing(flask, other, &came),
                    position,
                });
            }
        }
    }

    /// Closing speed of a flask and the body that struck it, m/s: its velocity before, relative to the other's, against the direction in
    /// which the blow pushes it. Its loss of speed within one of rapier's steps is only the first part of that, since a contact takes
    /// several steps.
    fn closing(&self, flask: usize, other: Option<usize>, came: &[Vec3]) -> f32 {
        let now = &self.memory.velocities;
        let relative = |of: &[Vec3]| of[flask] - other.map_or(Vec3::ZERO, |other| of[other]);
        let (before, pushed) = (relative(came), relative(now) - relative(came));
        -before.dot(pushed.normalize_or_zero())
    }

    /// Finds the blow of a held flask, which rapier lets pass through table and floor: it is at `held` after a step of `step` (s); `None`
    /// where no hand holds it.
    pub fn take_held(&mut self, index: usize, flask: &Body, held: Option<Pose>, step: f32) {
        let before = self.memory.clear[index];
        let Some(pose) = held else {
            self.memory.clear[index] = None;
            return;
        };
        let mut now = self.clearance(flask, &pose, before);
        let near = TOUCHES * self.scale;
        if let Some(was) = before.filter(|was| was.over_table == now.over_table) {
            now.speed = (was.height - now.height) / step;
            // In the step in which it reaches the surface it may have been stopped already.
            let speed = now.speed.max(was.speed);
            let impulse = flask.glass.mass() * speed;
            let comes = was.height > near && now.height <= near;
            if comes && impulse > LEAST * self.scale.powi(4) {
                self.strike(Strike {
                    flask: index,
                    other: None,
                    impulse,
                    speed,
                    position: pose.position,
                });
            }
        }
        self.memory.clear[index] = Some(now);
    }

    /// Adds a blow. One that lasts for several of rapier's steps counts once, with its greatest impulse and its greatest closing speed.
    fn strike(&mut self, strike: Strike) {
        let same = |it: &&mut Strike| (it.flask, it.other) == (strike.flask, strike.other);
        match self.found.iter_mut().find(same) {
            Some(found) => {
                let speed = found.speed.max(strike.speed);
                if found.impulse < strike.impulse {
                    *found = strike;
                }
                found.speed = speed;
            }
            None => self.found.push(strike),
        }
    }

    /// Where a held flask is that was at `before` in the step before. If a hand takes it through the table, the surface that it meets is
    /// still the table; if it came under the table from aside, it is the floor.
    fn clearance(&self, flask: &Body, pose: &Pose, before: Option<Clear>) -> Clear {
        let axis = pose.orientation * Vec3::Y;
        let sine = (1.0 - axis.y * axis.y).max(0.0).sqrt();
        let heights = flask.outline.iter();
        let lowest = heights
            .map(|[radius, height]| pose.position.y + height * axis.y - radius * sine)
            .fold(f32::INFINITY, f32::min);
        let came_over = before.is_some_and(|before| before.over_table);
        let table = self.table.filter(|table| {
            let aside = (pose.position.x - table.centre.x).abs() <= 0.5 * table.size.x;
            let along = (pose.position.z - table.centre.y).abs() <= 0.5 * table.size.y;
            aside && along && (came_over || lowest > table.top - TOUCHES * self.scale)
        });
        Clear {
            over_table: table.is_some(),
            height: lowest - table.map_or(self.floor, |table| table.top),
            speed: 0.0,
        }
    }
}

/// Each pair that touches once, the flask of the lower index first.
fn contacts(rapier: &PhysicsWorld, flasks: &[Body], units: Units) -> Vec<Contact> {
    let flask_of =
        |body: Option<RigidBodyHandle>| flasks.iter().position(|flask| Some(flask.body) == body);
    let mut all: Vec<Contact> = Vec::new();
    for pair in rapier.narrow_phase.contact_pairs() {
        if !pair.has_any_active_contact() {
            continue;
        }
        let parent = |handle| rapier.colliders.get(handle).and_then(|it| it.parent());
        let parents = [pair.collider1, pair.collider2].map(parent);
        // Table and floor have no body, and a sash is treated as they are. A free body that is no flask is a shard, which gives no blows.
        let is_free = |body| rapier.bodies.get(body).is_some_and(|it| it.is_dynamic());
        let is_shard =
            |body: &Option<RigidBodyHandle>| body.is_some_and(is_free) && flask_of(*body).is_none();
        if parents.iter().any(is_shard) {
            continue;
        }
        let [one, other] = parents.map(flask_of);
        let (flask, other) = match (one, other) {
            (Some(one), Some(other)) => (one.min(other), Some(one.max(other))),
            (Some(flask), None) | (None, Some(flask)) => (flask, None),
            (None, None) => continue,
        };
        // Velocities are lengths over time, and masses are the same in both units.
        let impulse = units.to_si(Vec3::X * pair.total_impulse_magnitude()).x;
        match all.iter_mut().find(|it| (it.0, it.1) == (flask, other)) {
            Some(contact) => contact.2 += impulse,
            None => all.push((flask, other, impulse)),
        }
    }
    all
}
