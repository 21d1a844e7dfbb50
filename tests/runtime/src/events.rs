//! Events, and the legal steps of a session's state.

use openxr::sys;
use sys::{Handle as _, Result as R, SessionState};

use crate::abi::given;
use crate::script::{Goal, Pose, SpaceKind};
use crate::state::{State, call};
use crate::world::raw_space;

/// An event that waits.
#[derive(Clone, Debug)]
pub(crate) enum Event {
    Profile {
        session: u64,
    },
    Moves {
        session: u64,
        space: SpaceKind,
        time: i64,
        /// In the previous space, if it is given.
        pose: Option<Pose>,
    },
    Mask {
        session: u64,
        views: sys::ViewConfigurationType,
        eye: u32,
    },
    Presence {
        session: u64,
        present: bool,
    },
    Rate {
        from: f32,
        to: f32,
    },
    InstanceLossPending(i64),
}

impl Event {
    /// The extension without which it is not raised.
    pub(crate) fn extension(&self) -> Option<&'static str> {
        match self {
            Self::Mask { .. } => Some("XR_KHR_visibility_mask"),
            Self::Presence { .. } => Some("XR_EXT_user_presence"),
            Self::Rate { .. } => Some("XR_FB_display_refresh_rate"),
            Self::Moves {
                space: SpaceKind::LocalFloor,
                ..
            } => Some("XR_EXT_local_floor"),
            _ => None,
        }
    }

    fn write(&self, to: &mut sys::EventDataBuffer) {
        macro_rules! put {
            ($event:ident { $($field:ident: $value:expr),* }) => {
                write(to, sys::$event {
                    ty: sys::$event::TYPE,
                    next: std::ptr::null(),
                    $($field: $value),*
                })
            };
        }
        let of = sys::Session::from_raw;
        match *self {
            Self::Profile { session } => {
                put! { EventDataInteractionProfileChanged { session: of(session) } }
            }
            Self::Moves {
                session,
                space,
                time,
                pose,
            } => put! {
                EventDataReferenceSpaceChangePending {
                    session: of(session),
                    reference_space_type: raw_space(space).unwrap_or(sys::ReferenceSpaceType::VIEW),
                    change_time: sys::Time::from_nanos(time),
                    pose_valid: pose.is_some().into(),
                    pose_in_previous_space: pose.unwrap_or(Pose::at(1e9, 1e9, 1e9)).raw()
                }
            },
            Self::Mask {
                session,
                views,
                eye,
            } => put! {
                EventDataVisibilityMaskChangedKHR {
                    session: of(session),
                    view_configuration_type: views,
                    view_index: eye
                }
            },
            Self::Presence { session, present } => put! {
                EventDataUserPresenceChangedEXT {
                    session: of(session),
                    is_user_present: present.into()
                }
            },
            Self::Rate { from, to: rate } => put! {
                EventDataDisplayRefreshRateChangedFB {
                    from_display_refresh_rate: from,
                    to_display_refresh_rate: rate
                }
            },
            Self::InstanceLossPending(time) => put! {
                EventDataInstanceLossPending { loss_time: sys::Time::from_nanos(time) }
            },
        }
    }
}

fn write<T>(to: &mut sys::EventDataBuffer, event: T) {
    const { assert!(size_of::<T>() <= size_of::<sys::EventDataBuffer>()) };
    // SAFETY: the buffer is larger than every event, as was just asserted, and aligned like them.
    unsafe { std::ptr::from_mut(to).cast::<T>().write(event) }
}

