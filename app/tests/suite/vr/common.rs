//! A small session, its headset, and the replay of what it recorded.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use tracing::{Event, Subscriber};
use tracing_subscriber::layer::{Context, Layer, SubscriberExt};
use vitriol_gpu::Gpu;
use vitriol_lesson::Language;
use vitriol_run::{Action, Scenes};
use vitriol_session::decision::Decision;
use vitriol_session::foveating::Foveating;
use vitriol_session::latch::Grip;
use vitriol_session::placement::Posture;
use vitriol_session::session::{Options, Session, SessionOutcome};
use vitriol_session::stand_in::{StandIn, StandInSpec, Timing};
use vitriol_session::workbench::{BUILT_AGAIN, Plan, TAKEN_UP};
use vitriol_sim::scene::Preset;
use vitriol_sound::Device;
use vitriol_tests::wait::PATIENCE;
use vitriol_xr::track::{Keyframes, Track};
use vitriol_xr::{
    Fov, Headset, HeadsetError, HeadsetFrame, Inset, InsetTargets, Pose, Shown, Targets, Turn, View,
};

/// Keyframes that pour from one flask into the other, see the track's own text.
pub fn pour() -> Keyframes {
    let text = vitriol_xr::track::builtin::text("two-flasks").unwrap();
    Keyframes::parse(text, Path::new("two-flasks.toml")).unwrap()
}

/// `two-flasks` with 1,200 particles, as a file in `folder`.
pub fn scene(folder: &Path) -> PathBuf {
    let text = include_str!("../../../../sim/scenes/two-flasks.toml");
    let small = text
        .replace("spacing = 0.0025 ", "spacing = 0.005 ")
        .replace("substeps = 10", "substeps = 5");
    assert_ne!(small, text);
    let file = folder.join("small.toml");
    // Colours and depths are looked for that furniture has, too.
    let bare = format!("{small}\n[picture]\nroom = \"bare\"\n");
    std::fs::write(&file, bare).unwrap();
    file
}

