//! Actions of both hands: made, bound by the table of profiles, and read once a frame.

use std::sync::Arc;

use openxr as xr;

use super::bindings::{On, POSES, PROFILES, Profile, Use};
use super::convert::{CallFailure, failed, located};
use super::seen::Seen;
use crate::{Hand, Joints, Pose, Side};

type Session = xr::Session<xr::Vulkan>;

/// Duration of a vibration that is not repeated, ns.
const FADE_NS: i64 = 200_000_000;

/// The actions in a session: spaces first, so that each is destroyed before the action that it belongs to.
pub(super) struct Actions {
    hands: [Bound; 2],
    seen: Option<Seen>,
    /// The gaze; `None` where the runtime does not track it.
    gaze: Option<xr::Space>,
    of: Set,
    /// By hand, whether the last call started a vibration.
    shaken: [bool; 2],
}

/// The actions of an instance, each before its set.
struct Set {
    hands: [xr::Path; 2],
    grip: xr::Action<xr::Posef>,
    aim: xr::Action<xr::Posef>,
    squeeze: xr::Action<f32>,
    trigger: xr::Action<f32>,
    stick: xr::Action<xr::Vector2f>,
    a: xr::Action<bool>,
    b: xr::Action<bool>,
    haptic: xr::Action<xr::Haptic>,
    gaze: Option<xr::Action<xr::Posef>>,
    set: xr::ActionSet,
}

/// Spaces and state of one hand.
struct Bound {
    path: xr::Path,
    grip: xr::Space,
    aim: xr::Space,
    profile: Arc<str>,
}

impl Set {
    fn new(instance: &xr::Instance) -> Result<Self, CallFailure> {
        let hands = [
            find(instance, xr::USER_HAND_LEFT)?,
            find(instance, xr::USER_HAND_RIGHT)?,
        ];
        let set = instance
            .create_action_set("lab", "Laboratory", 0)
            .map_err(failed("xrCreateActionSet"))?;
        Ok(Self {
            grip: action(&set, "grip_pose", "Grip", &hands)?,
            aim: action(&set, "aim_pose", "Point", &hands)?,
            squeeze: action(&set, "squeeze", "Close the hand", &hands)?,
            trigger: action(&set, "trigger", "Pull the trigger", &hands)?,
            stick: action(&set, "thumbstick", "Thumbstick", &hands)?,
            a: action(&set, "button_a", "First button", &hands)?,
            b: action(&set, "button_b", "Second button", &hands)?,
            haptic: action(&set, "haptic", "Feel", &hands)?,
            gaze: match instance.exts().ext_eye_gaze_interaction {
                Some(_) => Some(action(&set, "gaze", "Look", &[])?),
                None => None,
            },
            hands,
            set,
        })
    }

    /// Suggests one row of the table; the inner result is the runtime's answer.
    fn suggest(
        &self,
        instance: &xr::Instance,
        profile: &Profile,
    ) -> Result<xr::Result<()>, CallFailure> {
        let mut bindings = Vec::new();
        for (used, on, control) in POSES.iter().chain(profile.controls) {
            let hands = match on {
                On::Both => &[xr::USER_HAND_LEFT, xr::USER_HAND_RIGHT][..],
                On::Left => &[xr::USER_HAND_LEFT],
                On::Right => &[xr::USER_HAND_RIGHT],
            };
            for hand in hands {
                let path = find(instance, &format!("{hand}/{control}"))?;
                bindings.push(match used {
                    Use::Grip => xr::Binding::new(&self.grip, path),
                    Use::Aim => xr::Binding::new(&self.aim, path),
                    Use::Squeeze => xr::Binding::new(&self.squeeze, path),
                    Use::Trigger => xr::Binding::new(&self.trigger, path),
                    Use::Stick => xr::Binding::new(&self.stick, path),
                    Use::A => xr::Binding::new(&self.a, path),
                    Use::B => xr::Binding::new(&self.b, path),
                    Use::Haptic => xr::Binding::new(&self.haptic, path),
                });
            }
        }
        let path = find(instance, profile.path)?;
        Ok(instance.suggest_interaction_profile_bindings(path, &bindings))
    }

