//! The supported controllers and their controls (OpenXR specification, "Interaction Profile Paths").

use crate::script::HandState;

/// Paths of both hands, of the left and of the right alone, parted by spaces.
type Controls = [&'static str; 3];

const TOUCH: Controls = [
    "input/squeeze input/squeeze/value input/trigger input/trigger/value input/trigger/touch \
        input/thumbstick input/thumbstick/x input/thumbstick/y input/thumbstick/click \
        input/thumbstick/touch input/thumbrest/touch output/haptic",
    "input/x input/x/click input/x/touch input/y input/y/click input/y/touch input/menu/click",
    "input/a input/a/click input/a/touch input/b input/b/click input/b/touch \
        input/system/click",
];

/// Controls of a profile; `None` for one that is not supported with these extensions.
fn controls(profile: &str, extensions: &[String]) -> Option<Controls> {
    let on = |name: &str| extensions.iter().any(|on| on == name);
    let both = match profile.strip_prefix("/interaction_profiles/")? {
        "khr/simple_controller" => {
            "input/select input/select/click input/menu input/menu/click output/haptic"
        }
        "oculus/touch_controller" => return Some(TOUCH),
        "bytedance/pico4_controller" if on("XR_BD_controller_interaction") => return Some(TOUCH),
        "valve/index_controller" => {
            "input/system/click input/a input/a/click input/b input/b/click input/squeeze \
        input/squeeze/value input/squeeze/force input/trigger input/trigger/click \
        input/trigger/value input/thumbstick input/thumbstick/x input/thumbstick/y \
        input/thumbstick/click input/trackpad input/trackpad/force output/haptic"
        }
        "htc/vive_controller" => {
            "input/system/click input/squeeze input/squeeze/click input/menu input/menu/click \
        input/trigger input/trigger/click input/trigger/value input/trackpad input/trackpad/x \
        input/trackpad/y input/trackpad/click input/trackpad/touch output/haptic"
        }
        "microsoft/motion_controller" => {
            "input/squeeze input/squeeze/click input/menu input/menu/click input/trigger \
        input/trigger/value input/thumbstick input/thumbstick/x input/thumbstick/y \
        input/thumbstick/click input/trackpad input/trackpad/x input/trackpad/y \
        input/trackpad/click input/trackpad/touch output/haptic"
        }
        "ext/hand_interaction_ext" if on("XR_EXT_hand_interaction") => {
            "input/pinch_ext input/pinch_ext/value input/pinch_ext/ready_ext input/pinch_ext/pose \
        input/poke_ext/pose input/aim_activate_ext/value input/aim_activate_ext/ready_ext \
        input/grasp_ext input/grasp_ext/value input/grasp_ext/ready_ext"
        }
        "ext/eye_gaze_interaction" if on("XR_EXT_eye_gaze_interaction") => "",
        _ => return None,
    };
    Some([both, "", ""])
}

/// The gaze's profile, which no hand has, and its only path.
pub(crate) const GAZE: &str = "/interaction_profiles/ext/eye_gaze_interaction";
const GAZE_POSE: &str = "/user/eyes_ext/input/gaze_ext/pose";

/// Whether that path belongs to the gaze's profile.
pub(crate) fn is_gaze(profile: &str, path: &str) -> bool {
    (profile, path) == (GAZE, GAZE_POSE)
}

/// Poses of every hand's profile.
const POSES: &str = "input/grip input/grip/pose input/aim input/aim/pose";

/// Whether the profile is supported.
pub(crate) fn is_known(profile: &str, extensions: &[String]) -> bool {
    controls(profile, extensions).is_some()
}

/// Whether the hand's controller of that profile has the control.
pub(crate) fn has(profile: &str, extensions: &[String], side: usize, control: &str) -> bool {
    let Some(controls) = controls(profile, extensions) else {
        return false;
    };
    if profile == GAZE {
        return false;
    }
    let of = [POSES, controls[0], controls[1 + side]];
    let mut known = of.iter().flat_map(|list| list.split_whitespace());
    known.any(|known| known == control)
}

/// The value of a control; a button's is 0 or 1.
pub(crate) fn value(hand: &HandState, control: &str) -> f32 {
    let button = |pressed: bool| if pressed { 1.0 } else { 0.0 };
    let rest = control.strip_prefix("input/").unwrap_or_default();
    match rest {
        "squeeze/click" => button(hand.squeeze > 0.5),
        "trigger/click" | "select" | "select/click" => button(hand.trigger > 0.5),
        "squeeze" | "squeeze/value" | "grasp_ext" | "grasp_ext/value" => hand.squeeze,
        "trigger" | "trigger/value" | "pinch_ext" | "pinch_ext/value" => hand.trigger,
        "thumbstick/x" | "trackpad/x" => hand.stick[0],
        "thumbstick/y" | "trackpad/y" => hand.stick[1],
        "a" | "a/click" | "x" | "x/click" | "trackpad/click" => button(hand.a),
        "b" | "b/click" | "y" | "y/click" | "menu" | "menu/click" => button(hand.b),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::TOUCH;

    #[test]
    fn touch_has_its_buttons_on_their_sides() {
        let has = |side, control| has(TOUCH, &[], side, control);
        assert!(has(0, "input/x/click") && !has(1, "input/x/click"));
        assert!(has(1, "input/a/click") && !has(0, "input/a/click"));
        assert!(has(0, "input/squeeze/value") && !has(0, "input/squeeze/click"));
        assert!(has(0, "input/aim/pose"));
    }

    #[test]
    fn a_profile_of_an_extension_needs_it() {
        let pico = "/interaction_profiles/bytedance/pico4_controller";
        assert!(!is_known(pico, &[]));
        assert!(is_known(pico, &["XR_BD_controller_interaction".to_owned()]));
    }
}
