//! The panel behind the bench: temperatures, state, and buttons that a hand presses by pointing.
//!
//! It is drawn in the scene, and shown by a headset in a layer of its own under the picture (`xr/src/session/layers.rs`). A hand
//! that points at it has a ray.

mod aimed;
mod colours;
#[cfg(test)]
mod fits;
mod lesson;
mod view;

pub(crate) use self::aimed::Aimed;
pub(crate) use self::colours::{SAID, WARNING, WHITE};
pub(crate) use self::view::context;

use egui::{Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Vec2, pos2};
use glam::{Quat, Vec3};
use vitriol_gpu::{Gpu, Image, Recorder};
use vitriol_render::{Bone, Finish};
use vitriol_run::{Blame, Failure};
use vitriol_shaders::Library;
use vitriol_xr::{Hand, Pose, Side};

use super::decision::Decision;
use super::hold::Hold;
use super::info::Info;
use super::painter::{self, Painter};
use vitriol_run::texts::{PanelTexts, Texts};

/// Width and height of the panel, pixels.
pub const PANEL: [u32; 2] = [1024, 864];

/// Width of the panel, m.
pub const WIDTH: f32 = 0.72;

/// Width and height of the panel, m.
pub const SIZE: [f32; 2] = [WIDTH, WIDTH * PANEL[1] as f32 / PANEL[0] as f32];

/// Where it stands in the scene's stage: behind the vessels, over the table's far edge, leaning back a little. So it is
/// read from 0.8 m, sitting or standing, and a flask that is held up does not hide it.
pub fn scene_from_panel() -> Pose {
    Pose::new(Vec3::new(0.0, 1.16, -0.80), Quat::from_rotation_x(-0.12))
}

/// Radius of the ray from a hand that points here, m: at 0.7 m a quarter of a degree across.
const RAY: f32 = 0.0015;

/// The trigger presses from this value on, and releases below half of it.
const PRESSES: f32 = 0.6;

/// The panel: its layout and picture, and the hand that points at it.
pub struct Panel {
    words: PanelTexts,
    context: egui::Context,
    painter: Painter,
    /// Its picture.
    pub image: Image,
    /// Its picture has not been handed to the headset.
    kept_back: bool,
    /// Where a hand points, pixels.
    pointer: Option<Pos2>,
    /// The hand that points, and from where to where in the scene's stage.
    ray: Option<(Side, [Vec3; 2])>,
    /// The button there.
    aimed: Option<Aimed>,
    pressed: bool,
    /// Whether the pointing hand has had its trigger released while it pointed here.
    armed: bool,
    /// A button that is held, and what it stands for.
    holds: Option<(Decision, Hold)>,
    /// Which hand points, where both do: the one whose trigger was pulled last.
    side: usize,
    /// By hand, whether its trigger is pulled.
    pulled: [bool; 2],
    shown: Option<Shown>,
}

/// What the panel's picture depends on.
#[derive(Clone, Debug, PartialEq)]
struct Shown {
    info: Info,
    pointer: Option<Pos2>,
    pressed: bool,
    /// How far the button that is held has come, in so many steps.
    ring: Option<u32>,
}

/// Steps in which a ring fills.
const RING: f32 = 20.0;

impl Panel {
    /// A panel that shows nothing yet, in English.
    ///
    /// # Errors
    /// An error of the device.
    pub fn new(gpu: &Gpu, library: &Library) -> Result<Self, Failure> {
        Ok(Self {
            words: Texts::english()?.panel,
            context: context(),
            painter: Painter::new(gpu, library, "panel")?,
            image: painter::image(gpu, "panel", PANEL)?,
            kept_back: true,
            pointer: None,
            ray: None,
            aimed: None,
            pressed: false,
            armed: false,
            holds: None,
            side: 1,
            pulled: [false; 2],
            shown: None,
        })
    }

    /// This panel with the texts of another language.
    pub fn in_words(mut self, words: &PanelTexts) -> Self {
        self.words = words.clone();
        self
    }

