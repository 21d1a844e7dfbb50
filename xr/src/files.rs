//! Files that a user names: read with a limit, and only where they are files.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// A file that is not read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// A folder, pipe, socket or device: the last three may never end.
    #[error("{file}: is {kind} and no file; name a file", file = file.display())]
    NotAFile {
        /// Its path.
        file: PathBuf,
        /// Its kind, such as "a folder".
        kind: &'static str,
    },
    /// The file is longer than any of its kind.
    #[error("{file}: is longer than {limit} bytes, which no {what} is; name another file", file = file.display())]
    TooLong {
        /// The file.
        file: PathBuf,
        /// The limit, B.
        limit: u64,
        /// The kind of file that was expected.
        what: &'static str,
    },
    /// The file is neither UTF-8 nor UTF-16 with its mark.
    #[error(
        "{file}: is no text in UTF-8, nor in UTF-16 with its byte order mark; save it as UTF-8, or name another file",
        file = file.display()
    )]
    NotText {
        /// The file.
        file: PathBuf,
    },
    /// The operating system refused.
    #[error("{file}: cannot be read: {source}; is it there, and may you read it?", file = file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// The system's error.
        source: io::Error,
    },
}

/// Whether nothing has that path. What may not be looked at may be there: opening it gives the cause.
pub fn is_absent(path: &Path) -> bool {
    matches!(path.try_exists(), Ok(false))
}

/// The contents of `file`, which is to be a `what` of at most `limit` bytes.
///
/// Its kind is checked before it is opened: opening a pipe waits for a writer, and a device may be endless. A user who puts a pipe in the
/// file's place between the two waits for it; an endless file is read up to the limit.
///
/// # Errors
/// [`FileError`] where `file` is no file, longer than `limit`, or cannot be read.
pub fn read(file: &Path, what: &'static str, limit: u64) -> Result<Vec<u8>, FileError> {
    let refused = |source| FileError::Io {
        file: file.into(),
        source,
    };
    let kind = fs::metadata(file).map_err(refused)?;
    if !kind.is_file() {
        return Err(FileError::NotAFile {
            file: file.into(),
            kind: if kind.is_dir() {
                "a folder"
            } else {
                "a pipe or device"
            },
        });
    }
    let too_long = || FileError::TooLong {
        file: file.into(),
        limit,
        what,
    };
    if kind.len() > limit {
        return Err(too_long());
    }
    let mut bytes = Vec::new();
    let opened = File::open(file).map_err(refused)?;
    opened
        .take(limit + 1)
        .read_to_end(&mut bytes)
        .map_err(refused)?;
    if bytes.len() as u64 > limit {
        return Err(too_long());
    }
    Ok(bytes)
}

/// The contents of `file` as text; [`read`] gives its bytes.
///
/// # Errors
/// As for [`read`], and [`FileError::NotText`].
pub fn read_text(file: &Path, what: &'static str, limit: u64) -> Result<String, FileError> {
    let bytes = read(file, what, limit)?;
    decoded(&bytes).ok_or_else(|| FileError::NotText { file: file.into() })
}

/// The one line of `file`, such as an address or a token, without the space and the line's end around it.
///
/// # Errors
/// As for [`read_text`].
pub fn read_line(file: &Path, what: &'static str) -> Result<String, FileError> {
    Ok(read_text(file, what, LINE)?.trim().to_owned())
}

/// Bytes of a file of one line. Our choice: a signed token has some thousands.
const LINE: u64 = 65_536;

