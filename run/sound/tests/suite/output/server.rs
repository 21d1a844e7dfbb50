//! A PulseAudio server of a test's own, which plays into nothing.

use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use vitriol_tests::program::{Kept, own_name};
pub use vitriol_tests::wait::until;

/// Marks a test that was started again.
const INSIDE: &str = "VITRIOL_TEST_SOUND";

/// Runs `body` in this test, started again with `socket` as its server's. The result of `before` lives as long.
pub fn inside<T>(body: impl FnOnce(), before: impl FnOnce(&Path) -> Option<T>) {
    if std::env::var_os(INSIDE).is_some() {
        body();
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let Some(_kept) = before(folder.path()) else {
        return;
    };
    let mut again = Command::new(std::env::current_exe().unwrap());
    let test = own_name();
    again.args(["--exact", &test, "--nocapture", "--include-ignored"]);
    own(&mut again, folder.path());
    let output = again.env(INSIDE, folder.path()).output().unwrap();
    eprint!("{}", String::from_utf8_lossy(&output.stdout));
    eprint!("{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success());
    let ran = String::from_utf8_lossy(&output.stdout).contains("1 passed");
    assert!(ran, "there is no test {test}");
}

/// The environment that server and client share with no others.
fn own(command: &mut Command, folder: &Path) {
    command.env("HOME", folder).env("XDG_RUNTIME_DIR", folder);
    command.env(
        "PULSE_SERVER",
        format!("unix:{}", folder.join("socket").display()),
    );
    command
        .env_remove("PULSE_RUNTIME_PATH")
        .env_remove("PULSE_COOKIE");
    command.env_remove("XDG_CONFIG_HOME").env_remove("DISPLAY");
}

/// Kills the server of this test, from inside.
pub fn kill() {
    let folder = std::env::var_os(INSIDE).unwrap();
    let process = std::fs::read_to_string(Path::new(&folder).join("process")).unwrap();
    let killed = Command::new("kill").args(["-KILL", &process]).status();
    assert!(killed.unwrap().success());
}

/// Stops this whole process for `time`, as a machine that is too busy does.
pub fn pause(time: Duration) {
    let process = std::process::id();
    let stops = format!(
        "kill -STOP {process}; sleep {}; kill -CONT {process}",
        time.as_secs_f64()
    );
    assert!(
        Command::new("sh")
            .args(["-c", &stops])
            .status()
            .unwrap()
            .success()
    );
}

/// A server, which ends when this is dropped.
pub struct Server(Kept);

impl Server {
    /// Starts a server with an output "vitriol"; `None` where PulseAudio is not installed, with a message. With `CI=true` that is a
    /// failure.
    pub fn start(folder: &Path) -> Option<Self> {
        let mut command = Command::new("pulseaudio");
        own(&mut command, folder);
        let socket = folder.join("socket");
        command.args([
            "--daemonize=no",
            "--exit-idle-time=-1",
            "-n",
            "--use-pid-file=no",
        ]);
        command.args([
            "--disable-shm=yes",
            "--log-target=stderr",
            "--log-level=error",
        ]);
        command.args([
            "-L",
            "module-null-sink sink_name=vitriol format=float32le rate=48000",
        ]);
        let listen = format!("module-native-protocol-unix socket={}", socket.display());
        command.args(["-L", &listen]).stderr(Stdio::null());
        let there = Command::new("parec")
            .arg("--version")
            .stdout(Stdio::null())
            .status();
        let (Ok(child), Ok(_)) = (command.spawn(), there) else {
            let cause = "pulseaudio and pulseaudio-utils are not installed (./lab setup does it)";
            assert!(std::env::var("CI").as_deref() != Ok("true"), "{cause}");
            eprintln!("NOT TESTED: {}: {cause}", own_name());
            return None;
        };
        let mut server = Self(Kept(child));
        std::fs::write(folder.join("process"), server.0.id().to_string()).unwrap();
        until("the server's socket", || {
            let ended = server.0.try_wait().unwrap();
            assert!(ended.is_none(), "the server ended: {ended:?}");
            std::os::unix::net::UnixStream::connect(&socket).ok()
        });
        Some(server)
    }
}

/// The output's sound, from inside, recorded by PulseAudio's own program.
pub struct Recorder(Kept);

impl Recorder {
    /// Starts to record.
    pub fn start() -> Self {
        let mut command = Command::new("parec");
        command.args([
            "--device=vitriol.monitor",
            "--format=float32le",
            "--rate=48000",
        ]);
        command.args(["--channels=2", "--latency-msec=20"]);
        let mut recorder = Self(Kept(command.stdout(Stdio::piped()).spawn().unwrap()));
        recorder.seconds(0.1);
        recorder
    }

    /// Records the next `seconds`, left and right.
    pub fn seconds(&mut self, seconds: f64) -> Vec<[f32; 2]> {
        let mut bytes = vec![0; (seconds * 48_000.0) as usize * 8];
        let out = self.0.stdout.as_mut().unwrap();
        out.read_exact(&mut bytes).unwrap();
        let number = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().unwrap());
        let both = |bytes: &[u8]| [number(&bytes[..4]), number(&bytes[4..])];
        bytes.chunks_exact(8).map(both).collect()
    }
}
