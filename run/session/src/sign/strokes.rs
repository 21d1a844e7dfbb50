//! What pictograms are made of: thick strokes, beakers with liquid in them, hands and arrows.
//!
//! Places are in the sign's disc: its radius is 1, x goes to the right and y up. A pictogram is made for the right hand, and mirrored
//! for the left one.

use egui::{Color32, Pos2, Shape, Stroke, pos2};
use glam::{Vec2, vec2};

use crate::painter::GROUND;

/// Glass.
pub(super) const GLASS: Color32 = Color32::from_rgb(205, 225, 245);
/// Liquid.
pub(super) const LIQUID: Color32 = Color32::from_rgb(95, 175, 255);
/// A hand.
pub(super) const HAND: Color32 = Color32::from_rgb(250, 245, 235);
/// What is to be pressed, and where to: the panel's amber.
pub(super) const AMBER: Color32 = Color32::from_rgb(255, 190, 80);
/// A controller or a mouse, and what flasks stand on.
pub(super) const THING: Color32 = Color32::from_rgb(165, 175, 185);

/// Half a line's width.
const LINE: f32 = 0.028;
/// How broad the dark edge is that parts what lies over something else.
const EDGE: f32 = 0.028;

/// A beaker: half its width, its height, its lip.
pub(super) const HALF: f32 = 0.26;
pub(super) const HEIGHT: f32 = 0.66;
const LIP: f32 = 0.05;

/// The disc's ground.
pub(super) fn ground() -> Color32 {
    let [r, g, b, _] = GROUND.map(|share| (255.0 * share).round() as u8);
    Color32::from_rgb(r, g, b)
}

/// What is drawn on.
pub(super) struct Canvas {
    shapes: Vec<Shape>,
    /// Radius of the disc, pixels.
    radius: f32,
    mirrored: bool,
}

/// A beaker's place: the middle of its base, how far it is turned to the left (rad), and its size.
#[derive(Clone, Copy)]
pub(super) struct Beaker {
    pub base: Vec2,
    pub turn: f32,
    pub size: f32,
}

/// A part of a mouse that is to be used.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Part {
    Left,
    Right,
    Wheel,
}

impl Beaker {
    /// A place in it, in lengths of an upright beaker of size 1.
    pub fn at(&self, x: f32, y: f32) -> Vec2 {
        self.base + Vec2::from_angle(self.turn).rotate(self.size * vec2(x, y))
    }

    /// One whose left lip is there.
    pub fn with_lip_at(lip: Vec2, turn: f32, size: f32) -> Self {
        let base = Vec2::ZERO;
        let of = Self { base, turn, size };
        Self {
            base: lip - of.at(-HALF - LIP, HEIGHT),
            ..of
        }
    }

    /// The liquid that fills this share of it, as a level surface leaves it, and the surface's height.
    fn liquid(&self, share: f32) -> (Vec<Vec2>, f32) {
        let corners = [(-HALF, HEIGHT), (-HALF, 0.0), (HALF, 0.0), (HALF, HEIGHT)]
            .map(|(x, y)| self.at(x, y));
        let wanted = share * 2.0 * HALF * HEIGHT * self.size * self.size;
        let (mut low, mut high) = (-2.0, 2.0);
        for _ in 0..16 {
            let middle = 0.5 * (low + high);
            match area(&below(&corners, middle)) < wanted {
                true => low = middle,
                false => high = middle,
            }
        }
        (below(&corners, low), low)
    }
}

/// What of a convex polygon is below a height.
fn below(corners: &[Vec2], height: f32) -> Vec<Vec2> {
    let next = corners.iter().cycle().skip(1);
    let part = |(a, b): (&Vec2, &Vec2)| {
        let crosses = (a.y < height) != (b.y < height);
        let at = a.lerp(*b, (height - a.y) / (b.y - a.y));
        [(a.y < height).then_some(*a), crosses.then_some(at)]
    };
    corners.iter().zip(next).flat_map(part).flatten().collect()
}

