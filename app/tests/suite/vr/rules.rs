//! The rules of OpenXR's best-practice layer that the frame loop answers for: between a frame's begin
//! and its end nothing waits for the device, and a picture is submitted with the pose that it was
//! drawn with. (That it is submitted for the time that the runtime named is the session's, in `xr`.)

use std::sync::mpsc::{Sender, channel};

use crate::vr::common::{
    Calm, Trouble, Worn, heard, hearing, left_to, options, pour, run, session, switched,
};
use glam::{Quat, Vec2, Vec3};
use vitriol_gpu::Gpu;
use vitriol_render::SceneDesc;
use vitriol_run::Action;
use vitriol_run::track::key;
use vitriol_session::decision::Decision;
use vitriol_session::foveating::Foveating;
use vitriol_session::panel::{PANEL, WIDTH, scene_from_panel};
use vitriol_session::picture::Eyes;
use vitriol_session::stand_in::StandIn;
use vitriol_session::workbench::{TAKEN_UP, Workbench};
use vitriol_shaders::Library;
use vitriol_sim::scene::Scene;
use vitriol_tests::gpu;
use vitriol_xr::{Headset, HeadsetError, Inset, Pose, Shown, Targets, Turn, View};

/// Waits for the device so far.
fn waits() -> u64 {
    heard("vitriol_gpu::wait")
}

/// Another pose in each frame than the one that the frame began with, turned so far that a wall at
/// the side is seen, by which a shift to that side shows.
fn disturbed(frame: u64) -> Pose {
    let n = frame as f32;
    let turn = Quat::from_rotation_y(0.60 + 0.002 * n) * Quat::from_rotation_x(0.06);
    Pose::new(
        Vec3::new(0.05, 0.03 + 0.001 * n, 0.04),
        turn * Quat::from_rotation_z(-0.08),
    )
}

/// A stand-in that keeps a book of its frames.
struct Strict<T> {
    inner: Worn<T>,
    frames: u64,
    located: Option<[View; 2]>,
    /// Waits when the frame that is open began.
    begun: Option<u64>,
    /// Waits while a frame was open.
    within: u64,
}

impl<T: Trouble> Strict<T> {
    fn new(gpu: &Gpu, frames: u64, trouble: T) -> Self {
        Self {
            inner: Worn::new(gpu, pour().sample_track(), 90.0, frames, trouble),
            frames: 0,
            located: None,
            begun: None,
            within: 0,
        }
    }
}

/// Begins the scene anew on the way.
struct Starts(Sender<Decision>);

impl Trouble for Starts {
    fn turn(&mut self, _: &mut StandIn, after: u64) -> Option<Turn> {
        if after == 10 {
            self.0.send(Decision::Act(Action::Start(None))).unwrap();
        }
        None
    }

    fn awaits(&self, after: u64) -> bool {
        after == 12 && heard(TAKEN_UP) == 0
    }
}

impl<T: Trouble> Headset for Strict<T> {
    left_to!(inner);

    fn inset(&self) -> Option<Inset> {
        self.inner.inset()
    }
    fn hidden_area(&self) -> [Vec<[f32; 2]>; 2] {
        [Vec::new(), Vec::new()]
    }
    fn next(&mut self) -> Result<Turn, HeadsetError> {
        let turn = self.inner.next()?;
        self.frames += 1;
        assert_eq!(self.begun, None, "a frame was not ended");
        self.begun = matches!(turn, Turn::Frame(_)).then(waits);
        Ok(turn)
    }
    fn acquire(&mut self, panel: bool) -> Result<Option<Targets>, HeadsetError> {
        self.inner.acquire(panel)
    }
    fn locate_views(&mut self) -> Result<[View; 2], HeadsetError> {
        let away = disturbed(self.frames);
        let mut views = self.inner.locate_views()?;
        for view in &mut views {
            view.stage_from_eye = view.stage_from_eye.compose(&away);
        }
        self.located = Some(views);
        Ok(views)
    }
    fn end(&mut self, shown: Option<&Shown>) -> Result<(), HeadsetError> {
        self.within += waits() - self.begun.take().unwrap();
        // What is submitted is what was located, this frame.
        let located = self.located.take();
        assert_eq!(shown.map(|shown| shown.views), located);
        self.inner.end(shown)
    }
}

#[test]
fn nothing_waits_for_the_device_within_a_frame() {
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let (sender, decisions) = channel();
    // A bench is built and moved to on the way.
    let mut headset = Strict::new(&gpu, 60, Starts(sender));
    let (_, track) = session(&mut headset, folder.path(), decisions);
    assert!(switched(&track, key::START) > 0);
    // Between frames it waits for the picture before the last, in all frames but the first ones.
    let waited = waits() - headset.within;
    assert!(waited > 50, "{waited} waits were heard of");
    assert_eq!(headset.within, 0);
}

