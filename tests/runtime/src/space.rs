//! Spaces, and the positions of objects in them. At every time objects are where the script has them now; only the origins of spaces
//! change at times of their own.

use openxr::sys;
use sys::{Handle as _, Result as R};

use crate::abi::{Buffer, fill_with, given, place};
use crate::actions::hand_of;
use crate::script::{Known, Pose, SpaceKind};
use crate::state::{State, call};
use crate::views::FOLLOWS;
use crate::world::raw_space;

/// Target of an XrSpace handle.
pub(crate) struct Space {
    pub session: u64,
    of: Of,
    /// The space in the frame of the object that it belongs to.
    shift: Pose,
}

enum Of {
    Reference(SpaceKind),
    Action { action: u64, hand: sys::Path },
}

impl Space {
    pub(crate) fn kind(&self) -> SpaceKind {
        match self.of {
            Of::Reference(kind) => kind,
            Of::Action { .. } => SpaceKind::Action,
        }
    }
}

impl State {
    /// The space in the runtime's own world, and its known parts.
    fn world_from(&self, space: &Space, time: i64) -> (Pose, Known) {
        let world = &self.world;
        let (pose, known) = match space.of {
            Of::Reference(SpaceKind::View) => world.head,
            Of::Reference(SpaceKind::Gaze) => match world.gaze {
                Some(gaze) => (gaze, Known::TRACKED),
                None => (Pose::IDENTITY, Known::NOTHING),
            },
            Of::Reference(SpaceKind::Local) => (world.local.at(time), Known::TRACKED),
            Of::Reference(SpaceKind::LocalFloor) => (world.floor.at(time), Known::TRACKED),
            Of::Reference(_) => (world.stage.at(time), Known::TRACKED),
            Of::Action { action, hand } => self
                .action_pose(space.session, action, hand)
                .unwrap_or((Pose::IDENTITY, Known::NOTHING)),
        };
        (pose.compose(&space.shift), known)
    }

    /// A pose of the runtime's own world in the frame of the space.
    pub(crate) fn seen_from(
        &mut self,
        space: sys::Space,
        session: u64,
        time: sys::Time,
        (pose, known): (Pose, Known),
    ) -> Result<(Pose, Known), R> {
        self.session_of(session)?;
        self.check_time(time)?;
        let base = self.spaces.get(&space.into_raw());
        let base = base.filter(|base| base.session == session);
        let base = base.ok_or(R::ERROR_HANDLE_INVALID)?;
        let (origin, origin_known) = self.world_from(base, time.as_nanos());
        Ok((origin.inverse().compose(&pose), origin_known.and(known)))
    }

    fn new_space(
        &mut self,
        session: sys::Session,
        of: Of,
        shift: &sys::Posef,
    ) -> Result<sys::Space, R> {
        self.session(session)?;
        let shift = Pose::read(shift);
        if !shift.is_proper() {
            return Err(R::ERROR_POSE_INVALID);
        }
        let raw = self.handle();
        let session = session.into_raw();
        self.spaces.insert(raw, Space { session, of, shift });
        Ok(sys::Space::from_raw(raw))
    }
}

pub(crate) extern "system" fn enumerate_reference_spaces(
    session: sys::Session,
    capacity: u32,
    count: Option<&mut u32>,
    spaces: Buffer<sys::ReferenceSpaceType>,
) -> R {
    call("xrEnumerateReferenceSpaces", |state| {
        state.session(session)?;
        let offered = offered(state, session);
        let offered: Vec<_> = offered.into_iter().filter_map(raw_space).collect();
        fill_with(capacity, count, &spaces, &offered)
    })
}

/// The offered reference spaces; LOCAL_FLOOR and the gaze's need their extensions.
fn offered(state: &mut State, session: sys::Session) -> Vec<SpaceKind> {
    let mut offered = state.world.spaces.clone();
    offered.retain(|kind| match kind {
        SpaceKind::LocalFloor => state.session_has(session, "XR_EXT_local_floor").is_ok(),
        SpaceKind::Gaze => state.session_has(session, FOLLOWS).is_ok(),
        _ => true,
    });
    offered
}

