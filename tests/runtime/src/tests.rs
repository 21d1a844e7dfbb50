//! The runtime's own rules, called directly and without a device.

use std::ptr::{null, null_mut};

use openxr as xr;
use openxr::sys;
use sys::{Handle as _, Result as R, SessionState};

use crate::layers;
use crate::pictures::{Picture, Pictures};
use crate::script::{Change, Cue, Pose};
use crate::state::{Session, locked};
use crate::swapchain::{self, Swapchain};
use crate::{frame, table};

/// An instance as a program makes it, by the crate that asks for every function of the core by its name.
fn instance(extensions: &xr::ExtensionSet) -> xr::Instance {
    // SAFETY: the function gives OpenXR's.
    let entry =
        unsafe { xr::Entry::from_get_instance_proc_addr(table::get_instance_proc_addr, &()) };
    let application = xr::ApplicationInfo {
        application_name: "test",
        application_version: 0,
        engine_name: "",
        engine_version: 0,
        api_version: xr::Version::new(1, 0, 0),
    };
    let entry = entry.unwrap();
    entry
        .create_instance(&application, extensions, &[], &())
        .unwrap()
}

/// A session that runs, without a device.
fn session(instance: &xr::Instance) -> sys::Session {
    locked(|state| {
        let raw = state.handle();
        let mut session = Session::new(instance.as_raw().into_raw(), None);
        session.state = SessionState::FOCUSED;
        session.running = true;
        state.sessions.insert(raw, session);
        sys::Session::from_raw(raw)
    })
}

/// A swapchain without images, of which one was released.
fn chain(session: sys::Session, format: i64, layers: u32) -> sys::Swapchain {
    let info = sys::SwapchainCreateInfo {
        ty: sys::SwapchainCreateInfo::TYPE,
        next: null(),
        create_flags: sys::SwapchainCreateFlags::EMPTY,
        usage_flags: sys::SwapchainUsageFlags::COLOR_ATTACHMENT,
        format,
        sample_count: 1,
        width: 64,
        height: 48,
        face_count: 1,
        array_size: layers,
        mip_count: 1,
    };
    locked(|state| {
        let raw = state.handle();
        let mut images = Pictures::default();
        images.all.extend([0; 3].map(|_| Picture::default()));
        let mut chain = Swapchain::new(session.into_raw(), &info, images);
        chain.released = true;
        state.swapchains.insert(raw, chain);
        sys::Swapchain::from_raw(raw)
    })
}

fn wait(session: sys::Session) -> (R, sys::FrameState) {
    let mut state = sys::FrameState {
        ty: sys::FrameState::TYPE,
        next: null_mut(),
        predicted_display_time: sys::Time::from_nanos(0),
        predicted_display_period: sys::Duration::from_nanos(0),
        should_render: sys::FALSE,
    };
    let answer = frame::wait_frame(session, None, Some(&mut state));
    (answer, state)
}

fn end(session: sys::Session, time: sys::Time) -> R {
    let info = sys::FrameEndInfo {
        ty: sys::FrameEndInfo::TYPE,
        next: null(),
        display_time: time,
        environment_blend_mode: sys::EnvironmentBlendMode::OPAQUE,
        layer_count: 0,
        layers: null(),
    };
    frame::end_frame(session, Some(&info))
}

