//! `vitriol lesson new`: the file of a lesson of one's own.

use std::path::Path;

use serde::Serialize;
use vitriol_lesson::{FaultTexts, Lesson, LessonError};
use vitriol_run::output::{new_file, write_new};
use vitriol_run::{Blame, Failure, Format, emit};

use crate::cli::NewLessonArgs;
use crate::command::course::suggested;

/// What is printed of a new lesson.
#[derive(Debug, Serialize)]
struct Written {
    file: String,
    name: String,
    from: String,
    language: &'static str,
}

/// Writes the file of a new lesson.
///
/// # Errors
/// [`Failure::Input`] where there is no such lesson to begin with, none may have that name, or the file exists; [`Failure::Other`] where it
/// cannot be written.
pub fn write(args: &NewLessonArgs, format: Format) -> Result<(), Failure> {
    let (name, from) = (args.name.as_str(), &args.from);
    // Who gives the file's name gets that file.
    let name = name.strip_suffix(".toml").unwrap_or(name);
    let text = match Lesson::template(name, from, args.language) {
        Err(LessonError::NotFound { .. }) => {
            let texts = FaultTexts::of(args.language).other()?;
            let meant = suggested(from, &texts);
            let name = format!("{from:?}");
            return Err((texts.from).fill(&[("name", &name), ("meant", &meant)])).input();
        }
        made => made.input()?,
    };
    let path = new_file(Path::new(""), &format!("{name}.toml"))?;
    write_new(&path, text.as_bytes())?;
    let written = Written {
        file: path.display().to_string(),
        name: name.to_owned(),
        from: from.clone(),
        language: args.language.code(),
    };
    emit(format, &written, |it| {
        format!(
            "{file}: as {from}, with texts in {language}. Change it with an editor; `vitriol lesson {file}` checks it.",
            file = it.file,
            from = it.from,
            language = it.language
        )
    })
}
