//! Values of input actions.

use std::ffi::c_char;

use openxr::sys;
use sys::Result as R;

use crate::abi::{Buffer, fill_text, fill_with, given};
use crate::profiles;
use crate::script::HandState;
use crate::state::{State, call};

/// Time of the last sync, as the time at which a value changed; a better one is not known.
fn changed(state: &State) -> sys::Time {
    sys::Time::from_nanos(state.time)
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
        let driven = state.driven(session, info.action, info.subaction_path, kind)?;
        let pressed = |hand: &HandState, control: &str| profiles::value(hand, control) > 0.5;
        let values = driven.map(|driven| {
            let now = pressed(&driven.now, &driven.control);
            let before = driven.earlier.map(|hand| pressed(&hand, &driven.control));
            (now, before.is_some_and(|before| before != now))
        });
        let (now, has_changed) = values.unwrap_or_default();
        answer.current_state = now.into();
        answer.changed_since_last_sync = has_changed.into();
        answer.last_change_time = changed(state);
        answer.is_active = values.is_some().into();
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
        let kind = sys::ActionType::FLOAT_INPUT;
        let driven = state.driven(session, info.action, info.subaction_path, kind)?;
        let values = driven.map(|driven| {
            let now = profiles::value(&driven.now, &driven.control);
            let before = driven
                .earlier
                .map(|hand| profiles::value(&hand, &driven.control));
            (now, before.is_some_and(|before| before != now))
        });
        let (now, has_changed) = values.unwrap_or_default();
        answer.current_state = now;
        answer.changed_since_last_sync = has_changed.into();
        answer.last_change_time = changed(state);
        answer.is_active = values.is_some().into();
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
        let driven = state.driven(session, info.action, info.subaction_path, kind)?;
        let values = driven.map(|driven| {
            let before = driven.earlier.map(|hand| hand.stick);
            let now = driven.now.stick;
            (now, before.is_some_and(|before| before != now))
        });
        let ([x, y], has_changed) = values.unwrap_or_default();
        answer.current_state = sys::Vector2f { x, y };
        answer.changed_since_last_sync = has_changed.into();
        answer.last_change_time = changed(state);
        answer.is_active = values.is_some().into();
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
