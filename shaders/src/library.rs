//! The shaders a program runs with: those built in, or those on disk while they are written.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

use crate::check::{Checked, check};
use crate::compile::{Compiled, compile};
use crate::error::ShaderError;
use crate::files;
use crate::include::{Expanded, expand};
use crate::number::number_in;
use crate::reload::fits;
use crate::{EMBEDDED, ShaderId};

/// Shader sources, expanded and checked when first asked for, and compiled from there.
///
/// It can be shared between threads.
#[derive(Debug)]
pub struct Library {
    /// The folder that is watched, if one is.
    folder: Option<PathBuf>,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    /// Text by path relative to the `wgsl` folder, includes not expanded.
    files: BTreeMap<String, File>,
    /// The shaders that have been asked for so far.
    shaders: HashMap<ShaderId, Arc<Source>>,
}

#[derive(Debug)]
struct File {
    text: String,
    /// Time of change and size when it was read from disk.
    stamp: Option<(SystemTime, u64)>,
}

#[derive(Debug)]
struct Source {
    expanded: Expanded,
    checked: Checked,
}

impl Library {
    /// The shaders as they were when the program was built.
    pub fn embedded() -> Self {
        Self::from_sources(EMBEDDED.iter().copied())
    }

    /// In a build by the profile `dev` the files in this crate's `wgsl` folder, in any build the folder
    /// that the environment variable `VITRIOL_SHADERS` names; those built in where there is no
    /// such folder.
    pub fn watching() -> Self {
        if let Some(folder) = std::env::var_os("VITRIOL_SHADERS") {
            return Self::watching_at(folder);
        }
        if cfg!(watching) {
            return Self::watching_at(concat!(env!("CARGO_MANIFEST_DIR"), "/wgsl"));
        }
        Self::embedded()
    }

    /// The files under `folder` (laid out as this crate's `wgsl`), and built-in ones for those that are missing there.
    pub fn watching_at(folder: impl Into<PathBuf>) -> Self {
        let folder = folder.into();
        let mut library = Self::embedded();
        if folder.is_dir() {
            library.state().read_changed(&folder);
            library.folder = Some(folder);
        } else {
            tracing::warn!(
                "there is no shader folder {}: the built-in shaders serve",
                folder.display()
            );
        }
        library
    }

    /// Any files, by path relative to the `wgsl` folder.
    pub fn from_sources<P, T>(sources: impl IntoIterator<Item = (P, T)>) -> Self
    where
        P: Into<String>,
        T: Into<String>,
    {
        let file = |text: T| File {
            text: text.into(),
            stamp: None,
        };
        let files = sources.into_iter().map(|(p, t)| (p.into(), file(t)));
        Self {
            folder: None,
            state: Mutex::new(State {
                files: files.collect(),
                shaders: HashMap::new(),
            }),
        }
    }

    /// The value of the constant `name` of the file at `path`, which has a line `const NAME: f32 = NUMBER;`.
    ///
    /// # Errors
    /// [`ShaderError::UnknownShader`], [`ShaderError::NoNumber`].
    pub fn number(&self, path: &str, name: &str) -> Result<f64, ShaderError> {
        let state = self.state();
        Ok(number_in(path, text(&state.files, path), name)?.1)
    }

    /// This library with `times` the value of that constant, for all shaders that include the file. A watched file that changes on disk
    /// has its own value again.
    ///
    /// # Errors
    /// [`ShaderError::UnknownShader`], [`ShaderError::NoNumber`].
    pub fn with_number_times(
        self,
        path: &str,
        name: &str,
        times: f64,
    ) -> Result<Self, ShaderError> {
        let mut state = self.state();
        let (place, value) = number_in(path, text(&state.files, path), name)?;
        if let Some(file) = state.files.get_mut(path) {
            // Debug writes a decimal point or an exponent, without which WGSL would read an integer.
            file.text
                .replace_range(place, &format!("{:?}", times * value));
        }
        state.shaders.clear();
        drop(state);
        Ok(self)
    }

    /// The text of a shader with its includes in place.
    ///
    /// # Errors
    /// [`ShaderError::UnknownShader`], and [`ShaderError::Source`] where it is broken.
    pub fn source(&self, shader: &ShaderId) -> Result<String, ShaderError> {
        Ok(self.load(shader)?.expanded.text.clone())
    }

