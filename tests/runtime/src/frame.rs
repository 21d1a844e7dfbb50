//! The frame loop: frames are waited for, begun, ended. Time advances with them and not with any clock.

use std::time::Duration;

use openxr::sys;
use serde_json::{Value, json};
use sys::{Result as R, SessionState};

use crate::abi::{Answer, given};
use crate::layers;
use crate::state::{State, call, locked, told};

/// How long an xrWaitFrame waits for the frame before to begin, which another thread may do, ms. A runtime would wait for ever; here it is
/// refused then.
const PATIENCE_MS: u32 = 2000;

impl State {
    /// Checks that the runtime has poses for the time.
    pub(crate) fn check_time(&self, time: sys::Time) -> Result<(), R> {
        // From the first frame to a second after the last.
        let known = crate::world::EPOCH..=self.time + 1_000_000_000;
        match known.contains(&time.as_nanos()) {
            true => Ok(()),
            false => Err(R::ERROR_TIME_INVALID),
        }
    }

    fn wait_frame(&mut self, session: sys::Session, frame: Option<&mut sys::FrameState>) -> Answer {
        let (time, period) = (self.time, self.world.period);
        let held = self.session(session)?;
        if !held.running {
            return Err(R::ERROR_SESSION_NOT_RUNNING);
        }
        let frame = given!(frame, sys::FrameState);
        let seen = [SessionState::VISIBLE, SessionState::FOCUSED].contains(&held.state);
        held.waited = Some(time);
        frame.predicted_display_time = sys::Time::from_nanos(time);
        frame.predicted_display_period = sys::Duration::from_nanos(period);
        frame.should_render = seen.into();
        Ok(R::SUCCESS)
    }
}

pub(crate) extern "system" fn wait_frame(
    session: sys::Session,
    _info: Option<&sys::FrameWaitInfo>,
    frame: Option<&mut sys::FrameState>,
) -> R {
    let pause = || std::thread::sleep(Duration::from_millis(1));
    let waits = || locked(|state| state.session(session).is_ok_and(|s| s.waited.is_some()));
    for _ in 0..PATIENCE_MS {
        if !waits() {
            break;
        }
        pause();
    }
    if waits() {
        let with = json!({ "cause": "the frame before has not begun" });
        return told("xrWaitFrame", with, |_, _| Err(R::ERROR_CALL_ORDER_INVALID));
    }
    // A program that is not shown would otherwise turn as fast as it can.
    pause();
    locked(|state| {
        state.begin_wait();
        let with = json!({ "time": state.time });
        state.told("xrWaitFrame", with, &[], |state, _| {
            state.wait_frame(session, frame)
        })
    })
}

pub(crate) extern "system" fn begin_frame(
    session: sys::Session,
    _info: Option<&sys::FrameBeginInfo>,
) -> R {
    call("xrBeginFrame", |state| {
        let held = state.session(session)?;
        if !held.running {
            return Err(R::ERROR_SESSION_NOT_RUNNING);
        }
        let waited = held.waited.take().ok_or(R::ERROR_CALL_ORDER_INVALID)?;
        match held.begun.replace(waited) {
            None => Ok(R::SUCCESS),
            Some(_) => Ok(R::FRAME_DISCARDED),
        }
    })
}

pub(crate) extern "system" fn end_frame(
    session: sys::Session,
    info: Option<&sys::FrameEndInfo>,
) -> R {
    locked(|state| {
        let read = info.filter(|info| info.ty == sys::FrameEndInfo::TYPE);
        let ended = read.map(|info| layers::read(state, info));
        let with = ended.as_ref().map_or(Value::Null, |ended| json!(ended));
        let facts = ended.as_ref().map(layers::facts).unwrap_or_default();
        state.told("xrEndFrame", with, &facts, |state, _| {
            let held = state.session(session)?;
            if !held.running {
                return Err(R::ERROR_SESSION_NOT_RUNNING);
            }
            let begun = held.begun.ok_or(R::ERROR_CALL_ORDER_INVALID)?;
            let ended = ended.ok_or(R::ERROR_VALIDATION_FAILURE)?;
            // The specification allows any time; a picture of another one is an error of ours.
            if ended.time != begun {
                return Err(R::ERROR_TIME_INVALID);
            }
            layers::check(state, session, &ended)?;
            // A frame that is refused stays open.
            let held = state.session(session)?;
            held.begun = None;
            held.framed += 1;
            Ok(R::SUCCESS)
        })
    })
}
