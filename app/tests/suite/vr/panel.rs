//! The panel: what it shows, and that a hand can press it.

use crate::vr::common::{Trouble, Worn, heard, pour, run, switched};
use crate::vr::seen::keep;
use glam::{Quat, Vec3};
use image::ColorType;
use vitriol_console::MESSAGE;
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_lesson::Tone;
use vitriol_run::Action;
use vitriol_run::choices;
use vitriol_run::track::key;
use vitriol_session::decision::Decision;
use vitriol_session::info::{Effort, FlaskLine, Happened, Info, Lying, Told};
use vitriol_session::panel::{PANEL, Panel, WIDTH, scene_from_panel};
use vitriol_session::workbench::TAKEN_UP;
use vitriol_shaders::Library;
use vitriol_tests::gpu;
use vitriol_xr::{Hand, HeadsetFrame, Pose};

fn info() -> Info {
    let flask = |name: &str, temperature, acid| FlaskLine {
        broken: false,
        name: name.into(),
        temperature,
        acid,
    };
    Info {
        scene: "water-into-acid".into(),
        title: "Water into acid".into(),
        flasks: vec![
            flask("Beaker with water", Some(20), Some(0)),
            flask("Beaker with 98 % acid", Some(117), Some(71)),
        ],
        acid: true,
        spilt: Lying::of(12.3, 0.4),
        burns: [true, false, true],
        device_lost: true,
        heard: Some("[pouring, simmering: bubbles collapse]".into()),
        slow: Some(60),
        recording: Some(75),
        waits_for_disk: true,
        unwritten: 3,
        missed: 12,
        effort: Some(Effort {
            finer: false,
            solver: [10, 2],
            asked: [10, 3],
            picture: 85,
            foveated: true,
            other_filter: false,
            rate: Some(72),
        }),
        coming: Some("acid-into-water".into()),
        holding: Some(65),
        key_held: None,
        pouring: None,
        ends: true,
        pointer: false,
        happened: None,
        told: Told::default(),
        lesson: None,
    }
}

fn picture(gpu: &Gpu, panel: &mut Panel) -> Vec<u8> {
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    panel.record(&mut rec).unwrap();
    let read = rec.read_back_image(&panel.image).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    read.get().unwrap()
}

/// A place of the panel, given in pixels.
pub fn on_panel([x, y]: [f32; 2]) -> Vec3 {
    let pixel = WIDTH / PANEL[0] as f32;
    scene_from_panel().transform_point(Vec3::new(
        (x - 0.5 * PANEL[0] as f32) * pixel,
        (0.5 * PANEL[1] as f32 - y) * pixel,
        0.0,
    ))
}

/// A hand half a metre before the panel that points at a pixel of it.
fn pointing(x: f32, y: f32, trigger: f32) -> Hand {
    let from = scene_from_panel().transform_point(Vec3::new(0.1, -0.2, 0.5));
    pointing_from(from, [x, y], trigger)
}

/// The same of a hand at a place of the scene's stage.
fn pointing_from(from: Vec3, at: [f32; 2], trigger: f32) -> Hand {
    let target = on_panel(at);
    let turn = Quat::from_rotation_arc(Vec3::NEG_Z, (target - from).normalize());
    Hand {
        active: true,
        valid: true,
        stage_from_aim: Pose::new(from, turn),
        trigger,
        ..Hand::default()
    }
}

/// Points somewhere, pulls the trigger for so long (s) and lets it go; what that decided.
fn press(panel: &mut Panel, at: [f32; 2], seconds: f64) -> Option<Decision> {
    let from = scene_from_panel().transform_point(Vec3::new(0.1, -0.2, 0.5));
    press_from(panel, from, at, seconds)
}

/// The same of a hand at a place of the scene's stage.
pub fn press_from(panel: &mut Panel, from: Vec3, at: [f32; 2], seconds: f64) -> Option<Decision> {
    press_in(panel, &info(), from, at, seconds)
}