/// What a test does at a line of the log.
type Then = (&'static str, Box<dyn FnOnce()>);

thread_local! {
    static HEARD: RefCell<BTreeMap<String, u64>> = const { RefCell::new(BTreeMap::new()) };
    static THEN: RefCell<Option<Then>> = const { RefCell::new(None) };
}

/// Does that, and counts what is logged on this thread meanwhile.
pub fn hearing<T>(f: impl FnOnce() -> T) -> T {
    // Of what came before on this thread.
    HEARD.take();
    tracing::subscriber::with_default(tracing_subscriber::registry().with(Ear), f)
}

/// Does that once, in the middle of what the session does when it next logs a line with that target on this thread.
pub fn when_heard(target: &'static str, then: impl FnOnce() + 'static) {
    THEN.set(Some((target, Box::new(then))));
}

/// How many lines with that target were logged on this thread while [`hearing`] did the last thing.
pub fn heard(target: &str) -> u64 {
    HEARD.with_borrow(|heard| heard.get(target).copied().unwrap_or(0))
}

/// Hears what a session logs on its own thread.
struct Ear;

impl<S: Subscriber> Layer<S> for Ear {
    fn on_event(&self, event: &Event<'_>, _: Context<'_, S>) {
        let target = event.metadata().target().to_owned();
        let then = THEN.with_borrow_mut(|then| then.take_if(|(of, _)| *of == target));
        HEARD.with_borrow_mut(|heard| *heard.entry(target).or_default() += 1);
        if let Some((_, then)) = then {
            then();
        }
    }
}

/// What goes wrong, or is pressed, in a session.
pub trait Trouble {
    /// Before a turn, after so many frames: `Some` in its place.
    fn turn(&mut self, _headset: &mut StandIn, _after: u64) -> Option<Turn> {
        None
    }
    /// In a frame that has begun, after so many before it.
    fn frame(&mut self, _frame: &mut HeadsetFrame, _after: u64) {}
    /// In a frame after its steps, and behind its end.
    fn acquires(&mut self, _after: u64) {}
    /// See [`Trouble::acquires`].
    fn ends(&mut self, _after: u64) {}
    /// Whether a frame has a picture. A test that looks at few of them saves the time of the others, for which the headset has no images.
    fn draws(&self, _after: u64) -> bool {
        true
    }
    /// Whether something has still to come after so many frames: until it does, frames do not count.
    fn awaits(&self, _after: u64) -> bool {
        false
    }
}

/// None.
pub struct Calm;

impl Trouble for Calm {}

/// Waits for the device before a frame's steps and behind its end. With at most two steps a frame its picture shows all of them, and the
/// panel what was observed up to the last frame, however fast the device is: two such sessions' pictures can be compared to the bit.
pub struct Settled(pub Gpu);

impl Trouble for Settled {
    fn frame(&mut self, _: &mut HeadsetFrame, _: u64) {
        self.0.wait_idle().unwrap();
    }

    fn ends(&mut self, _: u64) {
        self.0.wait_idle().unwrap();
    }
}

/// Asks in a frame that the scene begins anew. Frames after it do not count until the new bench is taken up; one whose device was lost
/// before that is built again.
pub struct StartsOver {
    /// The frame that asks.
    pub asks: u64,
    /// Where it asks.
    pub decisions: Sender<Decision>,
}

impl Trouble for StartsOver {
    fn awaits(&self, after: u64) -> bool {
        after == self.asks + 1 && heard(TAKEN_UP) < 1 + heard(BUILT_AGAIN)
    }

    fn frame(&mut self, _: &mut HeadsetFrame, after: u64) {
        if after == self.asks {
            let start = Decision::Act(Action::Start(None));
            self.decisions.send(start).unwrap();
        }
    }
}

/// What a headset around another, in the field of that name, leaves to that one.
macro_rules! left_to {
    ($inner:ident) => {
        fn gpu(&self) -> &vitriol_gpu::Gpu {
            self.$inner.gpu()
        }
        fn extent(&self) -> [u32; 2] {
            self.$inner.extent()
        }
        fn name(&self) -> &str {
            self.$inner.name()
        }
        fn gaze(&self) -> Option<vitriol_xr::Pose> {
            self.$inner.gaze()
        }
        fn vibrate(
            &mut self,
            side: vitriol_xr::Side,
            amplitude: f32,
        ) -> Result<(), vitriol_xr::HeadsetError> {
            self.$inner.vibrate(side, amplitude)
        }
        fn lose_device(&mut self) {
            self.$inner.lose_device();
        }
        fn rates(&self) -> &[f32] {
            self.$inner.rates()
        }
        fn request_rate(&mut self, rate: f32) -> Result<(), vitriol_xr::HeadsetError> {
            self.$inner.request_rate(rate)
        }
        fn request_exit(&mut self) -> Result<(), vitriol_xr::HeadsetError> {
            self.$inner.request_exit()
        }
    };
}
pub(crate) use left_to;

/// A stand-in with trouble, taken off after some frames.
pub struct Worn<T> {
    pub inner: StandIn,
    pub trouble: T,
    /// Frames after which it is taken off.
    frames: u64,
    /// Frames so far, without those in which something was awaited.
    after: u64,
    awaiting: Option<Instant>,
    /// What the eyes see, in place of the stand-in's.
    pub sees: Option<[Fov; 2]>,
    /// What no eye sees, in its picture.
    pub hidden: Vec<[f32; 2]>,
    /// A second pair of pictures, which see that of what the eyes do, and its images.
    pub inset: Option<(Inset, InsetTargets)>,
    /// What was shown with each frame.
    pub shown: Vec<Shown>,
    /// What the left and the right hand felt in each.
    pub felt: Vec<[f32; 2]>,
}

impl<T: Trouble> Worn<T> {
    pub fn new(gpu: &Gpu, track: Track, rate_hz: f64, frames: u64, trouble: T) -> Self {
        Self::of_extent(gpu, track, [96, 64], (rate_hz, frames), trouble)
    }
    /// The same with larger pictures, for so many frames a second and altogether.
    pub fn of_extent(
        gpu: &Gpu,
        track: Track,
        extent: [u32; 2],
        (rate_hz, frames): (f64, u64),
        trouble: T,
    ) -> Self {
        let spec = StandInSpec {
            extent,
            rate_hz,
            timing: Timing::Free,
        };
        Self {
            inner: StandIn::new(gpu, track, spec).unwrap(),
            trouble,
            frames,
            after: 0,
            awaiting: None,
            sees: None,
            // A corner of each eye's.
            hidden: vec![[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]],
            inset: None,
            shown: Vec::new(),
            felt: Vec::new(),
        }
    }
}

impl<T: Trouble> Headset for Worn<T> {
    left_to!(inner);

    fn inset(&self) -> Option<Inset> {
        self.inset.as_ref().map(|(inset, _)| *inset)
    }
    fn hidden_area(&self) -> [Vec<[f32; 2]>; 2] {
        [self.hidden.clone(), self.hidden.clone()]
    }
    fn next(&mut self) -> Result<Turn, HeadsetError> {
        if let Some(turn) = self.trouble.turn(&mut self.inner, self.after) {
            return Ok(turn);
        }
        let awaits = self.trouble.awaits(self.after);
        if self.after == self.frames && !awaits {
            self.inner.request_exit()?;
        }
        let mut turn = self.inner.next()?;
        if let Turn::Frame(frame) = &mut turn {
            self.trouble.frame(frame, self.after);
            if awaits {
                let since = self.awaiting.get_or_insert_with(Instant::now);
                assert!(since.elapsed() < PATIENCE, "what is awaited does not come");
                // The processor is for what is made beside the frames, and the track goes on with each: few of them may pass on a
                // busy machine. Once the picture fades, all is made. The panel is then in the picture, and not in a layer.
                let has_layer = |shown: Option<&Shown>| shown.is_some_and(|it| it.panel.is_some());
                let fades = has_layer(self.shown.first()) && !has_layer(self.shown.last());
                if !fades {
                    std::thread::sleep(Duration::from_millis(250));
                }
            } else {
                self.awaiting = None;
                self.after += 1;
            }
        }
        Ok(turn)
    }
    fn acquire(&mut self, panel: bool) -> Result<Option<Targets>, HeadsetError> {
        self.trouble.acquires(self.after - 1);
        if !self.trouble.draws(self.after - 1) {
            return Ok(None);
        }
        let mut targets = self.inner.acquire(panel)?;
        if let (Some(targets), Some((_, inset))) = (&mut targets, &self.inset) {
            targets.inset = Some(inset.clone());
        }
        Ok(targets)
    }
    fn locate_views(&mut self) -> Result<[View; 2], HeadsetError> {
        let mut views = self.inner.locate_views()?;
        for (view, fov) in views.iter_mut().zip(self.sees.iter().flatten()) {
            view.fov = *fov;
        }
        for (view, inset) in views
            .iter()
            .zip(self.inset.iter_mut().flat_map(|it| &mut it.0.views))
        {
            inset.stage_from_eye = view.stage_from_eye;
        }
        Ok(views)
    }
    fn end(&mut self, shown: Option<&Shown>) -> Result<(), HeadsetError> {
        self.shown.extend(shown.copied());
        self.felt.push(self.inner.felt);
        let ended = self.inner.end(shown);
        self.trouble.ends(self.after - 1);
        ended
    }
}

/// Nothing comes from the keyboard.
pub fn nobody() -> Receiver<Decision> {
    channel().1
}

/// Keyframes that pour from the start on, and what changes [`scene`] for them: its flask is where the hand is.
pub fn pour_at_once() -> (Keyframes, impl Fn(String) -> String) {
    let text = include_str!("../../../../tests/tracks/pours.toml");
    let keyframes = Keyframes::parse(text, Path::new("pours.toml")).unwrap();
    let in_hand = |scene: String| {
        let moved = scene.replacen("[-0.12, 0.75, -0.40]", "[0.034, 0.890, -0.400]", 1);
        assert_ne!(moved, scene);
        moved
    };
    (keyframes, in_hand)
}

/// What a session is to be, recorded in `folder`.
pub fn options(folder: &Path) -> Options {
    options_where(folder, |scene| scene)
}

/// The same with the scene's text changed.
pub fn options_where(folder: &Path, change: impl Fn(String) -> String) -> Options {
    let file = scene(folder);
    let text = std::fs::read_to_string(&file).unwrap();
    std::fs::write(&file, change(text)).unwrap();
    let mut scenes = Scenes::default();
    Options {
        plan: Plan {
            scene: scenes.open(file.to_str().unwrap()).unwrap(),
            scenes,
            preset: Preset::Balanced,
            breakable: false,
            seed: 3,
            solver: None,
            filter: None,
            tint: None,
            room: None,
        },
        posture: Posture::Seated,
        grip: Grip::Hold,
        pointer: false,
        frames: None,
        record: Some(folder.join("session.mcap")),
        // What a software driver takes is no matter to most.
        governed: false,
        // Pictures are looked at to the pixel.
        foveating: Some(Foveating::Off),
        sound: Device::Silent,
        // Most look at other things.
        hints: false,
        console: None,
        course: None,
        language: Language::En,
        student: None,
    }
}

/// The same in the scene of that file.
pub fn in_scene(folder: &Path, file: &Path) -> Options {
    let mut options = options(folder);
    let plan = &mut options.plan;
    plan.scene = plan.scenes.open(file.to_str().unwrap()).unwrap();
    options
}

/// A session in the small scene that nobody directs, with options that may be changed, to its end; and its recording.
pub fn run(
    headset: &mut dyn Headset,
    change: impl FnOnce(&mut Options),
) -> (SessionOutcome, Track) {
    let folder = tempfile::tempdir().unwrap();
    let mut options = options(folder.path());
    change(&mut options);
    session_with(headset, options, nobody())
}

/// How often a recording has a switch of that key.
pub fn switched(track: &Track, key: &str) -> usize {
    let switches = track.frames.iter().flat_map(|frame| &frame.scenario);
    switches.filter(|it| it.key == key).count()
}

/// A session to its end, and its recording.
pub fn session(
    headset: &mut dyn Headset,
    folder: &Path,
    decisions: Receiver<Decision>,
) -> (SessionOutcome, Track) {
    session_with(headset, options(folder), decisions)
}

/// The same with other options.
pub fn session_with(
    headset: &mut dyn Headset,
    options: Options,
    decisions: Receiver<Decision>,
) -> (SessionOutcome, Track) {
    let file = options.record.clone().unwrap();
    let session = Session::new(headset, options, decisions).unwrap();
    let outcome = hearing(|| session.run(headset)).unwrap();
    let track = recording(&outcome, &file);
    (outcome, track)
}

/// The recording of a session that has ended, which is whole.
pub fn recording(outcome: &SessionOutcome, file: &Path) -> Track {
    let recorded = outcome.recorded.as_ref().unwrap();
    assert_eq!((recorded.steps, recorded.unwritten), (outcome.steps, 0));
    let track = Track::open(file).unwrap();
    assert!(!track.recovered);
    track
}

/// The scenes that a recording carries.
pub fn carried(track: &Track) -> Scenes {
    let mut scenes = Scenes::default();
    scenes.carry(&track.metadata);
    scenes
}

/// Hash of the state that a session ended with.
pub fn hash(outcome: &SessionOutcome) -> u64 {
    outcome.world.snapshot().unwrap().solver.hash()
}

/// How far two poses are apart: m, rad.
pub fn apart(a: &Pose, b: &Pose) -> (f32, f32) {
    (
        (a.position - b.position).length(),
        a.orientation.angle_between(b.orientation),
    )
}
