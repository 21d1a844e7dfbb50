//! Actions: made, bound by the suggestions for the controller that a hand holds, and synced.

use std::collections::BTreeMap;
use std::ffi::c_char;

use openxr::sys;
use sys::{Handle as _, Result as R, SessionState};

use crate::abi::{given, list, place, text_of};
use crate::events::Event;
use crate::profiles;
use crate::script::{HandState, Known, Pose};
use crate::space::side_of;
use crate::state::{State, call};

/// Target of an XrActionSet handle.
pub(crate) struct ActionSet {
    pub instance: u64,
    name: String,
}

/// Target of an XrAction handle.
pub(crate) struct Action {
    pub set: u64,
    name: String,
    pub kind: sys::ActionType,
    /// Its subaction paths.
    pub hands: Vec<sys::Path>,
}

/// The suggested bindings of each profile: actions, and the paths of their controls.
pub(crate) type Bindings = BTreeMap<String, Vec<(u64, String)>>;

/// A hand's state with the control that drives an action, now and at the sync before.
pub(crate) struct Driven {
    pub now: HandState,
    pub earlier: Option<HandState>,
    pub control: String,
}

/// The hands' user paths.
const HANDS: [&str; 2] = ["/user/hand/left", "/user/hand/right"];

/// The hand that a path begins with, and the rest of the path.
pub(crate) fn hand_of(path: &str) -> Option<(usize, &str)> {
    let after = |side: usize| {
        let rest = path.strip_prefix(HANDS[side])?;
        match rest {
            "" => Some((side, "")),
            rest => Some((side, rest.strip_prefix('/')?)),
        }
    };
    after(0).or_else(|| after(1))
}

impl State {
    /// The action, if it belongs to a set that is attached to the session.
    pub(crate) fn attached(
        &mut self,
        session: sys::Session,
        action: sys::Action,
    ) -> Result<&Action, R> {
        let attached = self.session(session)?.attached.clone();
        let action = self.actions.get(&action.into_raw());
        let action = action.ok_or(R::ERROR_HANDLE_INVALID)?;
        match attached.is_some_and(|sets| sets.contains(&action.set)) {
            true => Ok(action),
            false => Err(R::ERROR_ACTIONSET_NOT_ATTACHED),
        }
    }

    /// The control that drives the action by that hand, or by any for the null path.
    pub(crate) fn driven(
        &mut self,
        session: sys::Session,
        action: sys::Action,
        hand: sys::Path,
        kind: sys::ActionType,
    ) -> Result<Option<Driven>, R> {
        let held = self.attached(session, action)?;
        if held.kind != kind {
            return Err(R::ERROR_ACTION_TYPE_MISMATCH);
        }
        if hand != sys::Path::NULL && !held.hands.contains(&hand) {
            return Err(R::ERROR_PATH_UNSUPPORTED);
        }
        Ok(self.drives(session.into_raw(), action.into_raw(), hand))
    }

    fn drives(&self, session: u64, action: u64, hand: sys::Path) -> Option<Driven> {
        let session = self.sessions.get(&session)?;
        let set = self.actions.get(&action)?.set;
        if !session.active_sets.contains(&set) {
            return None;
        }
        let bindings = &self.instances.get(&session.instance)?.bindings;
        let sides = match side_of(self, hand) {
            Some(side) => side..side + 1,
            None => 0..2,
        };
        sides.into_iter().find_map(|side| {
            let now = session.hands[side].clone()?;
            let profile = session.profiles[side].as_ref()?;
            let bound = bindings.get(profile)?.iter();
            let mut controls = bound
                .filter(|(bound, _)| *bound == action)
                .filter_map(|(_, path)| hand_of(path))
                .filter(|(on, _)| *on == side);
            let control = controls.next()?.1.to_owned();
            let earlier = session.earlier[side].clone();
            Some(Driven {
                now,
                earlier,
                control,
            })
        })
    }

    /// The gaze, where the action is bound to it.
    fn gaze(&self, session: u64, action: u64) -> Option<(Pose, Known)> {
        let session = self.sessions.get(&session)?;
        let set = self.actions.get(&action)?.set;
        let bound = self
            .instances
            .get(&session.instance)?
            .bindings
            .get(profiles::GAZE)?;
        let bound = bound.iter().any(|(bound, _)| *bound == action);
        let active = session.active_sets.contains(&set);
        let gaze = self.world.gaze.filter(|_| bound && active)?;
        Some((gaze, Known::TRACKED))
    }

