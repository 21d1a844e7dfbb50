//! The label at a desk's pointer: names what is pointed at, and says what a press does. It stands beside that thing, in the window.

use egui::{Pos2, Rect, Vec2, pos2, vec2};

use super::letters::{Block, Letters, packed, write};
use crate::panel::{SAID, WHITE};

/// Lines of text at most.
const LINES: usize = 2;
/// Widest text, in heights of it. Our choice: the longest text of the tools is a line.
const WIDEST: f32 = 24.0;
/// Around the text, from its height; and from the thing to the label.
const MARGIN: f32 = 0.35;
const GAP: f32 = 0.4;
/// What a pointer's picture covers from its tip, from its upper left to its lower right, in heights of text: an arrow, with some room.
const POINTER: [[f32; 2]; 2] = [[-0.5, -0.5], [1.2, 1.7]];

/// What a label says, and of what.
#[derive(Clone, Debug, PartialEq)]
pub struct Said {
    /// Its text.
    pub text: String,
    /// Upper left and lower right corner of what it names, 0 to 1 from the picture's upper left, or beyond it.
    pub bounds: [[f32; 2]; 2],
}

/// The label, whose text is painted anew only where it or the window's size has changed.
#[derive(Default)]
pub struct Label {
    said: Option<Said>,
    pixels: Vec<u32>,
    /// Width and height, pixels.
    extent: [usize; 2],
    /// The text, and the room and the height that it was painted for, pixels.
    of: Option<(String, f32, f32)>,
}

impl Label {
    /// Says that from now on, or nothing.
    pub fn say(&mut self, said: Option<Said>) {
        self.said = said;
    }

    /// Draws it over a window `width` pixels wide, of which `room` is free for it, with text of height `size`. `place` leads from the
    /// picture to the window, and there the pointer is.
    pub fn draw(
        &mut self,
        letters: &Letters,
        (window, width): (&mut [u32], usize),
        (room, size): (Rect, f32),
        place: impl Fn([f32; 2]) -> [f32; 2],
        pointer: Option<[f32; 2]>,
    ) {
        let Some(said) = &self.said else {
            return;
        };
        let of = Some((said.text.clone(), room.width(), size));
        if self.of != of {
            (self.pixels, self.extent) = painted(letters, &said.text, room.width(), size);
            self.of = of;
        }
        let [from, to] = said.bounds.map(|at| Pos2::from(place(at)));
        let [wide, high] = self.extent.map(|side| side as f32);
        let pointer = pointer.map(Pos2::from);
        let things = (Rect::from_min_max(from, to), pointer);
        let at = corner(room, vec2(wide, high), things, size);
        let [left, upper] = [at.x, at.y].map(|side| side.max(0.0) as usize);
        let lines = window.chunks_exact_mut(width.max(1)).skip(upper);
        for (line, row) in lines.zip(self.pixels.chunks_exact(self.extent[0].max(1))) {
            for (pixel, painted) in line.iter_mut().skip(left).zip(row) {
                *pixel = *painted;
            }
        }
    }
}

/// A text on its ground, in a window so wide, with its width and height, pixels.
fn painted(letters: &Letters, text: &str, room: f32, size: f32) -> (Vec<u32>, [usize; 2]) {
    let margin = (MARGIN * size).round();
    let widest = (WIDEST * size).min(room - 2.0 * margin).max(size);
    let (laid, image) = letters.lay(size, |lay| lay(text, WHITE, widest, LINES));
    let extent = (laid.size() + Vec2::splat(2.0 * margin)).ceil();
    let [width, height] = [extent.x, extent.y].map(|side| side as usize);
    let mut pixels = vec![packed(SAID); width * height];
    let block: Block = (laid, WHITE, pos2(margin, margin));
    write(&mut pixels, width, &image, &block);
    (pixels, [width, height])
}