/// Area of a polygon.
fn area(corners: &[Vec2]) -> f32 {
    let next = corners.iter().cycle().skip(1);
    let doubled: f32 = corners.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum();
    0.5 * doubled.abs()
}

impl Canvas {
    /// An empty disc with that radius, pixels, in the middle of a square.
    pub fn new(radius: f32, mirrored: bool) -> Self {
        Self {
            shapes: Vec::new(),
            radius,
            mirrored,
        }
    }

    /// What was drawn.
    pub fn shapes(self) -> Vec<Shape> {
        self.shapes
    }

    fn place(&self, at: Vec2) -> Pos2 {
        let x = if self.mirrored { -at.x } else { at.x };
        pos2(self.radius * (1.0 + x), self.radius * (1.0 - at.y))
    }

    /// A disc.
    pub fn dot(&mut self, at: Vec2, radius: f32, colour: Color32) {
        let shape = Shape::circle_filled(self.place(at), radius * self.radius, colour);
        self.shapes.push(shape);
    }

    /// A ring.
    pub fn ring(&mut self, at: Vec2, radius: f32, half_width: f32, colour: Color32) {
        let stroke = Stroke::new(2.0 * half_width * self.radius, colour);
        let shape = Shape::circle_stroke(self.place(at), radius * self.radius, stroke);
        self.shapes.push(shape);
    }

    /// A line with round ends.
    pub fn line(&mut self, ends: [Vec2; 2], half_width: f32, colour: Color32) {
        let stroke = Stroke::new(2.0 * half_width * self.radius, colour);
        let points = ends.map(|end| self.place(end));
        self.shapes.push(Shape::line_segment(points, stroke));
        for end in ends {
            self.dot(end, half_width, colour);
        }
    }

    /// A line as [`Canvas::line`] draws it, with a dark edge that parts it from what is under it.
    pub fn edged(&mut self, ends: [Vec2; 2], half_width: f32, colour: Color32) {
        self.line(ends, half_width + EDGE, ground());
        self.line(ends, half_width, colour);
    }

    /// A convex polygon.
    fn polygon(&mut self, corners: &[Vec2], colour: Color32) {
        let points = corners.iter().map(|corner| self.place(*corner)).collect();
        let shape = Shape::convex_polygon(points, colour, Stroke::NONE);
        self.shapes.push(shape);
    }

    /// A beaker that is filled to this share; the height of the liquid's surface.
    pub fn beaker(&mut self, beaker: &Beaker, share: f32) -> f32 {
        let (liquid, surface) = beaker.liquid(share);
        if liquid.len() > 2 {
            self.polygon(&liquid, LIQUID);
        }
        let outline = [
            (-HALF - LIP, HEIGHT),
            (-HALF, HEIGHT - LIP),
            (-HALF, 0.0),
            (HALF, 0.0),
            (HALF, HEIGHT - LIP),
            (HALF + LIP, HEIGHT),
        ]
        .map(|(x, y)| beaker.at(x, y));
        for ends in outline.windows(2) {
            self.line([ends[0], ends[1]], LINE, GLASS);
        }
        surface
    }

    /// Goggles in a beaker's place: two glasses with a strap.
    pub fn goggles(&mut self, place: &Beaker) {
        for side in [-1.0_f32, 1.0] {
            let ends = [(0.30_f32, 0.24), (0.38, 0.40)].map(|(x, y)| place.at(side * x, y));
            self.line(ends, LINE, THING);
            self.ring(place.at(0.15 * side, 0.18), 0.14 * place.size, LINE, GLASS);
        }
    }