    /// Takes in where the free hands point (in the scene's stage) in the frame that is shown at `now` (ns), shows `info`, and
    /// returns what was pressed, or held for long enough. `None` stands for a hand that is not there or holds something.
    pub fn update(&mut self, hands: [Option<&Hand>; 2], info: &Info, now: i64) -> Option<Decision> {
        let mut events = Vec::new();
        let pointing = self.pointing(hands);
        let was = std::mem::replace(&mut self.pointer, pointing.map(|(at, _)| at));
        match pointing {
            Some((at, trigger)) => {
                events.push(Event::PointerMoved(at));
                let least = if self.pressed { 0.5 * PRESSES } else { PRESSES };
                let presses = trigger >= least;
                // A hand that begins to point with its trigger pulled presses nothing.
                self.armed = !presses || (self.armed && was.is_some());
                if presses != self.pressed && self.armed {
                    self.pressed = presses;
                    events.push(button(at, presses));
                }
            }
            None if was.is_some() => {
                self.pressed = false;
                events.push(Event::PointerGone);
            }
            None => {}
        }
        let held = self.holds.as_mut().and_then(|(decision, hold)| {
            let long = hold.advance(self.pressed, now);
            long.then(|| decision.clone())
        });
        let share = self.holds.as_ref().and_then(|(_, hold)| hold.share(now));
        let shown = Shown {
            info: info.clone(),
            pointer: self.pointer,
            pressed: self.pressed,
            ring: share.map(|share| (RING * share) as u32),
        };
        if self.shown.as_ref() == Some(&shown) {
            return held;
        }
        let seen = self.show(&shown, events);
        self.shown = Some(shown);
        self.aimed = seen.aimed;
        match seen.held.filter(|_| self.pressed) {
            Some(decision) if self.holds.as_ref().is_none_or(|(of, _)| *of != decision) => {
                let mut hold = Hold::default();
                hold.advance(true, now);
                self.holds = Some((decision, hold));
            }
            Some(_) => {}
            // Let go, or on another button.
            None => self.holds = None,
        }
        held.or(seen.clicked)
    }

    /// Where a hand points, and its trigger. Of two that point, the one that pulled its trigger last.
    fn pointing(&mut self, hands: [Option<&Hand>; 2]) -> Option<(Pos2, f32)> {
        for (side, hand) in hands.iter().enumerate() {
            let pulls = hand.is_some_and(|hand| hand.trigger >= PRESSES);
            if pulls && !self.pulled[side] {
                self.side = side;
            }
            self.pulled[side] = pulls;
        }
        let sides = [Side::BOTH[self.side], Side::BOTH[1 - self.side]];
        let found = sides.into_iter().find_map(|side| {
            let hand = hands[side as usize]?;
            let (at, hit) = pointed_at(&hand.stage_from_aim, PANEL)?;
            Some((
                at,
                hand.trigger,
                (side, [hand.stage_from_aim.position, hit]),
            ))
        });
        self.ray = found.map(|(_, _, ray)| ray);
        found.map(|(at, trigger, _)| (at, trigger))
    }

    /// The ray of the hand that points here, in the scene's stage.
    pub fn ray(&self) -> Option<(Side, Bone)> {
        let bone = |ends| Bone::new(Finish::Ray, ends, [RAY; 2]);
        self.ray.map(|(side, ends)| (side, bone(ends)))
    }

    /// The button that a hand points at, and its corners in the scene's stage.
    pub(crate) fn aimed(&self) -> Option<(&Aimed, [Vec3; 4])> {
        let aimed = self.aimed.as_ref()?;
        let Rect { min, max } = aimed.bounds;
        let corners = [min, pos2(max.x, min.y), pos2(min.x, max.y), max];
        Some((aimed, corners.map(place)))
    }

    fn show(&mut self, shown: &Shown, events: Vec<Event>) -> view::Seen {
        let mut seen = view::Seen::default();
        let ring = shown.ring.map(|step| step as f32 / RING);
        let output = self.context.run(input(events), |context| {
            let said = (&shown.info, &self.words);
            seen = view::show(context, said, shown.pointer, ring);
        });
        let meshes = self.context.tessellate(output.shapes, 1.0);
        self.painter.take(meshes, output.textures_delta);
        seen
    }

    /// Whether its picture has changed since the headset took it.
    pub fn has_changed(&self) -> bool {
        self.painter.changed || self.kept_back
    }

    /// Records the picture, if it has changed since it was recorded last.
    ///
    /// # Errors
    /// An error of the device.
    pub fn record(&mut self, rec: &mut Recorder) -> Result<(), Failure> {
        self.kept_back |= self.painter.changed;
        self.painter.record(rec, &self.image)
    }