/// The upper left corner of a label of that size in `room`: beside the thing, over it or under it, as near to the pointer as can be, and
/// over neither of them; where the thing leaves no room, in that corner of the room which is farthest from the pointer. Whole pixels.
fn corner(room: Rect, label: Vec2, (thing, pointer): (Rect, Option<Pos2>), size: f32) -> Pos2 {
    let most = (room.max - label).max(room.min);
    let within = |at: Pos2| at.max(room.min).min(most).round();
    let covered = pointer.map(|at| {
        let [from, to] = POINTER.map(|way| at + size * Vec2::from(way));
        Rect::from_min_max(from, to)
    });
    // The pointer's picture reaches beyond a thing that it is on.
    let taken = covered.filter(|it| it.intersects(thing));
    let taken = taken.map_or(thing, |it| it.union(thing));
    let tip = pointer.unwrap_or_else(|| thing.center());
    let near = tip.max(thing.min).min(thing.max) - 0.5 * label;
    let gap = GAP * size;
    let beside = [
        pos2(taken.max.x + gap, near.y),
        pos2(taken.min.x - gap - label.x, near.y),
        pos2(near.x, taken.min.y - gap - label.y),
        pos2(near.x, taken.max.y + gap),
    ];
    let is_clear = |at: &Pos2| {
        let label = Rect::from_min_size(*at, label);
        !label.intersects(thing) && !covered.is_some_and(|it| label.intersects(it))
    };
    let corners = [
        room.min,
        pos2(most.x, room.min.y),
        pos2(room.min.x, most.y),
        most,
    ];
    let away = |at: &Pos2| (*at + 0.5 * label).distance(tip);
    let free = beside.map(within).into_iter().find(is_clear);
    let farthest = || {
        corners
            .into_iter()
            .max_by(|a, b| away(a).total_cmp(&away(b)))
    };
    free.or_else(farthest).map_or(room.min, within)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: f32 = 24.0;
    const LABEL: Vec2 = vec2(300.0, 40.0);

    fn room() -> Rect {
        Rect::from_min_max(pos2(0.0, 40.0), pos2(1280.0, 720.0))
    }

    /// Where the label is of a thing from one place to another, pointed at there.
    fn label(thing: [[f32; 2]; 2], pointer: Option<[f32; 2]>) -> Rect {
        let [from, to] = thing.map(Pos2::from);
        let things = (Rect::from_min_max(from, to), pointer.map(Pos2::from));
        Rect::from_min_size(corner(room(), LABEL, things, SIZE), LABEL)
    }

    /// Wherever a thing is in the window, and wherever on it the pointer, the label is in the window and covers neither.
    #[test]
    fn it_is_beside_what_is_pointed_at() {
        for x in (0..1200).step_by(100) {
            for y in (50..640).step_by(50) {
                let (left, upper) = (x as f32, y as f32);
                let thing = [[left, upper], [left + 80.0, upper + 80.0]];
                for share in [0.0, 0.5, 1.0] {
                    let tip = [left + 80.0 * share, upper + 80.0 * share];
                    let at = label(thing, Some(tip));
                    let [from, to] = thing.map(Pos2::from);
                    assert!(room().contains_rect(at), "{thing:?} {at:?}");
                    assert!(!at.intersects(Rect::from_min_max(from, to)), "{at:?}");
                    assert!(!at.contains(Pos2::from(tip)), "{tip:?} {at:?}");
                }
            }
        }
    }

    /// To the right where there is room, else to the left; of a bar that is as wide as the window above it, over the pointer, else below.
    #[test]
    fn it_is_near_the_pointer() {
        let beaker = label([[500.0, 560.0], [560.0, 680.0]], Some([530.0, 600.0]));
        assert!(beaker.min.x > 560.0 && beaker.min.x < 575.0, "{beaker:?}");
        assert_eq!(beaker.center().y, 600.0);
        let right = label([[1100.0, 560.0], [1200.0, 680.0]], Some([1150.0, 600.0]));
        assert!(right.max.x < 1100.0 && right.max.x > 1085.0, "{right:?}");
        let bar = label([[-200.0, 300.0], [1500.0, 330.0]], Some([900.0, 315.0]));
        assert!(bar.max.y < 300.0 && bar.max.y > 285.0, "{bar:?}");
        assert_eq!(bar.center().x, 900.0);
        let high = label([[-200.0, 40.0], [1500.0, 100.0]], Some([900.0, 90.0]));
        // Below the pointer's picture as well, which ends at 90 + 1.7 · 24.
        assert!(high.min.y > 131.0 && high.min.y < 145.0, "{high:?}");
        // Keys point: there is no pointer in the window.
        let keys = label([[500.0, 560.0], [560.0, 680.0]], None);
        assert_eq!(keys.center().y, 620.0);
    }

    /// What fills the window is covered where the pointer is not.
    #[test]
    fn where_there_is_no_room_it_is_far_from_the_pointer() {
        let whole = [[-10.0, -10.0], [1300.0, 800.0]];
        for tip in [
            [10.0, 50.0],
            [1270.0, 50.0],
            [640.0, 380.0],
            [1270.0, 710.0],
        ] {
            let at = label(whole, Some(tip));
            assert!(room().contains_rect(at), "{at:?}");
            assert!(
                at.distance_to_pos(Pos2::from(tip)) > 100.0,
                "{tip:?} {at:?}"
            );
        }
    }

    /// It has its text, in two lines at most, and is no wider than the window.
    #[test]
    fn a_text_is_painted_on_its_ground() {
        let letters = Letters::new(1.0);
        let bright = |pixels: &[u32]| pixels.iter().filter(|it| **it & 0xff > 200).count();
        for text in ["Beaker, 160 mL: press to take", "烧杯：按下即可拿起"] {
            let (short, [wide, high]) = painted(&letters, text, 1280.0, SIZE);
            assert_eq!(short.len(), wide * high);
            assert!(bright(&short) > 100, "{text}");
            let (_, [long, two]) = painted(&letters, &text.repeat(9), 1280.0, SIZE);
            assert!(long as f32 <= (WIDEST + 1.0) * SIZE && two > high && two < 3 * high);
            let (_, [narrow, _]) = painted(&letters, &text.repeat(9), 200.0, SIZE);
            assert!(narrow <= 200, "{narrow}");
        }
    }

    /// The label of something is in the window's pixels where it belongs, and none of nothing.
    #[test]
    fn it_is_drawn_over_the_picture() {
        let (letters, mut it) = (Letters::new(1.0), Label::default());
        let (width, height) = (400, 200);
        let drawn = |it: &mut Label| {
            let mut window = vec![0; width * height];
            let room = Rect::from_min_size(Pos2::ZERO, vec2(width as f32, height as f32));
            let place = |[x, y]: [f32; 2]| [x * width as f32, y * height as f32];
            it.draw(
                &letters,
                (&mut window[..], width),
                (room, 12.0),
                place,
                None,
            );
            window
        };
        assert!(drawn(&mut it).iter().all(|pixel| *pixel == 0));
        it.say(Some(Said {
            text: "Beaker".into(),
            bounds: [[0.1, 0.4], [0.25, 0.6]],
        }));
        let window = drawn(&mut it);
        for (n, _) in window.iter().enumerate().filter(|(_, it)| **it != 0) {
            let (x, y) = (n % width, n / width);
            assert!(x > 100 && x < 200 && y > 80 && y < 120, "{x} {y}");
        }
        assert!(window.iter().any(|pixel| *pixel != 0));
        it.say(None);
        assert!(drawn(&mut it).iter().all(|pixel| *pixel == 0));
    }
}
