//! What may not be looked at is not taken for absent: the system's own cause is told.

use std::os::unix::fs::symlink;

use super::{VITRIOL, text};

/// A link to itself, which nobody may follow, as a folder to which this user has no right: who runs the tests may have every right.
#[test]
fn what_cannot_be_looked_at_is_not_called_absent() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    for name in ["x.mcap", "x.toml", "x.sqlite"] {
        symlink(name, here.join(name)).unwrap();
    }
    for line in [
        "track x.mcap",
        "replay two-flasks --no-video --scene x.toml",
        "lesson x.toml",
        "grade --scene two-flasks x.mcap",
        "forget p01 --class x.sqlite",
    ] {
        let output = VITRIOL.run(here, line);
        let told = text(&output.stderr);
        assert_ne!(output.status.code(), Some(0), "{line}: {told}");
        assert!(told.contains("x."), "{line}: {told}");
        for absent in ["no such file", "neither a file", "Nothing is kept"] {
            assert!(!told.contains(absent), "{line}: {told}");
        }
    }
}