    /// Suggests the gaze's binding, which belongs to no hand (XR_EXT_eye_gaze_interaction).
    fn suggest_gaze(&self, instance: &xr::Instance) -> Result<(), CallFailure> {
        let Some(gaze) = &self.gaze else {
            return Ok(());
        };
        let profile = find(instance, "/interaction_profiles/ext/eye_gaze_interaction")?;
        let path = find(instance, "/user/eyes_ext/input/gaze_ext/pose")?;
        let binding = xr::Binding::new(gaze, path);
        if let Err(answer) = instance.suggest_interaction_profile_bindings(profile, &[binding]) {
            tracing::warn!(%answer, "binding of the gaze refused");
        }
        Ok(())
    }
}

impl Actions {
    /// Makes the actions, suggests bindings for every profile that is offered, and attaches them.
    pub(super) fn new(instance: &xr::Instance, session: &Session) -> Result<Self, CallFailure> {
        let of = Set::new(instance)?;
        let on = instance.exts();
        for profile in PROFILES.iter().filter(|profile| (profile.offered)(on)) {
            // A runtime may support fewer profiles than the specification has (XR_ERROR_PATH_UNSUPPORTED); the others serve.
            if let Err(answer) = of.suggest(instance, profile)? {
                tracing::warn!(profile = profile.path, %answer, "bindings refused");
            }
        }
        of.suggest_gaze(instance)?;
        session
            .attach_action_sets(&[&of.set])
            .map_err(failed("xrAttachSessionActionSets"))?;
        let space = |action: &xr::Action<xr::Posef>, path| {
            action
                .create_space(session, path, xr::Posef::IDENTITY)
                .map_err(failed("xrCreateActionSpace"))
        };
        let bound = |path| -> Result<Bound, CallFailure> {
            Ok(Bound {
                path,
                grip: space(&of.grip, path)?,
                aim: space(&of.aim, path)?,
                profile: Arc::from(""),
            })
        };
        Ok(Self {
            hands: [bound(of.hands[0])?, bound(of.hands[1])?],
            seen: Seen::new(instance, session),
            gaze: match &of.gaze {
                Some(gaze) => Some(space(gaze, xr::Path::NULL)?),
                None => None,
            },
            of,
            shaken: [false; 2],
        })
    }

    /// Queries which controllers the hands hold now.
    pub(super) fn name_profiles(
        &mut self,
        instance: &xr::Instance,
        session: &Session,
    ) -> Result<(), CallFailure> {
        for hand in &mut self.hands {
            let profile = session
                .current_interaction_profile(hand.path)
                .map_err(failed("xrGetCurrentInteractionProfile"))?;
            hand.profile = if profile == xr::Path::NULL {
                Arc::from("")
            } else {
                let name = instance
                    .path_to_string(profile)
                    .map_err(failed("xrPathToString"))?;
                Arc::from(name)
            };
        }
        Ok(())
    }

    /// Syncs the actions and updates `hands` for `time`; returns the joints of bare hands. A pose that is not known stays.
    pub(super) fn read(
        &self,
        session: &Session,
        stage: &xr::Space,
        time: xr::Time,
        hands: &mut [Hand; 2],
    ) -> Result<[Option<Joints>; 2], CallFailure> {
        // Without the focus this answers SESSION_NOT_FOCUSED, which is no error, and every action
        // is inactive.
        session
            .sync_actions(&[xr::ActiveActionSet::new(&self.of.set)])
            .map_err(failed("xrSyncActions"))?;
        let mut joints = [None, None];
        for side in Side::BOTH {
            let hand = &mut hands[side as usize];
            self.read_hand(session, stage, time, &self.hands[side as usize], hand)?;
            if let Some(seen) = &self.seen {
                joints[side as usize] = seen.read(stage, time, side, hand)?;
            }
        }
        Ok(joints)
    }

