//! The runtime's one state, and the path of every call through it.

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Mutex, MutexGuard, PoisonError};

use openxr::sys;
use serde_json::Value;
use sys::Result as R;

use crate::abi::Answer;
use crate::actions::{Action, ActionSet, Bindings};
use crate::events::Event;
use crate::files::Files;
use crate::hands::Tracker;
use crate::script::{Change, Cue, HandState, Lost};
use crate::space::Space;
use crate::swapchain::Swapchain;
use crate::vulkan::{Device, Maker};
use crate::world::{EPOCH, Mask, World};

static STATE: Mutex<Option<State>> = Mutex::new(None);

/// Everything that is kept between calls.
pub(crate) struct State {
    files: Files,
    /// Changes that wait for their frame.
    cues: Vec<Cue>,
    refusals: Vec<Refusal>,
    pub world: World,
    /// Calls of xrWaitFrame that have begun.
    pub frames: u64,
    /// Display time of the last one.
    pub time: i64,
    last_handle: u64,
    pub paths: Vec<String>,
    pub instances: BTreeMap<u64, Instance>,
    pub sessions: BTreeMap<u64, Session>,
    pub spaces: BTreeMap<u64, Space>,
    pub swapchains: BTreeMap<u64, Swapchain>,
    pub sets: BTreeMap<u64, ActionSet>,
    pub actions: BTreeMap<u64, Action>,
    pub trackers: BTreeMap<u64, Tracker>,
}

/// A call that is refused.
struct Refusal {
    call: String,
    answer: R,
    times: Option<u32>,
    when: Option<String>,
}

/// Target of an XrInstance handle.
#[derive(Default)]
pub(crate) struct Instance {
    pub extensions: Vec<String>,
    pub lost: bool,
    pub events: VecDeque<Event>,
    /// Whether a session's change of state was sent in this round of xrPollEvent.
    pub stepped: bool,
    pub bindings: Bindings,
    /// Whether xrGetVulkanGraphicsRequirements2KHR was called.
    pub requirements_read: bool,
    pub maker: Option<Maker>,
}

/// Target of an XrSession handle.
pub(crate) struct Session {
    pub instance: u64,
    pub lost: bool,
    pub state: sys::SessionState,
    /// Whether it is between xrBeginSession and xrEndSession.
    pub running: bool,
    /// Frames ended since xrBeginSession.
    pub framed: u64,
    /// The view configuration given to xrBeginSession.
    pub views: sys::ViewConfigurationType,
    /// Whether xrRequestExitSession was called.
    pub leaving: bool,
    /// Display time of a frame that was waited for and has not begun.
    pub waited: Option<i64>,
    /// Display time of the frame that has begun.
    pub begun: Option<i64>,
    pub attached: Option<Vec<u64>>,
    /// Sets of the last xrSyncActions.
    pub active_sets: Vec<u64>,
    pub hands: [Option<HandState>; 2],
    pub earlier: [Option<HandState>; 2],
    pub profiles: [Option<String>; 2],
    /// `None` in tests of the runtime itself.
    pub device: Option<Device>,
}

impl Default for State {
    fn default() -> Self {
        Self {
            files: Files::of_the_environment(),
            cues: Vec::new(),
            refusals: Vec::new(),
            world: World::default(),
            frames: 0,
            time: EPOCH,
            last_handle: 0x1000,
            paths: Vec::new(),
            instances: BTreeMap::new(),
            sessions: BTreeMap::new(),
            spaces: BTreeMap::new(),
            swapchains: BTreeMap::new(),
            sets: BTreeMap::new(),
            actions: BTreeMap::new(),
            trackers: BTreeMap::new(),
        }
    }
}

/// Runs `body` on the state.
pub(crate) fn locked<T>(body: impl FnOnce(&mut State) -> T) -> T {
    let mut state: MutexGuard<'_, Option<State>> =
        STATE.lock().unwrap_or_else(PoisonError::into_inner);
    body(state.get_or_insert_default())
}

/// Runs a call that is logged only if the script refuses it.
pub(crate) fn call(name: &'static str, body: impl FnOnce(&mut State) -> Answer) -> R {
    locked(|state| match state.refused(name, &[]) {
        Some(answer) => state.tell(name, Value::Null, answer),
        None => body(state).unwrap_or_else(|answer| answer),
    })
}

