//! Shaders that change while a replay runs.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, SystemTime};

use crate::device::common::{BEFORE, experiment, frame};
use glam::Quat;
use tracing_subscriber::fmt::MakeWriter;
use vitriol_run::Experiment;
use vitriol_shaders::Library;
use vitriol_tests::gpu;
use vitriol_xr::Pose;

/// A copy of the project's shaders.
struct Folder {
    root: tempfile::TempDir,
    /// File systems stamp in ticks; a test writes faster.
    clock: SystemTime,
}

impl Folder {
    fn new() -> Self {
        let root = tempfile::tempdir().unwrap();
        let original = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders/wgsl");
        copy(&original, root.path());
        let clock = SystemTime::now();
        Self { root, clock }
    }

    fn edit(&mut self, file: &str, from: &str, to: &str) {
        let path: PathBuf = self.root.path().join(file);
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(from), "{file} has no {from}");
        fs::write(&path, text.replace(from, to)).unwrap();
        self.clock += Duration::from_secs(1);
        let file = fs::File::options().write(true).open(path).unwrap();
        file.set_modified(self.clock).unwrap();
    }
}

/// Copies what a folder holds.
fn copy(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let to = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            fs::create_dir(&to).unwrap();
            copy(&entry.path(), &to);
        } else {
            fs::copy(entry.path(), to).unwrap();
        }
    }
}

/// What the program would print on standard error.
#[derive(Clone, Default)]
struct Messages(Arc<Mutex<Vec<u8>>>);

impl Messages {
    /// What came since the last call.
    fn take(&self) -> String {
        String::from_utf8(std::mem::take(&mut *self.0.lock().unwrap())).unwrap()
    }
}

impl Write for Messages {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl MakeWriter<'_> for Messages {
    type Writer = Self;

    fn make_writer(&self) -> Self {
        self.clone()
    }
}

fn step(laboratory: &mut dyn Experiment) -> Vec<u8> {
    let level = Pose::new(BEFORE, Quat::IDENTITY);
    laboratory.step(&frame(0, level)).unwrap();
    laboratory.picture(0).unwrap().to_vec()
}

/// How many pixels are more red than blue: liquid at rest is blue.
fn red(picture: &[u8]) -> usize {
    let pixels = picture.chunks_exact(4);
    pixels.filter(|p| p[0] > p[2].saturating_add(40)).count()
}

#[test]
fn a_running_replay_takes_up_what_is_sound() {
    let messages = Messages::default();
    // As the program says it, who is told warnings unless asked for more.
    let subscriber = tracing_subscriber::fmt()
        .with_writer(messages.clone())
        .with_max_level(tracing::Level::WARN)
        .with_ansi(false);
    let _guard = tracing::subscriber::set_default(subscriber.finish());
    let device = gpu::device();
    let mut folder = Folder::new();
    let library = Library::watching_at(folder.root.path());
    let level = Pose::new(BEFORE, Quat::IDENTITY);
    let mut laboratory = experiment(&device, Some(level), library);
    let before = step(laboratory.as_mut());
    assert_eq!(messages.take(), "");

    // The liquid's colour; one file, one pipeline.
    let light = "let light = colour_of(particle) *";
    folder.edit(
        "render/spheres/light.wgsl",
        light,
        "let light = 5.0 * colour_of(particle).gbr *",
    );
    let after = step(laboratory.as_mut());
    // The liquid is 1 % of the picture.
    assert!(
        red(&before) < 20 && red(&after) > 250,
        "{} {}",
        red(&before),
        red(&after)
    );
    let said = messages.take();
    assert!(
        said.contains("reloaded: render/spheres/light.wgsl"),
        "{said}"
    );

    // Broken: the one that was reloaded stays, and the message has the line.
    folder.edit("render/spheres/light.wgsl", "5.0 *", "5.0 * nonsense *");
    let still = step(laboratory.as_mut());
    assert!(red(&still) > 250, "{}", red(&still));
    let said = messages.take();
    for part in [
        "the old render/spheres/light.wgsl stays",
        "light.wgsl:5",
        "nonsense",
    ] {
        assert!(said.contains(part), "{said}");
    }
    assert_eq!(said.lines().count(), 1, "{said}");

    // Valid, but not with what the program binds.
    folder.edit("render/spheres/light.wgsl", "nonsense *", "");
    folder.edit(
        "render/spheres/light.wgsl",
        "var<immediate> spheres",
        "var<private> spheres",
    );
    let still = step(laboratory.as_mut());
    assert!(red(&still) > 250, "{}", red(&still));
    let said = messages.take();
    assert!(
        said.contains("the old render/spheres/light.wgsl stays"),
        "{said}"
    );
}

#[test]
fn a_changed_solver_goes_on_from_where_it_was() {
    let device = gpu::device();
    let mut folder = Folder::new();
    let watching = Library::watching_at(folder.root.path());
    let mut changing = experiment(&device, None, watching);
    let mut plain = experiment(&device, None, Library::embedded());
    for _ in 0..4 {
        step(changing.as_mut());
        step(plain.as_mut());
    }
    let hash = |laboratory: &mut dyn Experiment| laboratory.outcome().unwrap().state_hash;
    // Other text, same mathematics: the exchange itself leaves no trace.
    let file = "common/liquid/prediction.wgsl";
    folder.edit(file, "let gravity = vec3", "let gravity = 1.0 * vec3");
    for _ in 0..4 {
        step(changing.as_mut());
        step(plain.as_mut());
    }
    assert_eq!(hash(changing.as_mut()), hash(plain.as_mut()));
    assert_eq!(
        changing.outcome().unwrap().counters.substeps,
        plain.outcome().unwrap().counters.substeps
    );

    // Other mathematics.
    folder.edit(file, "1.0 * vec3", "0.5 * vec3");
    step(changing.as_mut());
    step(plain.as_mut());
    assert_ne!(hash(changing.as_mut()), hash(plain.as_mut()));
}
