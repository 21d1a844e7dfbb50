//! Errors of a track.

use std::path::PathBuf;

use crate::files::FileError;

/// A track that cannot be read, written or converted. Each message names the file, the place
/// in it, and what would be right.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TrackError {
    /// The operating system refused.
    #[error("{file}: cannot {action}: {source}", file = file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// The action that failed.
        action: &'static str,
        /// The system's error.
        source: std::io::Error,
    },
    /// The path is no file, or the file is too long or cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The output is there already.
    #[error(
        "{file}: exists and is not overwritten; name another or take that one away",
        file = file.display()
    )]
    Exists {
        /// The file.
        file: PathBuf,
    },
    /// Too much waits for the disk, so that a frame was not taken.
    #[error("{file}: the disk is full, and what waits for it fills its memory; make room", file = file.display())]
    Full {
        /// The file.
        file: PathBuf,
    },
    /// The file is no MCAP file, or a damaged one.
    #[error(
        "{file}: {problem} ({place}); a pose track is an intact MCAP file: copy or record it again",
        file = file.display()
    )]
    Container {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        problem: String,
        /// How far the file could be read.
        place: String,
    },
    /// Other bytes follow the file's end. Without them it may be whole.
    #[error(
        "{file}: has {bytes} {noun} after its end, at byte {end}, and may be whole without; copy it again, or cut it there, \
         such as by `head -c {end}`",
        file = file.display(),
        noun = if *bytes == 1 { "byte" } else { "bytes" }
    )]
    Tail {
        /// The file.
        file: PathBuf,
        /// How many there are.
        bytes: usize,
        /// Length of the file without them.
        end: usize,
    },
    /// The file may be intact, and its chunks have a compression that is not read.
    #[error(
        "{file}: its chunks are compressed as {found:?}, and lz4, zstd and uncompressed ones are read; have the program that \
         wrote it use one of these, or convert it with the MCAP tool: mcap compress --compression zstd INPUT -o OUTPUT",
        file = file.display()
    )]
    Compression {
        /// The file.
        file: PathBuf,
        /// Name of the compression, cut where it is long.
        found: String,
    },
    /// A topic or record that each track has is not there.
    #[error("{file}: no {what}; {expected}", file = file.display())]
    Missing {
        /// The file.
        file: PathBuf,
        /// What is missing.
        what: String,
        /// What would be right.
        expected: String,
    },
    /// A topic's messages are of another schema.
    #[error(
        "{file}: topic {topic} holds {found}; it must hold {expected}",
        file = file.display()
    )]
    Schema {
        /// The file.
        file: PathBuf,
        /// The topic.
        topic: String,
        /// Schema and encoding found.
        found: String,
        /// Schema that the topic has in each track, and its encodings.
        expected: String,
    },
    /// A message has an invalid value.
    #[error("{file}: {place}: {field} {problem}; {expected}", file = file.display())]
    Message {
        /// The file.
        file: PathBuf,
        /// Topic, step (the message's sequence number) and time on the track's clock.
        place: String,
        /// The field.
        field: String,
        /// What is wrong with it.
        problem: String,
        /// What would be right.
        expected: String,
    },
    /// The metadata record has an invalid value.
    #[error("{file}: metadata: {field} {problem}; {expected}", file = file.display())]
    Metadata {
        /// The file.
        file: PathBuf,
        /// The field.
        field: String,
        /// What is wrong with it.
        problem: String,
        /// What would be right.
        expected: String,
    },
    /// A keyframe file is no TOML, lacks a key or has one that does not exist.
    #[error("{file}: {message}", file = file.display())]
    KeyframeSyntax {
        /// The file.
        file: PathBuf,
        /// Line, column, the line itself and what was expected.
        message: String,
    },
    /// A keyframe file has an invalid value.
    #[error("{file}:{line}: {field} {problem}; {expected}", file = file.display())]
    Keyframe {
        /// The file.
        file: PathBuf,
        /// Line in the file, from 1.
        line: usize,
        /// The field.
        field: String,
        /// What is wrong with it.
        problem: String,
        /// What would be right.
        expected: String,
    },
    /// The name is neither a built-in track's nor a file.
    #[error("{name}: neither a file nor a built-in track; {known}")]
    Unknown {
        /// The name that was asked for.
        name: String,
        /// The built-in track that may be meant, and all of them.
        known: String,
    },
}
