//! The script: lines of JSON in the file `script`, each a [`Cue`].

use serde::{Deserialize, Serialize};

use crate::number::{one, two};
pub use crate::pose::{Known, Pose};

/// A change and its time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cue {
    /// As the xrWaitFrame of that number begins, counted from 0 over all sessions of the process; at
    /// once where it has begun already, and for `None`.
    pub at: Option<u64>,
    /// The change.
    pub change: Change,
}

/// A change of the mock headset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Change {
    /// The head moves.
    Head {
        /// Pose in the runtime's own world.
        pose: Pose,
        /// Its known parts.
        known: Known,
    },
    /// A controller moves, is pressed, comes or goes.
    Hand {
        /// 0 left, 1 right.
        side: usize,
        /// `None` without a controller.
        state: Option<HandState>,
    },
    /// A hand is tracked (XR_EXT_hand_tracking).
    Joints {
        /// 0 left, 1 right.
        side: usize,
        /// The 26 joints in the extension's order; `None` for a hand that is not tracked.
        joints: Option<Vec<Joint>>,
    },
    /// The wearer looks from there along -Z (XR_EXT_eye_gaze_interaction, XR_VARJO_foveated_rendering), in the runtime's own world; `None`
    /// where the gaze is not known.
    Gaze(Option<Pose>),
    /// The inset in each eye's picture, where XR_VARJO_quad_views is offered.
    Inset(Inset),
    /// A reference space gets another origin.
    Move {
        /// The space: any but VIEW, the gaze's and actions'.
        space: SpaceKind,
        /// Its new origin in the runtime's own world.
        origin: Pose,
        /// Whether XrEventDataReferenceSpaceChangePending is raised.
        announced: bool,
        /// The event's `poseValid`.
        pose_valid: bool,
        /// Number of frames to delay the move, after the next one whose events can still be polled.
        later: u32,
    },
    /// The reference spaces that are offered.
    Offer {
        /// All offered spaces.
        spaces: Vec<SpaceKind>,
    },
    /// The extensions that are offered.
    Extensions(Vec<String>),
    /// Display rates (XR_FB_display_refresh_rate), and with them the period.
    Rates {
        /// The rates that can be chosen, Hz.
        rates: Vec<f32>,
        /// The present one, Hz.
        now: f32,
    },
    /// Period of the display alone, ns.
    Period(i64),
    /// Whether someone wears the headset (XR_EXT_user_presence).
    Presence(bool),
    /// The part of the picture that no eye sees (XR_KHR_visibility_mask).
    Mask {
        /// 0 left, 1 right.
        eye: usize,
        /// Corners in the plane 1 m ahead.
        vertices: Vec<[f32; 2]>,
        /// Three for each triangle.
        indices: Vec<u32>,
    },
    /// Most layers of a swapchain's images.
    ArrayLayers(u32),
    /// The eyes.
    Views {
        /// Their fields of view.
        fov: [Fov; 2],
        /// Distance between them, m.
        ipd: f32,
    },
    /// The state to which the runtime leads the session.
    Goal(Goal),
    /// An existing object is lost.
    Lose(Lost),
    /// Whether a headset is connected.
    Headset(bool),
    /// A call is refused. If several refusals apply, the earliest that is not used up counts.
    Refuse {
        /// OpenXR's name of it.
        call: String,
        /// The XrResult.
        answer: i32,
        /// Number of times; always for `None`.
        times: Option<u32>,
        /// Condition of the refusal. xrCreateSwapchain: its format's number, its `width x height`, or `layers>1`. xrBeginSession: the view
        /// configuration's number. xrCreateInstance: the name of an extension that is asked for. xrEndFrame: `projection`, `4 views`,
        /// `quad`, `depth`, or `infinite depth` (a near or far distance is infinite).
        when: Option<String>,
    },
    /// Nothing is refused any more.
    RefuseNothing,
    /// XrEventDataInstanceLossPending is raised.
    InstanceLossPending,
}

impl Change {
    /// The head at `pose`, tracked.
    #[must_use]
    pub fn head(pose: Pose) -> Self {
        Self::Head {
            pose,
            known: Known::TRACKED,
        }
    }

    /// A controller in that hand.
    #[must_use]
    pub fn hand(side: usize, state: HandState) -> Self {
        Self::Hand {
            side,
            state: Some(state),
        }
    }

    /// The runtime offers its default extensions, and this one.
    #[must_use]
    pub fn offer_too(extension: &str) -> Self {
        Self::offer_all_too(&[extension])
    }

