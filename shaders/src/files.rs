//! Where the WGSL files are.

use std::io;
use std::path::{Path, PathBuf};

/// The folders under `wgsl`: those of `common` are only included, the others hold a shader a file.
pub const FOLDERS: [&str; 13] = [
    "common/maths",
    "common/liquid",
    "common/chemistry",
    "common/glass",
    "common/picture",
    "sim",
    "render",
    "render/fluid",
    "render/hands",
    "render/spheres",
    "render/spray",
    "panel",
    "mirror",
];

/// The WGSL files under `root`: path relative to it (with forward slashes) and full path, sorted.
/// A folder that does not exist is empty.
///
/// # Errors
/// An I/O error while reading a folder that exists.
pub fn list(root: &Path) -> io::Result<Vec<(String, PathBuf)>> {
    let mut files = Vec::new();
    for folder in FOLDERS {
        let entries = match std::fs::read_dir(root.join(folder)) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
            Err(error) => return Err(error),
        };
        for entry in entries {
            let path = entry?.path();
            if path.extension().is_none_or(|extension| extension != "wgsl") {
                continue;
            }
            if let Some(name) = path.file_name().and_then(|name| name.to_str()) {
                files.push((format!("{folder}/{name}"), path));
            }
        }
    }
    files.sort();
    Ok(files)
}
