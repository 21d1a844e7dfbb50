//! One hand: on its way, closing, holding, opening.

use glam::Vec3;
use vitriol_xr::{Around, Pose, Side};

use super::gloves::{self, Pull};
use super::held::{Drag, Fares, Held};
use super::motion::{Motion, SPEED, turn_between};
use super::obstacles::level;
use super::pointing::{Ray, grip_at};

/// From where it closes, m and rad, a hand is at what it takes.
const THERE: f32 = 0.004;
const TURNED: f32 = 0.15;
/// How long a closed hand waits until it holds something, s, and frames.
const WAITS: f32 = 0.5;
const WAITS_FRAMES: u32 = 6;
/// How long a hand that opens stays, and goes back, s; and how far, m.
const OPENS: f32 = 0.15;
const BACK_FOR: f32 = 0.7;
const BACK: f32 = 0.05;

/// What a hand is to take.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taking {
    /// Index of the thing.
    pub thing: usize,
    /// How the pointer drags it from then on.
    pub drag: Drag,
    /// The pointer's ray, where it moved since.
    pub to: Option<Ray>,
    /// It is held without the main button.
    pub stays: bool,
    /// The button was let go: it is put down at once.
    pub drops: bool,
}

/// What a hand does.
pub(super) enum State {
    /// It holds nothing.
    Free,
    /// It goes to what it is to take.
    Reaching(Taking),
    /// It has closed, and it is not known yet what it holds.
    Closing {
        taking: Taking,
        waited: f32,
        frames: u32,
    },
    /// It holds something.
    Holding(Box<Held>),
    /// It has opened this many seconds ago.
    Opening(f32),
    /// It pulls the other hand's glove off.
    Pulling(Pull),
}

/// A hand.
pub(super) struct Mover {
    pub side: Side,
    pub state: State,
    /// Where it goes while it holds nothing.
    pub target: Pose,
    motion: Motion,
}

impl Mover {
    /// At rest there, and open.
    pub fn new(side: Side, pose: Pose) -> Self {
        Self {
            side,
            state: State::Free,
            target: pose,
            motion: Motion::at(pose),
        }
    }

    /// Its grip pose (stage_from_grip).
    pub fn pose(&self) -> Pose {
        match &self.state {
            State::Holding(held) => held.grip(),
            _ => self.motion.pose,
        }
    }

    /// Whether it is closed.
    pub fn is_closed(&self) -> bool {
        match &self.state {
            State::Closing { .. } | State::Holding(_) => true,
            State::Pulling(pull) => pull.is_closed(),
            State::Free | State::Reaching(_) | State::Opening(_) => false,
        }
    }

    /// Whether it holds nothing and is about to take nothing.
    pub fn is_free(&self) -> bool {
        matches!(self.state, State::Free | State::Opening(_))
    }

    /// Whether it holds something.
    pub fn holds(&self) -> bool {
        matches!(self.state, State::Holding(_))
    }

    /// Takes in what it holds; the user's eyes are at `eyes`, and `away` leads away from the viewer.
    pub fn take_in(&mut self, around: &Around, eyes: Vec3, away: Vec3) {
        let holds = around.holds[self.side as usize];
        // The thing broke, or the other hand took it over.
        let lost = matches!(&self.state, State::Holding(held) if holds != Some(held.thing));
        if lost {
            self.open();
            return;
        }
        let State::Closing {
            taking,
            waited,
            frames,
        } = &mut self.state
        else {
            return;
        };
        *frames += 1;
        let (taking, late) = (*taking, *waited > WAITS && *frames > WAITS_FRAMES);
        let pose = self.motion.pose;
        let held = holds.and_then(|it| Held::new(around, it, &pose, taking.drag));
        if let Some(mut held) = held {
            held.dragged = !taking.stays && !taking.drops;
            held.follows = taking.stays;
            if let Some(ray) = taking.to {
                held.point(ray, away, level(eyes));
            }
            self.state = State::Holding(Box::new(held));
            if taking.drops {
                self.put_down(around, eyes);
            }
        } else if late {
            self.open();
        }
    }

