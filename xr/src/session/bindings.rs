//! Which control of which controller does what: the one table of interaction profiles.
//!
//! Paths are those of the OpenXR specification, "Interaction Profile Paths", and of the
//! extensions named in the rows. A click bound to a value reads 0 or 1 (same, "Action state
//! conversions"): that is how squeeze and trigger come from controllers that only have buttons.

use openxr::InstanceExtensions;

/// What a control does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    /// Where the hand grips.
    Grip,
    /// Where it points.
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
    /// What shakes.
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
    /// Whether the runtime has it, by the extensions that are on.
    pub offered: fn(&InstanceExtensions) -> bool,
    /// Use, hands and path below the hand's.
    pub controls: &'static [(Use, On, &'static str)],
}

const GRIP: (Use, On, &str) = (Use::Grip, On::Both, "input/grip/pose");
const AIM: (Use, On, &str) = (Use::Aim, On::Both, "input/aim/pose");
const HAPTIC: (Use, On, &str) = (Use::Haptic, On::Both, "output/haptic");
const TRIGGER: (Use, On, &str) = (Use::Trigger, On::Both, "input/trigger/value");
const SQUEEZE: (Use, On, &str) = (Use::Squeeze, On::Both, "input/squeeze/value");
const SQUEEZE_CLICK: (Use, On, &str) = (Use::Squeeze, On::Both, "input/squeeze/click");
const STICK: (Use, On, &str) = (Use::Stick, On::Both, "input/thumbstick");
const MENU: (Use, On, &str) = (Use::B, On::Both, "input/menu/click");
const PAD_CLICK: (Use, On, &str) = (Use::A, On::Both, "input/trackpad/click");

fn core(_: &InstanceExtensions) -> bool {
    true
}

/// Every profile that bindings are suggested for.
pub(super) const PROFILES: [Profile; 7] = [
    Profile {
        path: "/interaction_profiles/khr/simple_controller",
        offered: core,
        controls: &[
            GRIP,
            AIM,
            (Use::Trigger, On::Both, "input/select/click"),
            MENU,
            HAPTIC,
        ],
    },
    Profile {
        path: "/interaction_profiles/oculus/touch_controller",
        offered: core,
        controls: &[
            GRIP,
            AIM,
            SQUEEZE,
            TRIGGER,
            STICK,
            (Use::A, On::Left, "input/x/click"),
            (Use::B, On::Left, "input/y/click"),
            (Use::A, On::Right, "input/a/click"),
            (Use::B, On::Right, "input/b/click"),
            HAPTIC,
        ],
    },
    Profile {
        path: "/interaction_profiles/valve/index_controller",
        offered: core,
        controls: &[
            GRIP,
            AIM,
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
            GRIP,
            AIM,
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
        controls: &[
            GRIP,
            AIM,
            SQUEEZE_CLICK,
            TRIGGER,
            STICK,
            PAD_CLICK,
            MENU,
            HAPTIC,
        ],
    },
    Profile {
        path: "/interaction_profiles/bytedance/pico4_controller",
        offered: |on| on.bd_controller_interaction.is_some(),
        controls: &[
            GRIP,
            AIM,
            SQUEEZE,
            TRIGGER,
            STICK,
            (Use::A, On::Left, "input/x/click"),
            (Use::B, On::Left, "input/y/click"),
            (Use::A, On::Right, "input/a/click"),
            (Use::B, On::Right, "input/b/click"),
            HAPTIC,
        ],
    },
    Profile {
        path: "/interaction_profiles/ext/hand_interaction_ext",
        offered: |on| on.ext_hand_interaction.is_some(),
        controls: &[
            GRIP,
            AIM,
            (Use::Squeeze, On::Both, "input/grasp_ext/value"),
            (Use::Trigger, On::Both, "input/pinch_ext/value"),
        ],
    },
];
