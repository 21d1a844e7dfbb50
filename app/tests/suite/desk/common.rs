//! A session at a screen, and a user who sees its frames and acts by XTEST.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::mpsc::channel;
use std::time::Duration;

use crate::desk::seen::{SOURCE, Seen, level};
use crate::vr::common::{hearing, left_to, options, recording};
use glam::Vec3;
use vitriol_gpu::Gpu;
use vitriol_session::clock::MOST_STEPS;
use vitriol_session::desk::{self, Desk, DeskSpec, FOV};
use vitriol_session::session::{Options, Session, SessionOutcome};
use vitriol_tests::gpu::{self, Watched};
use vitriol_tests::screen::{self, Button, Screen, Window, key};
use vitriol_xr::track::Track;
use vitriol_xr::{
    Around, Headset, HeadsetError, Inset, Line, Pointed, PoseFrame, Shown, Side, Targets, Turn,
    View,
};

/// Width and height of the window when it opens, pixels: few, so that a software driver is fast.
pub const SIZE: [u32; 2] = [320, 240];

/// Most frames of one step: 25 s on a display of 60 Hz, and several times what any step takes.
const MOST_FRAMES: u64 = 1500;
/// Length of the scene's steps, s.
const STEP: f64 = 1.0 / 90.0;
/// What is held moves less than this (m) between two frames while it stands still, and has stood for so many frames.
const STILL: f32 = 5e-4;
const RESTS: u32 = 5;
/// Share of what is left to go by which the pointer is moved once more.
const CORRECTS: f32 = 0.6;
/// From this distance on (m) arrow keys are held; below they are pressed for a frame at a time, at a quarter of the speed.
const FAR: f32 = 0.08;
/// Time in which the window's thread has usually got what was sent, so that the next frame has it. Nothing depends on it.
const ARRIVES: Duration = Duration::from_millis(20);

/// What moves the hands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    Mouse,
    Keys,
}

/// Who sits at the screen.
pub struct User {
    pub screen: Screen,
    pub window: Window,
    by: By,
    /// Keys that are down.
    down: BTreeSet<u32>,
    /// Something was sent since the last frame.
    acted: bool,
    /// Where the pointer was moved to last, pixels of the window.
    pub pointer: [i32; 2],
    /// The point of the stage at which it points.
    aim: Vec3,
    /// Where what is being moved was in the last frame, and for how many frames it has stood there.
    last: Option<Vec3>,
    still: u32,
    /// Where hands or a flask were at some time.
    pub noted: [Vec3; 2],
    /// Where the source stood at first.
    pub home: Option<Vec3>,
}

impl User {
    fn new(screen: Screen, by: By) -> Self {
        let window = screen.wait_for("Vitriol");
        screen.focus(window);
        Self {
            screen,
            window,
            by,
            down: BTreeSet::new(),
            acted: false,
            pointer: [0; 2],
            aim: Vec3::ZERO,
            last: None,
            still: 0,
            noted: [Vec3::ZERO; 2],
            home: None,
        }
    }

    /// Keeps the key of that symbol down, or up.
    pub fn hold(&mut self, symbol: u32, down: bool) {
        let changes = match down {
            true => self.down.insert(symbol),
            false => self.down.remove(&symbol),
        };
        if changes {
            self.screen.key(symbol, down);
            self.acted = true;
        }
    }

    pub fn tap(&mut self, symbol: u32) {
        self.screen.tap(symbol);
        self.acted = true;
    }

    pub fn button(&mut self, button: Button, down: bool) {
        self.screen.button(button, down);
        self.acted = true;
    }

    pub fn wheel(&mut self, notches: i32) {
        self.screen.wheel(notches);
        self.acted = true;
    }

    /// Moves the pointer to a place of the window, pixels.
    pub fn point(&mut self, at: [i32; 2]) {
        self.pointer = at;
        self.screen.point(self.window, at);
        self.acted = true;
    }

    /// Moves the pointer to where a point of the stage is seen.
    pub fn point_at(&mut self, seen: &Seen<'_>, point: Vec3) {
        self.aim = point;
        let (place, extent) = (seen.place(point), self.screen.extent(self.window));
        let at = [0, 1].map(|side| {
            // Inside the window, as a pointer on a screen that it fills.
            let most = extent[side] as f32 - 2.0;
            (place[side] * extent[side] as f32).clamp(1.0, most) as i32
        });
        self.point(at);
    }

    /// Tilts what is held by dragging the pointer to the right by so many pixels with the secondary button, or to the left where they are
    /// negative. The pointer is then where it was, and so is the hand.
    pub fn tilts(&mut self, pixels: i32) {
        let [x, y] = self.pointer;
        self.button(Button::Secondary, true);
        self.point([x + pixels, y]);
        self.button(Button::Secondary, false);
        self.point([x, y]);
    }

    /// Presses and releases the main button.
    pub fn click(&mut self) {
        self.button(Button::Main, true);
        self.button(Button::Main, false);
    }

    /// Takes hold of what the hand is at, or lets it go, as one does by mouse or by keys.
    pub fn grip(&mut self, closes: bool) {
        match self.by {
            By::Mouse => self.button(Button::Main, closes),
            By::Keys => self.tap(key::SPACE),
        }
    }