    /// The runtime offers its default extensions, and those of `extensions`; [`Change::offer_too`] takes one.
    #[must_use]
    pub fn offer_all_too(extensions: &[&str]) -> Self {
        let mut all = crate::world::World::default().extensions;
        all.extend(extensions.iter().map(|&name| name.to_owned()));
        Self::Extensions(all)
    }

    /// The space moves with the next frame, with an event.
    #[must_use]
    pub fn recentre(space: SpaceKind, origin: Pose) -> Self {
        Self::Move {
            space,
            origin,
            announced: true,
            pose_valid: true,
            later: 0,
        }
    }

    /// The call is refused once.
    #[must_use]
    pub fn refuse_once(call: &str, answer: i32) -> Self {
        Self::Refuse {
            call: call.to_owned(),
            answer,
            times: Some(1),
            when: None,
        }
    }
}

/// A second view of each eye, which is over a part of the first.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Inset {
    /// Recommended size of its pictures, pixels.
    pub extent: [u32; 2],
    /// Whether the headset supports that it follows the gaze (XR_VARJO_foveated_rendering).
    pub follows: bool,
    /// Recommended sizes of the eyes' pictures and of its own if it follows the gaze.
    pub following: [[u32; 2]; 2],
    /// Angle of its field of view to the left and to the right of its middle, rad; up and down it is three quarters of that.
    #[serde(with = "one")]
    pub half: f32,
    /// Number of views in all: 4, unless a test needs a wrong one.
    pub views: u32,
}

impl Default for Inset {
    fn default() -> Self {
        Self {
            extent: [40, 36],
            follows: true,
            following: [[32, 28], [56, 20]],
            half: 0.2,
            views: 4,
        }
    }
}

/// A hand with its controller.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HandState {
    /// Interaction profile.
    pub profile: String,
    /// Grip in the runtime's own world.
    pub grip: Pose,
    /// Aim in the runtime's own world.
    pub aim: Pose,
    /// Known parts of both.
    pub known: Known,
    /// Squeeze, 0 to 1.
    #[serde(with = "one")]
    pub squeeze: f32,
    /// Trigger, 0 to 1.
    #[serde(with = "one")]
    pub trigger: f32,
    /// Thumbstick or trackpad.
    #[serde(with = "two")]
    pub stick: [f32; 2],
    /// First button.
    pub a: bool,
    /// Second button.
    pub b: bool,
}

/// Profile of Touch's controllers.
pub const TOUCH: &str = "/interaction_profiles/oculus/touch_controller";

impl HandState {
    /// A Touch controller, 20 cm to its side, 1 m high and 40 cm ahead, with nothing pressed.
    #[must_use]
    pub fn touch(side: usize) -> Self {
        let pose = Pose::at(if side == 0 { -0.2 } else { 0.2 }, 1.0, -0.4);
        Self {
            profile: TOUCH.to_owned(),
            grip: pose,
            aim: pose,
            known: Known::TRACKED,
            squeeze: 0.0,
            trigger: 0.0,
            stick: [0.0; 2],
            a: false,
            b: false,
        }
    }
}

/// A joint of a tracked hand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// Pose in the runtime's own world.
    pub pose: Pose,
    /// Radius, m.
    #[serde(with = "one")]
    pub radius: f32,
    /// Known parts of the pose.
    pub known: Known,
}

/// Angles from the line of sight, rad; left and down are negative.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fov {
    /// Left side.
    #[serde(with = "one")]
    pub left: f32,
    /// Right side.
    #[serde(with = "one")]
    pub right: f32,
    /// Upper side.
    #[serde(with = "one")]
    pub up: f32,
    /// Lower side.
    #[serde(with = "one")]
    pub down: f32,
}

/// The object that a space belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum SpaceKind {
    /// The head.
    View,
    /// The eyes' first place.
    Local,
    /// The floor below it.
    LocalFloor,
    /// The middle of the free floor.
    Stage,
    /// The gaze (XR_VARJO_foveated_rendering).
    Gaze,
    /// A hand; never offered as a reference space.
    Action,
}

/// The state that the runtime leads a session to, step by step: one event in each round of xrPollEvent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Goal {
    /// The headset sleeps: no session is running.
    Idle,
    /// Frames, but not visible.
    Synchronized,
    /// Visible, without input.
    Visible,
    /// Visible, with input.
    Focused,
    /// The end. After its event, later sessions are led to the focus.
    Exiting,
    /// A loss that is announced. After its event, later sessions are led to the focus.
    LossPending,
}

/// The object that is lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Lost {
    /// The existing sessions: calls on them answer XR_ERROR_SESSION_LOST.
    Session,
    /// The existing instances: calls on them and their sessions answer XR_ERROR_INSTANCE_LOST.
    Instance,
}