/// The next legal step to `goal`, if there is one now. `framed`: the session's frames have begun to come.
pub(crate) fn step(
    now: SessionState,
    goal: Goal,
    running: bool,
    framed: bool,
) -> Option<SessionState> {
    use SessionState as S;
    let wants = |goals: &[Goal]| goals.contains(&goal);
    let runs = [Goal::Synchronized, Goal::Visible, Goal::Focused];
    if goal == Goal::LossPending && now != S::LOSS_PENDING {
        return Some(S::LOSS_PENDING);
    }
    match now {
        S::UNKNOWN => Some(S::IDLE),
        S::IDLE if goal == Goal::Exiting => Some(S::EXITING),
        S::IDLE if wants(&runs) => Some(S::READY),
        S::READY if running && framed => Some(S::SYNCHRONIZED),
        S::SYNCHRONIZED if wants(&runs[1..]) => Some(S::VISIBLE),
        S::SYNCHRONIZED if goal != Goal::Synchronized => Some(S::STOPPING),
        S::VISIBLE if goal == Goal::Focused => Some(S::FOCUSED),
        S::VISIBLE if goal != Goal::Visible => Some(S::SYNCHRONIZED),
        S::FOCUSED if goal != Goal::Focused => Some(S::VISIBLE),
        S::STOPPING if !running => Some(S::IDLE),
        _ => None,
    }
}

impl State {
    /// The next step of a session of the instance; returns its event.
    fn step(&mut self, instance: u64) -> Option<sys::EventDataSessionStateChanged> {
        let mine = |session: &&crate::state::Session| session.instance == instance && !session.lost;
        let (&raw, session) = self.sessions.iter_mut().find(|(_, s)| mine(&&**s))?;
        let goal = match session.leaving {
            true => Goal::Exiting,
            false => self.world.goal,
        };
        let to = step(session.state, goal, session.running, session.framed > 0)?;
        session.state = to;
        if to == SessionState::EXITING || to == SessionState::LOSS_PENDING {
            self.world.goal = Goal::Focused;
        }
        Some(sys::EventDataSessionStateChanged {
            ty: sys::EventDataSessionStateChanged::TYPE,
            next: std::ptr::null(),
            session: sys::Session::from_raw(raw),
            state: to,
            time: sys::Time::from_nanos(self.time),
        })
    }
}

pub(crate) extern "system" fn poll_event(
    instance: sys::Instance,
    event: Option<&mut sys::EventDataBuffer>,
) -> R {
    call("xrPollEvent", |state| {
        state.listen();
        let event = given!(event, sys::EventDataBuffer);
        let held = state.instance(instance)?;
        if let Some(waiting) = held.events.pop_front() {
            waiting.write(event);
            return Ok(R::SUCCESS);
        }
        if !std::mem::replace(&mut held.stepped, true)
            && let Some(step) = state.step(instance.into_raw())
        {
            write(event, step);
            return Ok(R::SUCCESS);
        }
        state.instance(instance)?.stepped = false;
        Ok(R::EVENT_UNAVAILABLE)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps until there is none, with a client that begins and ends sessions as it should.
    fn way(mut now: SessionState, goal: Goal) -> Vec<SessionState> {
        let mut way = Vec::new();
        let mut running = now != SessionState::UNKNOWN;
        while let Some(to) = step(now, goal, running, running) {
            match to {
                SessionState::READY => running = true,
                SessionState::STOPPING => running = false,
                _ => {}
            }
            way.push(to);
            now = to;
        }
        way
    }

    #[test]
    fn a_session_is_led_by_legal_steps() {
        use SessionState as S;
        let up = [S::IDLE, S::READY, S::SYNCHRONIZED, S::VISIBLE, S::FOCUSED];
        assert_eq!(way(S::UNKNOWN, Goal::Focused), up);
        assert_eq!(way(S::UNKNOWN, Goal::Idle), [S::IDLE]);
        assert_eq!(
            way(S::FOCUSED, Goal::Synchronized),
            [S::VISIBLE, S::SYNCHRONIZED]
        );
        let down = [
            S::VISIBLE,
            S::SYNCHRONIZED,
            S::STOPPING,
            S::IDLE,
            S::EXITING,
        ];
        assert_eq!(way(S::FOCUSED, Goal::Idle), down[..4]);
        assert_eq!(way(S::FOCUSED, Goal::Exiting), down);
        assert_eq!(way(S::VISIBLE, Goal::LossPending), [S::LOSS_PENDING]);
        // Without frames it stays ready.
        assert_eq!(step(S::READY, Goal::Focused, true, false), None);
    }
}