    /// Moves what is at `from` along the table towards `to`, as who looks at it does: a large movement at the step's `first` frame, and
    /// smaller ones where it has come to rest elsewhere. Returns whether it stands there within `tolerance` (m).
    pub fn brings(
        &mut self,
        seen: &Seen<'_>,
        (from, to): (Vec3, Vec3),
        tolerance: f32,
        first: bool,
    ) -> bool {
        let error = level(to - from);
        let misses = error.length() > tolerance;
        let stands = self.last.is_some_and(|last| last.distance(from) < STILL);
        self.last = Some(from);
        self.still = if stands { self.still + 1 } else { 0 };
        let there = !misses && self.still >= 2;
        let moves = first || (misses && self.still >= RESTS);
        if moves {
            self.still = 0;
        }
        match self.by {
            By::Mouse if moves => {
                let share = if first { 1.0 } else { CORRECTS };
                self.point_at(seen, self.aim + share * error);
            }
            By::Mouse => {}
            By::Keys => self.walk(error, tolerance, moves),
        }
        there
    }

    /// Holds the arrow keys towards `error` while it is far, else in a frame in which it `moves`.
    fn walk(&mut self, error: Vec3, tolerance: f32, moves: bool) {
        let far = error.length() > FAR;
        self.hold(key::SHIFT, !far);
        for (symbol, along) in [
            (key::RIGHT, error.x),
            (key::LEFT, -error.x),
            (key::DOWN, error.z),
            (key::UP, -error.z),
        ] {
            self.hold(symbol, (far || moves) && along > 0.5 * tolerance);
        }
    }

    /// Lets all keys up.
    pub fn keys_up(&mut self) {
        for symbol in self.down.clone() {
            self.hold(symbol, false);
        }
    }
}

