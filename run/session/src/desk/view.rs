//! From where the desk's user sees the bench: an eye that goes round it, as far as a student leans and gets up.

use std::f32::consts::FRAC_PI_2;

use glam::{Quat, Vec3};
use vitriol_xr::{Fov, Pose};

use crate::placement::SCENE_TABLE;

/// What the eye goes round, in the headset's stage, m: the middle of the vessels, on the table before a user at the origin.
const MIDDLE: Vec3 = Vec3::new(0.0, SCENE_TABLE, -0.45);
/// How far the eye goes to either side, rad: beyond, it would look at the bench from where the panel is.
const ASIDE: f32 = 70.0 * DEGREE;
/// Least and greatest height of the eye above the floor, m: of someone who bends down to the table's top, and of a tall person who stands.
const HEIGHTS: [f32; 2] = [0.8, 1.65];
/// Least and greatest angle between the picture's upper and lower side, degrees: what a magnifying glass has, and what is not yet distorted
/// much at the sides.
pub const FOVS: [f32; 2] = [20.0, 75.0];
/// The angle that the first view has where no other is asked for, degrees: hands, flasks and panel are in one picture.
pub const FOV: f32 = 56.0;
/// [`FOVS`], rad.
const ANGLES: [f32; 2] = [FOVS[0] * DEGREE, FOVS[1] * DEGREE];
/// Share of the picture's height or width that the panel fills in its view.
const FILLS: f32 = 0.9;
/// Time in which two thirds of a way to another view are gone, s. Our choice: it is followed by the eye, and is waited for by nobody.
const SMOOTHING: f32 = 0.12;
/// How high over the table's top one looks from low and where the view is narrow, m: at the middle of a beaker. And how much that rises
/// with the eye: in [`FIRST`] it is 15° down, which has both the flasks' feet and the whole panel in the picture.
const LOOKS: f32 = 0.10;
const RISES: f32 = 0.49;

const DEGREE: f32 = FRAC_PI_2 / 90.0;

/// Where the eye is about the bench, and how much it sees.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stand {
    /// Angle about the bench's middle, rad; positive to the right.
    yaw: f32,
    /// Height above the floor, m.
    height: f32,
    /// Level distance from the bench's middle, m.
    distance: f32,
    /// Angle between the picture's upper and lower side, rad.
    angle: f32,
}

/// The first view: of someone who sits upright, a little back from the bench, so that hands, flasks and panel are in one picture.
const FIRST: Stand = Stand {
    yaw: 0.0,
    height: 1.25,
    distance: 0.67,
    angle: FOV * DEGREE,
};

/// From the side and from low: levels and streams are seen.
const SIDE: Stand = Stand {
    yaw: 65.0 * DEGREE,
    height: 0.95,
    distance: 0.60,
    angle: 50.0 * DEGREE,
};

/// How the view is to turn in a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turns {
    /// The eye goes to the right about the bench, rad.
    pub yaw: f32,
    /// The eye rises, m.
    pub rise: f32,
    /// The view narrows: 1 halves its angle.
    pub zoom: f32,
    /// To the view from the side, or back.
    pub side: bool,
    /// To the panel, or back.
    pub panel: bool,
    /// To the first view.
    pub home: bool,
}

/// From where the bench is seen, and on its way to where.
#[derive(Clone, Debug)]
pub struct Viewpoint {
    first: Stand,
    wanted: Stand,
    /// Whether the panel is to fill the picture.
    panel: bool,
    /// The view before that from the side.
    before: Option<Stand>,
    /// As it is shown, and the place that is looked at.
    shown: Stand,
    at: Vec3,
    /// The picture's width over its height.
    aspect: f32,
}

#[cfg(test)]
impl Default for Viewpoint {
    fn default() -> Self {
        Self::new(FOV)
    }
}

impl Stand {
    fn eye(self) -> Vec3 {
        let level = self.distance * Vec3::new(self.yaw.sin(), 0.0, self.yaw.cos());
        (MIDDLE + level).with_y(self.height)
    }