/// Runs a call that is logged with its arguments, to which `body` may add.
pub(crate) fn told(
    name: &'static str,
    with: Value,
    body: impl FnOnce(&mut State, &mut Value) -> Answer,
) -> R {
    locked(|state| state.told(name, with, &[], body))
}

impl State {
    /// Runs a call as [`told`] does, whose refusal may depend on `facts`.
    pub(crate) fn told(
        &mut self,
        name: &'static str,
        mut with: Value,
        facts: &[String],
        body: impl FnOnce(&mut Self, &mut Value) -> Answer,
    ) -> R {
        let answer = match self.refused(name, facts) {
            Some(answer) => answer,
            None => body(self, &mut with).unwrap_or_else(|answer| answer),
        };
        self.tell(name, with, answer)
    }

    fn tell(&mut self, name: &'static str, with: Value, answer: R) -> R {
        let frame = self.frames.checked_sub(1);
        self.files.tell(frame, name, with, answer.into_raw());
        answer
    }

    /// The script's refusal of the call, if there is one.
    fn refused(&mut self, name: &str, facts: &[String]) -> Option<R> {
        let fits = |refusal: &&mut Refusal| {
            let when = refusal.when.as_ref();
            refusal.call == name
                && refusal.times != Some(0)
                && when.is_none_or(|when| facts.contains(when))
        };
        let refusal = self.refusals.iter_mut().find(fits)?;
        if let Some(times) = &mut refusal.times {
            *times -= 1;
        }
        Some(refusal.answer)
    }

    /// A new handle.
    pub(crate) fn handle(&mut self) -> u64 {
        self.last_handle += 1;
        self.last_handle
    }

    /// The instance, if the handle is valid and the instance is not lost.
    pub(crate) fn instance(&mut self, handle: sys::Instance) -> Result<&mut Instance, R> {
        self.instance_of(sys::Handle::into_raw(handle))
    }

    fn instance_of(&mut self, raw: u64) -> Result<&mut Instance, R> {
        let instance = self.instances.get_mut(&raw);
        let instance = instance.ok_or(R::ERROR_HANDLE_INVALID)?;
        match instance.lost {
            true => Err(R::ERROR_INSTANCE_LOST),
            false => Ok(instance),
        }
    }

    /// The session, if the handle is valid and neither session nor instance is lost.
    pub(crate) fn session(&mut self, handle: sys::Session) -> Result<&mut Session, R> {
        self.session_of(sys::Handle::into_raw(handle))
    }

    /// The session of that raw handle, checked as by [`State::session`].
    pub(crate) fn session_of(&mut self, raw: u64) -> Result<&mut Session, R> {
        let instance = self.sessions.get(&raw).map(|session| session.instance);
        self.instance_of(instance.ok_or(R::ERROR_HANDLE_INVALID)?)?;
        let session = self.sessions.get_mut(&raw);
        let session = session.ok_or(R::ERROR_HANDLE_INVALID)?;
        match session.lost {
            true => Err(R::ERROR_SESSION_LOST),
            false => Ok(session),
        }
    }

    /// Whether the session's instance has the extension.
    pub(crate) fn session_has(&mut self, handle: sys::Session, extension: &str) -> Result<(), R> {
        let instance = self.session(handle)?.instance;
        let on = &self.instance_of(instance)?.extensions;
        match on.iter().any(|name| name == extension) {
            true => Ok(()),
            false => Err(R::ERROR_FUNCTION_UNSUPPORTED),
        }
    }

    /// The text of a path.
    pub(crate) fn path(&self, path: sys::Path) -> Option<&str> {
        let index = usize::try_from(path.into_raw()).ok()?.checked_sub(1)?;
        self.paths.get(index).map(String::as_str)
    }

    /// The path of a text.
    pub(crate) fn path_of(&mut self, text: &str) -> sys::Path {
        let known = self.paths.iter().position(|path| path == text);
        let index = known.unwrap_or_else(|| {
            self.paths.push(text.to_owned());
            self.paths.len() - 1
        });
        sys::Path::from_raw(index as u64 + 1)
    }

    /// Reads the script on; changes that are not due wait for their frame.
    pub(crate) fn listen(&mut self) {
        self.take_cues(false);
    }

    /// [`State::listen`] at the beginning of an xrWaitFrame, which it also counts, with the next display time.
    pub(crate) fn begin_wait(&mut self) {
        self.take_cues(true);
        self.frames += 1;
        self.time += self.world.period;
    }