    /// Records the picture's copy to what the headset shows.
    ///
    /// # Errors
    /// An error of the device.
    pub fn hand_over(&mut self, rec: &mut Recorder, target: &Image) -> Result<(), Failure> {
        rec.copy_image(&self.image, target).other()?;
        self.kept_back = false;
        Ok(())
    }
}

/// egui's input for the whole panel, with these events.
fn input(events: Vec<Event>) -> RawInput {
    let [width, height] = PANEL.map(|side| side as f32);
    RawInput {
        screen_rect: Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(width, height))),
        events,
        ..RawInput::default()
    }
}

fn button(at: Pos2, pressed: bool) -> Event {
    Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::default(),
    }
}

/// Where a ray (from a place along a direction) meets the face of a panel of that pose, width and height (m): in the panel's own axes.
/// `None` beside the panel, from behind, and of what is no number.
pub(crate) fn met(
    (from, along): (Vec3, Vec3),
    (pose, [width, height]): (Pose, [f32; 2]),
) -> Option<Vec3> {
    let panel_from_stage = pose.inverse();
    let from = panel_from_stage.transform_point(from);
    let along = panel_from_stage.orientation * along;
    if from.z <= 0.0 || along.z >= -1e-3 {
        return None;
    }
    let at = from + along * (-from.z / along.z);
    (at.x.abs() < 0.5 * width && at.y.abs() < 0.5 * height).then_some(at)
}

/// Where a pixel of the panel is in the scene's stage.
fn place(at: Pos2) -> Vec3 {
    let metres = WIDTH / PANEL[0] as f32;
    let across = at.x - 0.5 * PANEL[0] as f32;
    let up = 0.5 * PANEL[1] as f32 - at.y;
    scene_from_panel().transform_point(metres * Vec3::new(across, up, 0.0))
}

/// The pixel that a ray along −Z meets, if it meets the panel's face, and where in the scene's stage that is.
fn pointed_at(scene_from_aim: &Pose, [width, height]: [u32; 2]) -> Option<(Pos2, Vec3)> {
    let pixels = width as f32 / WIDTH;
    let panel = (scene_from_panel(), [WIDTH, height as f32 / pixels]);
    let along = scene_from_aim.orientation * Vec3::NEG_Z;
    let at = met((scene_from_aim.position, along), panel)?;
    let (x, y) = (
        0.5 * width as f32 + pixels * at.x,
        0.5 * height as f32 - pixels * at.y,
    );
    Some((Pos2::new(x, y), scene_from_panel().transform_point(at)))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_meets_the_pixel_that_it_is_aimed_at() {
        let extent = [1024, 640];
        for (x, y) in [(512.0, 320.0), (10.0, 20.0), (1000.0, 600.0)] {
            // The pixel's place in the room, from the panel's own definition.
            let metres = WIDTH / 1024.0;
            let on_panel = Vec3::new((x - 512.0) * metres, (320.0 - y) * metres, 0.0);
            let target = scene_from_panel().transform_point(on_panel);
            let hand = Vec3::new(0.2, 0.9, -0.2);
            let turn = Quat::from_rotation_arc(Vec3::NEG_Z, (target - hand).normalize());
            let (at, hit) = pointed_at(&Pose::new(hand, turn), extent).unwrap();
            assert!((hit - target).length() < 1e-4, "{hit}");
            assert!((at - Pos2::new(x, y)).length() < 0.1, "{at:?}");
        }
        // Back from a pixel to the room.
        let (at, hit) = pointed_at(&Pose::new(Vec3::Y, Quat::IDENTITY), PANEL).unwrap();
        assert!((place(at) - hit).length() < 1e-5, "{hit}");
        // Past its edge, away from it, and from behind.
        let aim = |at: Vec3, turn| pointed_at(&Pose::new(at, turn), extent);
        assert_eq!(aim(Vec3::new(0.5, 1.16, 0.0), Quat::IDENTITY), None);
        let back = Quat::from_rotation_y(std::f32::consts::PI);
        assert_eq!(aim(Vec3::new(0.0, 1.16, 0.0), back), None);
        assert_eq!(aim(Vec3::new(0.0, 1.16, -1.5), back), None);
        // What is no number.
        assert_eq!(aim(Vec3::splat(f32::NAN), Quat::IDENTITY), None);
        let nowhere = Pose::new(Vec3::splat(f32::NAN), Quat::IDENTITY);
        assert_eq!(met((Vec3::ZERO, Vec3::NEG_Z), (nowhere, SIZE)), None);
    }
}
