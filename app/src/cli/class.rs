//! Arguments of what a class needs: console and hub, what is kept of a student, grades.

use std::net::SocketAddr;
use std::path::PathBuf;

use clap::Args;
use vitriol_lesson::{Language, Mode};
use vitriol_live::listen_address;
use vitriol_record::Pseudonym;
use vitriol_record::lrs::Endpoint;
use vitriol_run::arguments::{preset, whole};
use vitriol_sim::scene::Preset;

use crate::command::grade::Tolerance;

/// Arguments of `vitriol grade`.
#[derive(Debug, Args)]
pub struct GradeArgs {
    /// Recordings (MCAP), or folders of them, also with a folder for each student; one that cannot be graded stops no other
    #[arg(required = true, value_name = "DIR|TRACK")]
    pub tracks: Vec<PathBuf>,
    /// A scene that they are graded by: a built-in one's name (see `vitriol scenes`) or a TOML file. Given several times, each
    /// track is graded by the one that it names; a track that was made with another is listed as such. Without it by the
    /// scenes of the lessons, or else by all built-in ones
    #[arg(long, value_name = "SCENE")]
    pub scene: Vec<String>,
    /// Likewise the preset; without it any will do
    #[arg(long, value_parser = preset())]
    pub preset: Option<Preset>,
    /// Judge this lesson too: a built-in one's name (see `vitriol lesson`) or a TOML file. Given several times, each track by
    /// the one that it names
    #[arg(long, value_name = "LESSON")]
    pub lesson: Vec<String>,
    /// As it is gone through: guided, free or examination; without it as the lesson says
    #[arg(long, value_name = "MODE", requires = "lesson")]
    pub mode: Option<Mode>,
    /// Language of what the table says of them, and of why a file is not graded: en, de, es or zh
    #[arg(long, value_name = "LANGUAGE", default_value_t)]
    pub language: Language,
    /// Tracks at a time; without it as many as there are cores, and one with --verify
    #[arg(long, value_name = "N", value_parser = whole::<u32>(1), allow_negative_numbers = true)]
    pub jobs: Option<u32>,
    /// Folder for a result of each track, and for grades.csv, grades.html and a page for each track, which are written anew
    /// each time; results that are there and of the same track, scene and preset are taken as they are
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Simulate each track again, and say whether what happens is what it says
    #[arg(long)]
    pub verify: bool,
    /// How far what happens on another device may be from what a track says: a moment, a share of a volume, and a volume
    /// beside that; without it 0.2,5,0.1
    #[arg(
        long,
        value_name = "S,%,ML",
        allow_hyphen_values = true,
        requires = "verify"
    )]
    pub tolerance: Option<Tolerance>,
    /// Device for that: its number or a part of its name (see `vitriol doctor`)
    #[arg(long, requires = "verify")]
    pub device: Option<String>,
    /// The class's file, which tells whose tracks they are; without it the names of the students' folders, the names that tracks
    /// were recorded with (`--name`), or the files' names stand for students
    #[arg(long, value_name = "FILE")]
    pub class: Option<PathBuf>,
    /// Grade what is whole of a track that breaks off or lacks steps
    #[arg(long)]
    pub accept_truncated: bool,
    /// Fail where one of the tracks cannot be read, for scripts; without it only where none is graded
    #[arg(long)]
    pub strict: bool,
}

/// Arguments of `vitriol forget`.
#[derive(Debug, Args)]
pub struct ForgetArgs {
    /// Whose attempts and statements are deleted: one word, such as p07
    #[arg(value_name = "PSEUDONYM")]
    pub pseudonym: Pseudonym,
    /// The class's file; without it the one in your folder for data
    #[arg(long, value_name = "FILE")]
    pub class: Option<PathBuf>,
}

/// What is kept of a student. Nothing is without a pseudonym.
#[derive(Args, Clone, Debug, Default)]
pub struct KeepArgs {
    /// Keep the attempts in the class's file under this pseudonym: one word, such as p07
    #[arg(long, value_name = "PSEUDONYM")]
    pub pseudonym: Option<Pseudonym>,
    /// The class's file; without it the one in your folder for data
    #[arg(long, value_name = "FILE", requires = "pseudonym")]
    pub class: Option<PathBuf>,
    /// Send the statements to this Learning Record Store: https, or http on this machine
    #[arg(long, value_name = "URL", requires_all = ["pseudonym", "lrs_token"])]
    pub lrs: Option<Endpoint>,
    /// File with its token, which you alone may read: `Bearer TOKEN`, `Basic BASE64` or `NAME:PASSWORD`
    #[arg(long, value_name = "FILE", requires = "lrs")]
    pub lrs_token: Option<PathBuf>,
}

/// Arguments of `vitriol hub`.
#[derive(Debug, Args)]
pub struct HubArgs {
    /// Where it listens, by HTTPS; 0.0.0.0:8470 for a class, localhost:8470 or 8470 for this computer alone
    #[arg(long, value_name = "ADDRESS:PORT", value_parser = listen_address, default_value = "127.0.0.1:8470")]
    pub listen: SocketAddr,
    /// Language of the page: en, de, es or zh. Titles of scenes and incidents are in that of the student's program
    #[arg(long, value_name = "LANGUAGE", default_value_t)]
    pub language: Language,
}