/// The same of a panel that shows `info`.
fn press_in(
    panel: &mut Panel,
    info: &Info,
    from: Vec3,
    at: [f32; 2],
    seconds: f64,
) -> Option<Decision> {
    let mut decided = None;
    // Ten frames a second.
    let pulled = (10.0 * seconds) as i64;
    for frame in -2..pulled + 2 {
        let trigger = if (0..pulled).contains(&frame) {
            1.0
        } else {
            0.0
        };
        let hand = pointing_from(from, at, trigger);
        let now = 100_000_000 * frame;
        let said = panel.update([None, Some(&hand)], info, now);
        assert!(decided.is_none() || said.is_none(), "pressed twice");
        decided = decided.or(said);
    }
    decided
}

/// Where the middles of the scenes' three columns are, share of the panel's width. Other buttons reach over all of them.
const COLUMNS: [f32; 3] = [0.58, 0.74, 0.90];

/// Places over the right half of the panel, pixels: row by row, so many pixels apart.
fn places(step: usize) -> impl Iterator<Item = [f32; 2]> {
    let rows = (30..PANEL[1]).step_by(step);
    rows.flat_map(|y| COLUMNS.map(|x| [x * PANEL[0] as f32, y as f32]))
}

/// What is decided over the right half, each once and in order, by a trigger that is pulled for so long.
fn down_the_buttons(panel: &mut Panel, seconds: f64) -> Vec<Decision> {
    panel.update([None, None], &info(), 0);
    let mut decided = Vec::new();
    for at in places(12) {
        if let Some(decision) = press(panel, at, seconds)
            && !decided.contains(&decision)
        {
            decided.push(decision);
        }
    }
    decided
}

/// What the panel's buttons decide, from above.
pub fn decisions() -> Vec<Decision> {
    let scenes =
        choices::on_panel().map(|choice| Decision::Act(Action::Scene(choice.scene.into())));
    let others = [
        Decision::Act(Action::Start(None)),
        Decision::Toggle,
        Decision::Recentre,
        Decision::Summary,
    ];
    scenes.chain(others).collect()
}

#[test]
fn each_choice_can_be_pressed() {
    let gpu = gpu::device();
    let mut panel = Panel::new(&gpu, &Library::embedded()).unwrap();
    // What would lose the user's work takes a second.
    assert_eq!(down_the_buttons(&mut panel, 1.2), decisions());
    let at_once = [Decision::Recentre, Decision::Summary];
    assert_eq!(down_the_buttons(&mut panel, 0.8), at_once);
    // A trigger that is pulled before the hand comes in presses nothing.
    for (now, x) in (0..).zip([2000.0, 768.0, 768.0]) {
        let hand = pointing(x, 60.0, 1.0);
        let now = 1_000_000_000 * now;
        assert_eq!(panel.update([Some(&hand), None], &info(), now), None);
    }
    let hand = pointing(768.0, 60.0, 0.0);
    assert_eq!(
        panel.update([Some(&hand), None], &info(), 4_000_000_000),
        None
    );
}

/// A hold that leaves its button, or is broken, is none.
#[test]
fn a_hold_is_of_one_button() {
    let gpu = gpu::device();
    let mut panel = Panel::new(&gpu, &Library::embedded()).unwrap();
    let x = 0.75 * PANEL[0] as f32;
    panel.update([None, None], &info(), 0);
    for (tenth, (y, trigger)) in (0..).zip([
        (120.0, 0.0),
        (120.0, 1.0),
        (120.0, 1.0),
        (270.0, 1.0),
        (270.0, 1.0),
        (270.0, 1.0),
    ]) {
        let hand = pointing(x, y, trigger);
        let now = 400_000_000 * tenth;
        assert_eq!(panel.update([None, Some(&hand)], &info(), now), None);
    }
}

