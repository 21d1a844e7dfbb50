//! The mirror window, on a screen that only a program sees.

use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

use crate::vr::common::{Trouble, Worn, hash, nobody, options, pour, scene, switched};
use crate::vr::loss::replayed;
use crate::vr::seen::read;
use vitriol_run::track::key;
use vitriol_session::mirror;
use vitriol_session::session::Session;
use vitriol_session::stand_in::StandIn;
use vitriol_tests::gpu;
use vitriol_tests::program::Kept;
use vitriol_tests::screen::{self, Screen, Window};
use vitriol_tests::wait::{PATIENCE, until};
use vitriol_xr::track::{Track, load};
use vitriol_xr::{Headset, Pause, Turn};

/// Size of an eye's picture, see `common`.
const EYE: [usize; 2] = [96, 64];

/// Light of a byte and back (IEC 61966-2-1).
fn light(code: u8) -> f64 {
    let code = f64::from(code) / 255.0;
    match code < 0.04045 {
        true => code / 12.92,
        false => ((code + 0.055) / 1.055).powf(2.4),
    }
}

fn code(light: f64) -> f64 {
    255.0
        * match light < 0.003_130_8 {
            true => 12.92 * light,
            false => 1.055 * light.powf(1.0 / 2.4) - 0.055,
        }
}

/// The left eye's picture in an area of that size, by brute force: along each side each texel is cut
/// into as many equal pieces as there are pixels, so that a pixel has whole pieces, of which it takes
/// the mean light.
fn shrunk(eye: &[[u8; 4]], [width, height]: [usize; 2]) -> Vec<[f64; 3]> {
    let lights: Vec<f64> = (0..=255).map(light).collect();
    let mut sums = vec![[0.0; 3]; width * height];
    for y in 0..EYE[1] * height {
        for x in 0..EYE[0] * width {
            let texel = eye[y / height * EYE[0] + x / width];
            let sum = &mut sums[y / EYE[1] * width + x / EYE[0]];
            for channel in 0..3 {
                sum[channel] += lights[usize::from(texel[channel])];
            }
        }
    }
    let pieces = (EYE[0] * EYE[1]) as f64;
    let mean = |sum: &[f64; 3]| sum.map(|light| code(light / pieces));
    sums.iter().map(mean).collect()
}

/// A window in which the picture is half as large, with black above and below: its size, and the
/// picture's place and size in it.
const SMALL: [u32; 2] = [48, 100];
const SMALL_AT: [usize; 2] = [0, 34];
const SMALL_SIZE: [usize; 2] = [48, 32];

/// Another one, whose pixels take parts of texels: 64 · 61 / 96 = 40.7 pixels high.
const ODD: [u32; 2] = [61, 41];
const ODD_SIZE: [usize; 2] = [61, 41];

/// Looks at the window after some frames in each of its sizes.
struct Onlooker {
    screen: Screen,
    window: Option<Window>,
    /// Since when it looks without having seen what it should.
    looking: Option<Instant>,
    paused: bool,
    seen: [bool; 3],
}

impl Onlooker {
    /// Whether the window shows what the headset was given.
    fn sees(&self, headset: &StandIn, window: Window) -> Result<(), String> {
        let eyes = read(headset.gpu(), &headset.targets.colour);
        let left = &eyes[..EYE[0] * EYE[1]];
        let (extent, pixels) = self.screen.picture(window);
        let width = extent[0] as usize;
        // Half a code of rounding, and a tenth for the device's powers in 32 bits.
        let near = |seen: [u8; 3], wanted: [f64; 3]| {
            (0..3).all(|channel| (f64::from(seen[channel]) - wanted[channel]).abs() < 0.6)
        };
        let (at, size, wanted) = match extent {
            SMALL => (SMALL_AT, SMALL_SIZE, shrunk(left, SMALL_SIZE)),
            ODD => ([0, 0], ODD_SIZE, shrunk(left, ODD_SIZE)),
            // As it opens: 800 pixels wide, as the eye sees it, only larger.
            [800, 533] => {
                let bytes = |x: usize, y: usize| left[y * EYE[1] / 533 * EYE[0] + x * EYE[0] / 800];
                let rows = (0..533).flat_map(|y| (0..800).map(move |x| (x, y)));
                let wanted = rows.map(|(x, y)| {
                    let texel = bytes(x, y);
                    [0, 1, 2].map(|channel| f64::from(texel[channel]))
                });
                ([0, 0], [800, 533], wanted.collect())
            }
            other => return Err(format!("{other:?}")),
        };
        for (index, &seen) in pixels.iter().enumerate() {
            let (x, y) = (index % width, index / width);
            let inside =
                (at[0]..at[0] + size[0]).contains(&x) && (at[1]..at[1] + size[1]).contains(&y);
            let wanted = match inside {
                true => wanted[(y - at[1]) * size[0] + x - at[0]],
                false => [0.0; 3],
            };
            if !near(seen, wanted) {
                return Err(format!(
                    "at {x}, {y} of {extent:?}: {seen:?} for {wanted:?}"
                ));
            }
        }
        Ok(())
    }

