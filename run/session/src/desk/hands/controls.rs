//! What mouse, keyboard and gamepad ask of the hands in a frame.

use glam::Vec3;

/// Speed of keys over the bench, m/s, and the share of a speed that is slow.
pub(super) const KEYS: f32 = 0.25;
pub const SLOW: f32 = 0.25;
/// How far from the user the pointer's place on the bench, or what is held, is at most, m: an arm's length and a step.
pub(super) const REACH: f32 = 0.85;
/// Most notches of the wheel, and most tilt by the mouse (rad), in a frame: more is a fault of the device.
const NOTCHES: f32 = 20.0;
const TILT: f32 = 3.2;

/// What the pointer's hands are told in a frame. Directions are in the stage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Controls {
    /// From the eye through the pointer: origin (m) and unit direction.
    pub ray: (Vec3, Vec3),
    /// The unit vector on the level plane that the viewer sees to the right.
    pub right: Vec3,
    /// The unit vector on the level plane that leads away from the viewer.
    pub away: Vec3,
    /// The main button is down, or was pressed or let go since the last frame.
    pub pressed: bool,
    /// It was pressed since the last frame.
    pub press: bool,
    /// It was let go since the last frame.
    pub release: bool,
    /// The pointer moved since the last frame: else the hand does not follow it.
    pub pointed: bool,
    /// Notches that the wheel turned up since the last frame.
    pub wheel: f32,
    /// Tilt asked for by the mouse since the last frame, rad, to the left as the viewer sees it.
    pub tilt_drag: f32,
    /// Keys or a stick held, -1 to 1: to the right, and away.
    pub walk: [f32; 2],
    /// Keys or a stick held, -1 to 1: up.
    pub raise: f32,
    /// Keys or a stick held, -1 to 1: tilt to the left.
    pub tilt: f32,
    /// The key for slow motion is held.
    pub slow: bool,
    /// The key that takes hold, or puts down, was pressed since the last frame.
    pub grip: bool,
    /// The key for the other hand was pressed since the last frame.
    pub other: bool,
    /// The key that presses what the pointer is at on the panel was pressed since the last frame.
    pub panel_press: bool,
    /// That key is down.
    pub panel_down: bool,
    /// The key that swirls a held flask is down.
    pub swirl: bool,
    /// The key that pulls the other hand's glove off was pressed since the last frame.
    pub gloves: bool,
}

impl Controls {
    /// Whether what was pressed on the panel is still held, by button or key.
    pub(super) fn presses(&self) -> bool {
        self.panel_down || (self.pressed && !self.release)
    }

    /// These controls with numbers only, and in their range. Rays and directions that are none are as in `last`.
    pub(super) fn sound(&self, last: &Self) -> Self {
        let ray = unit(self.ray.1).filter(|_| self.ray.0.is_finite());
        let flat = |of: Vec3, last: Vec3| unit(of.with_y(0.0)).unwrap_or(last);
        let within = |of: f32, most: f32| {
            if of.is_finite() {
                of.clamp(-most, most)
            } else {
                0.0
            }
        };
        Self {
            ray: ray.map_or(last.ray, |along| (self.ray.0, along)),
            right: flat(self.right, last.right),
            away: flat(self.away, last.away),
            pointed: self.pointed && ray.is_some(),
            wheel: within(self.wheel, NOTCHES),
            tilt_drag: within(self.tilt_drag, TILT),
            walk: self.walk.map(|it| within(it, 1.0)),
            raise: within(self.raise, 1.0),
            tilt: within(self.tilt, 1.0),
            ..*self
        }
    }

    /// These controls with what was new in `earlier` frames, in which no time passed. A key that was pressed twice meanwhile undid
    /// itself.
    pub(super) fn after(self, earlier: &Self) -> Self {
        Self {
            // A click is of what was pointed at.
            ray: if earlier.press || earlier.panel_press {
                earlier.ray
            } else {
                self.ray
            },
            pressed: self.pressed || earlier.press,
            press: self.press || earlier.press,
            release: self.release || earlier.release,
            pointed: self.pointed || earlier.pointed,
            wheel: (self.wheel + earlier.wheel).clamp(-NOTCHES, NOTCHES),
            tilt_drag: (self.tilt_drag + earlier.tilt_drag).clamp(-TILT, TILT),
            grip: self.grip != earlier.grip,
            other: self.other != earlier.other,
            panel_press: self.panel_press || earlier.panel_press,
            gloves: self.gloves || earlier.gloves,
            ..self
        }
    }
}

fn unit(of: Vec3) -> Option<Vec3> {
    of.is_finite().then(|| of.try_normalize()).flatten()
}