    fn read_hand(
        &self,
        session: &Session,
        stage: &xr::Space,
        time: xr::Time,
        bound: &Bound,
        hand: &mut Hand,
    ) -> Result<(), CallFailure> {
        let float = |action: &xr::Action<f32>| -> Result<f32, CallFailure> {
            let state = action
                .state(session, bound.path)
                .map_err(failed("xrGetActionStateFloat"))?;
            Ok(if state.is_active {
                state.current_state
            } else {
                0.0
            })
        };
        let button = |action: &xr::Action<bool>| -> Result<bool, CallFailure> {
            let state = action
                .state(session, bound.path)
                .map_err(failed("xrGetActionStateBoolean"))?;
            Ok(state.is_active && state.current_state)
        };
        let locate = |space: &xr::Space| space.locate(stage, time).map_err(failed("xrLocateSpace"));
        hand.active = self
            .of
            .grip
            .is_active(session, bound.path)
            .map_err(failed("xrGetActionStatePose"))?;
        let grip = locate(&bound.grip)?;
        let known = located(&grip);
        let measured =
            xr::SpaceLocationFlags::POSITION_TRACKED | xr::SpaceLocationFlags::ORIENTATION_TRACKED;
        hand.valid = known.is_some();
        hand.tracked = hand.valid && grip.location_flags.contains(measured);
        if let Some(pose) = known {
            hand.stage_from_grip = pose;
        }
        if let Some(pose) = located(&locate(&bound.aim)?) {
            hand.stage_from_aim = pose;
        }
        hand.squeeze = float(&self.of.squeeze)?;
        hand.trigger = float(&self.of.trigger)?;
        let stick = self
            .of
            .stick
            .state(session, bound.path)
            .map_err(failed("xrGetActionStateVector2f"))?;
        hand.thumbstick = if stick.is_active {
            [stick.current_state.x, stick.current_state.y]
        } else {
            [0.0; 2]
        };
        hand.button_a = button(&self.of.a)?;
        hand.button_b = button(&self.of.b)?;
        hand.profile = bound.profile.clone();
        Ok(())
    }

    /// The gaze at `time`, from the last sync: from between the eyes along -Z. `None` where it is not known.
    pub(super) fn gaze(
        &self,
        stage: &xr::Space,
        time: xr::Time,
    ) -> Result<Option<Pose>, CallFailure> {
        let Some(gaze) = &self.gaze else {
            return Ok(None);
        };
        let found = gaze.locate(stage, time).map_err(failed("xrLocateSpace"))?;
        Ok(located(&found))
    }

    /// Vibrates a hand, or stops it at amplitude 0. A hand at rest gets no call: some runtimes send a packet to the controller for each.
    pub(super) fn vibrate(
        &mut self,
        session: &Session,
        side: Side,
        amplitude: f32,
    ) -> Result<(), CallFailure> {
        let path = self.hands[side as usize].path;
        let shaken = std::mem::replace(&mut self.shaken[side as usize], amplitude > 0.0);
        if amplitude > 0.0 {
            let vibration = xr::HapticVibration::new()
                .duration(xr::Duration::from_nanos(FADE_NS))
                .frequency(xr::FREQUENCY_UNSPECIFIED)
                .amplitude(amplitude.min(1.0));
            self.of
                .haptic
                .apply_feedback(session, path, &vibration)
                .map_err(failed("xrApplyHapticFeedback"))
        } else if !shaken {
            Ok(())
        } else {
            self.of
                .haptic
                .stop_feedback(session, path)
                .map_err(failed("xrStopHapticFeedback"))
        }
    }
}

fn find(instance: &xr::Instance, path: &str) -> Result<xr::Path, CallFailure> {
    instance
        .string_to_path(path)
        .map_err(failed("xrStringToPath"))
}

fn action<T: xr::ActionTy>(
    set: &xr::ActionSet,
    name: &str,
    shown: &str,
    hands: &[xr::Path],
) -> Result<xr::Action<T>, CallFailure> {
    set.create_action(name, shown, hands)
        .map_err(failed("xrCreateAction"))
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use vitriol_tests::monado;
    use vitriol_tests::program::own_name;

    use super::super::bindings::{Profile, Use};
    use super::super::system;
    use super::*;

    #[test]
    fn monado_takes_the_bindings_of_every_profile() {
        let Some(_rig) = monado::enter(&own_name()) else {
            return;
        };
        let entry = system::entry().unwrap();
        let instance = system::instance(&entry, false, false).unwrap();
        let set = Set::new(&instance).unwrap();
        for profile in &PROFILES {
            let path = profile.path;
            assert!((profile.offered)(instance.exts()), "{path}");
            let answer = set.suggest(&instance, profile).unwrap();
            assert_eq!(answer, Ok(()), "{path}");
        }
        // It would have refused a control that a profile does not have: Touch's squeeze has no click.
        let wrong = Profile {
            path: "/interaction_profiles/oculus/touch_controller",
            offered: |_| true,
            controls: &[(Use::Squeeze, On::Both, "input/squeeze/click")],
        };
        let answer = set.suggest(&instance, &wrong).unwrap();
        assert_eq!(answer, Err(xr::sys::Result::ERROR_PATH_UNSUPPORTED));
    }
}
