//! What the wearer sees in a session: the panel, what is before it, and the ray of a hand that points at it.

use std::path::Path;

use glam::{Quat, Vec3};
use image::ColorType;
use vitriol_gpu::{Gpu, Image};
use vitriol_session::handle::middles;
use vitriol_session::panel::{PANEL, SIZE, scene_from_panel};
use vitriol_sim::scene::{PictureRoom, Scene};
use vitriol_tests::gpu;
use vitriol_xr::track::Keyframes;
use vitriol_xr::{Hand, Headset, HeadsetFrame, Pose, View};

use crate::vr::common::{Calm, Trouble, Worn, pour, run};

const EXTENT: [u32; 2] = [640, 680];

/// She sits over the scene's origin and looks ahead.
const TRACK: &str = r#"
name = "looks-ahead"
scene = "two-flasks"
seed = 1
duration = 1.0
rate_hz = 90
head = [ { t = 0.0, position = [0.0, 1.20, 0.0], rotation = { pitch = PITCH } } ]
"#;

/// Frames of a session, of which the last is looked at.
const FRAMES: u64 = 4;

/// Her hands are as given.
struct Looks {
    hands: [Hand; 2],
}

impl Trouble for Looks {
    fn draws(&self, after: u64) -> bool {
        after + 1 == FRAMES
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, _: u64) {
        frame.poses.hands = self.hands.clone();
    }
}

/// The left eye's picture of a session's last frame, and where it was drawn from.
pub struct Seen {
    /// Width and height.
    pub extent: [u32; 2],
    /// sRGB and alpha, row by row.
    pub pixels: Vec<[u8; 4]>,
    view: View,
}

/// All layers of an image of colour.
pub fn read(gpu: &Gpu, image: &Image) -> Vec<[u8; 4]> {
    gpu::read_back(gpu, image).get().unwrap()
}

/// Keeps a picture as a file, where `VITRIOL_KEEP_PICTURES` names a folder for it.
pub fn keep(name: &str, [width, height]: [u32; 2], bytes: &[u8], colour: ColorType) {
    if let Some(folder) = std::env::var_os("VITRIOL_KEEP_PICTURES") {
        let file = Path::new(&folder).join(format!("{name}.png"));
        image::save_buffer(file, bytes, width, height, colour).unwrap();
    }
}

/// The same of pixels with alpha, which is left out.
pub fn keep_rgb(name: &str, extent: [u32; 2], pixels: &[[u8; 4]]) {
    let rgb = pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]);
    keep(name, extent, &rgb.collect::<Vec<u8>>(), ColorType::Rgb8);
}

/// Of a session with those hands; `name` is for a picture that is kept. Also the panel as the headset has it.
fn look(gpu: &Gpu, name: &str, hands: [Hand; 2]) -> (Seen, Vec<[u8; 4]>) {
    look_down(gpu, name, hands, 0.0)
}

/// The same with the head bent by so much, degrees.
fn look_down(gpu: &Gpu, name: &str, hands: [Hand; 2], bent: f32) -> (Seen, Vec<[u8; 4]>) {
    let text = TRACK.replace("PITCH", &format!("{:.1}", -bent));
    let track = Keyframes::parse(&text, Path::new("looks.toml"))
        .unwrap()
        .sample_track();
    let looks = Looks { hands };
    let mut headset = Worn::of_extent(gpu, track, EXTENT, (90.0, FRAMES), looks);
    run(&mut headset, |_| ());
    let shown = headset.shown.last().unwrap();
    assert_eq!(shown.panel.map(|(_, width)| width), Some(SIZE[0]));
    let panel = headset.inner.targets.panel.clone().unwrap();
    (Seen::last(gpu, name, &headset), read(gpu, &panel))
}

impl Seen {
    /// Of the last frame that a headset was given; `name` is for a picture that is kept.
    pub fn last<T: Trouble>(gpu: &Gpu, name: &str, headset: &Worn<T>) -> Self {
        let extent = headset.extent();
        let [width, height] = extent;
        let mut pixels = read(gpu, &headset.inner.targets.colour);
        pixels.truncate((width * height) as usize);
        keep_rgb(name, extent, &pixels);
        let alpha: Vec<u8> = pixels.iter().map(|pixel| pixel[3]).collect();
        keep(&format!("{name}-alpha"), extent, &alpha, ColorType::L8);
        let view = headset.shown.last().unwrap().views[0];
        Self {
            extent,
            pixels,
            view,
        }
    }

    /// Whether a ray is before everything else.
    fn has_ray(&self) -> bool {
        let mut pixels = self.pixels.iter();
        pixels.any(|pixel| is_amber(*pixel) && pixel[3] == 255)
    }

    /// Where the eye was in the stage.
    pub fn eye(&self) -> Pose {
        self.view.stage_from_eye
    }

