//! The panel: what it shows, and that a hand can press it.

use std::sync::mpsc::channel;

use crate::common::{Trouble, Worn, heard, pour, session};
use glam::{Quat, Vec3};
use vitriol::vr::decision::Decision;
use vitriol::vr::info::{Effort, FlaskLine, Info};
use vitriol::vr::menu::CHOICES;
use vitriol::vr::panel::{PANEL, Panel, WIDTH, scene_from_panel};
use vitriol::vr::workbench::TAKEN_UP;
use vitriol_experiment::switches::SWITCH_START;
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_shaders::Library;
use vitriol_tests::gpu;
use vitriol_xr::{Hand, HeadsetFrame, Pose};

fn info() -> Info {
    let flask = |name: &str, temperature, acid| FlaskLine {
        name: name.into(),
        temperature,
        acid,
    };
    Info {
        scene: "water-into-acid".into(),
        flasks: vec![
            flask("source", Some(20), Some(0)),
            flask("target", Some(117), Some(71)),
        ],
        acid: true,
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
            other_filter: false,
        }),
        coming: Some("acid-into-water".into()),
    }
}

fn picture(gpu: &Gpu, panel: &mut Panel) -> Vec<u8> {
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    panel.record(&mut rec).unwrap();
    let read = rec.read_back_image(&panel.image).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    read.get().unwrap()
}

/// A hand half a metre before the panel that points at a pixel of it.
fn pointing(x: f32, y: f32, trigger: f32) -> Hand {
    let metres = WIDTH / PANEL[0] as f32;
    let at = Vec3::new(
        (x - 0.5 * PANEL[0] as f32) * metres,
        (0.5 * PANEL[1] as f32 - y) * metres,
        0.0,
    );
    let target = scene_from_panel().transform_point(at);
    let from = scene_from_panel().transform_point(Vec3::new(0.1, -0.2, 0.5));
    let turn = Quat::from_rotation_arc(Vec3::NEG_Z, (target - from).normalize());
    Hand {
        active: true,
        valid: true,
        stage_from_aim: Pose::new(from, turn),
        trigger,
        ..Hand::default()
    }
}

/// Points somewhere, pulls the trigger and lets it go; what that decided.
fn press(panel: &mut Panel, x: f32, y: f32) -> Option<Decision> {
    let mut decided = None;
    for trigger in [0.0, 0.0, 1.0, 1.0, 0.0, 0.0] {
        let hand = pointing(x, y, trigger);
        let said = panel.update([None, Some(&hand)], &info());
        assert!(decided.is_none() || said.is_none(), "pressed twice");
        decided = decided.or(said);
    }
    decided
}

#[test]
fn each_choice_can_be_pressed() {
    let gpu = gpu::device();
    let mut panel = Panel::new(&gpu, &Library::embedded()).unwrap();
    panel.update([None, None], &info());
    // Down the middle of the right half: every decision once, in order.
    let mut decided = Vec::new();
    for y in (30..PANEL[1]).step_by(12) {
        if let Some(decision) = press(&mut panel, 0.75 * PANEL[0] as f32, y as f32)
            && decided.last() != Some(&decision)
        {
            decided.push(decision);
        }
    }
    let scenes = CHOICES.map(|choice| Decision::Scene(choice.scene.into()));
    let all = [&scenes[..], &[Decision::Start, Decision::Recentre]].concat();
    assert_eq!(decided, all);
    // A trigger that is pulled before the hand comes in presses nothing.
    for x in [2000.0, 768.0, 768.0] {
        let hand = pointing(x, 60.0, 1.0);
        assert_eq!(panel.update([Some(&hand), None], &info()), None);
    }
    let hand = pointing(768.0, 60.0, 0.0);
    assert_eq!(panel.update([Some(&hand), None], &info()), None);
}

#[test]
fn the_panel_is_legible() {
    let gpu = gpu::device();
    let mut panel = Panel::new(&gpu, &Library::embedded()).unwrap();
    let hand = pointing(700.0, 150.0, 0.0);
    panel.update([None, Some(&hand)], &info());
    let shown = picture(&gpu, &mut panel);
    if let Some(keep) = std::env::var_os("VITRIOL_KEEP_PICTURES") {
        let file = std::path::Path::new(&keep).join("panel.png");
        let [width, height] = PANEL;
        image::save_buffer(file, &shown, width, height, image::ColorType::Rgba8).unwrap();
    }
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
    panel.update([None, Some(&hand)], &info());
    assert_eq!(picture(&gpu, &mut panel), before);
}

/// Points at a button of the panel, and presses it.
struct Points {
    at: [f32; 2],
}

impl Trouble for Points {
    fn awaits(&self, after: u64) -> bool {
        after == 20 && heard(TAKEN_UP) == 0
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        let trigger = if (8..12).contains(&after) { 1.0 } else { 0.0 };
        frame.poses.hands[0] = pointing(self.at[0], self.at[1], trigger);
    }
}

/// From the ray to the switch in the recording. The head of the track makes the stage the scene's.
#[test]
fn a_hand_presses_the_panel_in_a_session() {
    let gpu = gpu::device();
    // Where the button is, found as above.
    let mut panel = Panel::new(&gpu, &Library::embedded()).unwrap();
    panel.update([None, None], &info());
    let x = 0.75 * PANEL[0] as f32;
    let mut rows = (30..PANEL[1]).step_by(6).map(|y| y as f32);
    let y = rows.find(|&y| press(&mut panel, x, y) == Some(Decision::Start));
    let trouble = Points {
        // Within the button, not at its edge.
        at: [x, y.unwrap() + 15.0],
    };
    let folder = tempfile::tempdir().unwrap();
    let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, 24, trouble);
    let (_, track) = session(&mut headset, folder.path(), channel().1);
    let switches = track.frames.iter().flat_map(|frame| &frame.scenario);
    let starts = switches.filter(|switch| switch.key == SWITCH_START).count();
    assert_eq!(starts, 1);
}