/// Of two hands that point, the one that pulled its trigger last presses.
#[test]
fn the_last_trigger_decides_whose_hand_points() {
    let gpu = gpu::device();
    let mut panel = Panel::new(&gpu, &Library::embedded()).unwrap();
    let x = 0.75 * PANEL[0] as f32;
    let rows: Vec<f32> = (30..PANEL[1]).step_by(6).map(|y| y as f32).collect();
    panel.update([None, None], &info(), 0);
    let recentre = rows
        .into_iter()
        .find(|&y| press(&mut panel, [x, y], 0.3) == Some(Decision::Recentre));
    let y = recentre.unwrap() + 15.0;
    let mut frame = |now: i64, left: f32, right: f32| {
        let hands = [pointing(x, y, left), pointing(300.0, 300.0, right)];
        panel.update(
            [Some(&hands[0]), Some(&hands[1])],
            &info(),
            100_000_000 * now,
        )
    };
    // The right one points first; the left one, on the button, takes over by pulling its trigger.
    assert_eq!(frame(0, 0.0, 0.0), None);
    let decided: Vec<_> = (1..)
        .zip([1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0])
        .filter_map(|(now, left)| frame(now, left, 0.0))
        .collect();
    assert_eq!(decided.last(), Some(&Decision::Recentre));
    // And keeps it until the right one pulls.
    assert_eq!(frame(20, 0.0, 1.0), None);
    let decided: Vec<_> = (21..)
        .zip([1.0, 0.0, 1.0, 0.0])
        .filter_map(|(now, right)| frame(now, 0.0, right))
        .collect();
    assert_eq!(decided, []);
}

/// What short presses decide down the panel at that share of its width, each with its row.
fn pressed_down(panel: &mut Panel, info: &Info, share: f32) -> Vec<(u32, Decision)> {
    let mut pressed = Vec::new();
    let [width, height] = PANEL;
    for y in (0..height).step_by(16) {
        let begun = i64::from(y) * 1_000_000_000;
        for (n, trigger) in (0..).zip([0.0, 0.0, 1.0, 0.0]) {
            let hand = pointing(share * width as f32, y as f32, trigger);
            let decided = panel.update([None, Some(&hand)], info, begun + 100_000_000 * n);
            pressed.extend(decided.map(|it| (y, it)));
        }
        panel.update([None, None], info, begun + 900_000_000);
    }
    pressed
}

/// The longest message is whole above everything else, and the lowest button is still on the panel.
#[test]
fn what_an_instructor_says_is_over_all_and_hides_no_button() {
    let gpu = gpu::device();
    let mut panel = Panel::new(&gpu, &Library::embedded()).unwrap();
    let said = "Put the flask down, step back from the bench, and look at the thermometer: ";
    let said: String = said.chars().cycle().take(MESSAGE).collect();
    let info = Info {
        told: Told {
            paused: Some("Paused by your instructor".into()),
            done: None,
            message: Some(format!("Your instructor: {said}")),
        },
        holding: None,
        ..info()
    };
    let pressed = pressed_down(&mut panel, &info, 0.75);
    let rows: Vec<u32> = (pressed.iter())
        .filter_map(|(y, it)| (*it == Decision::Summary).then_some(*y))
        .collect();
    assert!(
        rows.len() >= 2 && rows.iter().all(|y| *y < PANEL[1] - 22),
        "{pressed:?}"
    );
    let shown = picture(&gpu, &mut panel);
    keep("told", PANEL, &shown, ColorType::Rgba8);
    // The strip has a ground of its own, down to where the rest begins: five lines of at least 30 pixels.
    let ground = &shown[..4];
    let strip = shown.chunks_exact(4 * PANEL[0] as usize);
    let strip = strip.take_while(|row| row[..4] == *ground).count();
    assert!((150..260).contains(&strip), "{strip} rows");
}

/// As much as is ever said fits, the button that ends it is under it and can be pressed, and nothing else can.
#[test]
fn what_happened_fits_the_panel() {
    let gpu = gpu::device();
    let mut panel = Panel::new(&gpu, &Library::embedded()).unwrap();
    let sentence =
        "Water was poured into 98 % acid, the wrong order: 20 mL in 0.53 s, at most 40 mL/s.";
    let tones = [Tone::Bad, Tone::Good, Tone::Plain];
    let mut said: Vec<_> = (0..7)
        .map(|n| (tones[n % 3], sentence.to_owned()))
        .collect();
    said.push((Tone::Plain, "At the end: 178 mL, at 56 °C.".into()));
    let info = Info {
        happened: Some(Happened {
            title: "What happened".into(),
            points: Some("45 of 100 points".into()),
            said,
            more: Some("3 more in the report".into()),
            back: "Back".into(),
        }),
        holding: None,
        ..info()
    };
    let [width, height] = PANEL;
    let pressed = pressed_down(&mut panel, &info, 0.2);
    let rows: Vec<u32> = pressed.iter().map(|(y, _)| *y).collect();
    assert!(
        pressed.iter().all(|(_, it)| *it == Decision::Summary),
        "{pressed:?}"
    );
    // All of the button is on the panel: 46 pixels, and a margin of 22.
    assert!(
        rows.len() >= 2 && rows.iter().all(|y| *y < height - 22),
        "{rows:?}"
    );
    let shown = picture(&gpu, &mut panel);
    keep("what-happened", PANEL, &shown, ColorType::Rgba8);
    // Nothing runs over the margin.
    let ground = &shown[..4];
    for row in shown.chunks_exact(4 * width as usize) {
        let margin = row[4 * (width as usize - 20)..].chunks_exact(4);
        assert!(margin.into_iter().all(|pixel| pixel == ground));
    }
}

