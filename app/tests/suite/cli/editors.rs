//! Short files as editors write them: whichever encoding a file has, the program reads what is in it.

use std::fs;
use std::path::Path;

use vitriol_tests::editors::encodings;

use super::{VITRIOL, text};

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
    for bytes in encodings(&hub) {
        write(&here.join("hub.txt"), bytes);
        // The address is one, and of no use without a console.
        VITRIOL.refuses(here, "replay two-flasks --hub hub.txt", &["give --live"]);
    }
    let to_lrs = "replay two-flasks --pseudonym p07 --class class.sqlite --lrs-token token --lrs http://127.0.0.1:9/xAPI";
    for bytes in encodings("nonsense\r\n") {
        write(&here.join("token"), bytes);
        VITRIOL.refuses(here, to_lrs, &["token: holds no token"]);
    }
    let lesson = VITRIOL.run(here, "lesson dilute --toml");
    for bytes in encodings(text(&lesson.stdout)) {
        write(&here.join("own.toml"), bytes);
        assert_eq!(VITRIOL.object(here, "lesson own.toml")["points"], 100);
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
    VITRIOL.refuses_each(
        here,
        "
lesson bytes => bytes; save it as UTF-8
replay two-flasks --hub bytes => bytes; save it as UTF-8
lesson long => long; longer than
replay two-flasks --hub long => long; longer than
replay two-flasks --hub nothing => nothing; HOST:PORT#FINGERPRINT.KEY
",
    );
}
