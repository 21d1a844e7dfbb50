//! A real OpenXR runtime without a headset: Monado's service with its null compositor and its
//! remote driver, in a network of its own, on the software Vulkan driver.
//!
//! Monado is taken from the system where it is installed, else from Debian 13's packages, which
//! `./lab setup` unpacks into the user's cache. A program that talks to it must share its C
//! library and its Vulkan driver, so the unpacked `/usr` is laid over the system's, in a mount
//! namespace: a test starts itself again in there (see [`enter`]), and what it starts is in there
//! too.

mod remote;

use std::fs::File;
use std::os::unix::fs::{DirBuilderExt, MetadataExt};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use crate::wait::until;
pub use remote::{Controller, Remote};

/// Where the rig's folder is told to the test that runs in it.
const FOLDER: &str = "VITRIOL_RIG";
/// Port of the remote driver; the network namespace has no other.
const PORT: u16 = 4242;
/// Monado's manifest, of the system or laid over it.
const MANIFEST: &str = "/usr/share/openxr/1/openxr_monado.json";
/// The software driver's manifest.
const DRIVERS: &str = "/usr/share/vulkan/icd.d";

/// The rig from within, with its service running.
pub struct Rig {
    folder: PathBuf,
    service: Option<Child>,
}

/// Runs the test `name` (module path and function, as the test's own runner knows it) in the
/// rig: gives the rig to the instance that runs there, and `None` to the one outside, where the
/// test is over then.
///
/// Where there is no Monado, or no namespace can be made, a loud word goes to standard error and
/// the test is over too.
///
/// # Panics
/// Where the test fails in the rig; where there can be no rig and `CI=true`.
#[must_use]
pub fn enter(name: &str) -> Option<Rig> {
    if let Some(folder) = std::env::var_os(FOLDER) {
        let folder = PathBuf::from(folder);
        File::create(folder.join("entered")).expect("a file in the rig's folder");
        let mut rig = Rig {
            folder,
            service: None,
        };
        rig.start();
        return Some(rig);
    }
    match root().and_then(|root| able().map(|()| root)) {
        Ok(root) => run_inside(name, root.as_deref()),
        Err(cause) => {
            assert!(
                std::env::var("CI").as_deref() != Ok("true"),
                "no OpenXR runtime for this test: {cause}"
            );
            eprintln!("NOT TESTED: no OpenXR runtime for {name}: {cause}");
        }
    }
    None
}

