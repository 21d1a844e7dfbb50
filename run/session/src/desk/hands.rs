//! The hands of a pointer: a mouse and a keyboard move two hands over the bench as a careful person would.
//!
//! The poses are those of a headset's hands, so what they do is simulated, recorded, judged and replayed like anything else. Pure: no
//! device is used here.

mod controls;
mod gloves;
mod hand;
mod held;
mod lines;
mod motion;
mod obstacles;
mod pointing;
mod press;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use glam::{Quat, Vec3};
use vitriol_xr::{Around, Hand, Kind, Line, Pose, Side};

pub use controls::{Controls, SLOW};
use controls::{KEYS, REACH};
use gloves::{Pull, other};
use hand::{Mover, State, Taking};
use held::Drag;
use obstacles::{hover, level};
use pointing::{Ray, by_place, by_ray, grip_at, nearest, orientation, outwards, pours_clear};
use press::Press;

use crate::panel::met;

/// Interaction profile of these hands in a recording. It is ours: OpenXR has none for a mouse.
const PROFILE: &str = "/interaction_profiles/vitriol/mouse";
/// Longest time that one frame moves a hand, s: where frames take longer, hands are slower and as steady.
const LONGEST: f32 = 0.1;
/// Longest step of the motion, s: as that of the simulation.
const STEP: f32 = 1.0 / 90.0;
/// Where hands rest from between the eyes, m: to their side, down and ahead; over the bench, and clear of all glass.
const REST: [f32; 3] = [0.22, 0.25, 0.18];
/// Least height of a hand over the bench at rest, and over what it hovers, m.
const REST_OVER: f32 = 0.2;
const REST_CLEAR: f32 = 0.1;
const HOVERS: f32 = 0.06;

/// Two hands that a pointer moves, one at a time.
pub struct Hands {
    movers: [Mover; 2],
    active: Side,
    /// A click takes, and another one puts down.
    toggles: bool,
    /// The pointer takes a flask with the hand that a pour does not run over.
    chooses: bool,
    /// The user has changed hands, and the active one has taken nothing since: it takes what is taken next.
    chosen: bool,
    /// The eyes, and right and ahead, as the session began.
    head: Vec3,
    ahead: [Vec3; 2],
    /// The bench that the hands are at, as `Around` counts them.
    scene: u64,
    /// The last frame's controls, and what came since then while no time passed.
    controls: Controls,
    pending: Option<Controls>,
    /// The place on the bench that is pointed at, and the thing that a press would take.
    spot: Vec3,
    picked: Option<usize>,
    press: Option<Press>,
    /// Whether the pointer was used last, and not keys.
    points: bool,
    /// Whether the pointer is on the panel, and on a glove that a press would pull off.
    on_panel: bool,
    on_glove: bool,
    /// The mouse tilted, so that the place that is pointed at may have leapt.
    tilted: bool,
    lines: Vec<Line>,
    profile: Arc<str>,
}

impl Hands {
    /// Hands at rest over a bench whose top is `table` metres high, before eyes at `head` (stage_from_view).
    pub fn new(head: &Pose, table: f32) -> Self {
        let head = if head.is_valid() {
            *head
        } else {
            Pose::IDENTITY
        };
        let level_of = |along: Vec3| (head.orientation * along).with_y(0.0).try_normalize();
        let away = level_of(Vec3::NEG_Z).unwrap_or(Vec3::NEG_Z);
        let right = away.cross(Vec3::Y);
        let eyes = head.position;
        let ahead = [right, away];
        let rest = |side| {
            let orientation = orientation(side, Vec3::Y, outwards(side, right));
            Mover::new(side, Pose::new(rest(side, eyes, ahead, table), orientation))
        };
        Self {
            movers: Side::BOTH.map(rest),
            active: Side::Right,
            toggles: false,
            chooses: false,
            chosen: false,
            head: eyes,
            ahead,
            scene: 0,
            controls: Controls {
                ray: (eyes, away),
                right,
                away,
                ..Controls::default()
            },
            pending: None,
            spot: (eyes + 0.4 * away).with_y(table),
            picked: None,
            press: None,
            points: false,
            on_panel: false,
            on_glove: false,
            tilted: false,
            lines: Vec::new(),
            profile: PROFILE.into(),
        }
    }

    /// These hands, of which the pointer takes a flask with that over which no pour into its neighbour runs. A change of hands by the user
    /// holds for the next thing that is taken.
    pub fn with_choice(mut self) -> Self {
        self.chooses = true;
        self
    }

    /// These hands, of which a click takes hold and another one puts down, if it `toggles`; else a thing is held as long as the button.
    pub fn with_toggles(mut self, toggles: bool) -> Self {
        self.toggles = toggles;
        self
    }