    fn looks_at(self) -> Vec3 {
        let wide = (self.angle - ANGLES[0]) / (FIRST.angle - ANGLES[0]);
        let over = self.height.min(FIRST.height) - HEIGHTS[0];
        MIDDLE + (LOOKS + RISES * wide.min(1.0) * over) * Vec3::Y
    }

    /// The first stand with its view on a panel, whose pose and size (m) these are, in a picture of that aspect; and the place looked at.
    fn of_panel((pose, [width, height]): (Pose, [f32; 2]), aspect: f32) -> (Self, Vec3) {
        let away = FIRST.eye().distance(pose.position).max(0.1);
        let half = 0.5 * height.max(width / aspect) / (FILLS * away);
        let angle = (2.0 * half.atan()).clamp(ANGLES[0], ANGLES[1]);
        (Self { angle, ..FIRST }, pose.position)
    }

    fn mixed(self, to: Self, share: f32) -> Self {
        let mix = |from: f32, to: f32| from + share * (to - from);
        Self {
            yaw: mix(self.yaw, to.yaw),
            height: mix(self.height, to.height),
            distance: mix(self.distance, to.distance),
            angle: mix(self.angle, to.angle),
        }
    }
}

impl Viewpoint {
    /// The first view, with that angle between the picture's upper and lower side: degrees, as [`FOVS`] allow.
    pub fn new(fov: f32) -> Self {
        let angle = (fov * DEGREE).clamp(ANGLES[0], ANGLES[1]);
        let first = Stand { angle, ..FIRST };
        Self {
            first,
            wanted: first,
            panel: false,
            before: None,
            shown: first,
            at: first.looks_at(),
            aspect: 1.0,
        }
    }

    /// Goes on by `passed` seconds, in a picture of that aspect (width over height), to what `turns` ask for. The panel has that pose and
    /// size (m).
    pub fn advance(&mut self, turns: &Turns, panel: (Pose, [f32; 2]), aspect: f32, passed: f32) {
        self.aspect = aspect;
        if turns.panel {
            self.panel = !self.panel;
        }
        if turns.side {
            self.panel = false;
            self.wanted = match self.before.take() {
                Some(before) => before,
                None => {
                    self.before = Some(self.wanted);
                    SIDE
                }
            };
        }
        if turns.home {
            (self.panel, self.before, self.wanted) = (false, None, self.first);
        }
        if turns.yaw != 0.0 || turns.rise != 0.0 || turns.zoom != 0.0 {
            self.panel = false;
        }
        let Stand {
            yaw,
            height,
            angle,
            distance,
        } = self.wanted;
        self.wanted = Stand {
            yaw: (yaw + turns.yaw).clamp(-ASIDE, ASIDE),
            height: (height + turns.rise).clamp(HEIGHTS[0], HEIGHTS[1]),
            angle: (angle * (-turns.zoom).exp2()).clamp(ANGLES[0], ANGLES[1]),
            distance,
        };
        let (to, at) = match self.panel {
            true => Stand::of_panel(panel, aspect),
            false => (self.wanted, self.wanted.looks_at()),
        };
        let share = 1.0 - (-passed / SMOOTHING).exp();
        self.shown = self.shown.mixed(to, share);
        self.at = self.at.lerp(at, share);
    }

    /// stage_from_eye: the eye of the picture, which looks along -Z.
    pub fn pose(&self) -> Pose {
        let eye = self.shown.eye();
        let ahead = self.at - eye;
        let yaw = (-ahead.x).atan2(-ahead.z);
        let pitch = ahead.y.atan2(ahead.x.hypot(ahead.z));
        let turned = Quat::from_rotation_y(yaw) * Quat::from_rotation_x(pitch);
        Pose::new(eye, turned.normalize())
    }

    /// The field of view.
    pub fn fov(&self) -> Fov {
        let up = 0.5 * self.shown.angle;
        let right = (up.tan() * self.aspect).atan();
        Fov {
            left: -right,
            right,
            up,
            down: -up,
        }
    }

