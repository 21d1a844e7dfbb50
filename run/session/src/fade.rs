//! The picture fades where the world would leap: between two scenes, and where the head's place is lost and found again.
//!
//! It is dark when the new scene comes, and in the frame in which the head is elsewhere at once. A head that stays lost sees
//! again after a while what turns with it: to be left in the dark is worse, and a warning of the runtime needs a ground.

/// How long it takes, s: as long as a blink (0.1 to 0.4 s), so that it is seen as one and hides a leap.
const FADE: f32 = 0.2;
/// How long a lost head stays in the dark, s.
const DARK: f32 = 2.0;
/// Time between two frames that counts at most, s: after a pause the picture does not come at once.
const MOST: f32 = 0.05;

/// How much of the light is shown.
#[derive(Clone, Debug)]
pub struct Fade {
    /// As the eye takes it, 0 to 1.
    level: f32,
    /// Display time of the last frame, ns.
    last: Option<i64>,
    /// How long the head has been lost, s; `None` while it is not.
    lost: Option<f32>,
}

impl Default for Fade {
    fn default() -> Self {
        Self {
            level: 1.0,
            last: None,
            lost: None,
        }
    }
}

impl Fade {
    /// Takes in the frame that is shown at `now` (ns), whether the head's place is `lost` in it, and whether a scene `leaves`.
    pub fn advance(&mut self, now: i64, lost: bool, leaves: bool) {
        let last = self.last.replace(now).unwrap_or(now);
        let passed = (1e-9 * now.saturating_sub(last) as f32).clamp(0.0, MOST);
        let before = self.lost;
        self.lost = lost.then(|| before.map_or(0.0, |time| time + passed));
        let found = self.lost.is_none() && before.is_some_and(|time| time > FADE);
        if found {
            self.level = 0.0;
        }
        let dark = leaves || self.lost.is_some_and(|time| time < DARK);
        let by = passed / FADE;
        let level = if dark {
            self.level - by
        } else {
            self.level + by
        };
        self.level = if found { 0.0 } else { level.clamp(0.0, 1.0) };
    }

    /// Shows nothing in this frame: the world has leapt.
    pub fn close(&mut self) {
        self.level = 0.0;
    }

    /// Share of the light that is shown: about the square, so that it falls evenly to the eye.
    pub fn shown(&self) -> f32 {
        self.level * self.level
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At 90 Hz, for so many seconds; the last frame's share.
    fn go(fade: &mut Fade, now: &mut i64, seconds: f32, lost: bool, leaves: bool) -> f32 {
        for _ in 0..(90.0 * seconds).round() as i64 {
            *now += 11_111_111;
            fade.advance(*now, lost, leaves);
        }
        fade.shown()
    }

    #[test]
    fn a_scene_leaves_in_the_dark_and_another_comes() {
        let (mut fade, mut now) = (Fade::default(), 1_000_000_000_000);
        let mut go = |seconds, leaves| go(&mut fade, &mut now, seconds, false, leaves);
        assert_eq!(go(1.0, false), 1.0);
        // Half way to the eye is a quarter of the light.
        assert!((go(0.1, true) - 0.25).abs() < 0.06);
        assert_eq!(go(0.13, true), 0.0);
        assert!((go(0.1, false) - 0.25).abs() < 0.06);
        assert_eq!(go(0.13, false), 1.0);
    }

    #[test]
    fn a_lost_head_is_in_the_dark_for_a_while_and_when_it_is_found() {
        let (mut fade, mut now) = (Fade::default(), 0);
        let mut go = |seconds, lost| go(&mut fade, &mut now, seconds, lost, false);
        go(0.1, false);
        assert_eq!(go(0.3, true), 0.0);
        assert_eq!(go(1.5, true), 0.0);
        assert_eq!(go(0.5, true), 1.0, "it goes on turning");
        assert_eq!(go(1.0 / 90.0, false), 0.0, "found, elsewhere");
        assert_eq!(go(0.25, false), 1.0);
        // For two frames it is not worth it.
        assert!(go(2.0 / 90.0, true) > 0.7);
        assert!(go(1.0 / 90.0, false) > 0.8);
    }

    #[test]
    fn after_a_pause_it_goes_on_where_it_was() {
        let mut fade = Fade::default();
        fade.advance(0, false, false);
        fade.close();
        fade.advance(60_000_000_000, false, false);
        assert!(fade.shown() < 0.1);
        // A clock that goes back does no harm.
        fade.advance(0, false, false);
        assert!((0.0..0.1).contains(&fade.shown()));
    }
}