/// The text of a file without its byte order mark; `None` where it is none. Windows' editors write the mark in UTF-8, and PowerShell's `>`
/// writes UTF-16 with it.
fn decoded(bytes: &[u8]) -> Option<String> {
    let utf_16 = |rest: &[u8], unit: fn([u8; 2]) -> u16| {
        let (pairs, half) = rest.as_chunks::<2>();
        let units: Vec<u16> = pairs.iter().map(|&pair| unit(pair)).collect();
        String::from_utf16(&units).ok().filter(|_| half.is_empty())
    };
    let text = match bytes {
        [0xff, 0xfe, rest @ ..] => utf_16(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => utf_16(rest, u16::from_be_bytes),
        [0xef, 0xbb, 0xbf, rest @ ..] => String::from_utf8(rest.to_vec()).ok(),
        _ => String::from_utf8(bytes.to_vec()).ok(),
    };
    // No text has it; UTF-16 without its mark is UTF-8 of such, where it has only letters of ASCII.
    text.filter(|text| !text.contains('\0'))
}

/// How alike a name is to what may be meant by it: clap's measure and bound for options and commands.
const ALIKE: f64 = 0.7;

/// The built-in name that a user's `name` is most like, if it is like any.
pub fn alike<'b>(name: &str, builtin: &[&'b str]) -> Option<&'b str> {
    let alike = builtin.iter().map(|it| (strsim::jaro(name, it), *it));
    let nearest = alike.max_by(|a, b| a.0.total_cmp(&b.0));
    nearest.filter(|(alike, _)| *alike > ALIKE).map(|it| it.1)
}

/// For the error where a user's `name` is neither a file's nor built in: the built-in one that it is most like, if it is like any, and
/// all of them.
pub fn suggested(name: &str, builtin: &[&str]) -> String {
    let meant = alike(name, builtin);
    let meant = meant.map_or_else(String::new, |it| format!("did you mean {it}? "));
    format!("{meant}built in are {}", builtin.join(", "))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_name_is_answered_with_the_nearest() {
        let said = |name| suggested(name, &["two-flasks", "three-flasks", "dilute"]);
        let all = "built in are two-flasks, three-flasks, dilute";
        assert_eq!(said("two-flask"), format!("did you mean two-flasks? {all}"));
        assert_eq!(said("dilutte"), format!("did you mean dilute? {all}"));
        for other in ["", "my/recording.mcap", "x"] {
            assert_eq!(said(other), all, "{other}");
        }
    }

    #[test]
    fn a_file_is_read_up_to_its_limit() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("x");
        fs::write(&file, "12345").unwrap();
        assert_eq!(read(&file, "scene", 5).unwrap(), b"12345");
        let message = read(&file, "scene", 4).unwrap_err().to_string();
        assert!(message.contains("longer than 4 bytes"), "{message}");
        assert!(matches!(
            read(&folder.path().join("y"), "scene", 4),
            Err(FileError::Io { .. })
        ));
    }

    #[test]
    fn a_text_has_the_encodings_that_editors_write() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("x");
        let text = "ä😀 b\r\n";
        for bytes in vitriol_tests::editors::encodings(text) {
            fs::write(&file, bytes).unwrap();
            assert_eq!(read_text(&file, "scene", 99).unwrap(), text);
            assert_eq!(read_line(&file, "token").unwrap(), "ä😀 b");
        }
        // No UTF-8; half a unit; half of a surrogate's pair; UTF-16 without a mark, in both orders.
        for bytes in [
            &[0xff][..],
            &[0xff, 0xfe, b'a'],
            &[0xff, 0xfe, 0x3d, 0xd8],
            &[0xe4, 0, b'b', 0],
            &[b'a', 0, b'b', 0],
            &[0, b'a', 0, b'b'],
        ] {
            fs::write(&file, bytes).unwrap();
            let error = read_text(&file, "scene", 99).unwrap_err();
            assert!(matches!(error, FileError::NotText { .. }), "{bytes:?}");
            let said = error.to_string();
            assert!(said.contains("x: ") && said.contains("UTF-8"), "{said}");
        }
    }

    /// A pipe that nobody writes to would keep whoever opens it waiting for ever.
    #[cfg(unix)]
    #[test]
    fn folders_pipes_and_devices_are_not_opened() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.unwrap().success());
        for (path, kind) in [
            (folder.path(), "a folder"),
            (&pipe, "a pipe"),
            (Path::new("/dev/zero"), "device"),
        ] {
            let message = read(path, "track", 4).unwrap_err().to_string();
            assert!(message.contains(kind), "{message}");
        }
    }
}
