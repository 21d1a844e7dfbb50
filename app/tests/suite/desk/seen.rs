//! What a frame shows to who sits at the screen: where flasks and hands are, by the poses of the frame and by rules of its own.

use glam::Vec3;
use vitriol_xr::{Around, Line, PoseFrame, Side, Thing};

/// Flasks of the scene `two-flasks`: a beaker with 150 mL of water, and an empty one to the right of it.
pub const SOURCE: usize = 0;
pub const TARGET: usize = 1;

/// The part of `v` along the table.
pub fn level(v: Vec3) -> Vec3 {
    v.with_y(0.0)
}

/// What the last frame showed.
pub struct Seen<'a> {
    /// Head and hands.
    pub frame: &'a PoseFrame,
    /// The bodies.
    pub around: &'a Around,
    /// The lines that were drawn with it.
    pub lines: &'a [Line],
    /// Width and height that were drawn, pixels.
    pub drawn: [u32; 2],
    /// About the simulated time since the step of the user began, s.
    pub lasts: f64,
}

impl Seen<'_> {
    pub fn thing(&self, thing: usize) -> &Thing {
        &self.around.things[thing]
    }

    pub fn foot(&self, thing: usize) -> Vec3 {
        self.thing(thing).pose.position
    }

    pub fn middle(&self, thing: usize) -> Vec3 {
        let thing = self.thing(thing);
        thing.pose.transform_point(0.5 * thing.height * Vec3::Y)
    }

    /// The direction of its axis.
    pub fn axis(&self, thing: usize) -> Vec3 {
        self.thing(thing).pose.orientation * Vec3::Y
    }

    /// How far it is tilted, degrees.
    pub fn tilt(&self, thing: usize) -> f32 {
        self.axis(thing).angle_between(Vec3::Y).to_degrees()
    }

    /// The lowest place of its rim; of an upright one the middle of the rim.
    pub fn lip(&self, thing: usize) -> Vec3 {
        let (axis, thing) = (self.axis(thing), self.thing(thing));
        let down = (axis * axis.y - Vec3::Y).normalize_or_zero();
        thing.pose.transform_point(thing.height * Vec3::Y) + thing.rim * down
    }

    pub fn palm(&self, side: Side) -> Vec3 {
        self.frame.hand(side).stage_from_grip.position
    }

    /// The hand that holds it.
    pub fn holder(&self, thing: usize) -> Option<Side> {
        let mut sides = Side::BOTH.into_iter();
        sides.find(|side| self.around.holds[*side as usize] == Some(thing))
    }

    /// Distance along the table from the nearer palm to the glass, m.
    pub fn gap(&self, thing: usize) -> f32 {
        let thing = self.thing(thing);
        let away = |side| level(self.palm(side) - thing.pose.position).length() - thing.radius;
        away(Side::Left).min(away(Side::Right))
    }

    /// Whether lines go round it, as they do about what a press would take.
    pub fn is_ringed(&self, thing: usize) -> bool {
        let thing = self.thing(thing);
        let thing_from_stage = thing.pose.inverse();
        let ends = self.lines.iter().flat_map(|line| [line.from, line.to]);
        let ends = ends.map(|end| thing_from_stage.transform_point(end));
        // 3 cm is the most by which a ring may be wider or higher than the glass.
        let about: Vec<Vec3> = ends
            .filter(|end| level(*end).length() < thing.radius + 0.03)
            .filter(|end| (-0.03..thing.height + 0.03).contains(&end.y))
            .collect();
        [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z]
            .iter()
            .all(|way| about.iter().any(|end| end.dot(*way) > 0.5 * thing.radius))
    }

    /// Where a point of the stage is in the picture: shares of its width and height from its upper left.
    pub fn place(&self, point: Vec3) -> [f32; 2] {
        let fov = &self.frame.info.fov[0];
        let at = (self.frame.stage_from_view.inverse()).transform_point(point);
        assert!(at.z < 0.0, "{point} is behind the eye");
        let [left, right, up, down] = [fov.left, fov.right, fov.up, fov.down].map(f32::tan);
        let (x, y) = (at.x / -at.z, at.y / -at.z);
        [(x - left) / (right - left), (up - y) / (up - down)]
    }

    /// Width over height of what the eye sees.
    pub fn aspect(&self) -> f32 {
        let fov = &self.frame.info.fov[0];
        (fov.right.tan() - fov.left.tan()) / (fov.up.tan() - fov.down.tan())
    }
}