    /// Names of the override constants that a shader declares.
    ///
    /// # Errors
    /// [`ShaderError::UnknownShader`], and [`ShaderError::Source`] where it is broken.
    pub fn constants(&self, shader: &ShaderId) -> Result<Vec<String>, ShaderError> {
        let source = self.load(shader)?;
        let overrides = source.checked.module.overrides.iter();
        Ok(overrides.filter_map(|(_, o)| o.name.clone()).collect())
    }

    /// Compiles `entry` of `shader` with override constants by name (a Boolean as 0 or 1; what is
    /// not named has its default). Takes 0.05 to 0.3 ms in an optimised build once the shader has
    /// been loaded.
    ///
    /// # Errors
    /// Any [`ShaderError`].
    pub fn compile(
        &self,
        shader: &ShaderId,
        entry: &str,
        constants: &[(&str, f64)],
    ) -> Result<Compiled, ShaderError> {
        let source = self.load(shader)?;
        compile(shader.path(), &source.checked, entry, constants)
    }

    /// Looks for files that changed on disk since the last call, and takes up those shaders that
    /// have been asked for, changed and are sound. One that is broken, has lost an entry point or
    /// has given a buffer another layout keeps its old source, and the error is logged as a
    /// warning.
    ///
    /// Returns the shaders to compile anew. A call costs a `stat` for each file; without a
    /// watched folder it does nothing.
    pub fn changed(&self) -> Vec<ShaderId> {
        let Some(folder) = &self.folder else {
            return Vec::new();
        };
        let mut state = self.state();
        if !state.read_changed(folder) {
            return Vec::new();
        }
        let State { files, shaders } = &mut *state;
        let mut changed = Vec::new();
        for (id, current) in shaders.iter_mut() {
            match renew(files, id, current) {
                Ok(Some(source)) => {
                    *current = Arc::new(source);
                    changed.push(*id);
                }
                Ok(None) => {}
                Err(error) => tracing::warn!("the old {id} stays in use: {error}"),
            }
        }
        changed.sort();
        changed
    }

    fn load(&self, shader: &ShaderId) -> Result<Arc<Source>, ShaderError> {
        let mut state = self.state();
        if let Some(source) = state.shaders.get(shader) {
            return Ok(Arc::clone(source));
        }
        let source = match read_source(&state.files, shader) {
            Ok(source) => source,
            Err(error) if self.folder.is_some() => {
                tracing::warn!("the built-in {shader} is used: {error}");
                let built_in = |path: &str| EMBEDDED.iter().find(|e| e.0 == path).map(|e| e.1);
                checked_source(expand(shader.path(), &built_in).map_err(|_| error)?)?
            }
            Err(error) => return Err(error),
        };
        let source = Arc::new(source);
        state.shaders.insert(*shader, Arc::clone(&source));
        Ok(source)
    }

    /// Locks the sources. A panic elsewhere leaves them whole: each is replaced in one assignment.
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    /// Reads the files that are new or changed; returns whether any text differs. A file that cannot be read now (an editor is replacing
    /// it) keeps its text until it can.
    fn read_changed(&mut self, folder: &Path) -> bool {
        let mut changed = false;
        for (path, full) in files::list(folder).unwrap_or_default() {
            let stamp = std::fs::metadata(&full)
                .and_then(|meta| Ok((meta.modified()?, meta.len())))
                .ok();
            let known = self.files.get(&path);
            if stamp.is_none() || known.is_some_and(|file| file.stamp == stamp) {
                continue;
            }
            let Ok(text) = std::fs::read_to_string(&full) else {
                continue;
            };
            changed |= known.is_none_or(|file| file.text != text);
            self.files.insert(path, File { text, stamp });
        }
        changed
    }
}

fn read_source(files: &BTreeMap<String, File>, id: &ShaderId) -> Result<Source, ShaderError> {
    checked_source(expand(id.path(), &|path| text(files, path))?)
}

fn checked_source(expanded: Expanded) -> Result<Source, ShaderError> {
    let checked = check(&expanded)?;
    Ok(Source { expanded, checked })
}

fn text<'a>(files: &'a BTreeMap<String, File>, path: &str) -> Option<&'a str> {
    files.get(path).map(|file| file.text.as_str())
}

/// The shader's new source if its text differs from `current`.
fn renew(
    files: &BTreeMap<String, File>,
    id: &ShaderId,
    current: &Source,
) -> Result<Option<Source>, ShaderError> {
    let expanded = expand(id.path(), &|path| text(files, path))?;
    if expanded.text == current.expanded.text {
        return Ok(None);
    }
    let source = checked_source(expanded)?;
    fits(id.path(), &current.checked.module, &source.checked.module)?;
    Ok(Some(source))
}