    /// Direction in the eye's frame, of depth 1, to what is seen at a pixel.
    pub fn along(&self, x: u32, y: u32) -> Vec3 {
        let fov = self.view.fov;
        let slope = |from: f32, to: f32, at: u32, of: u32| {
            from.tan() + (to.tan() - from.tan()) * (at as f32 + 0.5) / of as f32
        };
        let [width, height] = self.extent;
        let (across, up) = (
            slope(fov.left, fov.right, x, width),
            slope(fov.up, fov.down, y, height),
        );
        Vec3::new(across, up, -1.0)
    }

    /// The pixel at which a place of the stage is seen, by the view's own angles.
    pub fn at(&self, place: Vec3) -> Option<([u32; 2], [u8; 4])> {
        let at = self.view.stage_from_eye.inverse().transform_point(place);
        let fov = self.view.fov;
        let share = |slope: f32, from: f32, to: f32| (slope - from.tan()) / (to.tan() - from.tan());
        let [width, height] = self.extent;
        let x = share(at.x / -at.z, fov.left, fov.right) * width as f32;
        let y = share(at.y / -at.z, fov.up, fov.down) * height as f32;
        let inside = at.z < 0.0 && x >= 0.0 && y >= 0.0;
        let at = [x as u32, y as u32];
        (inside && at[0] < width && at[1] < height)
            .then(|| (at, self.pixels[(at[1] * width + at[0]) as usize]))
    }
}

/// A place of the panel, from its middle over half its sides, `before` its face (m).
fn on_panel(x: f32, y: f32, before: f32) -> Vec3 {
    scene_from_panel().transform_point(Vec3::new(0.5 * SIZE[0] * x, 0.5 * SIZE[1] * y, before))
}

/// A hand there that points at a place.
fn pointing(from: Vec3, to: Vec3) -> Hand {
    let turn = Quat::from_rotation_arc(Vec3::NEG_Z, (to - from).normalize());
    Hand {
        active: true,
        valid: true,
        stage_from_grip: Pose::new(from, turn),
        stage_from_aim: Pose::new(from, turn),
        ..Hand::default()
    }
}

fn is_amber([r, g, b, _]: [u8; 4]) -> bool {
    r > 180 && g > 90 && b < 140 && r - b > 80
}

/// The panel in the picture says what the headset's own does, and lets that one be seen: with no hand, everywhere.
#[test]
fn the_panel_is_in_the_picture_and_seen_through_it() {
    let gpu = gpu::device();
    let (seen, panel) = look(&gpu, "panel-alone", [Hand::default(), Hand::default()]);
    let light = |level: u8| (f32::from(level) / 255.0).powf(2.2);
    let [mut through, mut off] = [0_u32, 0];
    for y in -19..=19 {
        for x in -19..=19 {
            let place = [0.05 * x as f32, 0.05 * y as f32];
            let (_, pixel) = seen.at(on_panel(place[0], place[1], 0.0)).unwrap();
            assert_eq!(pixel[3], 0, "{place:?}");
            through += 1;
            // A pixel has some of the panel's: its light is between their least and most.
            let at = [
                (0.5 + 0.5 * place[0]) * PANEL[0] as f32,
                (0.5 - 0.5 * place[1]) * PANEL[1] as f32,
            ];
            let near = (-5..=5).flat_map(|dy| (-5..=5).map(move |dx| (dx, dy)));
            let near = near.map(|(dx, dy)| {
                let x = (at[0] as i32 + dx).clamp(0, PANEL[0] as i32 - 1);
                let y = (at[1] as i32 + dy).clamp(0, PANEL[1] as i32 - 1);
                light(panel[(y * PANEL[0] as i32 + x) as usize][1])
            });
            let (least, most) = near.fold((1.0_f32, 0.0_f32), |(a, b), l| (a.min(l), b.max(l)));
            let found = light(pixel[1]);
            off += u32::from(found < least - 0.01 || found > most + 0.01);
        }
    }
    assert_eq!((through, off), (39 * 39, 0));
    assert!(!seen.has_ray(), "nobody points");
}

/// A hand before the panel is seen, and neither the panel nor its layer there. One behind it is not.
#[test]
fn a_hand_before_the_panel_is_seen() {
    let gpu = gpu::device();
    // It points at the ceiling, and its palm is there.
    let place = on_panel(0.3, -0.1, 0.15);
    let mut hand = pointing(place, place + Vec3::Y);
    hand.stage_from_grip.orientation = Quat::IDENTITY;
    let (seen, _) = look(&gpu, "hand-before-panel", [Hand::default(), hand.clone()]);
    let (without, _) = look(&gpu, "panel-alone", [Hand::default(), Hand::default()]);
    let places = [-8, -4, 0, 4, 8].map(|mm| 0.001 * mm as f32);
    let around = places
        .iter()
        .flat_map(|x| places.map(|y| Vec3::new(*x, y, 0.0)));
    let gloves = around.filter(|aside| seen.at(place + *aside).unwrap().1[3] == 255);
    assert!(gloves.count() > 12);
    let covers = |seen: &Seen| {
        let pairs = seen.pixels.iter().zip(&without.pixels);
        let covered = pairs.filter(|(with, without)| with[3] == 255 && without[3] == 0);
        covered.count()
    };
    let covered = covers(&seen);
    // Some 90 by 190 mm at 0.65 m, of 0.72 by 0.56 m at 0.8 m.
    let whole = without.pixels.iter().filter(|pixel| pixel[3] == 0).count();
    let share = covered as f32 / whole as f32;
    assert!((0.03..0.20).contains(&share), "{covered} of {whole}");
    assert!(!seen.has_ray());
    // Behind it a hand hides nothing.
    let place = on_panel(0.3, -0.1, -0.1);
    let turn = hand.stage_from_grip.orientation;
    hand.stage_from_grip = Pose::new(place, turn);
    let (seen, _) = look(&gpu, "hand-behind-panel", [Hand::default(), hand]);
    assert_eq!(covers(&seen), 0);
}