#[test]
fn frames_come_in_their_order() {
    let instance = instance(&xr::ExtensionSet::default());
    let session = session(&instance);
    let early = sys::Time::from_nanos(1);
    assert_eq!(
        frame::begin_frame(session, None),
        R::ERROR_CALL_ORDER_INVALID
    );
    assert_eq!(end(session, early), R::ERROR_CALL_ORDER_INVALID);
    let (answer, first) = wait(session);
    assert_eq!(answer, R::SUCCESS);
    assert!(bool::from(first.should_render));
    assert_eq!(end(session, early), R::ERROR_CALL_ORDER_INVALID);
    assert_eq!(frame::begin_frame(session, None), R::SUCCESS);
    // The next one can be waited for within this one, and takes its place.
    let (answer, second) = wait(session);
    assert_eq!(answer, R::SUCCESS);
    let step = second.predicted_display_time - first.predicted_display_time;
    // Other tests of this process may have advanced the time too.
    let period = second.predicted_display_period.as_nanos();
    assert!(step.as_nanos() > 0 && step.as_nanos() % period == 0);
    assert_eq!(frame::begin_frame(session, None), R::FRAME_DISCARDED);
    assert_eq!(
        end(session, first.predicted_display_time),
        R::ERROR_TIME_INVALID
    );
    assert_eq!(end(session, second.predicted_display_time), R::SUCCESS);
    let stale = sys::Session::from_raw(1);
    assert_eq!(wait(stale).0, R::ERROR_HANDLE_INVALID);
    assert_eq!(end(stale, early), R::ERROR_HANDLE_INVALID);
}

#[test]
fn images_come_in_their_order() {
    let instance = instance(&xr::ExtensionSet::default());
    let chain = chain(session(&instance), 43, 2);
    let info = sys::SwapchainImageWaitInfo {
        ty: sys::SwapchainImageWaitInfo::TYPE,
        next: null(),
        timeout: sys::Duration::INFINITE,
    };
    let acquire = || {
        let mut index = u32::MAX;
        let answer = swapchain::acquire_swapchain_image(chain, None, Some(&mut index));
        (answer, index)
    };
    let wait = || swapchain::wait_swapchain_image(chain, Some(&info));
    let release = || swapchain::release_swapchain_image(chain, None);
    let wrong = R::ERROR_CALL_ORDER_INVALID;
    assert_eq!((wait(), release()), (wrong, wrong));
    assert_eq!(acquire(), (R::SUCCESS, 0));
    assert_eq!(release(), wrong);
    assert_eq!(wait(), R::SUCCESS);
    assert_eq!(acquire(), (R::SUCCESS, 1));
    // One is ours already.
    assert_eq!(wait(), wrong);
    assert_eq!(release(), R::SUCCESS);
    assert_eq!(release(), wrong);
    assert_eq!(acquire(), (R::SUCCESS, 2));
    assert_eq!(acquire(), (R::SUCCESS, 0));
    assert_eq!(acquire(), (wrong, u32::MAX));
}

/// A frame with one layer, of pictures with depths, changed by `spoil`.
fn layer(
    session: sys::Session,
    chains: [sys::Swapchain; 2],
    spoil: impl FnOnce(&mut crate::calls::ProjectionView),
) -> Result<(), R> {
    use crate::calls::{Depth, Ended, Layer, Part, ProjectionView};
    let part = |chain: usize, layer| Part {
        swapchain: chains[chain].into_raw(),
        rect: [0, 0, 64, 48],
        layer,
    };
    let fov = locked(|state| state.world.fov[0]);
    let view = |layer| ProjectionView {
        pose: Pose::IDENTITY,
        fov,
        image: part(0, layer),
        depth: Some(Depth {
            image: part(1, layer),
            min: 0.0,
            max: 1.0,
            near: f32::INFINITY,
            far: 0.05,
        }),
    };
    let mut views = [view(0), view(1)];
    spoil(&mut views[1]);
    let ended = Ended {
        time: 0,
        blend: 1,
        layers: vec![Layer::Projection {
            space: Some(crate::script::SpaceKind::Stage),
            flags: 0,
            views: views.to_vec(),
        }],
    };
    locked(|state| layers::check(state, session, &ended))
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let mut extensions = xr::ExtensionSet::default();
    extensions.khr_composition_layer_depth = true;
    let instance = instance(&extensions);
    let session = session(&instance);
    let chains = [chain(session, 43, 2), chain(session, 126, 2)];
    let layer = |spoil: fn(&mut crate::calls::ProjectionView)| layer(session, chains, spoil);
    assert_eq!(layer(|_| {}), Ok(()));
    let turned = |w| Pose::new(glam::Vec3::ZERO, glam::Quat::from_xyzw(0.0, 0.0, 0.0, w));
    assert!(turned(1.0005).is_proper());
    let answers = [
        layer(|view| view.pose.orientation.w = 1.01),
        layer(|view| view.pose.position.x = f32::NAN),
        layer(|view| view.image.rect[2] = 65),
        layer(|view| view.image.rect[0] = 1),
        layer(|view| view.image.layer = 2),
        layer(|view| view.image.swapchain = 1),
        // Depths are no picture, and a picture has no depths.
        layer(|view| view.image = view.depth.unwrap().image),
        layer(|view| view.depth.as_mut().unwrap().image = view.image),
        layer(|view| view.depth.as_mut().unwrap().max = 0.0),
        layer(|view| view.depth.as_mut().unwrap().far = f32::INFINITY),
        layer(|view| view.fov.left = f32::INFINITY),
    ];
    let wanted = [
        R::ERROR_POSE_INVALID,
        R::ERROR_POSE_INVALID,
        R::ERROR_SWAPCHAIN_RECT_INVALID,
        R::ERROR_SWAPCHAIN_RECT_INVALID,
        R::ERROR_VALIDATION_FAILURE,
        R::ERROR_HANDLE_INVALID,
        R::ERROR_LAYER_INVALID,
        R::ERROR_LAYER_INVALID,
        R::ERROR_VALIDATION_FAILURE,
        R::ERROR_VALIDATION_FAILURE,
        R::ERROR_VALIDATION_FAILURE,
    ];
    assert_eq!(answers, wanted.map(Err));
}

