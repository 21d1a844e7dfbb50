//! Where results go: nothing half-written, nothing overwritten.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

pub use png::ColorType;
use serde::Serialize;
use tempfile::NamedTempFile;

use crate::failure::{Blame, Cause, Failure};

/// The report's name in the output folder; it is written last, so a folder
/// that holds it is a whole run.
pub const REPORT_JSON: &str = "report.json";
/// The readable report's name in the output folder.
pub const REPORT_HTML: &str = "report.html";
/// The name of the table of incidents in the output folder.
pub const INCIDENTS_CSV: &str = "incidents.csv";
/// The name of the file of statements on attempts for other programs, where one is written.
pub const STATEMENTS: &str = "statements.jsonl";
/// The film's name in the output folder.
pub const FILM: &str = "film.mp4";
/// Names of the pictures that stand for film and film of temperature until they are played.
pub const POSTERS: [&str; 2] = ["film.png", "film-temperature.png"];
/// The name of the film coloured by temperature.
pub const FILM_TEMPERATURE: &str = "film-temperature.mp4";
/// The name of the film of two scenes side by side.
pub const COMPARE_FILM: &str = "compare.mp4";
/// The name of the same as an animated picture.
pub const COMPARE_PICTURE: &str = "compare.gif";
/// The name of what was measured in both; it is written last.
pub const COMPARE_JSON: &str = "compare.json";

/// What can go wrong with the place of the results.
#[derive(Debug, thiserror::Error)]
enum OutputError {
    /// The folder holds an earlier run's results.
    #[error(
        "--out {dir}: holds {found} of an earlier run, which is not overwritten; name another folder or take that one away"
    )]
    Taken {
        dir: PathBuf,
        /// The file that was found in it.
        found: &'static str,
    },
    /// The folder asked for is a file.
    #[error("--out {dir}: is not a folder; name a folder, which may be new")]
    NotAFolder { dir: PathBuf },
    /// The file or folder exists already.
    #[error("{path}: exists and is not overwritten; name another or take that one away")]
    Exists { path: PathBuf },
    /// The system refused.
    #[error("{path}: could not be written; is there room and permission?")]
    Write {
        path: PathBuf,
        /// The system's error, or that of a format's writer.
        source: Cause,
    },
}

impl OutputError {
    fn write(path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        if source.kind() == io::ErrorKind::AlreadyExists {
            Self::Exists { path }
        } else {
            let source = source.into();
            Self::Write { path, source }
        }
    }
}

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        match error {
            OutputError::Write { .. } => Self::Other(error.into()),
            _ => Self::Input(error.into()),
        }
    }
}

/// Makes of an error in writing the file at `path` a failure that names it, as every writer's does: the system's own error names no
/// file.
pub fn unwritten<E: Into<Cause>>(path: &Path) -> impl FnOnce(E) -> Failure {
    let path = path.to_owned();
    move |error| {
        let source = error.into();
        OutputError::Write { path, source }.into()
    }
}

/// Makes a folder where there is none.
///
/// # Errors
/// [`Failure::Input`] where a file has its name, else [`Failure::Other`].
pub fn make_folder(path: &Path) -> Result<(), Failure> {
    Ok(fs::create_dir_all(path).map_err(|source| OutputError::write(path, source))?)
}

/// What the name of a file begins and ends with that nobody can read before it is whole.
const HIDDEN: [&str; 2] = [".vitriol-", ".part"];

/// A file that is written under a temporary name in its own folder and gets its
/// name when it is whole. Dropped before that, it is removed.
#[derive(Debug)]
pub struct Staged {
    file: NamedTempFile<File>,
    /// The path that the file will have.
    pub path: PathBuf,
}

impl Staged {
    /// Begins the file that will be found at `path`.
    ///
    /// # Errors
    /// `AlreadyExists` where `path` exists, else an error of the system.
    pub fn create(path: &Path) -> io::Result<Self> {
        Self::begin(path, HIDDEN)
    }

    /// Begins one that can be read before it is whole: its name until then is that of `path` with `unfinished` in it, so that it is found
    /// where the program is killed.
    ///
    /// # Errors
    /// As for [`Staged::create`].
    pub fn unfinished(path: &Path) -> io::Result<Self> {
        let mut before = path.file_stem().unwrap_or_default().to_owned();
        before.push("-unfinished-");
        let mut after = OsString::from(".");
        after.push(path.extension().unwrap_or_default());
        Self::begin(path, [&before, &after])
    }

    fn begin<S: AsRef<OsStr>>(path: &Path, name: [S; 2]) -> io::Result<Self> {
        if path.symlink_metadata().is_ok() {
            return Err(io::ErrorKind::AlreadyExists.into());
        }
        Ok(Self {
            file: Self::temporary(path, name)?,
            path: path.to_owned(),
        })
    }

    /// An empty file of another name, which begins and ends like that, beside `path`.
    fn temporary<S: AsRef<OsStr>>(
        path: &Path,
        [before, after]: [S; 2],
    ) -> io::Result<NamedTempFile<File>> {
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        tempfile::Builder::new()
            .prefix(&before)
            .suffix(&after)
            // Not tempfile's own way of opening, which lets nobody but the
            // owner read the file that it becomes.
            .make_in(folder, |path| File::create_new(path))
    }