    /// A box of gloves in a beaker's place, out of which one looks.
    pub fn gloves(&mut self, place: &Beaker) {
        for n in 0..4 {
            let x = -0.12 + 0.08 * n as f32;
            let ends = [place.at(x, 0.30), place.at(1.3 * x, 0.58)];
            self.line(ends, 0.035 * place.size, LIQUID);
        }
        let low = HALF + LIP;
        let corners = [(-low, 0.0), (low, 0.0), (low, 0.36), (-low, 0.36)];
        self.polygon(&corners.map(|(x, y)| place.at(x, y)), THING);
    }

    /// What a beaker stands on, at that height.
    pub fn table(&mut self, ends: [f32; 2], height: f32) {
        let ends = ends.map(|x| vec2(x, height - 2.0 * LINE));
        self.line(ends, LINE, THING);
    }

    /// An arrow.
    pub fn arrow(&mut self, from: Vec2, to: Vec2) {
        let along = (to - from).normalize_or_zero();
        let (broad, long) = (0.13, 0.17);
        let neck = to - long * along;
        self.line([from, neck], 0.055, AMBER);
        let aside = broad * along.perp();
        self.polygon(&[to, neck + aside, neck - aside], AMBER);
    }

    /// A hand that reaches for a beaker from its right, or is `closed` (0 to 1) round it, its forearm coming from `elbow`. Its thumb
    /// is behind the beaker, so `thumb` comes before it.
    pub fn thumb(&mut self, palm: &Beaker, closed: f32) {
        let root = palm.at(HALF + 0.12, 0.42);
        let open = palm.at(HALF - 0.10, 0.80);
        let tip = open.lerp(palm.at(HALF - 0.16, 0.50), closed);
        self.edged([root, tip], 0.075 * palm.size, HAND);
    }

    /// See [`Canvas::thumb`]: fingers, palm and forearm.
    pub fn hand(&mut self, palm: &Beaker, closed: f32, elbow: Vec2) {
        let wrist = palm.at(HALF + 0.20, 0.22);
        self.edged([wrist, elbow], 0.13 * palm.size, HAND);
        for n in 0..4 {
            let n = n as f32;
            let root = palm.at(HALF + 0.13, 0.43 - 0.115 * n);
            let round = palm.at(-0.04 + 0.03 * (n - 1.0).abs(), 0.43 - 0.125 * n);
            let stretched = palm.at(HALF - 0.24 + 0.05 * (n - 1.0).abs(), 0.62 - 0.24 * n);
            self.edged(
                [root, stretched.lerp(round, closed)],
                0.056 * palm.size,
                HAND,
            );
        }
        let back = [0.38, 0.12].map(|y| palm.at(HALF + 0.19, y));
        self.line(back, 0.125 * palm.size, HAND);
        self.line([wrist, elbow], 0.13 * palm.size, HAND);
    }

    /// A controller in a fist, whose trigger the first finger has pulled so far (0 to 1), and is to pull or to let go. `at` is the
    /// trigger's pivot.
    pub fn controller(&mut self, at: Vec2, pulled: f32, lets_go: bool) {
        let to = |x: f32, y: f32| at + vec2(x, y);
        let goes = 0.11 * pulled;
        self.line([to(0.13, 0.04), to(0.24, -0.40)], 0.085, THING);
        self.line([to(0.03, 0.10), to(0.17, 0.12)], 0.11, THING);
        let back = [to(0.36, -0.12), to(0.42, -0.34)];
        for n in 0..3 {
            let (x, y) = (0.04 * n as f32, -0.22 - 0.105 * n as f32);
            self.edged([to(x + 0.07, y), to(x + 0.32, y + 0.02)], 0.045, HAND);
        }
        // Behind the trigger, round it.
        self.edged([to(0.34, -0.07), to(-0.22 + goes, -0.15)], 0.055, HAND);
        self.line(back, 0.085, HAND);
        self.edged([to(-0.02, -0.02), to(-0.13 + goes, -0.24)], 0.06, AMBER);
        let ends = [to(-0.56 + goes, -0.17), to(-0.30 + goes, -0.17)];
        match lets_go {
            true => self.arrow(ends[1], ends[0]),
            false => self.arrow(ends[0], ends[1]),
        }
    }