/// A step of a user, called after each frame with the count of frames since the step began; returns whether it is done.
type Step = Box<dyn FnMut(&mut User, &Seen<'_>, u64) -> bool>;

/// What a user does, step by step.
#[derive(Default)]
pub struct Script(Vec<(&'static str, Step)>);

impl Script {
    pub fn then(
        mut self,
        name: &'static str,
        step: impl FnMut(&mut User, &Seen<'_>, u64) -> bool + 'static,
    ) -> Self {
        self.0.push((name, Box::new(step)));
        self
    }
}

/// A desk with its user, who ends the session after the last step.
struct Used {
    desk: Desk,
    user: User,
    steps: Vec<(&'static str, Step)>,
    /// The step that is being done, and frames since it began.
    at: usize,
    frames: u64,
    /// About the simulated time so far, and at the step's beginning, s.
    simulated: f64,
    begun: f64,
    /// The last frame, and whether the user has not acted on it yet.
    frame: Option<PoseFrame>,
    fresh: bool,
    around: Around,
    lines: Vec<Line>,
    drawn: [u32; 2],
}

impl Used {
    /// Does what the user does about the last frame.
    fn act(&mut self) -> Result<(), HeadsetError> {
        if !std::mem::take(&mut self.fresh) || self.around.things.is_empty() {
            return Ok(());
        }
        let (Some(frame), Some((name, step))) = (&self.frame, self.steps.get_mut(self.at)) else {
            return Ok(());
        };
        let seen = Seen {
            frame,
            around: &self.around,
            lines: &self.lines,
            drawn: self.drawn,
            lasts: self.simulated - self.begun,
        };
        self.user.home.get_or_insert(seen.foot(SOURCE));
        let done = step(&mut self.user, &seen, self.frames);
        self.frames += 1;
        assert!(
            done || self.frames < MOST_FRAMES,
            "not done in {MOST_FRAMES} frames: {name}; there are {:#?}, palms at {} and {}",
            self.around,
            seen.palm(Side::Left),
            seen.palm(Side::Right)
        );
        if done {
            eprintln!("{name}: {} frames", self.frames);
            self.at += 1;
            (self.frames, self.begun) = (0, self.simulated);
        }
        if std::mem::take(&mut self.user.acted) {
            std::thread::sleep(ARRIVES);
        }
        if self.at == self.steps.len() {
            self.desk.request_exit()?;
        }
        Ok(())
    }
}

impl Headset for Used {
    left_to!(desk);

    fn eyes(&self) -> u32 {
        self.desk.eyes()
    }
    fn wanted(&self) -> [u32; 2] {
        self.desk.wanted()
    }
    fn inset(&self) -> Option<Inset> {
        self.desk.inset()
    }
    fn hidden_area(&self) -> [Vec<[f32; 2]>; 2] {
        self.desk.hidden_area()
    }
    fn next(&mut self) -> Result<Turn, HeadsetError> {
        self.act()?;
        let turn = self.desk.next()?;
        if let Turn::Frame(frame) = &turn {
            let now = frame.poses.info.xr_time;
            let last = (self.frame.as_ref()).map_or(now, |last| last.info.xr_time);
            let passed = 1e-9 * (now - last) as f64;
            self.simulated += passed.min(f64::from(MOST_STEPS) * STEP);
            // The user sees the window's picture; the recorded head stays.
            let [eye, _] = self.desk.locate_views()?;
            self.frame = Some(PoseFrame {
                stage_from_view: eye.stage_from_eye,
                ..frame.poses.clone()
            });
            self.fresh = true;
        }
        Ok(turn)
    }
    fn acquire(&mut self, panel: bool) -> Result<Option<Targets>, HeadsetError> {
        self.desk.acquire(panel)
    }
    fn locate_views(&mut self) -> Result<[View; 2], HeadsetError> {
        self.desk.locate_views()
    }
    fn around(&mut self, around: Around) {
        self.around = around.clone();
        self.desk.around(around);
    }
    fn lines(&self) -> Vec<Line> {
        self.desk.lines()
    }
    fn pointed(&self) -> Option<Pointed> {
        self.desk.pointed()
    }
    fn end(&mut self, shown: Option<&Shown>) -> Result<(), HeadsetError> {
        self.lines = self.desk.lines();
        if let Some(shown) = shown {
            self.drawn = shown.extent;
        }
        self.desk.end(shown)
    }
}

/// A session that has ended.
pub struct Sat {
    pub outcome: SessionOutcome,
    pub track: Track,
    /// Where it was seen.
    pub screen: Screen,
    /// The step in which it ended; `None` where all were done.
    pub ended_in: Option<&'static str>,
}

/// What a session at a screen is to be, recorded in `folder`.
pub fn at_screen(folder: &Path) -> Options {
    Options {
        pointer: true,
        ..options(folder)
    }
}

/// A session in the test of that name, whose options may be changed and whose script may need its device; with that device. `None` in the
/// process that starts the screen's.
pub fn sat(
    name: &str,
    by: By,
    script: impl FnOnce(&Gpu, &mut Options) -> Script,
) -> Option<(Watched, Sat)> {
    let screen = screen::enter(name)?;
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let mut options = at_screen(folder.path());
    let script = script(&gpu, &mut options);
    let sat = session(&gpu, (screen, by), options, script);
    Some((gpu, sat))
}

/// A session in a window, to the end of what its user does.
pub fn session(gpu: &Gpu, seat: (Screen, By), options: Options, script: Script) -> Sat {
    session_at(gpu, seat, options, script, (spec(), |desk| desk))
}

/// A small window in which a hand holds as long as the button.
pub fn spec() -> DeskSpec {
    DeskSpec {
        size: SIZE,
        full_screen: false,
        fov: FOV,
        scale: 1.0,
        toggles: false,
    }
}

/// The same in that window, at a desk with a change.
pub fn session_at(
    gpu: &Gpu,
    (screen, by): (Screen, By),
    options: Options,
    script: Script,
    (spec, change): (DeskSpec, impl FnOnce(Desk) -> Desk),
) -> Sat {
    let file = options.record.clone().unwrap();
    let (decisions, taken) = channel();
    let (desk, window) = desk::open(gpu, spec, decisions).unwrap();
    let mut used = Used {
        desk: change(desk),
        user: User::new(screen, by),
        steps: script.0,
        at: 0,
        frames: 0,
        simulated: 0.0,
        begun: 0.0,
        frame: None,
        fresh: false,
        around: Around::default(),
        lines: Vec::new(),
        drawn: [0; 2],
    };
    let session = Session::new(&used, options, taken).unwrap();
    let session = session.mirrored(window).unwrap();
    let outcome = hearing(|| session.run(&mut used)).unwrap();
    let track = recording(&outcome, &file);
    Sat {
        outcome,
        track,
        screen: used.user.screen,
        ended_in: used.steps.get(used.at).map(|(name, _)| *name),
    }
}

/// The hand is at the flask, and a ring shows that a press would take it.
pub fn points(script: Script) -> Script {
    script.then("points at the flask", |user, seen, frame| {
        // The view may still be coming to rest.
        if frame.is_multiple_of(10) {
            user.point_at(seen, seen.middle(SOURCE));
        }
        seen.is_ringed(SOURCE) && seen.gap(SOURCE) < vitriol_sim::bodies::GRIP_REACH
    })
}

/// Takes hold of the flask that the hand is at.
pub fn takes(script: Script) -> Script {
    script.then("takes the flask", |user, seen, frame| {
        if frame == 0 {
            user.grip(true);
        }
        seen.holder(SOURCE).is_some()
    })
}

/// Whether it stands on the table, and no hand holds it.
pub fn stands(seen: &Seen<'_>, flask: usize) -> bool {
    // Upright, its foot on the table: to 3 mm and 2°, by which a contact of the bodies may differ.
    let down = seen.foot(flask).y - seen.around.table < 3e-3;
    seen.holder(flask).is_none() && down && seen.tilt(flask) < 2.0
}

/// Lets the flask go, and waits until it stands.
pub fn puts_down(script: Script) -> Script {
    script
        .then("puts the flask down", |user, seen, frame| {
            if frame == 0 {
                user.grip(false);
            }
            stands(seen, SOURCE)
        })
        // A lesson looks for half a second in which it stands.
        .then("looks at it", |_, seen, _| seen.lasts > 0.8)
}