/// A bench is built beside the frames of the one before it, and each of its waits takes as long as the pictures under way: on a software
/// driver a second and more. So it waits once for its world and once for its picture, and its like has no pipeline to compile.
#[test]
fn a_bench_waits_twice_for_the_device_and_its_like_compiles_nothing() {
    // Other tests hold pipelines of the process's device.
    let gpu = gpu::another_device(|_| {});
    let folder = tempfile::tempdir().unwrap();
    let plan = options(folder.path()).plan;
    let library = Library::embedded();
    let eyes = Eyes {
        views: 2,
        extent: [64, 64],
        inset: None,
        hidden: [Vec::new(), Vec::new()],
        foveating: Some(Foveating::Off),
    };
    let build = || hearing(|| Workbench::new(&gpu, &library, &plan, &eyes).unwrap());
    let compiled = || heard("vitriol_gpu::compile");
    let _first = build();
    assert_eq!(waits(), 2);
    assert!(compiled() > 20, "{} were heard of", compiled());
    let _second = build();
    assert_eq!((waits(), compiled()), (2, 0));
}

#[test]
fn a_picture_is_submitted_with_the_pose_that_it_was_drawn_with() {
    let gpu = gpu::device();
    let mut headset = Strict::new(&gpu, 5, Calm);
    run(&mut headset, |_| ());
    let shown = *headset.inner.shown.last().unwrap();
    let depth = headset.inner.inner.targets.depth.as_ref().unwrap();
    let depth: Vec<f32> = gpu::read_back(&gpu, depth).get().unwrap();

    // Each depth is of a point in the room. Seen from where the picture is said to be taken it lies
    // on a face of the room or of the table, but for liquid and hands, which are small.
    let (panel, _) = shown.panel.unwrap();
    let stage_from_scene = panel.compose(&scene_from_panel().inverse());
    let table = Scene::builtin("two-flasks").unwrap().table.unwrap();
    let room = SceneDesc::laboratory(Vec::new(), table.top as f32, 1.0);
    let room = room.room.unwrap();
    let [across, deep] = table.size.map(|side| 0.5 * side as f32);
    let middle = Vec3::new(table.centre[0] as f32, 0.0, table.centre[1] as f32);
    // Across which axis the face lies, if it is on one.
    let face = |p: Vec3| {
        const NEAR: f32 = 2e-3;
        let from = (p - middle).abs();
        let above = from.x < across + NEAR && from.z < deep + NEAR;
        if above && (p.y - table.top as f32).abs() < NEAR {
            return Some(1);
        }
        (0..3).find(|&axis| {
            (p[axis] - room.min[axis]).abs() < NEAR || (p[axis] - room.max[axis]).abs() < NEAR
        })
    };
    // The panel is in the picture too.
    let on_panel = |p: Vec3| {
        let p = scene_from_panel().inverse().transform_point(p);
        let half = 0.5 * Vec2::new(WIDTH, WIDTH * PANEL[1] as f32 / PANEL[0] as f32);
        p.z.abs() < 2e-3 && p.x.abs() < half.x && p.y.abs() < half.y
    };
    // Each is that of the nearest of two by two pixels, of which it is not said which.
    let [width, height] = headset.extent().map(|side| side as usize);
    for (eye, view) in shown.views.iter().enumerate() {
        let scene_from_eye = stage_from_scene.inverse().compose(&view.stage_from_eye);
        let (mut on, mut panel) = ([0; 3], 0);
        for (index, reversed) in depth
            .chunks(width * height / 4)
            .nth(eye)
            .unwrap()
            .iter()
            .enumerate()
        {
            let part = |at: usize, of: usize, low: f32, high: f32| {
                let s = (at as f32 + 0.5) / of as f32;
                low.tan() + s * (high.tan() - low.tan())
            };
            let way = shown.near / reversed;
            let four = [[0, 0], [1, 0], [0, 1], [1, 1]];
            let points = four.map(|[right, down]| {
                let column = 2 * (index % (width / 2)) + right;
                let row = 2 * (index / (width / 2)) + down;
                let x = part(column, width, view.fov.left, view.fov.right);
                let y = part(row, height, view.fov.up, view.fov.down);
                scene_from_eye.transform_point(way * Vec3::new(x, y, -1.0))
            });
            if let Some(axis) = points.iter().find_map(|point| face(*point)) {
                on[axis] += 1;
            } else if points.iter().any(|point| on_panel(*point)) {
                panel += 1;
            }
        }
        // The table's edges, and what stands on it, are the rest. Of each direction there is enough
        // to be seen that a shift along it is.
        let all = width * height / 4;
        let seen = panel + on.iter().sum::<usize>();
        assert!(seen > all * 9 / 10, "eye {eye}: {on:?} {panel}");
        assert!(panel > all / 40, "eye {eye}: {panel}");
        assert!(on.iter().all(|on| *on > all / 20), "eye {eye}: {on:?}");
    }
}
