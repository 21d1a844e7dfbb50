//! Disks that are full: one for a while, a real one, of memory, and one for ever.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Output};

use vitriol_sim::scene::Scene;
use vitriol_tests::program::words;
use vitriol_xr::track::Track;

/// Mounts a disk of 512 kB, fills all of it but 64 kB, records until the program says that it waits, makes room, and
/// takes the recording away when the session has ended.
const SCRIPT: &str = r#"
set -eu
mkdir disk
mount -t tmpfs -o size=512k tmpfs disk
head -c 458752 /dev/zero > disk/filler
"$VITRIOL" vr --stand-in two-flasks --fixed --frames 120 --size 64x64 --no-mirror \
    --scene small.toml --record disk/x.mcap --json > session.json 2> session.log &
until grep -q 'waits for the disk' session.log; do
    kill -0 $! || { cat session.log; exit 1; }
    sleep 0.05
done
rm disk/filler
wait $!
cp disk/x.mcap x.mcap
"#;

/// In a mount namespace of its own, which root may make, and others with a user namespace around it; `None` where
/// neither is allowed.
fn in_own_namespace(folder: &Path) -> Option<Output> {
    let run = |flags: &str, script: &str| {
        let mut command = Command::new("unshare");
        command
            .args([flags, "sh", "-c", script])
            .current_dir(folder);
        command.env("VITRIOL", env!("CARGO_BIN_EXE_vitriol"));
        command.output().unwrap()
    };
    let mounts = |flags: &&str| run(flags, "mount -t tmpfs none /mnt").status.success();
    let flags = ["-m", "-rm"].into_iter().find(mounts)?;
    Some(run(flags, SCRIPT))
}

/// The system's error says that there is no space, and not for what. Help and version, which are printed before there is a command, are no
/// exception.
#[test]
fn standard_output_that_is_full_is_named() {
    let folder = tempfile::tempdir().unwrap();
    for line in [
        "--help",
        "-h",
        "--version",
        "help",
        "help vr",
        "replay --help",
        "scenes --version",
        "scenes",
        "track --list",
        "track two-flasks",
        "lesson",
        "lesson dilute",
        "lesson dilute --toml",
        "pages --out pages",
        "doctor",
    ] {
        for json in [None, Some("--json")] {
            let full = File::options().write(true).open("/dev/full").unwrap();
            let mut command = Command::new(env!("CARGO_BIN_EXE_vitriol"));
            command.args(json).args(words(line));
            let command = command.current_dir(folder.path()).stdout(full);
            let output = command.output().unwrap();
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(1), "{line}: {said}");
            for part in ["standard output: could not be written", "No space left"] {
                assert!(said.contains(part), "{line}: {said}");
            }
            let _ = fs::remove_dir_all(folder.path().join("pages"));
        }
    }
}

mod long {
    use super::*;

    #[test]
    fn a_disk_that_is_full_for_a_while_loses_no_step() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path();
        let small = Scene::builtin_text("two-flasks")
            .unwrap()
            .replacen("spacing = 0.0025 ", "spacing = 0.006 ", 1)
            .replacen("substeps = 10", "substeps = 4", 1);
        fs::write(here.join("small.toml"), &small).unwrap();
        let Some(output) = in_own_namespace(here) else {
            assert!(
                std::env::var("CI").as_deref() != Ok("true"),
                "no disk can be mounted here"
            );
            eprintln!("NOT TESTED: a full disk, which cannot be mounted here");
            return;
        };
        let log = fs::read_to_string(here.join("session.log")).unwrap_or_default();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{said}\n{log}");

        assert!(log.contains("No space left"), "{log}");
        assert!(log.contains("takes the recording again"), "{log}");
        let session = fs::read(here.join("session.json")).unwrap();
        let session: serde_json::Value = serde_json::from_slice(&session).unwrap();
        let recording = &session["recording"];
        assert_eq!(recording["steps"], session["steps"], "{recording}");
        assert_eq!(recording["unwritten"], 0);
        assert!(recording["cause"].is_null(), "{recording}");
        let track = Track::open(&here.join("x.mcap")).unwrap();
        assert!(!track.recovered);
        assert_eq!(track.holes().count(), 0);

        let replay = Command::new(env!("CARGO_BIN_EXE_vitriol"))
            .args(["replay", "x.mcap", "--no-video", "--json"])
            .current_dir(here)
            .output()
            .unwrap();
        let replayed: serde_json::Value = serde_json::from_slice(&replay.stdout).unwrap();
        assert_eq!(replayed["state_hash"], session["state_hash"]);
    }
}