    /// Writes more of the file.
    ///
    /// # Errors
    /// [`Failure::Other`] where the system refuses.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        let written = self.file.as_file().write_all(bytes);
        written.map_err(unwritten(&self.path))
    }

    /// A second handle to the file being written.
    ///
    /// # Errors
    /// An error of the system.
    pub fn try_clone(&self) -> io::Result<File> {
        self.file.as_file().try_clone()
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// `AlreadyExists` where a file of that name has appeared meanwhile, which
    /// is kept; else an error of the system.
    pub fn keep(self) -> io::Result<()> {
        self.file.as_file().sync_all()?;
        self.file.persist_noclobber(&self.path)?;
        Ok(())
    }

    /// One on a disk that is full.
    #[cfg(all(test, target_os = "linux"))]
    pub(crate) fn on_full_disk(path: &Path) -> io::Result<Self> {
        let full = File::options().write(true).open("/dev/full")?;
        let beside = tempfile::TempPath::try_from_path(path.with_extension("part"))?;
        Ok(Self {
            file: NamedTempFile::from_parts(full, beside),
            path: path.to_owned(),
        })
    }
}

/// The path of a file that a command will write at its end into a folder,
/// which may be new; asked for at its start, so that a long run does not end
/// in a refusal.
///
/// # Errors
/// [`Failure::Input`] where the file exists or the folder is a file.
pub fn new_file(dir: &Path, name: &str) -> Result<PathBuf, Failure> {
    let path = dir.join(name);
    if path.symlink_metadata().is_ok() {
        return Err(OutputError::Exists { path }.into());
    }
    if dir.symlink_metadata().is_ok() && !dir.is_dir() {
        let dir = dir.to_owned();
        return Err(OutputError::NotAFolder { dir }.into());
    }
    Ok(path)
}

/// Those of several files in the folder that `--out` names; `None` without one.
///
/// # Errors
/// As for [`new_file`].
pub fn new_files<const N: usize>(
    dir: Option<&Path>,
    names: [&str; N],
) -> Result<Option<[PathBuf; N]>, Failure> {
    let Some(dir) = dir else { return Ok(None) };
    for name in names {
        new_file(dir, name)?;
    }
    Ok(Some(names.map(|name| dir.join(name))))
}

/// Likewise refuses a folder that exists, which a command is to make at its end.
///
/// # Errors
/// [`Failure::Input`] where it exists.
pub fn new_dir(path: &Path) -> Result<(), Failure> {
    if path.symlink_metadata().is_ok() {
        let path = path.to_owned();
        return Err(OutputError::Exists { path }.into());
    }
    Ok(())
}

/// Writes a whole new file at once, by way of [`Staged`], and its folder where
/// there is none.
///
/// # Errors
/// [`Failure::Input`] where the file exists, else [`Failure::Other`].
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let write = || {
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        let staged = Staged::create(path)?;
        staged.file.as_file().write_all(bytes)?;
        staged.keep()
    };
    Ok(write().map_err(|source| OutputError::write(path, source))?)
}

/// Writes a file whole, in place of one of an earlier call or as a new one: a reader finds the one or the other.
///
/// # Errors
/// [`Failure::Other`] where the system refuses.
pub fn write_over(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let write = || {
        let file = Staged::temporary(path, HIDDEN)?;
        file.as_file().write_all(bytes)?;
        file.as_file().sync_all()?;
        file.persist(path)?;
        Ok(())
    };
    Ok(write().map_err(|source| OutputError::write(path, source))?)
}

/// Writes an object as JSON to a whole new file, by way of [`write_new`].
///
/// # Errors
/// As for [`write_new`].
pub fn write_json(path: &Path, object: &impl Serialize) -> Result<(), Failure> {
    write_new(path, &serde_json::to_vec_pretty(object).other()?)
}

/// A picture of `[width, height]` pixels as PNG: a byte a channel, rows from the top.
///
/// # Errors
/// [`Failure::Other`] where the bytes are not as many as that.
pub fn png(
    pixels: &[u8],
    [width, height]: [u32; 2],
    colour: ColorType,
) -> Result<Vec<u8>, Failure> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(colour);
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header().other()?;
    writer.write_image_data(pixels).other()?;
    writer.finish().other()?;
    Ok(file)
}

/// The folder of one run's results.
///
/// Dropped before [`OutDir::complete`], because the run failed, it takes away
/// again what it holds of the run, and the folder too where it made it.
#[derive(Debug)]
pub struct OutDir {
    /// The folder.
    pub path: PathBuf,
    made: bool,
    files: Vec<PathBuf>,
}