    fn take_cues(&mut self, within_wait: bool) {
        let heard = self.files.hear();
        self.cues.extend(heard);
        // The number of the frame that begins; between frames, of the last one that has begun.
        let frame = match within_wait {
            true => Some(self.frames),
            false => self.frames.checked_sub(1),
        };
        let due = |cue: &Cue| cue.at.is_none_or(|at| Some(at) <= frame);
        let (now, later) = std::mem::take(&mut self.cues).into_iter().partition(due);
        self.cues = later;
        let now: Vec<Cue> = now;
        // The first frame whose events can still be polled before it.
        let next = self.time + self.world.period * if within_wait { 2 } else { 1 };
        for cue in now {
            self.apply(cue.change, next);
        }
    }

    fn apply(&mut self, change: Change, next: i64) {
        let world = &mut self.world;
        match change {
            Change::Head { pose, known } => world.head = (pose, known),
            Change::Hand { side, state } => world.hands[side] = state,
            Change::Joints { side, joints } => world.joints[side] = joints,
            Change::Gaze(pose) => world.gaze = pose,
            Change::Inset(inset) => world.inset = inset,
            Change::Move {
                space,
                origin,
                announced,
                pose_valid,
                later,
            } => {
                let time = next + i64::from(later) * world.period;
                let Some(origins) = world.origins(space) else {
                    return;
                };
                let before = origins.at(time);
                origins.push(time, origin);
                if announced {
                    let pose = pose_valid.then(|| before.inverse().compose(&origin));
                    self.raise(|session| Event::Moves {
                        session,
                        space,
                        time,
                        pose,
                    });
                }
            }
            Change::Offer { spaces } => world.spaces = spaces,
            Change::Extensions(names) => world.extensions = names,
            Change::Rates { rates, now } => {
                let from = world.rate;
                world.rates = rates;
                world.set_rate(now);
                self.raise_rate(from, now);
            }
            Change::Period(period) => world.period = period,
            Change::Presence(present) => {
                world.present = present;
                self.raise(|session| Event::Presence { session, present });
            }
            Change::Mask {
                eye,
                vertices,
                indices,
            } => {
                world.masks[eye] = Mask { vertices, indices };
                let eye = eye as u32;
                let views = self.sessions.iter().map(|(raw, held)| (*raw, held.views));
                let views: BTreeMap<_, _> = views.collect();
                self.raise(|session| Event::Mask {
                    session,
                    views: views[&session],
                    eye,
                });
            }
            Change::ArrayLayers(most) => world.array_layers = most,
            Change::Views { fov, ipd } => (world.fov, world.ipd) = (fov, ipd),
            Change::Goal(goal) => world.goal = goal,
            Change::Lose(Lost::Session) => {
                self.sessions.values_mut().for_each(|s| s.lost = true);
            }
            Change::Lose(Lost::Instance) => {
                self.instances.values_mut().for_each(|i| i.lost = true);
            }
            Change::Headset(connected) => world.connected = connected,
            Change::Refuse {
                call,
                answer,
                times,
                when,
            } => self.refusals.push(Refusal {
                call,
                answer: R::from_raw(answer),
                times,
                when,
            }),
            Change::RefuseNothing => self.refusals.clear(),
            Change::InstanceLossPending => {
                let time = self.time;
                for instance in self.instances.values_mut().filter(|i| !i.lost) {
                    instance.events.push_back(Event::InstanceLossPending(time));
                }
            }
        }
    }

    /// Raises an event for each session that is not lost.
    pub(crate) fn raise(&mut self, event: impl Fn(u64) -> Event) {
        for (&raw, session) in self.sessions.iter().filter(|(_, s)| !s.lost) {
            let instance = self.instances.get_mut(&session.instance);
            let Some(instance) = instance.filter(|instance| !instance.lost) else {
                continue;
            };
            let event = event(raw);
            let on = |name: &str| instance.extensions.iter().any(|on| on == name);
            if event.extension().is_none_or(on) {
                instance.events.push_back(event);
            }
        }
    }

    /// Raises an event of the display rate, if the rate changes.
    pub(crate) fn raise_rate(&mut self, from: f32, to: f32) {
        if from != to {
            self.raise(|_| Event::Rate { from, to });
        }
    }
}
