//! A runtime's poses and values, made valid for simulation and recording; buttons as events.

use std::f32::consts::FRAC_PI_2;

use vitriol_xr::{Hand, Pose, PoseFrame, Side};

use super::hold::Hold;

/// `frame` with each value in its range and each pose finite and normalised. The steps consume this one, because the
/// recording keeps what they consumed and a track refuses anything else. An invalid pose is replaced by the last one,
/// and its hand is marked as not valid.
pub fn sound(frame: &PoseFrame, last: Option<&PoseFrame>) -> PoseFrame {
    let mut frame = frame.clone();
    let known = |pose: Option<Pose>| pose.unwrap_or(Pose::IDENTITY);
    if !frame.stage_from_view.is_valid() {
        frame.stage_from_view = known(last.map(|last| last.stage_from_view));
    }
    for side in Side::BOTH {
        let before = last.map(|last| last.hand(side));
        let hand = &mut frame.hands[side as usize];
        if !(hand.stage_from_grip.is_valid() && hand.stage_from_aim.is_valid()) {
            hand.valid = false;
            hand.stage_from_grip = known(before.map(|hand| hand.stage_from_grip));
            hand.stage_from_aim = known(before.map(|hand| hand.stage_from_aim));
        }
        hand.squeeze = within(hand.squeeze, 0.0, 1.0);
        hand.trigger = within(hand.trigger, 0.0, 1.0);
        hand.thumbstick = hand.thumbstick.map(|axis| within(axis, -1.0, 1.0));
    }
    for fov in &mut frame.info.fov {
        for angle in [&mut fov.left, &mut fov.right, &mut fov.up, &mut fov.down] {
            *angle = within(*angle, -FRAC_PI_2, FRAC_PI_2);
        }
    }
    frame
}

fn within(value: f32, least: f32, most: f32) -> f32 {
    if value.is_finite() {
        value.clamp(least, most)
    } else {
        0.0
    }
}

/// What was pressed in a frame and not in the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pressed {
    /// B (Y on the left), held: back to the start.
    pub start: bool,
    /// A (X on the left): the bench before the user.
    pub recentre: bool,
}

/// Remembers what is held down.
#[derive(Clone, Copy, Debug, Default)]
pub struct Buttons {
    /// By hand, A.
    pressed: [bool; 2],
    /// By hand, B.
    held: [Hold; 2],
}

impl Buttons {
    /// Takes in the hands of the frame that is shown at `now` (ns).
    pub fn advance(&mut self, hands: &[Hand; 2], now: i64) -> Pressed {
        let mut pressed = Pressed::default();
        for (side, hand) in hands.iter().enumerate() {
            // A controller that sleeps holds nothing, and keeps its A as it was.
            pressed.start |= self.held[side].advance(hand.active && hand.button_b, now);
            if hand.active {
                let before = std::mem::replace(&mut self.pressed[side], hand.button_a);
                pressed.recentre |= hand.button_a && !before;
            }
        }
        pressed
    }

    /// How far a hold of B has come at `now` (ns), 0 to 1.
    pub fn holding(&self, now: i64) -> Option<f32> {
        let shares = self.held.iter().filter_map(|held| held.share(now));
        shares.reduce(f32::max)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use glam::{Quat, Vec3};
    use vitriol_xr::track::{Existing, TrackMetadata, TrackWriter};

    /// What comes out can be recorded, whatever went in.
    #[test]
    fn a_track_takes_what_a_runtime_made_up() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("x.mcap");
        let metadata = TrackMetadata::default();
        let mut writer = TrackWriter::create(&file, &metadata, Existing::Refuse).unwrap();
        let mut good = PoseFrame::default();
        good.hands[1].valid = true;
        good.hands[1].stage_from_grip = Pose::new(Vec3::ONE, Quat::from_rotation_x(0.5));
        let mut bad = good.clone();
        bad.step = 1;
        bad.time_ns = 1;
        bad.stage_from_view.position.x = f32::NAN;
        bad.hands[0].squeeze = 1.0001;
        bad.hands[0].thumbstick = [f32::INFINITY, -7.0];
        bad.hands[1].trigger = f32::NAN;
        bad.hands[1].stage_from_grip.orientation = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        bad.info.fov[1].up = 2.0;
        assert!(writer.write(&bad, &[]).is_err());
        writer.write(&sound(&good, None), &[]).unwrap();
        let mended = sound(&bad, Some(&good));
        writer.write(&mended, &[]).unwrap();
        assert_eq!(mended.hands[0].squeeze, 1.0);
        assert_eq!(mended.hands[0].thumbstick, [0.0, -1.0]);
        // The hand is where it was last, and not there.
        assert!(!mended.hands[1].valid);
        let held = mended.hands[1].stage_from_grip;
        assert_eq!(held, good.hands[1].stage_from_grip);
        // What is sound is left alone.
        assert_eq!(sound(&good, None), good);
    }

    #[test]
    fn a_button_counts_once() {
        let mut buttons = Buttons::default();
        let mut hands = [Hand::default(), Hand::default()];
        // Half a second from one to the next.
        let mut now = 0;
        let mut press = |active, b, a| {
            hands[1] = Hand {
                active,
                button_b: b,
                button_a: a,
                ..Hand::default()
            };
            now += 500_000_000;
            let pressed = buttons.advance(&hands, now);
            (pressed.start, pressed.recentre, buttons.holding(now))
        };
        assert_eq!(press(true, true, false), (false, false, Some(0.0)));
        assert_eq!(press(true, true, true), (false, true, Some(0.5)));
        assert_eq!(press(true, true, true), (true, false, None));
        assert_eq!(press(true, true, true), (false, false, None));
        // Asleep: A is as it was, and a hold is broken.
        assert_eq!(press(false, false, false), (false, false, None));
        assert_eq!(press(true, true, true), (false, false, Some(0.0)));
        assert_eq!(press(true, false, false), (false, false, None));
        assert_eq!(press(true, true, true), (false, true, Some(0.0)));
    }
}
