//! Which control of which controller has which use: the one table of interaction profiles.
//!
//! Paths are those of the OpenXR specification, "Interaction Profile Paths", and of the
//! extensions named in the rows. A click bound to a value reads 0 or 1 (same, "Action state
//! conversions"): that is how squeeze and trigger come from controllers that only have buttons.

use openxr::InstanceExtensions;

/// The use of a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    /// Pose of the grip.
    Grip,
    /// Pose for pointing.
    Aim,
    /// Closing the hand, 0 to 1.
    Squeeze,
    /// Pulling the index finger, 0 to 1.
    Trigger,
    /// Thumbstick or its like, x and y.
    Stick,
    /// First button.
    A,
    /// Second button.
    B,
    /// Vibration output.
    Haptic,
}

/// The hands that have a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum On {
    Both,
    Left,
    Right,
}

/// One interaction profile.
pub(super) struct Profile {
    /// Its path.
    pub path: &'static str,
    /// Whether the runtime supports it, by the extensions that are on.
    pub offered: fn(&InstanceExtensions) -> bool,
    /// All its controls but [`POSES`].
    pub controls: &'static [Control],
}

/// Use, hands and path below the hand's.
type Control = (Use, On, &'static str);

/// Controls of every profile.
pub(super) const POSES: [Control; 2] = [
    (Use::Grip, On::Both, "input/grip/pose"),
    (Use::Aim, On::Both, "input/aim/pose"),
];

const HAPTIC: Control = (Use::Haptic, On::Both, "output/haptic");
const TRIGGER: Control = (Use::Trigger, On::Both, "input/trigger/value");
const SQUEEZE: Control = (Use::Squeeze, On::Both, "input/squeeze/value");
const SQUEEZE_CLICK: Control = (Use::Squeeze, On::Both, "input/squeeze/click");
const STICK: Control = (Use::Stick, On::Both, "input/thumbstick");
const MENU: Control = (Use::B, On::Both, "input/menu/click");
const PAD_CLICK: Control = (Use::A, On::Both, "input/trackpad/click");

/// Controls of Touch, and of Pico's controllers, which are like them.
const TOUCH: &[Control] = &[
    SQUEEZE,
    TRIGGER,
    STICK,
    (Use::A, On::Left, "input/x/click"),
    (Use::B, On::Left, "input/y/click"),
    (Use::A, On::Right, "input/a/click"),
    (Use::B, On::Right, "input/b/click"),
    HAPTIC,
];

fn core(_: &InstanceExtensions) -> bool {
    true
}

/// Every profile that bindings are suggested for.
pub(super) const PROFILES: [Profile; 7] = [
    Profile {
        path: "/interaction_profiles/khr/simple_controller",
        offered: core,
        controls: &[(Use::Trigger, On::Both, "input/select/click"), MENU, HAPTIC],
    },
    Profile {
        path: "/interaction_profiles/oculus/touch_controller",
        offered: core,
        controls: TOUCH,
    },
    Profile {
        path: "/interaction_profiles/valve/index_controller",
        offered: core,
        controls: &[
            SQUEEZE,
            TRIGGER,
            STICK,
            (Use::A, On::Both, "input/a/click"),
            (Use::B, On::Both, "input/b/click"),
            HAPTIC,
        ],
    },
    Profile {
        path: "/interaction_profiles/htc/vive_controller",
        offered: core,
        controls: &[
            SQUEEZE_CLICK,
            TRIGGER,
            (Use::Stick, On::Both, "input/trackpad"),
            PAD_CLICK,
            MENU,
            HAPTIC,
        ],
    },
    Profile {
        path: "/interaction_profiles/microsoft/motion_controller",
        offered: core,
        controls: &[SQUEEZE_CLICK, TRIGGER, STICK, PAD_CLICK, MENU, HAPTIC],
    },
    Profile {
        path: "/interaction_profiles/bytedance/pico4_controller",
        offered: |on| on.bd_controller_interaction.is_some(),
        controls: TOUCH,
    },
    Profile {
        path: "/interaction_profiles/ext/hand_interaction_ext",
        offered: |on| on.ext_hand_interaction.is_some(),
        controls: &[
            (Use::Squeeze, On::Both, "input/grasp_ext/value"),
            (Use::Trigger, On::Both, "input/pinch_ext/value"),
        ],
    },
];