    /// Whether the window shows it soon, with a title that says so.
    fn look(&self, headset: &StandIn, window: Window) -> Result<(), String> {
        let mut outcome = Ok(());
        for _ in 0..SOON {
            let title = self.screen.title(window).unwrap();
            outcome = match title.contains("small.toml") && title.contains("headset is off") {
                true => self.sees(headset, window),
                false => Err(title),
            };
            if outcome.is_ok() {
                break;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        outcome
    }
}

/// Frames after which there is a look, each preceded by a pause, in which the device gets done.
const LOOKS: [u64; 3] = [10, 20, 30];
/// Looks before there is another frame: the session may not have known the window's size in the last
/// one, or the window not have been done with the pictures before.
const SOON: usize = 25;

impl Trouble for Onlooker {
    fn turn(&mut self, headset: &mut StandIn, after: u64) -> Option<Turn> {
        let at = LOOKS.iter().position(|frames| *frames == after)?;
        if self.seen[at] {
            return None;
        }
        let window = *self
            .window
            .get_or_insert_with(|| self.screen.wait_for("Vitriol: "));
        self.paused = !self.paused;
        if self.paused {
            // What is done is handed over after the turn.
            gpu_done(headset);
            return Some(Turn::Paused { cause: Pause::Off });
        }
        let since = *self.looking.get_or_insert_with(Instant::now);
        match self.look(headset, window) {
            Ok(()) => {
                (self.looking, self.seen[at]) = (None, true);
                if let Some(extent) = [SMALL, ODD].get(at) {
                    self.screen.resize(window, *extent);
                }
            }
            Err(why) => assert!(since.elapsed() < PATIENCE, "{why}"),
        }
        None
    }

    fn awaits(&self, after: u64) -> bool {
        let at = LOOKS.iter().position(|frames| *frames == after);
        at.is_some_and(|at| !self.seen[at])
    }
}

fn gpu_done(headset: &StandIn) {
    headset.gpu().wait_idle().unwrap();
}

#[test]
fn the_window_shows_what_the_left_eye_sees() {
    let Some(screen) = screen::enter("vr::mirror::the_window_shows_what_the_left_eye_sees") else {
        return;
    };
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let onlooker = Onlooker {
        screen,
        window: None,
        looking: None,
        paused: false,
        seen: [false; 3],
    };
    // 30 frames a second: each is shown.
    let mut headset = Worn::new(&gpu, pour().sample_track(), 30.0, 31, onlooker);
    let options = options(folder.path());
    let recording = options.record.clone().unwrap();
    let window = mirror::Window::open(headset.extent(), channel().0).unwrap();
    let session = Session::new(&headset, options, nobody()).unwrap();
    let outcome = session.mirrored(window).unwrap().run(&mut headset).unwrap();
    // Each of them was shown.
    assert_eq!(outcome.frames, headset.shown.len() as u64);
    assert_eq!(headset.trouble.seen, [true; 3]);
    assert_eq!(
        headset.trouble.screen.find("Vitriol: "),
        None,
        "it is gone with the session"
    );
    // Nothing of it is in what was simulated.
    let track = Track::open(&recording).unwrap();
    assert_eq!(replayed(&gpu, track), hash(&outcome));
}

/// `vitriol vr` on a stand-in.
struct Program(Kept);

impl Program {
    fn start(scene: &Path, more: &[&str]) -> Self {
        let child = Command::new(env!("CARGO_BIN_EXE_vitriol"))
            .args([
                "vr",
                "--json",
                "--stand-in",
                "two-flasks",
                "--preset",
                "fast",
            ])
            .args(["--size", "96x64", "--rate", "30", "--scene"])
            .arg(scene)
            .args(more)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn();
        Self(Kept(child.unwrap()))
    }

    fn runs(&mut self) -> bool {
        self.0.try_wait().unwrap().is_none()
    }

    /// Asks it to end, as the system does.
    fn ask(&self) {
        let asked = Command::new("kill").arg(self.0.id().to_string()).status();
        assert!(asked.unwrap().success());
    }

    /// Waits for its end; what it reported and what it logged.
    fn end(mut self) -> (serde_json::Value, String) {
        let (stdout, stderr) = (self.0.stdout.take(), self.0.stderr.take());
        let text = std::io::read_to_string(stdout.unwrap()).unwrap();
        let log = std::io::read_to_string(stderr.unwrap()).unwrap();
        let status = self.0.wait().unwrap();
        assert!(status.success(), "{status}: {log}");
        (serde_json::from_str(&text).unwrap(), log)
    }
}

/// Waits until steps are recorded that have not been yet: the session goes on.
fn records(recording: &Path) {
    let length = || std::fs::metadata(recording).map_or(0, |file| file.len());
    // What was taken before may be written yet.
    for _ in 0..2 {
        let before = length();
        until("more is recorded", || (length() > before).then_some(()));
    }
}

#[test]
fn there_is_a_session_without_a_window() {
    let Some(screen) = screen::enter("vr::mirror::there_is_a_session_without_a_window") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let recording = folder.path().join("alone.mcap");
    let keep = ["--no-mirror", "--record", recording.to_str().unwrap()];
    screen.watch();
    let program = Program::start(&scene, &keep);
    records(&recording);
    program.ask();
    let (report, log) = program.end();
    assert_eq!(screen.opened(), 0);
    // It says where its console is, and nothing else.
    let said: Vec<_> = log.lines().collect();
    assert!(report["steps"].as_u64() > Some(0), "{report}");
    assert!(said.len() == 1 && said[0].contains("console"), "{log}");
}

mod long {
    use super::*;

    #[test]
    fn keys_and_closing_are_heard() {
        let Some(screen) = screen::enter("vr::mirror::long::keys_and_closing_are_heard") else {
            return;
        };
        let folder = tempfile::tempdir().unwrap();
        let scene = scene(folder.path());
        let recording = folder.path().join("keys.mcap");
        let keep = ["--record", recording.to_str().unwrap()];

        // `b` without Enter: the scene from its start.
        let mut program = Program::start(&scene, &keep);
        let window = screen.wait_for("small.toml");
        screen.press(window, 'b');
        screen.wait_for("setting up");
        until("the scene is set up", || {
            let title = screen.title(window).unwrap();
            (!title.contains("setting up")).then_some(())
        });
        // Closed, it is gone, and the session goes on until it is asked to end.
        screen.close(window);
        until("the window goes", || {
            screen.find("Vitriol").is_none().then_some(())
        });
        records(&recording);
        assert!(program.runs());
        program.ask();
        let (report, log) = program.end();
        assert_eq!(report["lost_particles"], 0);
        // A window that is closed is nothing to complain of.
        assert!(!log.contains("mirror"), "{log}");
        let track = load(recording.to_str().unwrap()).unwrap();
        assert_eq!(switched(&track, key::START), 1);

        // `q`, twice: the end.
        let program = Program::start(&scene, &[]);
        let window = screen.wait_for("small.toml");
        for _ in 0..2 {
            screen.press(window, 'q');
        }
        program.end();
    }
}
