//! The program under test, run as a user runs it.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread::JoinHandle;
use std::time::Instant;

use glam::{Quat, Vec3};
use vitriol_tests::program::Kept;
use vitriol_tests::wait::PATIENCE;
use vitriol_xr::Pose;

/// A pour with 1,760 particles, in the places of `two-flasks`.
pub fn scene(folder: &Path) -> PathBuf {
    scene_of(folder, "0.0044")
}

/// The same with particles `spacing` (m) apart.
pub fn scene_of(folder: &Path, spacing: &str) -> PathBuf {
    let text = include_str!("../../../../sim/scenes/two-flasks.toml");
    let small = text
        .replace("spacing = 0.0025 ", &format!("spacing = {spacing} "))
        .replace("substeps = 10", "substeps = 4")
        .replace("iterations = 3", "iterations = 2");
    assert_eq!(small.matches(spacing).count(), 1);
    let file = folder.join("small.toml");
    std::fs::write(&file, small).unwrap();
    file
}

/// What Vulkan's layer says first of each instance, at its level of information.
const GREETING: &str = "Khronos Validation Layer Active";
/// What the layer's lines of interest have; the text of an objection is in lines of their own.
const SAID: [&str; 3] = [GREETING, "Validation Error", "Validation Warning"];
/// An objection to what is not ours, see `docs/measurements/headset.md`.
const NOT_OURS: &str = "VUID-VkDeviceCreateInfo-pNext-02830";

fn vr(scene: &Path, recording: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vitriol"));
    command.args(["-vv", "vr", "--json", "--scene"]).arg(scene);
    command.arg("--record").arg(recording);
    command
}

/// With Vulkan's validation layer by the loader's own means: the program has no flag for it. The layer would open a file
/// anew, and empty, with each instance; what goes to the log stays.
fn watch(command: &mut Command) -> &mut Command {
    command
        .env("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation")
        .env("VK_LAYER_DEBUG_ACTION", "VK_DBG_LAYER_ACTION_LOG_MSG")
        .env("VK_LAYER_REPORT_FLAGS", "error,warn,info")
        .env("VK_LAYER_LOG_FILENAME", "/dev/stderr")
}

/// What the runtime gave the program with a frame, by the program's log.
#[derive(Debug)]
pub struct Seen {
    /// The frame's display time on the runtime's clock, ns.
    pub time: i64,
    pub head: Pose,
    /// Grip and squeeze of the right hand; `None` while its controller sleeps.
    pub right: Option<(Pose, f32)>,
}

impl Seen {
    /// Of a line such as `frame for 3 ns: head ([x, y, z], [x, y, z, w]), left None, right
    /// Some((([x, y, z], [x, y, z, w]), squeeze))`.
    fn of(line: &str) -> Option<Self> {
        let (_, line) = line.split_once("frame for ")?;
        let (time, line) = line.split_once(" ns: head ")?;
        let (head, line) = line.split_once(", left ")?;
        let (_, right) = line.split_once(", right ")?;
        let pose = |n: &[f32]| Pose::new(Vec3::from_slice(n), Quat::from_slice(&n[3..]));
        let hand = numbers(right);
        Some(Self {
            time: time.parse().unwrap(),
            head: pose(&numbers(head)),
            right: (!hand.is_empty()).then(|| (pose(&hand), hand[7])),
        })
    }
}

fn numbers(text: &str) -> Vec<f32> {
    let parts = text.split(['(', ')', '[', ']', ',', ' ']);
    parts.filter_map(|part| part.parse().ok()).collect()
}

/// Frames between two looks at a program's memory.
pub const WINDOW: usize = 200;

/// `vitriol vr` at work.
pub struct Program {
    child: Kept,
    /// Its log's lines.
    log: Receiver<String>,
    /// Its frames as far as its log was read.
    pub seen: Vec<Seen>,
    /// What it held of memory after every [`WINDOW`] of them, bytes.
    pub held: Vec<f64>,
    /// Whether Vulkan's validation layer watches it.
    watched: bool,
    /// What that layer says among the lines, at their end.
    layer: Option<JoinHandle<Vec<String>>>,
}

impl Program {
    /// In that scene, keeping a recording, with Vulkan's validation layer.
    pub fn start(scene: &Path, recording: &Path) -> Self {
        Self::start_with(scene, recording, &[])
    }

    /// The same with further arguments.
    pub fn start_with(scene: &Path, recording: &Path, arguments: &[&str]) -> Self {
        let mut command = vr(scene, recording);
        Self::spawn(watch(command.args(arguments)), true)
    }

    /// [`Program::start`] without the layer, whose own memory grows by some 7 kB a second.
    pub fn start_unwatched(scene: &Path, recording: &Path) -> Self {
        Self::spawn(&mut vr(scene, recording), false)
    }

