//! Values of input actions.

use std::ffi::c_char;

use openxr::sys;
use sys::Result as R;

use crate::abi::{Buffer, fill_text, fill_with, given};
use crate::profiles;
use crate::script::HandState;
use crate::state::{State, call};

impl State {
    /// Value of an action's control, and whether it was another one at the sync before; `None` where no control drives it.
    fn values<T: PartialEq>(
        &mut self,
        session: sys::Session,
        info: &sys::ActionStateGetInfo,
        kind: sys::ActionType,
        of: impl Fn(&HandState, &str) -> T,
    ) -> Result<Option<(T, bool)>, R> {
        let driven = self.driven(session, info.action, info.subaction_path, kind)?;
        Ok(driven.map(|driven| {
            let now = of(&driven.now, &driven.control);
            let before = driven.earlier.map(|hand| of(&hand, &driven.control));
            let has_changed = before.is_some_and(|before| before != now);
            (now, has_changed)
        }))
    }
}

/// Writes what [`State::values`] found into an answer. The time of the last sync stands for that of the change: a better one is not known.
macro_rules! set {
    ($answer:ident, $values:ident, $state:ident) => {
        let (now, has_changed) = $values.unwrap_or_default();
        $answer.current_state = now;
        $answer.changed_since_last_sync = has_changed.into();
        $answer.last_change_time = sys::Time::from_nanos($state.time);
        $answer.is_active = $values.is_some().into();
    };
}

pub(crate) extern "system" fn get_action_state_boolean(
    session: sys::Session,
    info: Option<&sys::ActionStateGetInfo>,
    answer: Option<&mut sys::ActionStateBoolean>,
) -> R {
    call("xrGetActionStateBoolean", |state| {
        let info = given!(info, sys::ActionStateGetInfo);
        let answer = given!(answer, sys::ActionStateBoolean);
        let kind = sys::ActionType::BOOLEAN_INPUT;
        let values = state.values(session, info, kind, |hand, control| {
            sys::Bool32::from(profiles::value(hand, control) > 0.5)
        })?;
        set!(answer, values, state);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn get_action_state_float(
    session: sys::Session,
    info: Option<&sys::ActionStateGetInfo>,
    answer: Option<&mut sys::ActionStateFloat>,
) -> R {
    call("xrGetActionStateFloat", |state| {
        let info = given!(info, sys::ActionStateGetInfo);
        let answer = given!(answer, sys::ActionStateFloat);
        let values = state.values(session, info, sys::ActionType::FLOAT_INPUT, profiles::value)?;
        set!(answer, values, state);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn get_action_state_vector2f(
    session: sys::Session,
    info: Option<&sys::ActionStateGetInfo>,
    answer: Option<&mut sys::ActionStateVector2f>,
) -> R {
    call("xrGetActionStateVector2f", |state| {
        let info = given!(info, sys::ActionStateGetInfo);
        let answer = given!(answer, sys::ActionStateVector2f);
        let kind = sys::ActionType::VECTOR2F_INPUT;
        let values = state.values(session, info, kind, |hand, _| {
            let [x, y] = hand.stick;
            sys::Vector2f { x, y }
        })?;
        set!(answer, values, state);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn get_action_state_pose(
    session: sys::Session,
    info: Option<&sys::ActionStateGetInfo>,
    answer: Option<&mut sys::ActionStatePose>,
) -> R {
    call("xrGetActionStatePose", |state| {
        let info = given!(info, sys::ActionStateGetInfo);
        let answer = given!(answer, sys::ActionStatePose);
        let kind = sys::ActionType::POSE_INPUT;
        let driven = state.driven(session, info.action, info.subaction_path, kind)?;
        answer.is_active = driven.is_some().into();
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn enumerate_bound_sources_for_action(
    session: sys::Session,
    info: Option<&sys::BoundSourcesForActionEnumerateInfo>,
    capacity: u32,
    count: Option<&mut u32>,
    sources: Buffer<sys::Path>,
) -> R {
    call("xrEnumerateBoundSourcesForAction", |state| {
        let info = given!(info, sys::BoundSourcesForActionEnumerateInfo);
        state.attached(session, info.action)?;
        fill_with(capacity, count, &sources, &[])
    })
}

pub(crate) extern "system" fn get_input_source_localized_name(
    session: sys::Session,
    info: Option<&sys::InputSourceLocalizedNameGetInfo>,
    capacity: u32,
    count: Option<&mut u32>,
    buffer: Buffer<c_char>,
) -> R {
    call("xrGetInputSourceLocalizedName", |state| {
        let info = given!(info, sys::InputSourceLocalizedNameGetInfo);
        state.session(session)?;
        let path = state.path(info.source_path).ok_or(R::ERROR_PATH_INVALID)?;
        fill_text(capacity, count, &buffer, path)
    })
}
