//! A real OpenXR runtime without a headset: Monado's service with its null compositor and its
//! remote driver, in the rig (`tests/src/rig.rs`).

mod remote;

use std::fs::File;
use std::os::unix::fs::DirBuilderExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::program::Kept;
use crate::rig::{self, MANIFEST};
use crate::wait::until;
pub use remote::{Controller, Remote};

/// Port of the remote driver; the network namespace has no other.
const PORT: u16 = 4242;

/// The rig seen from inside, with its service running.
pub struct Rig {
    folder: PathBuf,
    service: Option<Kept>,
}

/// Runs the test `name` (module path and function, as the test's own runner knows it) in the rig: returns the rig in the process that runs
/// there, and `None` in the one outside, where the test is over then.
///
/// Where there is no Monado, or no namespace can be made, a message goes to standard error and the test is over too.
///
/// # Panics
/// Where the test fails in the rig; where there can be no rig and `CI=true`.
#[must_use]
pub fn enter(name: &str) -> Option<Rig> {
    let folder = rig::enter(name, prepare, log)?;
    let mut rig = Rig {
        folder,
        service: None,
    };
    rig.start();
    Some(rig)
}

/// Fills the rig's folder; returns the environment that leads to it.
fn prepare(folder: &Path) -> Vec<(&'static str, PathBuf)> {
    let at = |part: &str| folder.join(part);
    std::fs::create_dir_all(at("config/monado")).expect("a folder in the rig's");
    std::fs::DirBuilder::new()
        .mode(0o700)
        .create(at("run"))
        .expect("a folder in the rig's");
    let config =
        format!(r#"{{"active":"remote","remote":{{"version":0,"port":{PORT},"view_count":2}}}}"#);
    std::fs::write(at("config/monado/config_v0.json"), config).expect("a file in the rig's");
    vec![
        ("XDG_RUNTIME_DIR", at("run")),
        ("XDG_CONFIG_HOME", at("config")),
        ("XR_RUNTIME_JSON", MANIFEST.into()),
        ("XRT_COMPOSITOR_NULL", "1".into()),
        ("XRT_NO_STDIN", "1".into()),
    ]
}

/// The service's log.
fn log(folder: &Path) -> String {
    let log = std::fs::read_to_string(folder.join("monado.log")).unwrap_or_default();
    format!("Monado's log:\n{log}")
}

impl Rig {
    /// Starts the service and waits until it listens.
    ///
    /// # Panics
    /// Where it does not.
    pub fn start(&mut self) {
        // A service that was killed leaves its socket.
        for left in ["monado_comp_ipc", "monado.pid"] {
            let _ = std::fs::remove_file(self.folder.join("run").join(left));
        }
        let log = File::options()
            .create(true)
            .append(true)
            .open(self.folder.join("monado.log"))
            .expect("Monado's log");
        let before = self.starts();
        let service = Command::new("monado-service")
            .stdin(Stdio::null())
            .stdout(log.try_clone().expect("Monado's log"))
            .stderr(log)
            .env_remove("XR_ENABLE_API_LAYERS")
            .spawn()
            .expect("monado-service starts");
        self.service = Some(Kept(service));
        // Its socket exists before it listens; its message that it has started comes after.
        until("monado-service listens", || {
            (self.starts() > before).then_some(())
        });
    }

    /// Number of times that the service has logged its start.
    fn starts(&self) -> usize {
        let log = std::fs::read_to_string(self.folder.join("monado.log")).unwrap_or_default();
        log.matches("service has started").count()
    }

    /// Kills the service, as a crash would: its clients lose their instance.
    ///
    /// # Panics
    /// Where it is not running.
    pub fn kill(&mut self) {
        drop(self.service.take().expect("the service runs"));
    }

    /// A connection that sets head and hands.
    ///
    /// # Panics
    /// Where the remote driver does not answer.
    #[must_use]
    pub fn remote(&self) -> Remote {
        Self::remote_here()
    }

    /// A connection that sets head and hands, for a process that a test has started in its rig; [`Rig::remote`] is for the test itself.
    ///
    /// # Panics
    /// Where the remote driver does not answer.
    #[must_use]
    pub fn remote_here() -> Remote {
        Remote::try_open(PORT).expect("the remote driver answers")
    }

    /// A folder for the test's own files.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

impl Drop for Rig {
    fn drop(&mut self) {
        drop(self.service.take());
        rig::assert_silent(&self.folder);
    }
}