    /// Pose of a pose action's hand, or of the gaze.
    pub(crate) fn action_pose(
        &self,
        session: u64,
        action: u64,
        hand: sys::Path,
    ) -> Option<(Pose, Known)> {
        if let Some(gaze) = self.gaze(session, action) {
            return Some(gaze);
        }
        let driven = self.drives(session, action, hand)?;
        let side = match side_of(self, hand) {
            Some(side) => side,
            None => (0..2).find(|side| self.sessions[&session].hands[*side].is_some())?,
        };
        // Poses are current, not those of the sync.
        let now = self.world.hands[side].as_ref()?;
        let pose = match driven.control.starts_with("input/aim") {
            true => now.aim,
            false => now.grip,
        };
        Some((pose, now.known))
    }
}

pub(crate) extern "system" fn create_action_set(
    instance: sys::Instance,
    info: Option<&sys::ActionSetCreateInfo>,
    set: Option<&mut sys::ActionSet>,
) -> R {
    call("xrCreateActionSet", |state| {
        let info = given!(info, sys::ActionSetCreateInfo);
        state.instance(instance)?;
        let name = name(&info.action_set_name, &info.localized_action_set_name)?;
        let of = instance.into_raw();
        if state
            .sets
            .values()
            .any(|set| set.instance == of && set.name == name)
        {
            return Err(R::ERROR_NAME_DUPLICATED);
        }
        let raw = state.handle();
        state.sets.insert(raw, ActionSet { instance: of, name });
        *place!(set) = sys::ActionSet::from_raw(raw);
        Ok(R::SUCCESS)
    })
}

/// Checks a name for the specification's characters.
fn name(name: &[c_char], shown: &[c_char]) -> Result<String, R> {
    let name = text_of(name);
    let known =
        |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"-_.".contains(&byte);
    if name.is_empty() {
        return Err(R::ERROR_NAME_INVALID);
    }
    if !name.bytes().all(known) {
        return Err(R::ERROR_PATH_FORMAT_INVALID);
    }
    match text_of(shown).is_empty() {
        true => Err(R::ERROR_LOCALIZED_NAME_INVALID),
        false => Ok(name),
    }
}