    /// A mouse of that size from above, whose `part` is to be used; a button that is `pressed` is lower, with strokes beside it. `at`
    /// is about its middle. A mirrored picture has its buttons where they are.
    pub fn mouse(&mut self, at: Vec2, size: f32, part: Part, pressed: bool) {
        let across = if self.mirrored { -1.0 } else { 1.0 };
        let to = |x: f32, y: f32| at + size * vec2(across * x, y);
        self.edged([to(0.0, -0.20), to(0.0, 0.06)], 0.19 * size, THING);
        for (button, side) in [(Part::Left, -1.0_f32), (Part::Right, 1.0)] {
            let is_used = button == part;
            let goes = if is_used && pressed { 0.04 } else { 0.0 };
            let ends = [0.01, 0.12].map(|y| to(0.085 * side, y - goes));
            let colour = if is_used { AMBER } else { HAND };
            self.line(ends, 0.062 * size, colour);
            if is_used && pressed {
                for ends in [[(0.19, 0.21), (0.25, 0.28)], [(0.23, 0.10), (0.33, 0.12)]] {
                    let ends = ends.map(|(x, y): (f32, f32)| to(side * x, y));
                    self.line(ends, 0.022 * size, AMBER);
                }
            }
        }
        let colour = if part == Part::Wheel { AMBER } else { ground() };
        self.line([to(0.0, 0.03), to(0.0, 0.13)], 0.03 * size, colour);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a square that stands on a corner, and a tilted beaker that keeps what is in it: 0.3 of its area, up to 45°.
    #[test]
    fn liquid_is_level_and_does_not_get_less() {
        let half = 0.5_f32.sqrt();
        let square = [
            vec2(0.0, -half),
            vec2(half, 0.0),
            vec2(0.0, half),
            vec2(-half, 0.0),
        ];
        assert!((area(&below(&square, 0.0)) - 0.5).abs() < 1e-6);
        for turn in [0.0, 0.4, 0.8] {
            let base = Vec2::ZERO;
            let beaker = Beaker {
                base,
                turn,
                size: 0.8,
            };
            let (liquid, surface) = beaker.liquid(0.3);
            let whole = 2.0 * HALF * HEIGHT * 0.64;
            assert!((area(&liquid) / whole - 0.3).abs() < 1e-3);
            assert!(liquid.iter().all(|corner| corner.y <= surface + 1e-6));
        }
    }

    /// The left button is at the left in a picture for the left hand, too.
    #[test]
    fn a_mouse_is_not_mirrored() {
        for mirrored in [false, true] {
            let mut canvas = Canvas::new(100.0, mirrored);
            canvas.mouse(Vec2::ZERO, 1.0, Part::Left, false);
            let amber = canvas.shapes().into_iter().filter_map(|shape| match shape {
                Shape::Circle(end) if end.fill == AMBER => Some(end.center.x),
                _ => None,
            });
            let places: Vec<f32> = amber.collect();
            let at_the_left = places.iter().all(|x| *x < 100.0);
            assert!(!places.is_empty() && at_the_left, "{mirrored}: {places:?}");
        }
    }

    /// WCAG 2.1, success criterion 1.4.6 (AAA), though pictures need but 3 : 1.
    #[test]
    fn all_stands_out_from_the_ground() {
        let luminance = |colour: Color32| {
            let [r, g, b] = [colour.r(), colour.g(), colour.b()]
                .map(|level| ((f32::from(level) / 255.0 + 0.055) / 1.055).powf(2.4));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        for colour in [GLASS, LIQUID, HAND, AMBER, THING] {
            let contrast = (luminance(colour) + 0.05) / (luminance(ground()) + 0.05);
            assert!(contrast >= 7.0, "{contrast} of {colour:?}");
        }
    }
}