    /// The hand that pointer and keys move.
    #[cfg(test)]
    pub fn active(&self) -> Side {
        self.active
    }

    /// Lines to be drawn with the last frame: what a press would take, where a pour would fall, what is under a hand.
    pub fn lines(&self) -> Vec<Line> {
        self.lines.clone()
    }

    /// Advances by `dt` simulated seconds and returns both hands for the frame. Where that is 0, what is asked for waits.
    pub fn advance(&mut self, controls: &Controls, around: &Around, dt: f32) -> [Hand; 2] {
        if around.scene != self.scene {
            self.begin(around);
        }
        let mut controls = controls.sound(&self.controls);
        if let Some(earlier) = self.pending.take() {
            controls = controls.after(&earlier);
        }
        let dt = if dt.is_finite() {
            dt.clamp(0.0, LONGEST)
        } else {
            0.0
        };
        if dt == 0.0 {
            // Display time goes on: a button that was let go must not fill the panel's ring.
            let press = self.press.take();
            self.press = press.and_then(|it| it.after(false, controls.presses(), 0.0));
            self.pending = Some(controls);
            return self.frame();
        }
        self.controls = controls.clone();
        if controls.other {
            self.movers[self.active as usize].leave();
            self.active = other(self.active);
            self.chosen = true;
        }
        let user = level(self.head);
        for mover in &mut self.movers {
            mover.take_in(around, self.head, controls.away);
        }
        if let State::Holding(_) = self.movers[self.active as usize].state {
            self.chosen = false;
        }
        self.point(&controls, around, dt);
        self.click(&controls, around, dt);
        self.decide(&controls, around);
        self.pull(around);
        let steps = (dt / STEP).ceil();
        let view = [controls.right, controls.away];
        for _ in 0..steps as usize {
            let h = dt / steps;
            let active = self.movers.get_mut(self.active as usize);
            if let Some(State::Holding(held)) = active.map(|it| &mut it.state) {
                held.control(&controls, user, h);
            }
            for mover in &mut self.movers {
                mover.step(around, view, self.spot, h);
            }
        }
        self.draw(around);
        self.frame()
    }

    /// Another bench: both hands are empty and at rest.
    fn begin(&mut self, around: &Around) {
        self.scene = around.scene;
        self.movers = Side::BOTH.map(|side| {
            let upright = orientation(side, Vec3::Y, outwards(side, self.ahead[0]));
            Mover::new(side, Pose::new(self.rests(side, around), upright))
        });
        (self.picked, self.press, self.pending) = (None, None, None);
        (self.on_panel, self.on_glove, self.tilted) = (false, false, false);
        self.chosen = false;
        self.lines.clear();
    }

    /// Where a hand rests, clear of all glass.
    fn rests(&self, side: Side, around: &Around) -> Vec3 {
        let rest = rest(side, self.head, self.ahead, around.table);
        let over = hover(around, level(rest), REST_CLEAR, REST_CLEAR);
        rest.with_y(rest.y.max(over))
    }

    /// The hand that can press something on the panel: one that holds nothing, else one that holds something, whose trigger closes it no
    /// further; of two the active one.
    fn presser(&self) -> Option<Side> {
        let sides = [self.active, other(self.active)];
        let first = |can: fn(&Mover) -> bool| {
            let mut sides = sides.into_iter();
            sides.find(|&side| can(&self.movers[side as usize]))
        };
        first(Mover::is_free).or_else(|| first(Mover::holds))
    }

    /// Whether the hand of that press is still as it was clicked with: one that took something meanwhile, or put it down, pulls no trigger,
    /// since that would close it.
    fn presses(&self, press: &Press) -> bool {
        let mover = &self.movers[press.side as usize];
        if press.holds {
            mover.holds()
        } else {
            mover.is_free()
        }
    }

