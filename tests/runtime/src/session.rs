//! Sessions.

use openxr::sys;
use serde_json::json;
use sys::{Handle as _, Result as R, SessionState};

use crate::abi::{chained, given, place};
use crate::events::Event;
use crate::state::{Session, State, locked, told};
use crate::vulkan::Device;

impl State {
    /// Ends a session and destroys its objects.
    pub(crate) fn drop_session(&mut self, raw: u64) {
        let Some(session) = self.sessions.remove(&raw) else {
            return;
        };
        self.spaces.retain(|_, space| space.session != raw);
        self.trackers.retain(|_, tracker| tracker.session != raw);
        self.swapchains.retain(|_, chain| {
            if let (true, Some(device)) = (chain.session == raw, &session.device) {
                device.destroy(&chain.pictures);
            }
            chain.session != raw
        });
    }
}

impl Session {
    /// A session of an instance, not running.
    pub(crate) fn new(instance: u64, device: Option<Device>) -> Self {
        Self {
            instance,
            lost: false,
            state: SessionState::UNKNOWN,
            running: false,
            framed: 0,
            views: sys::ViewConfigurationType::PRIMARY_STEREO,
            leaving: false,
            waited: None,
            begun: None,
            attached: None,
            active_sets: Vec::new(),
            hands: [None, None],
            earlier: [None, None],
            profiles: [None, None],
            device,
        }
    }
}

pub(crate) extern "system" fn create_session(
    instance: sys::Instance,
    info: Option<&sys::SessionCreateInfo>,
    session: Option<&mut sys::Session>,
) -> R {
    told("xrCreateSession", json!({}), |state, with| {
        let info = given!(info, sys::SessionCreateInfo);
        let held = state.system(instance, info.system_id)?;
        // SAFETY: OpenXR's callers chain structures that live through the call.
        let binding: Option<&sys::GraphicsBindingVulkanKHR> =
            unsafe { chained(info.next, sys::GraphicsBindingVulkanKHR::TYPE) };
        let binding = binding.ok_or(R::ERROR_GRAPHICS_DEVICE_INVALID)?;
        if !held.requirements_read {
            return Err(R::ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING);
        }
        let maker = held
            .maker
            .as_ref()
            .ok_or(R::ERROR_GRAPHICS_DEVICE_INVALID)?;
        let device = maker.bind(binding)?;
        let of = instance.into_raw();
        // A lost session has to be destroyed too before there is another.
        if state
            .sessions
            .values()
            .any(|session| session.instance == of)
        {
            return Err(R::ERROR_LIMIT_REACHED);
        }
        let raw = state.handle();
        let made = Session::new(of, Some(device));
        state.sessions.insert(raw, made);
        with["session"] = json!(raw);
        *place!(session) = sys::Session::from_raw(raw);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn destroy_session(session: sys::Session) -> R {
    let raw = session.into_raw();
    told("xrDestroySession", json!({ "session": raw }), |state, _| {
        // A lost one can be destroyed.
        match state.sessions.contains_key(&raw) {
            true => state.drop_session(raw),
            false => return Err(R::ERROR_HANDLE_INVALID),
        }
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn begin_session(
    session: sys::Session,
    info: Option<&sys::SessionBeginInfo>,
) -> R {
    let views = info.map(|info| info.primary_view_configuration_type.into_raw());
    let facts: Vec<String> = views.iter().map(i32::to_string).collect();
    let with = json!({ "views": views });
    let begin = |state: &mut State, _: &mut serde_json::Value| {
        let info = given!(info, sys::SessionBeginInfo);
        let views = info.primary_view_configuration_type;
        state.session_offers(session, views)?;
        let held = state.session(session)?;
        if held.running {
            return Err(R::ERROR_SESSION_RUNNING);
        }
        if held.state != SessionState::READY {
            return Err(R::ERROR_SESSION_NOT_READY);
        }
        held.views = views;
        held.running = true;
        held.framed = 0;
        (held.waited, held.begun) = (None, None);
        let present = state.world.present;
        state.raise(|session| Event::Presence { session, present });
        Ok(R::SUCCESS)
    };
    locked(|state| state.told("xrBeginSession", with, &facts, begin))
}

pub(crate) extern "system" fn end_session(session: sys::Session) -> R {
    told("xrEndSession", json!({}), |state, _| {
        let held = state.session(session)?;
        if !held.running {
            return Err(R::ERROR_SESSION_NOT_RUNNING);
        }
        if held.state != SessionState::STOPPING {
            return Err(R::ERROR_SESSION_NOT_STOPPING);
        }
        held.running = false;
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn request_exit_session(session: sys::Session) -> R {
    told("xrRequestExitSession", json!({}), |state, _| {
        let held = state.session(session)?;
        if !held.running {
            return Err(R::ERROR_SESSION_NOT_RUNNING);
        }
        held.leaving = true;
        Ok(R::SUCCESS)
    })
}
