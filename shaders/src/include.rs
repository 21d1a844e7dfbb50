//! WGSL has no include: a line `//!include common/liquid/kernel.wgsl` is replaced by that file.
//!
//! Each file enters at most once, so that two included files may both include a third. The
//! origin of every line is kept, so that an error points at the file that a person wrote.

use crate::error::ShaderError;

const DIRECTIVE: &str = "//!include";

/// A shader's text with its includes in place.
#[derive(Clone, Debug)]
pub struct Expanded {
    /// The text that naga parses.
    pub text: String,
    files: Vec<String>,
    /// For each line of `text`: index into `files`, line there from 1.
    origins: Vec<(usize, u32)>,
}

impl Expanded {
    /// The original file and line (from 1) of a line (from 1) of the expanded text; the last
    /// line where the text has no such line.
    pub fn origin(&self, line: u32) -> (&str, u32) {
        let index = (line.max(1) as usize - 1).min(self.origins.len().saturating_sub(1));
        match self.origins.get(index) {
            Some(&(file, line)) => (&self.files[file], line),
            None => (&self.files[0], 1),
        }
    }
}

/// Expands the file at `path`. `read` gives a file's text by its path relative to the `wgsl`
/// folder.
///
/// # Errors
/// [`ShaderError::UnknownShader`] where `path` itself is missing, [`ShaderError::Source`] at the
/// include line that names a missing file, no file, or a file that is being included already.
pub fn expand<'a>(
    path: &str,
    read: &dyn Fn(&str) -> Option<&'a str>,
) -> Result<Expanded, ShaderError> {
    let Some(text) = read(path) else {
        return Err(ShaderError::UnknownShader {
            path: path.to_owned(),
        });
    };
    let mut expansion = Expansion {
        read,
        out: Expanded {
            text: String::with_capacity(2 * text.len()),
            files: Vec::new(),
            origins: Vec::new(),
        },
        open: Vec::new(),
    };
    expansion.file(path, text)?;
    Ok(expansion.out)
}

struct Expansion<'r, 'a> {
    read: &'r dyn Fn(&str) -> Option<&'a str>,
    out: Expanded,
    /// The files that are being included now, outermost first.
    open: Vec<String>,
}

impl Expansion<'_, '_> {
    fn file(&mut self, path: &str, text: &str) -> Result<(), ShaderError> {
        let index = self.out.files.len();
        self.out.files.push(path.to_owned());
        self.open.push(path.to_owned());
        for (line, number) in text.lines().zip(1..) {
            if let Some(target) = include_target(line) {
                let column = (line.len() - line.trim_start().len() + 1) as u32;
                let at = |message| ShaderError::Source {
                    file: path.to_owned(),
                    line: number,
                    column,
                    message,
                };
                self.include(target).map_err(|fault| match fault {
                    Fault::Here(message) => at(message),
                    Fault::Inside(error) => error,
                })?;
                continue;
            }
            // To naga `//!` is a comment on the module and allowed at its head only, where an
            // included file's is not.
            if line.trim_start().starts_with("//!") {
                self.out.text.push_str(&line.replacen("//!", "// ", 1));
            } else {
                self.out.text.push_str(line);
            }
            self.out.text.push('\n');
            self.out.origins.push((index, number));
        }
        self.open.pop();
        Ok(())
    }

    fn include(&mut self, target: &str) -> Result<(), Fault> {
        if target.is_empty() {
            return Err(Fault::Here(format!(
                "an include names a file: {DIRECTIVE} common/liquid/kernel.wgsl"
            )));
        }
        if self.open.iter().any(|open| open == target) {
            return Err(Fault::Here(format!(
                "'{target}' includes itself: {} -> {target}",
                self.open.join(" -> ")
            )));
        }
        if self.out.files.iter().any(|file| file == target) {
            return Ok(());
        }
        let Some(text) = (self.read)(target) else {
            return Err(Fault::Here(format!(
                "there is no '{target}': the path is relative to shaders/wgsl"
            )));
        };
        self.file(target, text).map_err(Fault::Inside)
    }
}

enum Fault {
    /// The include line itself is wrong; the message.
    Here(String),
    /// A file below it is wrong.
    Inside(ShaderError),
}

fn include_target(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix(DIRECTIVE)?;
    (rest.is_empty() || rest.starts_with(char::is_whitespace)).then(|| rest.trim())
}