    /// Where the pointer is: on the panel, at a thing, on the bench; and where a hand that holds nothing goes.
    fn point(&mut self, controls: &Controls, around: &Around, dt: f32) {
        let walks = controls.walk != [0.0; 2];
        let user = level(self.head);
        if controls.pointed || controls.press || controls.panel_press {
            self.points = true;
        } else if walks {
            self.points = false;
        }
        let by_ray = by_ray(controls.ray, around);
        let drags = match &self.movers[self.active as usize].state {
            State::Holding(held) => held.dragged,
            State::Reaching(_) | State::Closing { .. } => true,
            State::Free | State::Opening(_) | State::Pulling(_) => false,
        };
        // What is before the panel, and met by the ray, hides it.
        let panel = met(controls.ray, around.panel)
            .map(|at| around.panel.0.transform_point(at).distance(controls.ray.0))
            .filter(|_| !drags);
        let hidden = |far: f32| by_ray.is_some_and(|it| it.beside == 0.0 && it.along < far);
        self.on_panel = self.points && panel.is_some_and(|far| !hidden(far));
        self.steer(controls);
        self.on_glove = false;
        if !self.movers[self.active as usize].is_free() {
            return;
        }
        if controls.pointed {
            if let Some(at) = pointing::at_height(controls.ray, around.table) {
                let at = user + (at - user).clamp_length_max(REACH);
                self.spot = Vec3::new(at.x, around.table, at.y);
            }
        } else if walks {
            let speed = if controls.slow { SLOW * KEYS } else { KEYS };
            let walk = controls.walk[0] * controls.right + controls.walk[1] * controls.away;
            let at = level(self.spot + speed * dt * walk) - user;
            let at = user + at.clamp_length_max(REACH);
            self.spot = Vec3::new(at.x, around.table, at.y);
        }
        // What the ray meets hides a hand behind it.
        let met = by_ray.is_some_and(|it| it.beside == 0.0);
        self.on_glove = self.points && !self.on_panel && !met && self.is_on_glove(around);
        // In every frame: the view may turn under a pointer that is still, and a flask may break.
        let picked = match self.points {
            _ if self.on_panel || self.on_glove => None,
            true => by_ray.map(|it| it.thing),
            false => by_place(level(self.spot), around),
        };
        self.picked = picked.filter(|&it| !self.has_what_is_in(around, it));
        let chooses = self.chooses && !self.chosen && self.points && self.press.is_none();
        if chooses && self.movers.iter().all(Mover::is_free) {
            let clear = self
                .picked
                .and_then(|it| pours_clear(around, it, controls.right));
            if clear.is_some_and(|side| side != self.active) {
                let left = self.active;
                self.movers[left as usize].target.position = self.rests(left, around);
                self.active = other(left);
            }
        }
        if !self.on_panel && (controls.pointed || walks) && self.press.is_none() {
            self.movers[self.active as usize].target = self.hovering(around);
        }
    }

    /// The pointer moves what the active hand holds, or what it is about to take.
    fn steer(&mut self, controls: &Controls) {
        let user = level(self.head);
        self.tilted |= controls.tilt_drag != 0.0;
        // After a tilt the pointer is elsewhere: what it drags goes on from where it is.
        let leapt = controls.pointed && std::mem::take(&mut self.tilted);
        match &mut self.movers[self.active as usize].state {
            // What is dropped as soon as it is held is no longer dragged.
            State::Reaching(taking) | State::Closing { taking, .. }
                if controls.pointed && !taking.drops =>
            {
                taking.to = Some(controls.ray);
            }
            State::Holding(held) => {
                let on_panel = self.on_panel && !held.dragged;
                if controls.pointed && (held.dragged || held.follows) && !on_panel {
                    if leapt {
                        held.engage(controls.ray);
                    }
                    held.point(controls.ray, controls.away, user);
                }
                if !held.is_put_down() {
                    let share = if controls.slow { SLOW } else { 1.0 };
                    held.nudge(share * controls.wheel, share * controls.tilt_drag);
                }
            }
            _ => {}
        }
    }

    /// Where the active hand hovers.
    fn hovering(&self, around: &Around) -> Pose {
        let side = self.active;
        let view = [self.controls.right, self.controls.away];
        let at_thing = self
            .picked
            .and_then(|it| grip_at(side, around, it, view, self.spot));
        at_thing.unwrap_or_else(|| {
            let height = hover(around, level(self.spot), HOVERS, 0.5 * HOVERS);
            let upright = orientation(side, Vec3::Y, outwards(side, self.controls.right));
            Pose::new(self.spot.with_y(height), upright)
        })
    }

    /// A click on the panel: a free hand that presses goes out of the way of all glass first, since its trigger closes it.
    fn click(&mut self, controls: &Controls, around: &Around, dt: f32) {
        if let Some(press) = self.press.take().filter(|it| self.presses(it)) {
            let palm = self.movers[press.side as usize].pose().position;
            let clear = press.holds || nearest(around, palm, None) > press::CLEAR;
            self.press = press.after(clear, controls.presses(), dt);
        }
        let clicked = controls.press || controls.panel_press;
        let presser = self.presser();
        if let (true, true, None, Some(side)) = (self.on_panel, clicked, &self.press, presser) {
            let holds = self.movers[side as usize].holds();
            self.press = Some(Press::new(controls.ray, side, holds));
        }
        let pressing = self.press.map(|it| it.side);
        if let Some(side) = pressing.or(presser.filter(|_| self.on_panel)) {
            self.movers[side as usize].target.position = self.rests(side, around);
        }
    }