impl OutDir {
    /// Takes the folder that the user named, which may be new, or else the
    /// first free `out/<stem>-<number>`.
    ///
    /// # Errors
    /// [`Failure::Input`] for a folder with an earlier run's results or a file
    /// of its name, else [`Failure::Other`].
    pub fn take(named: Option<&Path>, stem: &str) -> Result<Self, Failure> {
        Ok(match named {
            Some(path) => Self::named(path),
            None => Self::numbered(Path::new("out"), stem),
        }?)
    }

    /// The path of a file in the folder.
    pub fn join(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a whole new file into the folder.
    ///
    /// # Errors
    /// As for [`write_new`].
    pub fn write(&mut self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        let path = self.join(name);
        write_new(&path, bytes)?;
        self.adopt(path);
        Ok(())
    }

    /// Begins a file that is written bit by bit.
    ///
    /// # Errors
    /// As for [`write_new`].
    pub fn stage(&self, name: &str) -> Result<Staged, Failure> {
        let path = self.join(name);
        Ok(Staged::create(&path).map_err(|source| OutputError::write(&path, source))?)
    }

    /// Gives a file that [`OutDir::stage`] began its name, and counts it among the run's.
    ///
    /// # Errors
    /// As for [`write_new`].
    pub fn keep(&mut self, staged: Staged) -> Result<(), Failure> {
        let path = staged.path.clone();
        let kept = staged.keep();
        kept.map_err(|source| OutputError::write(&path, source))?;
        self.adopt(path);
        Ok(())
    }

    /// Counts a file that someone else wrote into the folder among the run's.
    pub fn adopt(&mut self, file: PathBuf) {
        self.files.push(file);
    }

    /// How many files of the run it holds, and how many bytes they have.
    ///
    /// # Errors
    /// [`Failure::Other`] where one cannot be looked at any more.
    pub fn sizes(&self) -> Result<(usize, u64), Failure> {
        let mut bytes = 0;
        for file in &self.files {
            bytes += fs::metadata(file).map_err(unwritten(file))?.len();
        }
        Ok((self.files.len(), bytes))
    }

    /// The run is whole: all stays.
    pub fn complete(mut self) {
        self.files.clear();
    }

    fn new(path: PathBuf, made: bool) -> Self {
        Self {
            path,
            made,
            files: Vec::new(),
        }
    }

    fn named(path: &Path) -> Result<Self, OutputError> {
        let dir = path.to_owned();
        if path.is_dir() {
            let files = [
                REPORT_JSON,
                REPORT_HTML,
                INCIDENTS_CSV,
                STATEMENTS,
                FILM,
                FILM_TEMPERATURE,
                COMPARE_FILM,
                COMPARE_PICTURE,
                COMPARE_JSON,
            ];
            for found in files {
                if path.join(found).symlink_metadata().is_ok() {
                    return Err(OutputError::Taken { dir, found });
                }
            }
            return Ok(Self::new(dir, false));
        }
        if path.symlink_metadata().is_ok() {
            return Err(OutputError::NotAFolder { dir });
        }
        fs::create_dir_all(path).map_err(|source| OutputError::write(path, source))?;
        Ok(Self::new(dir, true))
    }

    fn numbered(parent: &Path, stem: &str) -> Result<Self, OutputError> {
        fs::create_dir_all(parent).map_err(|source| OutputError::write(parent, source))?;
        let mut number = 1u32;
        loop {
            let path = parent.join(format!("{stem}-{number:03}"));
            // Making the folder is what claims the number: two runs begun at
            // once get two folders.
            match fs::create_dir(&path) {
                Ok(()) => return Ok(Self::new(path, true)),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
                Err(source) => return Err(OutputError::write(&path, source)),
            }
        }
    }
}

impl Drop for OutDir {
    fn drop(&mut self) {
        for file in &self.files {
            // What cannot be taken away is at least a whole file.
            let _ = fs::remove_file(file);
        }
        if self.made {
            // Succeeds on an empty folder only, which is the intention.
            let _ = fs::remove_dir(&self.path);
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// The system's error says that there is no space, and not for what.
    #[test]
    fn a_full_disk_is_said_with_the_files_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("particles.vtu.series");
        let staged = Staged::on_full_disk(&path).unwrap();
        let failure = staged.write(b"[").unwrap_err();
        assert!(matches!(failure, Failure::Other(_)), "{failure}");
        let said = failure.to_string();
        for part in ["particles.vtu.series", "is there room", "No space left"] {
            assert!(said.contains(part), "{said}");
        }
    }

    #[test]
    fn what_is_in_the_way_of_a_file_or_folder_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let mut out = OutDir::take(Some(folder.path()), "x").unwrap();
        let staged = out.stage("measurements.csv").unwrap();
        fs::create_dir(out.join("measurements.csv")).unwrap();
        let said = out.keep(staged).unwrap_err().to_string();
        assert!(said.contains("measurements.csv: exists"), "{said}");
        let file = folder.path().join("grades");
        fs::write(&file, "").unwrap();
        let said = make_folder(&file).unwrap_err().to_string();
        assert!(said.contains("grades: exists"), "{said}");
        let said = make_folder(&file.join("class")).unwrap_err().to_string();
        assert!(said.contains("class: could not be written"), "{said}");
    }
}
