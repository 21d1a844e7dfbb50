//! The pictograms: no words, so that nobody has to read. Each moves, and begins anew.

use egui::Shape;
use glam::{Vec2, vec2};
use vitriol_sim::scene::ToolKind;
use vitriol_xr::Side;

use super::strokes::{Beaker, Canvas, HAND, LIQUID, Part};
use crate::first_minute::Lesson;

/// Steps of a pictogram's motion, and how many of them a picture stays when the motion is done.
pub const STEPS: u32 = 24;
const RESTS: u32 = 8;

/// What moves a hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MovedBy {
    /// The user's bare hand.
    Fingers,
    /// A controller, whose trigger is shown.
    Controller,
    /// A mouse, whose button or wheel is shown.
    Mouse,
}

/// A picture of the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pictogram {
    /// What it shows.
    pub lesson: Lesson,
    /// The tool that is taken; `None` of a flask.
    pub tool: Option<ToolKind>,
    /// The hand that does it.
    pub side: Side,
    /// What moves that hand, which is shown beside it.
    pub by: MovedBy,
    /// Whether another press lets go.
    pub toggles: bool,
    /// Step of the motion.
    pub step: u32,
}

/// How far a motion is, 0 to 1, that begins and ends at these shares of all of it: slowly, fast, slowly.
fn eased(progress: f32, [from, to]: [f32; 2]) -> f32 {
    let share = ((progress - from) / (to - from)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

impl Pictogram {
    /// As shapes within a square whose inscribed disc has that radius, pixels.
    pub fn shapes(&self, radius: f32) -> Vec<Shape> {
        let mut canvas = Canvas::new(radius, self.side == Side::Left);
        let progress = (self.step % STEPS) as f32 / (STEPS - RESTS) as f32;
        let progress = progress.min(1.0);
        match self.lesson {
            Lesson::Take => self.take(&mut canvas, progress),
            Lesson::Lift => self.lift(&mut canvas, progress),
            Lesson::Pour => self.pour(&mut canvas, progress),
            Lesson::PutDown => self.put_down(&mut canvas, progress),
        }
        canvas.ring(Vec2::ZERO, 0.955, 0.03, HAND);
        canvas.shapes()
    }

    /// How far a trigger is pulled that is at `held` (0 to 1) by who holds it; where another press lets go it is pulled for a moment
    /// as `turns` goes from 0 to 1.
    fn pulled(&self, held: f32, turns: f32) -> f32 {
        match self.toggles {
            true => 1.0 - (2.0 * turns - 1.0).abs(),
            false => held,
        }
    }

    /// How large beaker and hand are, and where the beaker stands: there is room for controller or mouse over them.
    fn beaker(&self) -> Beaker {
        let (x, y, size) = match self.by {
            MovedBy::Controller | MovedBy::Mouse => (-0.36, -0.56, 0.82),
            MovedBy::Fingers => (-0.22, -0.40, 1.0),
        };
        let (base, turn) = (vec2(x, y), 0.0);
        Beaker { base, turn, size }
    }

    /// The hand comes from the right, and closes round the beaker or the tool.
    fn take(&self, canvas: &mut Canvas, progress: f32) {
        let beaker = self.beaker();
        let closed = eased(progress, [0.5, 1.0]);
        let far = 0.30 * (1.0 - eased(progress, [0.0, 0.5]));
        canvas.table([-0.74, 0.30], beaker.base.y);
        holding(canvas, (&beaker, self.tool), far, closed);
        self.press(canvas, self.pulled(closed, closed), false);
    }

    /// Up from the table: by a mouse's wheel, since its hand carries things just over the table.
    fn lift(&self, canvas: &mut Canvas, progress: f32) {
        lift(canvas, progress);
        if self.by == MovedBy::Mouse {
            canvas.mouse(vec2(0.50, 0.50), 0.75, Part::Wheel, false);
        }
    }

    /// The beaker turns over the other one: by a mouse's right button, which is held while the mouse goes to the side to
    /// which it is poured.
    fn pour(&self, canvas: &mut Canvas, progress: f32) {
        pour(canvas, progress);
        if self.by == MovedBy::Mouse {
            canvas.mouse(vec2(0.48, -0.36), 0.75, Part::Right, true);
            canvas.arrow(vec2(0.25, -0.46), vec2(0.0, -0.46));
        }
    }

    /// The trigger that is pulled so far (0 to 1), and is to pull or to let go; or the mouse's button.
    fn press(&self, canvas: &mut Canvas, pulled: f32, lets_go: bool) {
        match self.by {
            MovedBy::Fingers => {}
            MovedBy::Controller => canvas.controller(CONTROLLER, pulled, lets_go),
            MovedBy::Mouse => canvas.mouse(MOUSE, 1.0, Part::Left, pulled >= 0.5),
        }
    }

    /// Down to the table, where the hand opens and goes away.
    fn put_down(&self, canvas: &mut Canvas, progress: f32) {
        let up = 1.0 - eased(progress, [0.0, 0.5]);
        let opens = eased(progress, [0.55, 0.8]);
        let far = 0.30 * eased(progress, [0.75, 1.0]);
        let mut beaker = self.beaker();
        beaker.base.y -= 0.1;
        canvas.table([-0.62, 0.30], beaker.base.y);
        canvas.arrow(vec2(-0.74, 0.40), vec2(-0.74, -0.22));
        beaker.base += vec2(0.06, 0.36 * up);
        holding(canvas, (&beaker, None), far, 1.0 - opens);
        let pulled = self.pulled(1.0 - opens, opens);
        self.press(canvas, pulled, !self.toggles);
    }
}

/// Where a controller's trigger is.
const CONTROLLER: Vec2 = vec2(0.22, 0.58);
/// Where a mouse is.
const MOUSE: Vec2 = vec2(0.20, 0.50);

/// A beaker, or a tool in its place, with a hand at its right, so far away and so far closed.
fn holding(
    canvas: &mut Canvas,
    (beaker, tool): (&Beaker, Option<ToolKind>),
    far: f32,
    closed: f32,
) {
    let palm = Beaker {
        base: beaker.base + far * Vec2::X,
        ..*beaker
    };
    canvas.thumb(&palm, closed);
    match tool {
        Some(ToolKind::Goggles) => canvas.goggles(beaker),
        Some(_) => canvas.gloves(beaker),
        None => {
            canvas.beaker(beaker, 0.55);
        }
    }
    canvas.hand(&palm, closed, palm.at(1.5, -0.42));
}

/// Up from the table.
fn lift(canvas: &mut Canvas, progress: f32) {
    let up = eased(progress, [0.1, 1.0]);
    canvas.table([-0.62, 0.40], -0.56);
    canvas.arrow(vec2(-0.66, -0.26), vec2(-0.66, 0.46));
    let beaker = Beaker {
        base: vec2(-0.14, -0.56 + 0.46 * up),
        turn: 0.0,
        size: 1.0,
    };
    holding(canvas, (&beaker, None), 0.0, 1.0);
}

/// The beaker in the hand turns about its lip, over the other one.
fn pour(canvas: &mut Canvas, progress: f32) {
    let turn = 0.25 + 1.35 * eased(progress, [0.0, 0.7]);
    let flows = eased(progress, [0.4, 1.0]);
    let target = Beaker {
        base: vec2(-0.30, -0.76),
        turn: 0.0,
        size: 0.82,
    };
    let lip = vec2(-0.26, 0.06);
    let poured = 0.45 * flows;
    let source = Beaker::with_lip_at(lip, turn, 0.82);
    if flows > 0.0 {
        let bottom = target.at(0.0, 0.04).y;
        canvas.line([lip, vec2(lip.x, bottom)], 0.035, LIQUID);
    }
    canvas.beaker(&target, poured);
    canvas.thumb(&source, 1.0);
    canvas.beaker(&source, 0.55 - poured);
    canvas.hand(&source, 1.0, vec2(0.98, 0.24));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sign::strokes::{AMBER, GLASS, LIQUID};

    /// Over the goggles no beaker with liquid is shown, and over the gloves, which are blue, no glass.
    #[test]
    fn a_tool_is_not_shown_as_a_beaker() {
        let colours = |tool| {
            let picture = Pictogram {
                lesson: Lesson::Take,
                tool,
                side: Side::Right,
                by: MovedBy::Fingers,
                toggles: false,
                step: 0,
            };
            let shapes = picture.shapes(100.0).into_iter();
            let mut has = [false; 2];
            for shape in shapes {
                let colour = match shape {
                    Shape::Path(path) => path.fill,
                    Shape::Circle(circle) if circle.fill == egui::Color32::TRANSPARENT => {
                        circle.stroke.color
                    }
                    Shape::Circle(circle) => circle.fill,
                    _ => continue,
                };
                has = [has[0] || colour == LIQUID, has[1] || colour == GLASS];
            }
            has
        };
        assert_eq!(colours(None), [true, true]);
        assert_eq!(colours(Some(ToolKind::Goggles)), [false, true]);
        assert_eq!(colours(Some(ToolKind::Gloves)), [true, false]);
    }

    /// A right hand holds the beaker from the right and pours to the left, and the mouse goes there too.
    #[test]
    fn the_mouse_goes_to_the_side_to_which_it_is_poured() {
        for (side, way) in [(Side::Right, -1.0), (Side::Left, 1.0)] {
            let picture = Pictogram {
                lesson: Lesson::Pour,
                tool: None,
                side,
                by: MovedBy::Mouse,
                toggles: false,
                step: 0,
            };
            let shapes = picture.shapes(100.0).into_iter();
            // An arrow's head: its tip is the first corner.
            let heads: Vec<f32> = shapes
                .filter_map(|shape| match shape {
                    Shape::Path(path) if path.fill == AMBER => {
                        Some(path.points[0].x - path.points[1].x)
                    }
                    _ => None,
                })
                .collect();
            assert!(heads.len() == 1 && heads[0] * way > 0.0, "{heads:?}");
        }
    }
}
