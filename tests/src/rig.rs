//! The environment in which tests of OpenXR run: OpenXR's loader with its core validation layer and the software Vulkan driver, in a
//! network of its own.
//!
//! All of it, and Monado, is taken from the system where Monado is installed, else from Debian 13's packages, which `./lab setup` unpacks
//! into the user's cache. A program that uses it must share its C library and its Vulkan driver, so the unpacked `/usr` is laid over the
//! system's, in a mount namespace: a test starts itself again in there (see [`enter`]), and processes that it starts are in there too.

use std::fs::File;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::installed::not_tested;

/// Environment variable with the rig's folder, for the test that runs in it.
const FOLDER: &str = "VITRIOL_RIG";
/// Monado's manifest, of the system or laid over it.
pub(crate) const MANIFEST: &str = "/usr/share/openxr/1/openxr_monado.json";
/// The software driver's manifest.
const DRIVERS: &str = "/usr/share/vulkan/icd.d";
/// File of the core validation layer's messages, in the rig's folder.
const SAID: &str = "validation.txt";

/// Runs the test `name` (module path and function, as the test's own runner knows it) in the rig: returns the rig's folder in the process
/// that runs there, and `None` in the one outside, where the test is over then. Before it starts, `prepare` fills the folder and returns
/// environment variables in addition to those of every rig; where the test fails, the text of `log` is added to the message.
///
/// Where there can be no rig, a message goes to standard error and the test is over too.
///
/// # Panics
/// Where the test fails in the rig; where there can be no rig and `CI=true`.
pub(crate) fn enter(
    name: &str,
    prepare: impl FnOnce(&Path) -> Vec<(&'static str, PathBuf)>,
    log: impl FnOnce(&Path) -> String,
) -> Option<PathBuf> {
    if let Some(folder) = std::env::var_os(FOLDER) {
        let folder = PathBuf::from(folder);
        File::create(folder.join("entered")).expect("a file in the rig's folder");
        return Some(folder);
    }
    match root().and_then(|root| able().map(|()| root)) {
        Ok(root) => run_inside(name, root.as_deref(), prepare, log),
        Err(cause) => not_tested(&format!("no OpenXR for {name}: {cause}")),
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

/// The newest of the packages that are unpacked: the layer that dumps OpenXR's calls.
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

fn run_inside(
    name: &str,
    root: Option<&Path>,
    prepare: impl FnOnce(&Path) -> Vec<(&'static str, PathBuf)>,
    log: impl FnOnce(&Path) -> String,
) {
    let folder = tempfile::tempdir().expect("a folder for the rig");
    let environment = prepare(folder.path());
    let drivers = root.map_or(PathBuf::from(DRIVERS), |root| {
        root.join(DRIVERS.trim_start_matches('/'))
    });
    let status = unshare()
        .args(["sh", "-c", ENTER, "sh"])
        .arg(root.unwrap_or(Path::new("")))
        .arg(std::env::current_exe().expect("this test's program"))
        .args(["--exact", name, "--nocapture", "--include-ignored"])
        .env(FOLDER, folder.path())
        .env("VK_DRIVER_FILES", software_driver(&drivers))
        .env("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation")
        .env("XR_CORE_VALIDATION_EXPORT_TYPE", "text")
        .env("XR_CORE_VALIDATION_FILE_NAME", folder.path().join(SAID))
        .envs(environment)
        .stdin(Stdio::null())
        .status()
        .expect("unshare runs");
    assert!(
        status.success(),
        "{name} failed in the rig ({status}); {}",
        log(folder.path())
    );
    let entered = folder.path().join("entered").exists();
    assert!(entered, "there is no test {name}");
}

/// The manifest in `folder`, with the path that it has in the rig.
fn software_driver(folder: &Path) -> PathBuf {
    let name = std::fs::read_dir(folder)
        .expect("the folder of Vulkan's drivers")
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .find(|name| name.starts_with("lvp_icd"))
        .expect("Mesa's software driver beside Monado");
    Path::new(DRIVERS).join(name)
}

/// Objections of the core validation layer so far.
fn objections(folder: &Path) -> Vec<String> {
    let said = std::fs::read_to_string(folder.join(SAID)).unwrap_or_default();
    let (greetings, objections): (Vec<_>, Vec<_>) = said
        .lines()
        .map(str::to_owned)
        // Its messages of start and end.
        .partition(|line| line.contains("VALID_DEBUG | VUID-CoreValidation-"));
    assert!(
        !greetings.is_empty() || std::thread::panicking(),
        "OpenXR's core validation layer was not loaded"
    );
    objections
}

/// Fails where the core validation layer has objected to anything.
pub(crate) fn assert_silent(folder: &Path) {
    let objections = objections(folder);
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