#[test]
fn the_panel_is_legible() {
    let gpu = gpu::device();
    let mut panel = Panel::new(&gpu, &Library::embedded()).unwrap();
    let hand = pointing(700.0, 150.0, 0.0);
    panel.update([None, Some(&hand)], &info(), 0);
    let shown = picture(&gpu, &mut panel);
    keep("panel", PANEL, &shown, ColorType::Rgba8);
    let luminance = |pixel: &[u8]| {
        let linear = |byte: u8| (f32::from(byte) / 255.0).powf(2.2);
        0.2126 * linear(pixel[0]) + 0.7152 * linear(pixel[1]) + 0.0722 * linear(pixel[2])
    };
    let all: Vec<f32> = shown.chunks_exact(4).map(luminance).collect();
    let dark = all.iter().filter(|&&l| l < 0.02).count() as f32 / all.len() as f32;
    let bright = all.iter().filter(|&&l| l > 0.6).count() as f32 / all.len() as f32;
    // Light text on dark ground, by more than WCAG's 7 : 1; a twentieth of a page is ink.
    assert!(dark > 0.4, "{dark}");
    assert!((0.01..0.2).contains(&bright), "{bright}");
    // Nothing has changed: nothing is drawn.
    let before = shown;
    panel.update([None, Some(&hand)], &info(), 0);
    assert_eq!(picture(&gpu, &mut panel), before);
}

/// A place within the button that decides this, pixels, found by pressing.
pub fn place_of(gpu: &Gpu, decision: &Decision) -> [f32; 2] {
    place_in(gpu, &info(), decision)
}

/// The same on the panel of who has mouse and keyboard.
#[cfg(target_os = "linux")]
pub fn place_at_desk(gpu: &Gpu, decision: &Decision) -> [f32; 2] {
    let info = Info {
        pointer: true,
        ..info()
    };
    place_in(gpu, &info, decision)
}

fn place_in(gpu: &Gpu, info: &Info, decision: &Decision) -> [f32; 2] {
    let mut panel = Panel::new(gpu, &Library::embedded()).unwrap();
    let from = scene_from_panel().transform_point(Vec3::new(0.1, -0.2, 0.5));
    panel.update([None, None], info, 0);
    let found =
        places(6).find(|&at| press_in(&mut panel, info, from, at, 1.2).as_ref() == Some(decision));
    // Not at its edge.
    let [x, y] = found.unwrap();
    [x, y + 15.0]
}

/// Points at a button of the panel, and presses it.
struct Points {
    at: [f32; 2],
}

impl Trouble for Points {
    fn awaits(&self, after: u64) -> bool {
        after == 115 && heard(TAKEN_UP) == 0
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        // 1.1 s at 90 Hz.
        let trigger = if (8..108).contains(&after) { 1.0 } else { 0.0 };
        frame.poses.hands[0] = pointing(self.at[0], self.at[1], trigger);
    }
}

/// From the ray to the switch in the recording. The head of the track makes the stage the scene's.
#[test]
fn a_hand_presses_the_panel_in_a_session() {
    let gpu = gpu::device();
    let trouble = Points {
        at: place_of(&gpu, &Decision::Act(Action::Start(None))),
    };
    let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, 120, trouble);
    let (_, track) = run(&mut headset, |_| ());
    assert_eq!(switched(&track, key::START), 1);
}