pub(crate) extern "system" fn destroy_action_set(set: sys::ActionSet) -> R {
    call("xrDestroyActionSet", |state| {
        let raw = set.into_raw();
        state.sets.remove(&raw).ok_or(R::ERROR_HANDLE_INVALID)?;
        state.actions.retain(|_, action| action.set != raw);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn create_action(
    set: sys::ActionSet,
    info: Option<&sys::ActionCreateInfo>,
    action: Option<&mut sys::Action>,
) -> R {
    call("xrCreateAction", |state| {
        let info = given!(info, sys::ActionCreateInfo);
        let raw_set = set.into_raw();
        let instance = state
            .sets
            .get(&raw_set)
            .ok_or(R::ERROR_HANDLE_INVALID)?
            .instance;
        state.instance(sys::Instance::from_raw(instance))?;
        let holds = |sets: &Vec<u64>| sets.contains(&raw_set);
        if state
            .sessions
            .values()
            .any(|s| s.attached.as_ref().is_some_and(holds))
        {
            return Err(R::ERROR_ACTIONSETS_ALREADY_ATTACHED);
        }
        let name = name(&info.action_name, &info.localized_action_name)?;
        if state
            .actions
            .values()
            .any(|a| a.set == raw_set && a.name == name)
        {
            return Err(R::ERROR_NAME_DUPLICATED);
        }
        // SAFETY: OpenXR's callers pass an array of so many paths.
        let hands = unsafe { list(info.count_subaction_paths, info.subaction_paths) }?.to_vec();
        if hands.iter().any(|hand| side_of(state, *hand).is_none()) {
            return Err(R::ERROR_PATH_UNSUPPORTED);
        }
        let raw = state.handle();
        let made = Action {
            set: raw_set,
            name,
            kind: info.action_type,
            hands,
        };
        state.actions.insert(raw, made);
        *place!(action) = sys::Action::from_raw(raw);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn destroy_action(action: sys::Action) -> R {
    call("xrDestroyAction", |state| {
        let removed = state.actions.remove(&action.into_raw());
        removed.map(|_| R::SUCCESS).ok_or(R::ERROR_HANDLE_INVALID)
    })
}

pub(crate) extern "system" fn suggest_interaction_profile_bindings(
    instance: sys::Instance,
    info: Option<&sys::InteractionProfileSuggestedBinding>,
) -> R {
    call("xrSuggestInteractionProfileBindings", |state| {
        let info = given!(info, sys::InteractionProfileSuggestedBinding);
        let on = state.instance(instance)?.extensions.clone();
        let of = instance.into_raw();
        if state
            .sessions
            .values()
            .any(|s| s.instance == of && s.attached.is_some())
        {
            return Err(R::ERROR_ACTIONSETS_ALREADY_ATTACHED);
        }
        let profile = state
            .path(info.interaction_profile)
            .ok_or(R::ERROR_PATH_INVALID)?;
        let profile = profile.to_owned();
        if !profiles::is_known(&profile, &on) {
            return Err(R::ERROR_PATH_UNSUPPORTED);
        }
        // SAFETY: OpenXR's callers pass an array of so many bindings.
        let asked = unsafe { list(info.count_suggested_bindings, info.suggested_bindings) }?;
        let mut bindings = Vec::new();
        for binding in asked {
            let path = state
                .path(binding.binding)
                .ok_or(R::ERROR_PATH_INVALID)?
                .to_owned();
            let action = binding.action.into_raw();
            if !state.actions.contains_key(&action) {
                return Err(R::ERROR_HANDLE_INVALID);
            }
            let known = hand_of(&path)
                .is_some_and(|(side, control)| profiles::has(&profile, &on, side, control));
            if !known && !profiles::is_gaze(&profile, &path) {
                return Err(R::ERROR_PATH_UNSUPPORTED);
            }
            bindings.push((action, path));
        }
        state.instance(instance)?.bindings.insert(profile, bindings);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn attach_session_action_sets(
    session: sys::Session,
    info: Option<&sys::SessionActionSetsAttachInfo>,
) -> R {
    call("xrAttachSessionActionSets", |state| {
        let info = given!(info, sys::SessionActionSetsAttachInfo);
        if state.session(session)?.attached.is_some() {
            return Err(R::ERROR_ACTIONSETS_ALREADY_ATTACHED);
        }
        // SAFETY: OpenXR's callers pass an array of so many sets.
        let sets = unsafe { list(info.count_action_sets, info.action_sets) }?;
        let sets: Vec<u64> = sets.iter().map(|set| set.into_raw()).collect();
        if !sets.iter().all(|set| state.sets.contains_key(set)) {
            return Err(R::ERROR_HANDLE_INVALID);
        }
        state.session(session)?.attached = Some(sets);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn get_current_interaction_profile(
    session: sys::Session,
    hand: sys::Path,
    profile: Option<&mut sys::InteractionProfileState>,
) -> R {
    call("xrGetCurrentInteractionProfile", |state| {
        let profile = given!(profile, sys::InteractionProfileState);
        let held = state.session(session)?;
        if held.attached.is_none() {
            return Err(R::ERROR_ACTIONSET_NOT_ATTACHED);
        }
        let profiles = held.profiles.clone();
        let side = side_of(state, hand).ok_or(R::ERROR_PATH_UNSUPPORTED)?;
        profile.interaction_profile = match &profiles[side] {
            Some(name) => state.path_of(name),
            None => sys::Path::NULL,
        };
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn sync_actions(
    session: sys::Session,
    info: Option<&sys::ActionsSyncInfo>,
) -> R {
    call("xrSyncActions", |state| {
        let info = given!(info, sys::ActionsSyncInfo);
        // SAFETY: OpenXR's callers pass an array of so many sets.
        let sets = unsafe { list(info.count_active_action_sets, info.active_action_sets) }?;
        let sets: Vec<u64> = sets.iter().map(|set| set.action_set.into_raw()).collect();
        let hands = state.world.hands.clone();
        let held = state.session(session)?;
        let attached = held.attached.clone().unwrap_or_default();
        if !sets.iter().all(|set| attached.contains(set)) {
            return Err(R::ERROR_ACTIONSET_NOT_ATTACHED);
        }
        held.earlier = std::mem::take(&mut held.hands);
        if held.state != SessionState::FOCUSED {
            held.active_sets.clear();
            return Ok(R::SESSION_NOT_FOCUSED);
        }
        let (before, instance) = (held.profiles.clone(), held.instance);
        let bindings = &state.instance(sys::Instance::from_raw(instance))?.bindings;
        // A controller without suggested bindings counts as none.
        let profiles = [0, 1].map(|side: usize| {
            let profile = &hands[side].as_ref()?.profile;
            bindings.contains_key(profile).then(|| profile.clone())
        });
        let held = state.session(session)?;
        held.active_sets = sets;
        held.hands = hands;
        held.profiles = profiles;
        if held.profiles != before {
            let session = session.into_raw();
            let held = state.instance(sys::Instance::from_raw(instance))?;
            held.events.push_back(Event::Profile { session });
        }
        Ok(R::SUCCESS)
    })
}