    fn spawn(command: &mut Command, watched: bool) -> Self {
        let mut child = command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let stderr = child.stderr.take().unwrap();
        let (sender, log) = channel();
        let layer = std::thread::spawn(move || {
            let mut layer = Vec::new();
            for line in BufReader::new(stderr).lines().map_while(Result::ok) {
                eprintln!("vitriol: {line}");
                if SAID.iter().any(|part| line.contains(part)) {
                    layer.push(line.clone());
                }
                // Who waits for a word has it.
                let _ = sender.send(line);
            }
            layer
        });
        Self {
            child: Kept(child),
            log,
            seen: Vec::new(),
            held: Vec::new(),
            watched,
            layer: Some(layer),
        }
    }

    /// Waits for the log's next line.
    fn line(&mut self) -> String {
        let line = self.log.recv_timeout(PATIENCE);
        let line = line.unwrap_or_else(|error| panic!("the program says nothing: {error}"));
        let seen = Seen::of(&line);
        if seen.is_some() && self.seen.len().is_multiple_of(WINDOW) {
            self.held.extend(Self::memory());
        }
        self.seen.extend(seen);
        line
    }

    /// What it holds of memory, bytes; `None` once it has ended, of which the log tells later.
    fn memory() -> Option<f64> {
        // The rig numbers processes anew and has the system's /proc, so it is found there as a child of this one.
        let of = |stat: &str| -> Option<(String, String, String)> {
            let (pid, rest) = stat.split_once(" (")?;
            let (name, rest) = rest.rsplit_once(") ")?;
            let parent = rest.split(' ').nth(1)?;
            Some((pid.to_owned(), name.to_owned(), parent.to_owned()))
        };
        let stat = |path: &Path| of(&std::fs::read_to_string(path.join("stat")).ok()?);
        let (own, ..) = stat(Path::new("/proc/self"))?;
        let all = std::fs::read_dir("/proc").ok()?.map_while(Result::ok);
        let mut found = all.map(|entry| entry.path()).filter(|path| {
            stat(path).is_some_and(|(_, name, parent)| name == "vitriol" && parent == own)
        });
        let status = std::fs::read_to_string(found.next()?.join("status")).ok()?;
        let mut lines = status.lines();
        let line = lines.find_map(|line| line.strip_prefix("VmRSS:"))?;
        let kilobytes: f64 = line.trim().trim_end_matches(" kB").parse().ok()?;
        Some(1024.0 * kilobytes)
    }

    /// Waits for a line of the log that has `part`.
    pub fn says(&mut self, part: &str) {
        let begun = Instant::now();
        while !self.line().contains(part) {
            assert!(begun.elapsed() < PATIENCE, "no word of {part}");
        }
    }

    /// Waits for the next frame.
    pub fn frame(&mut self) -> &Seen {
        let before = self.seen.len();
        while self.seen.len() == before {
            self.line();
        }
        &self.seen[before]
    }

    /// Waits for so many more.
    pub fn frames(&mut self, count: usize) {
        for _ in 0..count {
            self.frame();
        }
    }

    /// Asks it to end, as the system does, and gives what it printed, and all its frames. Vulkan's
    /// layer must have greeted each of its instances, and else have said nothing.
    pub fn end(mut self) -> (serde_json::Value, Vec<Seen>) {
        // The shell's own kill: the rig has no other.
        let asked = Command::new("sh")
            .args(["-c", &format!("kill {}", self.child.id())])
            .status();
        assert!(asked.unwrap().success());
        let stdout = self.child.stdout.take().unwrap();
        let text = std::io::read_to_string(stdout).unwrap();
        let status = self.child.wait().unwrap();
        assert!(status.success(), "{status}");
        let (greetings, objections): (Vec<_>, Vec<_>) = (self.layer.take())
            .map_or_else(Vec::new, |layer| layer.join().unwrap())
            .into_iter()
            .filter(|line| !line.contains(NOT_OURS))
            .partition(|line| line.contains(GREETING));
        assert!(
            objections.is_empty(),
            "Vulkan's layer says: {objections:#?}"
        );
        // OpenXR's layer greets on standard output, and Vulkan's has a word there too.
        let json = &text[text.find("\n{").map_or(0, |at| at + 1)..];
        let mut json = serde_json::Deserializer::from_str(json).into_iter();
        let report: serde_json::Value = json.next().unwrap().unwrap();
        let instances = u64::from(self.watched) * (1 + report["renewals"].as_u64().unwrap());
        assert_eq!(greetings.len() as u64, instances, "{greetings:#?}");
        let rest = self.log.try_iter();
        self.seen.extend(rest.filter_map(|line| Seen::of(&line)));
        (report, std::mem::take(&mut self.seen))
    }
}
