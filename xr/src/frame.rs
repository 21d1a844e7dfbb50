//! Input of one simulation step: head, hands and the instructor's switches.

use std::sync::Arc;

use crate::Pose;

/// Everything that one simulation step consumed of the user's movements; by default of the first step, with nothing known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PoseFrame {
    /// Index of the simulation step that consumes this frame.
    pub step: u64,
    /// Time on the track's clock, which is simulation time, ns. Not negative.
    pub time_ns: i64,
    /// The head (OpenXR's VIEW space: -Z is the line of sight, +Y up).
    pub stage_from_view: Pose,
    /// Left hand, right hand; [`Side`] is the index.
    pub hands: [Hand; 2],
    /// Switches of an instructor or the student for this step, in order.
    pub scenario: Vec<Switch>,
    /// The display frame that the poses were predicted for.
    pub info: FrameInfo,
}

impl PoseFrame {
    /// The hand on that side.
    pub fn hand(&self, side: Side) -> &Hand {
        &self.hands[side as usize]
    }

    /// Poses and analogue values interpolated at `s` in 0..=1 on the way to `later`, whose values they are at 1, bit for bit; everything
    /// else is that of the earlier frame.
    #[must_use]
    pub fn between(&self, later: &Self, s: f32) -> Self {
        let value = |a: f32, b: f32| if s >= 1.0 { b } else { a + (b - a) * s };
        let mut frame = self.clone();
        frame.stage_from_view = self.stage_from_view.interpolate(&later.stage_from_view, s);
        for (hand, later) in frame.hands.iter_mut().zip(&later.hands) {
            // A controller that sleeps is no target of interpolation: its squeeze of 0 would open a hand that nobody opened, and let a
            // flask fall.
            let is_known = |hand: &Hand| hand.active && hand.valid;
            if !(is_known(hand) && is_known(later)) {
                continue;
            }
            hand.stage_from_grip = hand.stage_from_grip.interpolate(&later.stage_from_grip, s);
            hand.stage_from_aim = hand.stage_from_aim.interpolate(&later.stage_from_aim, s);
            hand.squeeze = value(hand.squeeze, later.squeeze);
            hand.trigger = value(hand.trigger, later.trigger);
            for (axis, later) in hand.thumbstick.iter_mut().zip(later.thumbstick) {
                *axis = value(*axis, later);
            }
        }
        frame
    }
}

/// Which hand; its value is the index into [`PoseFrame::hands`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The left hand.
    Left = 0,
    /// The right hand.
    Right = 1,
}

impl Side {
    /// Both sides, in the order of [`PoseFrame::hands`].
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// The side as text: `left` or `right`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}

/// One hand with its controller; by default inactive, with nothing known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hand {
    /// Whether the runtime binds this hand to a device, so that its inputs count.
    pub active: bool,
    /// Whether the poses are known. Where they are not, they are the last known ones: a flask that follows a hand must not jump to the
    /// origin when a controller falls asleep.
    pub valid: bool,
    /// Whether the poses are measured now; valid without tracked is the runtime's own guess.
    pub tracked: bool,
    /// The grip pose, which a flask follows. OpenXR: -Z runs along the tube that the curled
    /// fingers form, from the little finger to the thumb; +X leaves the left palm and enters
    /// the right one.
    pub stage_from_grip: Pose,
    /// The aim pose, for pointing along -Z.
    pub stage_from_aim: Pose,
    /// Squeeze value, 0 open to 1 closed.
    pub squeeze: f32,
    /// Trigger value, 0 to 1.
    pub trigger: f32,
    /// Thumbstick, x right and y forward, each -1 to 1.
    pub thumbstick: [f32; 2],
    /// Button A (X on the left controller).
    pub button_a: bool,
    /// Button B (Y on the left controller).
    pub button_b: bool,
    /// OpenXR interaction profile path; empty where nothing is bound.
    pub profile: Arc<str>,
}

/// The display frame for which a runtime predicted the poses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameInfo {
    /// Predicted display time on the runtime's clock (OpenXR's XrTime), ns. It has nothing
    /// in common with [`PoseFrame::time_ns`] but its rate.
    pub xr_time: i64,
    /// Predicted display period, ns; 0 where there is no display.
    pub period_ns: i64,
    /// Field of view of the left and the right eye.
    pub fov: [Fov; 2],
    /// State of the session.
    pub session_state: SessionState,
}

impl Default for FrameInfo {
    /// No display: times 0, a symmetric field of view of 90°, focused.
    fn default() -> Self {
        Self {
            xr_time: 0,
            period_ns: 0,
            fov: [Fov::default(); 2],
            session_state: SessionState::Focused,
        }
    }
}

/// Angles from the line of sight to the four sides of a view, rad; left and down are
/// negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fov {
    /// Left side, rad.
    pub left: f32,
    /// Right side, rad.
    pub right: f32,
    /// Upper side, rad.
    pub up: f32,
    /// Lower side, rad.
    pub down: f32,
}

impl Default for Fov {
    /// 90° each way.
    fn default() -> Self {
        use std::f32::consts::FRAC_PI_4;
        Self {
            left: -FRAC_PI_4,
            right: FRAC_PI_4,
            up: FRAC_PI_4,
            down: -FRAC_PI_4,
        }
    }
}

/// OpenXR's session states (XrSessionState), with its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, prost::Enumeration)]
#[repr(i32)]
pub enum SessionState {
    /// XR_SESSION_STATE_UNKNOWN
    Unknown = 0,
    /// XR_SESSION_STATE_IDLE
    Idle = 1,
    /// XR_SESSION_STATE_READY
    Ready = 2,
    /// XR_SESSION_STATE_SYNCHRONIZED
    Synchronized = 3,
    /// XR_SESSION_STATE_VISIBLE
    Visible = 4,
    /// XR_SESSION_STATE_FOCUSED
    Focused = 5,
    /// XR_SESSION_STATE_STOPPING
    Stopping = 6,
    /// XR_SESSION_STATE_LOSS_PENDING
    LossPending = 7,
    /// XR_SESSION_STATE_EXITING
    Exiting = 8,
}

/// A switch that an instructor or the student set, as text, because keys and values are defined by the code that acts on them.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Switch {
    /// Its key, such as `scenario`. Not empty.
    pub key: String,
    /// The value that it was set to.
    pub value: String,
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    fn with(active: bool, squeeze: f32) -> PoseFrame {
        let hand = Hand {
            active,
            valid: active,
            squeeze,
            ..Hand::default()
        };
        PoseFrame {
            hands: [hand, Hand::default()],
            ..PoseFrame::default()
        }
    }

    #[test]
    fn a_hand_that_falls_asleep_does_not_open_on_the_way() {
        let between = |from: &PoseFrame, to: &PoseFrame| from.between(to, 0.75).hands[0].squeeze;
        assert_eq!(between(&with(true, 1.0), &with(true, 0.0)), 0.25);
        assert_eq!(between(&with(true, 1.0), &with(false, 0.0)), 1.0);
        // Nor does it close halfway when it wakes.
        let woken = with(false, 0.0).between(&with(true, 1.0), 0.75);
        assert!(!woken.hands[0].active && woken.hands[0].squeeze == 0.0);
    }
}