    /// From the eye through a place of the picture, 0 to 1 from its upper left: origin and unit direction in the stage.
    pub fn ray(&self, [x, y]: [f32; 2]) -> (Vec3, Vec3) {
        let (pose, fov) = (self.pose(), self.fov());
        let between = |from: f32, to: f32, share: f32| from.tan() + share * (to.tan() - from.tan());
        let across = between(fov.left, fov.right, x);
        let up = between(fov.up, fov.down, y);
        let along = Vec3::new(across, up, -1.0).normalize();
        (pose.position, pose.orientation * along)
    }

    /// Unit vectors of the level plane: to the viewer's right, and away from her.
    pub fn level(&self) -> [Vec3; 2] {
        let ahead = (self.at - self.shown.eye()).with_y(0.0);
        let away = ahead.normalize_or(Vec3::NEG_Z);
        [away.cross(Vec3::Y), away]
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::panel::{SIZE, met, scene_from_panel};

    const WIDE: f32 = 16.0 / 9.0;

    fn panel() -> (Pose, [f32; 2]) {
        (scene_from_panel(), SIZE)
    }

    /// A place of the panel, -1 to 1 to the right and up from its middle.
    fn on_panel(x: f32, y: f32) -> Vec3 {
        let at = Vec3::new(0.5 * x * SIZE[0], 0.5 * y * SIZE[1], 0.0);
        scene_from_panel().transform_point(at)
    }

    fn turns(ask: impl FnOnce(&mut Turns)) -> Turns {
        let mut turns = Turns::default();
        ask(&mut turns);
        turns
    }

    /// Two seconds in which nothing more is asked for, after `turns`.
    fn gone(view: &mut Viewpoint, turns: Turns, aspect: f32) {
        view.advance(&turns, panel(), aspect, 0.02);
        for _ in 0..100 {
            view.advance(&Turns::default(), panel(), aspect, 0.02);
        }
    }

    /// Where a place of the stage is in the picture, 0 to 1 from its upper left: from pose and field of view alone.
    fn seen(view: &Viewpoint, at: Vec3) -> [f32; 2] {
        let at = view.pose().inverse().transform_point(at);
        assert!(at.z < 0.0, "{at}");
        let fov = view.fov();
        let (across, up) = (at.x / -at.z, at.y / -at.z);
        [
            (across - fov.left.tan()) / (fov.right.tan() - fov.left.tan()),
            (fov.up.tan() - up) / (fov.up.tan() - fov.down.tan()),
        ]
    }

    /// Flasks' feet and the panel's corners are in the first picture, and a ray through where something is seen meets it.
    #[test]
    fn a_ray_goes_where_it_is_seen() {
        let mut view = Viewpoint::default();
        view.advance(&Turns::default(), panel(), WIDE, 0.02);
        for at in [
            Vec3::new(-0.12, 0.75, -0.35),
            Vec3::new(0.25, 0.85, -0.35),
            on_panel(-1.0, 1.0),
            on_panel(1.0, 1.0),
            on_panel(1.0, -1.0),
        ] {
            let [x, y] = seen(&view, at);
            assert!(
                (0.0..1.0).contains(&x) && (0.0..1.0).contains(&y),
                "{at}: {x} {y}"
            );
            let (from, along) = view.ray([x, y]);
            assert!((along.length() - 1.0).abs() < 1e-6);
            let off = (at - from).reject_from(along).length();
            assert!(off < 1e-5, "{at}: {off} m");
        }
        // The upper left corner is up and to the left.
        let [right, away] = view.level();
        let (_, corner) = view.ray([0.0, 0.0]);
        let (_, middle) = view.ray([0.5, 0.5]);
        assert!(corner.dot(right) < 0.0 && corner.y > middle.y && middle.dot(away) > 0.0);
        assert!((right - Vec3::X).length() < 1e-5 && (away - Vec3::NEG_Z).length() < 1e-5);
    }

    #[test]
    fn the_eye_stays_where_a_student_can_be() {
        let mut view = Viewpoint::default();
        for (yaw, rise, zoom) in [(9.0, 9.0, 9.0), (-9.0, -9.0, -9.0), (0.3, 0.2, 0.5)] {
            let turned = turns(|it| (it.yaw, it.rise, it.zoom) = (yaw, rise, zoom));
            gone(&mut view, turned, WIDE);
            let eye = view.pose().position;
            assert!((0.79..1.66).contains(&eye.y), "{eye}");
            let aside = (eye.x - MIDDLE.x).atan2(eye.z - MIDDLE.z);
            assert!(aside.to_degrees().abs() < 70.1, "{eye}");
            let away = (eye - MIDDLE).with_y(0.0).length();
            assert!((0.35..0.9).contains(&away), "{away}");
            let fov = view.fov();
            let angle = (fov.up - fov.down).to_degrees();
            assert!((19.9..75.1).contains(&angle), "{angle}");
            // The flasks stay in sight.
            let [x, y] = seen(&view, MIDDLE + 0.1 * Vec3::Y);
            assert!(
                (0.0..1.0).contains(&x) && (0.0..1.0).contains(&y),
                "{x} {y}"
            );
        }
    }

    /// To the side and back, to the panel and back, and home from anywhere.
    #[test]
    fn other_views_are_left_as_they_were_entered() {
        let mut view = Viewpoint::default();
        gone(&mut view, turns(|it| it.yaw = 0.3), WIDE);
        let before = view.pose().position;
        let side = turns(|it| it.side = true);
        let to_panel = turns(|it| it.panel = true);
        gone(&mut view, side, WIDE);
        assert!((view.pose().position - before).length() > 0.3);
        gone(&mut view, side, WIDE);
        assert!((view.pose().position - before).length() < 1e-4);
        gone(&mut view, to_panel, WIDE);
        gone(&mut view, to_panel, WIDE);
        assert!((view.pose().position - before).length() < 1e-4);
        gone(&mut view, turns(|it| it.home = true), WIDE);
        let first = Viewpoint::default().pose().position;
        assert!((view.pose().position - first).length() < 1e-4);
    }

    /// The picture has the angle that is asked for from its first frame on, and again with `Home` after another one.
    #[test]
    fn the_first_view_has_the_angle_that_is_asked_for() {
        for wanted in [20.0, 40.0, FOV, 75.0] {
            let mut view = Viewpoint::new(wanted);
            let angle = |view: &Viewpoint| (view.fov().up - view.fov().down).to_degrees();
            assert!((angle(&view) - wanted).abs() < 1e-3, "{}", angle(&view));
            let other = if wanted > 50.0 { 0.5 } else { -0.5 };
            gone(&mut view, turns(|it| it.zoom = other), WIDE);
            assert!((angle(&view) - wanted).abs() > 5.0, "{}", angle(&view));
            gone(&mut view, turns(|it| it.home = true), WIDE);
            assert!((angle(&view) - wanted).abs() < 1e-3, "{}", angle(&view));
        }
    }

    /// In its view the panel fills nine tenths of the height, or of the width of a picture that is narrower than it.
    #[test]
    fn the_panel_fills_its_view() {
        for aspect in [WIDE, 0.9] {
            let mut view = Viewpoint::default();
            gone(&mut view, turns(|it| it.panel = true), aspect);
            let side = |x: f32, y: f32| seen(&view, on_panel(x, y));
            let (left, right) = (side(-1.0, 0.0)[0], side(1.0, 0.0)[0]);
            let (upper, lower) = (side(0.0, 1.0)[1], side(0.0, -1.0)[1]);
            let largest = (right - left).max(lower - upper);
            // It leans back, so that its two halves are not equally far.
            assert!((largest - FILLS).abs() < 0.03, "{largest}");
            assert!(met(view.ray([0.5, 0.5]), panel()).is_some());
            assert_eq!(met(view.ray([0.01, 0.01]), panel()), None);
        }
    }
}