pub(crate) extern "system" fn create_reference_space(
    session: sys::Session,
    info: Option<&sys::ReferenceSpaceCreateInfo>,
    space: Option<&mut sys::Space>,
) -> R {
    call("xrCreateReferenceSpace", |state| {
        let info = given!(info, sys::ReferenceSpaceCreateInfo);
        state.session(session)?;
        let kind = offered(state, session)
            .into_iter()
            .find(|kind| raw_space(*kind) == Some(info.reference_space_type))
            .ok_or(R::ERROR_REFERENCE_SPACE_UNSUPPORTED)?;
        let shift = &info.pose_in_reference_space;
        *place!(space) = state.new_space(session, Of::Reference(kind), shift)?;
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn create_action_space(
    session: sys::Session,
    info: Option<&sys::ActionSpaceCreateInfo>,
    space: Option<&mut sys::Space>,
) -> R {
    call("xrCreateActionSpace", |state| {
        let info = given!(info, sys::ActionSpaceCreateInfo);
        state.session(session)?;
        let (action, hand) = (info.action.into_raw(), info.subaction_path);
        let held = state.actions.get(&action).ok_or(R::ERROR_HANDLE_INVALID)?;
        if held.kind != sys::ActionType::POSE_INPUT {
            return Err(R::ERROR_ACTION_TYPE_MISMATCH);
        }
        if hand != sys::Path::NULL && !held.hands.contains(&hand) {
            return Err(R::ERROR_PATH_UNSUPPORTED);
        }
        let of = Of::Action { action, hand };
        *place!(space) = state.new_space(session, of, &info.pose_in_action_space)?;
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn destroy_space(space: sys::Space) -> R {
    call("xrDestroySpace", |state| {
        let removed = state.spaces.remove(&space.into_raw());
        removed.map(|_| R::SUCCESS).ok_or(R::ERROR_HANDLE_INVALID)
    })
}

pub(crate) extern "system" fn get_reference_space_bounds_rect(
    session: sys::Session,
    _kind: sys::ReferenceSpaceType,
    bounds: Option<&mut sys::Extent2Df>,
) -> R {
    call("xrGetReferenceSpaceBoundsRect", |state| {
        state.session(session)?;
        *place!(bounds) = sys::Extent2Df {
            width: 0.0,
            height: 0.0,
        };
        Ok(R::SPACE_BOUNDS_UNAVAILABLE)
    })
}

pub(crate) extern "system" fn locate_space(
    space: sys::Space,
    base: sys::Space,
    time: sys::Time,
    location: Option<&mut sys::SpaceLocation>,
) -> R {
    call("xrLocateSpace", |state| {
        let location = given!(location, sys::SpaceLocation);
        let located = state.spaces.get(&space.into_raw());
        let located = located.ok_or(R::ERROR_HANDLE_INVALID)?;
        let session = located.session;
        let there = state.world_from(located, time.as_nanos());
        let (pose, known) = state.seen_from(base, session, time, there)?;
        (location.location_flags, location.pose) = known.show(&pose);
        // Velocities are never known.
        let mut next = location.next.cast::<sys::BaseOutStructure>();
        while !next.is_null() {
            // SAFETY: OpenXR's callers chain structures, which all begin like this one.
            let (ty, after) = unsafe { ((*next).ty, (*next).next) };
            if ty == sys::SpaceVelocity::TYPE {
                // SAFETY: by its type it is this structure.
                let velocity = unsafe { &mut *next.cast::<sys::SpaceVelocity>() };
                velocity.velocity_flags = sys::SpaceVelocityFlags::EMPTY;
            }
            next = after;
        }
        Ok(R::SUCCESS)
    })
}

/// The hand of a subaction path, where it is one.
pub(crate) fn side_of(state: &State, path: sys::Path) -> Option<usize> {
    state.path(path).and_then(hand_of).map(|(side, _)| side)
}
