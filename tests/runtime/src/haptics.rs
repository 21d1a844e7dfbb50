//! Vibrations of hands: they are written to the log of calls.

use openxr::sys;
use serde_json::json;
use sys::{Result as R, SessionState};

use crate::abi::{given, place};
use crate::number::Number;
use crate::space::side_of;
use crate::state::{State, told};

/// Checks a haptic action; `SESSION_NOT_FOCUSED` where the session does not have the input focus.
fn shaken(state: &mut State, session: sys::Session, info: &sys::HapticActionInfo) -> Result<R, R> {
    let kind = sys::ActionType::VIBRATION_OUTPUT;
    state.driven(session, info.action, info.subaction_path, kind)?;
    match state.session(session)?.state == SessionState::FOCUSED {
        true => Ok(R::SUCCESS),
        false => Ok(R::SESSION_NOT_FOCUSED),
    }
}

pub(crate) extern "system" fn apply_haptic_feedback(
    session: sys::Session,
    info: Option<&sys::HapticActionInfo>,
    feedback: Option<&sys::HapticBaseHeader>,
) -> R {
    told("xrApplyHapticFeedback", json!({}), |state, with| {
        let info = given!(info, sys::HapticActionInfo);
        let feedback = place!(feedback);
        if feedback.ty != sys::HapticVibration::TYPE {
            return Err(R::ERROR_VALIDATION_FAILURE);
        }
        // SAFETY: by its type it is this structure.
        let vibration = unsafe { &*std::ptr::from_ref(feedback).cast::<sys::HapticVibration>() };
        let duration = vibration.duration.as_nanos();
        *with = json!({
            "hand": side_of(state, info.subaction_path),
            "amplitude": Number(vibration.amplitude),
            "duration": duration,
            "frequency": Number(vibration.frequency),
        });
        let answer = shaken(state, session, info)?;
        let lasts = duration > 0 || vibration.duration == sys::Duration::MIN_HAPTIC;
        match (0.0..=1.0).contains(&vibration.amplitude) && lasts {
            true => Ok(answer),
            false => Err(R::ERROR_VALIDATION_FAILURE),
        }
    })
}

pub(crate) extern "system" fn stop_haptic_feedback(
    session: sys::Session,
    info: Option<&sys::HapticActionInfo>,
) -> R {
    told("xrStopHapticFeedback", json!({}), |state, with| {
        let info = given!(info, sys::HapticActionInfo);
        with["hand"] = json!(side_of(state, info.subaction_path));
        shaken(state, session, info)
    })
}