/// Seen by who looks down at the bench, and lit while a hand is at it.
#[test]
fn handles_are_seen_at_the_tables_edge() {
    let gpu = gpu::device();
    let scene = Scene::builtin("two-flasks").unwrap();
    let [left, right] = middles(&scene).unwrap();
    // 10 cm of a bar before the table's edge, at the height of its top.
    assert!((left - Vec3::new(-0.30, 0.735, -0.065)).length() < 1e-6);
    let (seen, _) = look_down(&gpu, "handles", [Hand::default(), Hand::default()], 40.0);
    let bar = |seen: &Seen| {
        let places = [0.0, 0.01, 0.02, 0.03, 0.04].map(|x| left + Vec3::new(x, -0.002, 0.009));
        let pixels = places.map(|place| seen.at(place).unwrap().1);
        // Amber, unlike everything else there.
        assert!(
            pixels.iter().all(|[r, _, b, _]| r.saturating_sub(*b) > 60),
            "{pixels:?}"
        );
        pixels.iter().map(|pixel| u32::from(pixel[1])).sum::<u32>() / 5
    };
    let dark = bar(&seen);
    let (_, off) = seen.at(left + Vec3::new(0.08, 0.0, 0.0)).unwrap();
    assert!(off[0].abs_diff(off[2]) < 30, "{off:?}");
    // From the side, so that it does not hide the bar.
    let at = left + Vec3::new(-0.10, 0.02, 0.0);
    let hand = pointing(at, at + Vec3::X);
    let (seen, _) = look_down(&gpu, "handle-at-hand", [hand, Hand::default()], 40.0);
    let lit = bar(&seen);
    assert!(lit > dark + 10, "{lit} {dark}");
    assert_eq!(right.x, -left.x);
}

mod long {
    use super::*;

    /// The room that is asked for is seen, whatever the scene says: an evening's, of 70 lx, is darker than a day's, of 800 lx.
    #[test]
    fn the_room_that_is_asked_for_is_seen() {
        let gpu = gpu::device();
        let mean = |room: Option<PictureRoom>| {
            let track = pour().sample_track();
            let mut headset = Worn::of_extent(&gpu, track, EXTENT, (90.0, 4), Calm);
            let (outcome, _) = run(&mut headset, |options| options.plan.room = room);
            let drawn = outcome.world.scene().picture.room;
            assert_eq!(drawn, room.unwrap_or(PictureRoom::Bare));
            let name = format!("room-{}", drawn.name());
            let seen = Seen::last(&gpu, &name, &headset);
            let levels = seen.pixels.iter().map(|pixel| u64::from(pixel[1]));
            levels.sum::<u64>() / seen.pixels.len() as u64
        };
        let (day, evening) = (mean(None), mean(Some(PictureRoom::Dark)));
        assert!(10 * evening < 7 * day, "{evening} of {day}");
    }

    /// From the hand to where it points, over whatever is behind it.
    #[test]
    fn a_hand_that_points_at_the_panel_has_a_ray() {
        let gpu = gpu::device();
        let (from, to) = (Vec3::new(0.18, 1.0, -0.25), on_panel(-0.42, 0.13, 0.0));
        let hand = pointing(from, to);
        let (seen, _) = look(&gpu, "ray", [Hand::default(), hand.clone()]);
        let lit = |share: f32| {
            let (_, pixel) = seen.at(from.lerp(to, share)).unwrap();
            is_amber(pixel) && pixel[3] > 200
        };
        let places = (40..98).map(|n| 0.01 * n as f32);
        let count = places.clone().filter(|share| lit(*share)).count();
        // Two pixels wide, it is smoothed where it steps.
        assert!(10 * count >= 9 * places.count(), "{count}");
        // It ends there.
        let beyond = from.lerp(to, 1.1);
        assert!(!is_amber(seen.at(beyond).unwrap().1));
        // A little to the side of the panel there is none.
        let (seen, _) = look(
            &gpu,
            "no-ray",
            [Hand::default(), pointing(from, on_panel(-1.1, 0.2, 0.0))],
        );
        assert!(!seen.has_ray());
    }
}