#[test]
fn a_binding_of_what_is_not_there_is_refused() {
    let instance = instance(&xr::ExtensionSet::default());
    let set = instance.create_action_set("set", "Set", 0).unwrap();
    let squeeze = set.create_action::<f32>("squeeze", "Squeeze", &[]).unwrap();
    let path = |text: &str| instance.string_to_path(text).unwrap();
    let suggest = |profile: &str, control: &str| {
        let binding = xr::Binding::new(&squeeze, path(control));
        instance.suggest_interaction_profile_bindings(path(profile), &[binding])
    };
    let touch = crate::script::TOUCH;
    let value = "/user/hand/left/input/squeeze/value";
    assert_eq!(suggest(touch, value), Ok(()));
    let click = "/user/hand/left/input/squeeze/click";
    assert_eq!(suggest(touch, click), Err(R::ERROR_PATH_UNSUPPORTED));
    let pico = "/interaction_profiles/bytedance/pico4_controller";
    assert_eq!(suggest(pico, value), Err(R::ERROR_PATH_UNSUPPORTED));
    for text in ["user", "/User", "/user//hand", "/user/", "/.."] {
        let answer = instance.string_to_path(text);
        assert_eq!(answer, Err(R::ERROR_PATH_FORMAT_INVALID), "{text}");
    }
    let again = set.create_action::<bool>("squeeze", "Again", &[]).err();
    assert_eq!(again, Some(R::ERROR_NAME_DUPLICATED));
}

#[test]
fn a_lost_session_answers_so_until_it_is_destroyed() {
    let instance = instance(&xr::ExtensionSet::default());
    let session = session(&instance);
    let lose = |held: &mut Session| held.lost = true;
    locked(|state| state.session(session).map(lose)).unwrap();
    assert_eq!(wait(session).0, R::ERROR_SESSION_LOST);
    assert_eq!(frame::begin_frame(session, None), R::ERROR_SESSION_LOST);
    assert_eq!(crate::session::destroy_session(session), R::SUCCESS);
    assert_eq!(wait(session).0, R::ERROR_HANDLE_INVALID);
}

#[test]
fn a_cue_is_a_line() {
    let cue = Cue {
        at: Some(7),
        change: Change::head(Pose::at(f32::NAN, 1.6, f32::INFINITY)),
    };
    let line = serde_json::to_string(&cue).unwrap();
    assert!(!line.contains('\n'));
    let read: Cue = serde_json::from_str(&line).unwrap();
    let Change::Head { pose, known } = read.change else {
        panic!("{line}");
    };
    assert!(pose.position.x.is_nan() && pose.position.z.is_infinite());
    assert_eq!(known, crate::script::Known::TRACKED);
}