    /// Taking hold and putting down.
    fn decide(&mut self, controls: &Controls, around: &Around) {
        let press = controls.press && !self.on_panel;
        let let_go = controls.release || !controls.pressed;
        let asks_glove = controls.gloves || (press && self.on_glove);
        if asks_glove && self.press.is_none() && self.can_pull(around) {
            self.movers[self.active as usize].state = State::Pulling(Pull::Goes { clear: false });
            self.chosen = false;
            return;
        }
        let picked = self.picked.filter(|_| self.press.is_none());
        // A click is enough to put goggles on, and needs not wait for the hand.
        let goggles = |thing: usize| {
            let thing = around.things.get(thing);
            thing.is_some_and(|it| it.kind == Kind::Goggles)
        };
        let toggles = self.toggles;
        let asked = controls.grip || (toggles && press);
        let stays = controls.grip || toggles;
        let begins = picked.filter(|_| controls.grip || press);
        let drag = begins.and_then(|thing| self.drag(around, thing));
        let mover = &mut self.movers[self.active as usize];
        match &mut mover.state {
            State::Free | State::Opening(_) => {
                let clicks = toggles || !let_go || picked.is_some_and(goggles);
                let begins = controls.grip || (press && clicks);
                if let (true, Some(thing), Some(drag)) = (begins, picked, drag) {
                    mover.take(Taking {
                        thing,
                        drag,
                        to: None,
                        stays,
                        drops: (toggles && picked.is_some_and(goggles)) || (!stays && let_go),
                    });
                }
            }
            State::Reaching(taking) => {
                let ends = asked || (!taking.stays && let_go);
                if ends && goggles(taking.thing) {
                    taking.drops = true;
                } else if ends {
                    mover.state = State::Free;
                }
            }
            State::Closing { taking, .. } => {
                taking.drops |= asked || (!taking.stays && let_go);
            }
            State::Pulling(pull) => {
                if (controls.grip || press) && !pull.is_closed() {
                    mover.state = State::Free;
                }
            }
            State::Holding(held) => {
                if asked && held.is_put_down() {
                    held.engage(controls.ray);
                    held.follows = true;
                } else if asked || (held.dragged && let_go) {
                    mover.put_down(around, self.head);
                } else if press {
                    held.engage(controls.ray);
                    held.dragged = true;
                }
            }
        }
    }

    /// How the pointer will drag a thing that it takes now.
    fn drag(&self, around: &Around, index: usize) -> Option<Drag> {
        let thing = around.things.get(index)?;
        let view = [self.controls.right, self.controls.away];
        let grip = grip_at(self.active, around, index, view, self.spot)?;
        let held = thing.pose.inverse().transform_point(grip.position).y;
        let held = held.clamp(0.0, thing.height.max(0.0));
        let at = thing.pose.transform_point(held * Vec3::Y);
        Some(Drag::from(at, self.controls.ray))
    }

    fn draw(&mut self, around: &Around) {
        // In the order of what they are worth: the last ones are left out.
        let (mut drawn, mut rings) = (Vec::new(), Vec::new());
        let is_free = self.movers[self.active as usize].is_free();
        let picked = self.picked.and_then(|it| around.things.get(it));
        match picked {
            _ if self.on_glove => lines::wrist(&self.gloved(), &mut drawn),
            Some(thing) if is_free && !self.on_panel => lines::mark(thing, &mut drawn),
            None if is_free && !self.on_panel => lines::cross(self.spot, &mut drawn),
            _ => {}
        }
        for mover in &self.movers {
            if let State::Holding(held) = &mover.state {
                lines::held(around, held.thing, &held.pose(), &mut drawn, &mut rings);
            }
        }
        drawn.append(&mut rings);
        drawn.truncate(lines::MOST);
        self.lines = drawn;
    }

    fn frame(&self) -> [Hand; 2] {
        let press = self.press.filter(|it| self.presses(it));
        let ray: Ray = press.map_or(self.controls.ray, |it| it.ray);
        let turned = Quat::from_rotation_arc(Vec3::NEG_Z, ray.1);
        self.movers.each_ref().map(|mover| Hand {
            active: true,
            valid: true,
            tracked: true,
            stage_from_grip: mover.pose(),
            // Before the eye, so that the panel's ray does not begin in it.
            stage_from_aim: Pose::new(ray.0 + 0.25 * ray.1, turned),
            squeeze: f32::from(u8::from(mover.is_closed())),
            trigger: press.map_or(0.0, |it| it.trigger(mover.side)),
            profile: Arc::clone(&self.profile),
            ..Hand::default()
        })
    }
}

/// Where a hand rests.
fn rest(side: Side, eyes: Vec3, [right, away]: [Vec3; 2], table: f32) -> Vec3 {
    let [aside, down, ahead] = REST;
    let at = eyes + aside * outwards(side, right) + ahead * away;
    at.with_y((eyes.y - down).max(table + REST_OVER))
}