/// The unpacked system, or `None` where Monado is installed.
fn root() -> Result<Option<PathBuf>, String> {
    if Path::new(MANIFEST).exists() && Path::new("/usr/bin/monado-service").exists() {
        return Ok(None);
    }
    let cache = std::env::var_os("XDG_CACHE_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(PathBuf::from(std::env::var_os("HOME")?).join(".cache")));
    let root = cache.map(|cache| cache.join("vitriol/monado-debian-13"));
    match root {
        Some(root) if root.join(dumps()).exists() => Ok(Some(root)),
        _ => Err(
            "Monado is not installed, and `./lab setup`, which unpacks it on Debian, has not been \
             run"
            .to_owned(),
        ),
    }
}

/// What was added last to the packages that are unpacked: the layer that dumps OpenXR's calls.
fn dumps() -> String {
    let manifest = "usr/share/openxr/1/api_layers/explicit.d/XrApiLayer_api_dump";
    format!("{manifest}.{}-linux-gnu.json", std::env::consts::ARCH)
}

/// Whether namespaces can be made here.
fn able() -> Result<(), String> {
    let tried = unshare()
        .arg("true")
        .stdin(Stdio::null())
        .output()
        .map_err(|error| format!("unshare (package util-linux) cannot be run: {error}"))?;
    match tried.status.success() {
        true => Ok(()),
        false => Err(format!(
            "no namespace can be made ({}); run the tests as root, or allow user namespaces",
            String::from_utf8_lossy(&tried.stderr).trim()
        )),
    }
}

/// Mounts and network of its own; all that runs in it ends with it.
fn unshare() -> Command {
    let mut command = Command::new("unshare");
    command.args(["--mount", "--net", "--pid", "--fork", "--kill-child"]);
    // The owner of one's own process is oneself.
    let user = std::fs::metadata("/proc/self").expect("/proc").uid();
    if user != 0 {
        command.arg("--map-root-user");
    }
    command
}

/// Lays the unpacked `/usr` over the system's (what an administrator put there stays), wakes the
/// loopback, and runs the rest of the arguments.
const ENTER: &str = r#"
set -e
root=$1
shift
if [ -n "$root" ]; then
    for kept in local src; do
        if [ -d "/usr/$kept" ]; then
            mkdir -p "$root/usr/$kept"
            mount --rbind "/usr/$kept" "$root/usr/$kept"
        fi
    done
    mount --rbind "$root/usr" /usr
fi
/usr/sbin/ip link set lo up
exec "$@"
"#;

fn run_inside(name: &str, root: Option<&Path>) {
    let folder = tempfile::tempdir().expect("a folder for the rig");
    let at = |part: &str| folder.path().join(part);
    std::fs::create_dir_all(at("config/monado")).expect("a folder in the rig's");
    std::fs::DirBuilder::new()
        .mode(0o700)
        .create(at("run"))
        .expect("a folder in the rig's");
    let config =
        format!(r#"{{"active":"remote","remote":{{"version":0,"port":{PORT},"view_count":2}}}}"#);
    std::fs::write(at("config/monado/config_v0.json"), config).expect("a file in the rig's");
    let drivers = root.map_or(PathBuf::from(DRIVERS), |root| {
        root.join(DRIVERS.trim_start_matches('/'))
    });
    let status = unshare()
        .args(["sh", "-c", ENTER, "sh"])
        .arg(root.unwrap_or(Path::new("")))
        .arg(std::env::current_exe().expect("this test's program"))
        .args(["--exact", name, "--nocapture"])
        .env(FOLDER, folder.path())
        .env("XDG_RUNTIME_DIR", at("run"))
        .env("XDG_CONFIG_HOME", at("config"))
        .env("XR_RUNTIME_JSON", MANIFEST)
        .env("VK_DRIVER_FILES", software_driver(&drivers))
        .env("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation")
        .env("XR_CORE_VALIDATION_EXPORT_TYPE", "text")
        .env("XR_CORE_VALIDATION_FILE_NAME", at("validation.txt"))
        .env("XRT_COMPOSITOR_NULL", "1")
        .env("XRT_NO_STDIN", "1")
        .stdin(Stdio::null())
        .status()
        .expect("unshare runs");
    let log = std::fs::read_to_string(at("monado.log")).unwrap_or_default();
    assert!(
        status.success(),
        "{name} failed in the rig ({status}); Monado's log:\n{log}"
    );
    assert!(at("entered").exists(), "there is no test {name}");
}

/// The manifest in `folder`, as the rig will see it.
fn software_driver(folder: &Path) -> PathBuf {
    let name = std::fs::read_dir(folder)
        .expect("the folder of Vulkan's drivers")
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .find(|name| name.starts_with("lvp_icd"))
        .expect("Mesa's software driver beside Monado");
    Path::new(DRIVERS).join(name)
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
        self.service = Some(service);
        // Its socket is there before it listens; its word that it has started comes after.
        until("monado-service listens", || {
            (self.starts() > before).then_some(())
        });
    }

    /// How often a service has said that it has started.
    fn starts(&self) -> usize {
        let log = std::fs::read_to_string(self.folder.join("monado.log")).unwrap_or_default();
        log.matches("service has started").count()
    }

    /// Kills the service, as a crash would: its clients lose their instance.
    ///
    /// # Panics
    /// Where it is not running.
    pub fn kill(&mut self) {
        let mut service = self.service.take().expect("the service runs");
        service.kill().expect("the service can be killed");
        service.wait().expect("the service ends");
    }

    /// A hold on head and hands.
    ///
    /// # Panics
    /// Where the remote driver does not answer.
    #[must_use]
    pub fn remote(&self) -> Remote {
        Self::remote_here()
    }

    /// The same for a process that a test has started in its rig.
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

    /// What the core validation layer has objected to so far.
    fn objections(&self) -> Vec<String> {
        let said = std::fs::read_to_string(self.folder.join("validation.txt")).unwrap_or_default();
        let (greetings, objections): (Vec<_>, Vec<_>) = said
            .lines()
            .map(str::to_owned)
            // Its coming and going.
            .partition(|line| line.contains("VALID_DEBUG | VUID-CoreValidation-"));
        assert!(
            !greetings.is_empty() || std::thread::panicking(),
            "OpenXR's core validation layer was not loaded"
        );
        objections
    }
}

impl Drop for Rig {
    fn drop(&mut self) {
        if let Some(mut service) = self.service.take() {
            let _ = service.kill();
            let _ = service.wait();
        }
        let objections = self.objections();
        if std::thread::panicking() {
            // A second panic would hide the first.
            eprintln!("OpenXR's core validation layer says: {objections:#?}");
            return;
        }
        assert!(
            objections.is_empty(),
            "OpenXR's core validation layer says: {objections:#?}"
        );
    }
}
