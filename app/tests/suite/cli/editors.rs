//! Short files as editors write them: whichever encoding a file has, the program reads what is in it.

use std::fs;
use std::path::Path;

use vitriol_tests::editors::encodings;

use super::{VITRIOL, object, refuses, text};

/// Writes a file that its owner alone may read, as a token's has to be.
fn write(file: &Path, bytes: Vec<u8>) {
    fs::write(file, bytes).unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        fs::set_permissions(file, fs::Permissions::from_mode(0o600)).unwrap();
    }
}

#[test]
fn addresses_tokens_and_lessons_have_any_encoding_of_an_editor() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let hub = format!("lab-pc:8443#{}.{}\r\n", "0f".repeat(32), "a1".repeat(16));
    let to_hub = ["replay", "two-flasks", "--hub", "hub.txt"];
    for bytes in encodings(&hub) {
        write(&here.join("hub.txt"), bytes);
        // The address is one, and of no use without a console.
        refuses(here, &to_hub, 2, &["give --live"]);
    }
    let mut to_lrs = vec!["replay", "two-flasks", "--pseudonym", "p07"];
    to_lrs.extend(["--class", "class.sqlite", "--lrs-token", "token"]);
    to_lrs.extend(["--lrs", "http://127.0.0.1:9/xAPI"]);
    for bytes in encodings("nonsense\r\n") {
        write(&here.join("token"), bytes);
        refuses(here, &to_lrs, 2, &["token: holds no token"]);
    }
    let lesson = VITRIOL.run(here, &["lesson", "dilute", "--toml"]);
    for bytes in encodings(text(&lesson.stdout)) {
        write(&here.join("own.toml"), bytes);
        assert_eq!(object(here, &["lesson", "own.toml"])["points"], 100);
    }
}

/// Each message names the file and what would be right.
#[test]
fn a_short_file_that_is_no_text_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    write(&here.join("bytes"), vec![0xc3, 0x28]);
    write(&here.join("long"), vec![b'#'; (1 << 20) + 1]);
    write(&here.join("nothing"), Vec::new());
    let hub = ["replay", "two-flasks", "--hub"];
    for (file, parts) in [
        ("bytes", ["bytes", "save it as UTF-8"]),
        ("long", ["long", "longer than"]),
    ] {
        refuses(here, &["lesson", file], 2, &parts);
        refuses(here, &[&hub[..], &[file]].concat(), 2, &parts);
    }
    let parts = ["nothing", "HOST:PORT#FINGERPRINT.KEY"];
    refuses(here, &[&hub[..], &["nothing"]].concat(), 2, &parts);
}