    /// Begins to take a thing.
    pub fn take(&mut self, taking: Taking) {
        self.state = State::Reaching(taking);
    }

    /// Begins to put down what it holds.
    pub fn put_down(&mut self, around: &Around, eyes: Vec3) {
        if let State::Holding(held) = &mut self.state {
            (held.dragged, held.follows) = (false, false);
            if held.put_down(around, eyes) == Fares::Stands {
                self.open();
            }
        }
    }

    /// The other hand becomes the active one: this one stays, and keeps what it has.
    pub fn leave(&mut self) {
        match &mut self.state {
            State::Free | State::Reaching(_) => self.stay(),
            State::Closing { taking, .. } => taking.stays = true,
            State::Holding(held) => held.leave(),
            State::Pulling(pull) if pull.is_closed() => self.open(),
            State::Pulling(_) => self.stay(),
            State::Opening(_) => {}
        }
    }

    fn stay(&mut self) {
        self.state = State::Free;
        self.target = self.motion.pose;
    }

    /// Away from what is before its palm.
    fn back(&self) -> Vec3 {
        let out = self.motion.pose.orientation * Vec3::X;
        match self.side {
            Side::Right => out,
            Side::Left => -out,
        }
    }

    /// Opens, and goes back a little.
    fn open(&mut self) {
        if let State::Holding(held) = &self.state {
            self.motion = held.hand();
        }
        self.target = self.motion.pose;
        let back = BACK * self.back();
        self.target.position += back;
        self.state = State::Opening(0.0);
    }

    /// Moves for `h` seconds; the view's directions and the place on the bench that is pointed at say from where it takes something.
    pub fn step(&mut self, around: &Around, view: [Vec3; 2], spot: Vec3, h: f32) {
        match &mut self.state {
            State::Free => self.motion = self.motion.towards(&self.target, SPEED, h),
            State::Reaching(taking) => {
                let taking = *taking;
                match grip_at(self.side, around, taking.thing, view, spot) {
                    Some(pose) => self.target = pose,
                    None => self.state = State::Free,
                }
                self.motion = self.motion.towards(&self.target, SPEED, h);
                if matches!(self.state, State::Reaching(_)) && self.is_there() {
                    self.state = State::Closing {
                        taking,
                        waited: 0.0,
                        frames: 0,
                    };
                }
            }
            State::Closing { waited, .. } => {
                *waited += h;
                self.motion = self.motion.braked(h);
            }
            State::Holding(held) => {
                if held.step(around, h) == Fares::Stands {
                    self.open();
                }
            }
            State::Pulling(pull) => {
                let pull = *pull;
                self.motion = match pull {
                    Pull::Closes(_) => self.motion.braked(h),
                    Pull::Goes { .. } | Pull::Leaves => self.motion.towards(&self.target, SPEED, h),
                };
                match pull {
                    Pull::Goes { clear } if clear && self.is_there() => {
                        self.state = State::Pulling(Pull::Closes(0.0));
                    }
                    Pull::Closes(since) if since < gloves::CLOSES => {
                        self.state = State::Pulling(Pull::Closes(since + h));
                    }
                    Pull::Closes(_) => {
                        let off = gloves::OFF * self.back();
                        self.target.position += off;
                        self.state = State::Pulling(Pull::Leaves);
                    }
                    Pull::Leaves if self.is_there() => self.open(),
                    Pull::Goes { .. } | Pull::Leaves => {}
                }
            }
            State::Opening(since) => {
                *since += h;
                let since = *since;
                self.motion = if since > OPENS {
                    self.motion.towards(&self.target, SPEED, h)
                } else {
                    self.motion.braked(h)
                };
                if since > BACK_FOR {
                    self.state = State::Free;
                }
            }
        }
    }

    fn is_there(&self) -> bool {
        let Pose {
            position,
            orientation,
        } = self.motion.pose;
        let turn = turn_between(orientation, self.target.orientation);
        let near = position.distance(self.target.position) < THERE;
        near && turn.length() < TURNED && self.motion.is_slow()
    }
}
