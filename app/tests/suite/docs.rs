//! README and docs name what there is: files, subcommands, flags, scenes, tests.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use clap::CommandFactory;
use vitriol::cli::Cli;
use vitriol_lesson::{Lesson, Mode};
use vitriol_sim::scene::Scene;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Paths of all files and folders of the repository, from its root, with `/` between.
fn repository() -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut folders = vec![root()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.strip_prefix(root()).unwrap();
            let name = name.to_str().unwrap().replace('\\', "/");
            found.insert(name.clone());
            let own =
                !["target", "out", ".git", "fuzz/corpus", "fuzz/target"].contains(&name.as_str());
            if own && path.is_dir() {
                folders.push(path);
            }
        }
    }
    found
}

/// Path from the root and text of each file with one of these extensions, in a folder or below it.
fn texts(files: &BTreeSet<String>, extensions: &[&str]) -> Vec<(String, String)> {
    let of = |name: &&String| {
        let extension = name.rsplit_once('.').map(|(_, extension)| extension);
        extension.is_some_and(|it| extensions.contains(&it)) && root().join(name).is_file()
    };
    let read = |name: &String| (name.clone(), fs::read_to_string(root().join(name)).unwrap());
    files.iter().filter(of).map(read).collect()
}

/// What stands between backticks, and the lines of indented blocks.
fn code(text: &str) -> Vec<String> {
    let mut spans = Vec::new();
    for line in text.lines() {
        if let Some(line) = line.strip_prefix("    ") {
            spans.push(line.split(" #").next().unwrap().trim().to_owned());
        }
    }
    let text = text.replace('\n', " ");
    let spans_of = text.split('`').skip(1).step_by(2);
    spans.extend(spans_of.map(str::to_owned));
    spans
}

/// Whether a file or folder is there by its path, the path's end, or a shader's without its ending.
fn is_there(files: &BTreeSet<String>, name: &str) -> bool {
    let name = name.trim_end_matches('/');
    let end = format!("/{name}");
    let shader = format!("{end}.wgsl");
    files
        .iter()
        .any(|file| file == name || file.ends_with(&end) || file.ends_with(&shader))
}

/// Whether a span of code is a path of this repository: nothing else in these texts has a slash or
/// one of these endings, but for what is built and what a reader is to name.
fn is_path(span: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./".contains(c);
    let source = [".rs", ".wgsl", ".md"]
        .iter()
        .any(|end| span.ends_with(end));
    let folders = span.contains('/') && !span.starts_with(['.', '/']);
    let made = span.starts_with("target/") || span.contains("NAME");
    span.chars().all(plain) && (source || folders) && !made
}

#[test]
fn links_and_paths_are_there() {
    let files = repository();
    let mut missing = Vec::new();
    for (page, text) in texts(&files, &["md"]) {
        let folder = Path::new(&page).parent().unwrap();
        for link in text.split("](").skip(1) {
            let link = link.split([')', '#']).next().unwrap();
            if !link.contains("://") && !root().join(folder).join(link).exists() {
                missing.push(format!("{page}: a link to {link}"));
            }
        }
        let paths = code(&text).into_iter().filter(|span| is_path(span));
        let unknown = paths.filter(|path| !is_there(&files, path));
        missing.extend(unknown.map(|path| format!("{page}: {path}")));
    }
    assert!(missing.is_empty(), "{missing:#?}");
}

#[test]
fn code_names_pages_that_are_there() {
    let files = repository();
    for (file, text) in texts(&files, &["rs", "wgsl", "toml"]) {
        for page in text.split("docs/").skip(1) {
            let name = |c: char| c.is_ascii_alphanumeric() || "_-/.".contains(c);
            let end = page.find(|c| !name(c)).unwrap_or(page.len());
            let page = format!("docs/{}", page[..end].trim_end_matches('.'));
            if page.ends_with(".md") {
                assert!(files.contains(&page), "{file}: {page}");
            }
        }
    }
}

/// Long names with underscores in docs are tests'.
#[test]
fn tests_that_are_named_are_there() {
    let files = repository();
    let sources = texts(&files, &["rs"]);
    let mut missing = Vec::new();
    for (page, text) in texts(&files, &["md"]) {
        for span in code(&text) {
            let name = span
                .chars()
                .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
            if name && span.matches('_').count() >= 3 {
                let function = format!("fn {span}(");
                if !sources.iter().any(|(_, text)| text.contains(&function)) {
                    missing.push(format!("{page}: {span}"));
                }
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}

/// In a cell of the paper's map a name that follows a file is in that file.
#[test]
fn functions_of_the_papers_map_are_in_their_files() {
    let files = repository();
    let sources = texts(&files, &["rs", "wgsl"]);
    let map = fs::read_to_string(root().join("docs/paper-map.md")).unwrap();
    let (mut names, mut missing) = (0, Vec::new());
    for cell in map.lines().flat_map(|line| line.split('|')) {
        let mut file = None;
        for span in code(cell.trim()) {
            if is_path(&span) {
                file = Some(span);
            } else if let (Some(file), Some(name)) = (&file, name_in(&span)) {
                let end = format!("/{file}");
                let mut of_file = sources.iter().filter(|(path, _)| path.ends_with(&end));
                if !of_file.any(|(_, text)| text.contains(name)) {
                    missing.push(format!("{file}: {span}"));
                }
                names += 1;
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
    assert!(names > 20, "{names} names were found");
}

/// A shader's function that the map names for a line of Algorithm 1 begins its comment with that line.
#[test]
fn functions_of_algorithm_1_name_their_lines() {
    let map = fs::read_to_string(root().join("docs/paper-map.md")).unwrap();
    let table = map.split("| Algorithm 1 |").nth(1).unwrap();
    let rows = table.lines().take_while(|line| !line.is_empty());
    let (mut names, mut without) = (0, Vec::new());
    for cell in rows.filter_map(|row| row.split('|').nth(2)) {
        let mut shader = None;
        for span in code(cell.trim()) {
            if is_path(&span) {
                shader = Some(span).filter(|path| path.ends_with(".wgsl"));
            } else if let Some(shader) = &shader {
                let path = root().join("shaders/wgsl").join(shader);
                let text = fs::read_to_string(path).unwrap();
                let before = text.split(&format!("fn {span}(")).next().unwrap();
                let above = before.lines().rev();
                let comment = above.take_while(|line| line.starts_with("///")).last();
                if !comment.is_some_and(|line| line.starts_with("/// Line")) {
                    without.push(format!("{shader}: {span}"));
                }
                names += 1;
            }
        }
    }
    assert!(without.is_empty(), "{without:#?}");
    assert!(names > 15, "{names} names were found");
}

/// The last part of a name of code.
fn name_in(span: &str) -> Option<&str> {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_:".contains(c);
    let last = span.rsplit("::").next();
    last.filter(|_| span.chars().all(plain))
}

/// Flags of a command and of the commands inside it, with those of all.
fn flags(command: &clap::Command) -> BTreeSet<String> {
    let long = |arg: &clap::Arg| arg.get_long().map(|name| format!("--{name}"));
    let short = |arg: &clap::Arg| arg.get_short().map(|name| format!("-{name}"));
    let own = command.get_arguments();
    own.flat_map(|arg| [long(arg), short(arg)])
        .flatten()
        .chain(command.get_subcommands().flat_map(flags))
        .collect()
}

#[test]
fn commands_flags_and_scenes_are_there() {
    let mut cli = Cli::command();
    cli.build();
    let every: BTreeSet<_> = cli.get_subcommands().flat_map(flags).collect();
    let scenes = Scene::builtin_names();
    let lessons = Lesson::builtin_names();
    let (mut commands, mut modes) = (0, 0);
    for (page, text) in texts(&repository(), &["md"]) {
        // What is gone is told there.
        if page == "CHANGELOG.md" {
            continue;
        }
        for span in code(&text) {
            let mut words = span.split_whitespace().peekable();
            let known = match (words.next(), words.peek().copied()) {
                (Some("vitriol"), Some(name)) if name.starts_with(|c: char| c.is_lowercase()) => {
                    commands += 1;
                    let command = cli.find_subcommand(name);
                    flags(command.unwrap_or_else(|| panic!("{page}: `{span}`")))
                }
                (Some(flag), _) if flag.starts_with("--") => {
                    words = span.split_whitespace().peekable();
                    every.clone()
                }
                _ => continue,
            };
            let mut lesson = None;
            while let Some(word) = words.next() {
                let word = word.trim_start_matches('[').trim_end_matches(']');
                let flag = word.starts_with('-') && word.len() > 1;
                assert!(!flag || known.contains(word), "{page}: {word} of `{span}`");
                let value = words.peek().copied().unwrap_or_default();
                let name = value.chars().all(|c| c.is_ascii_lowercase() || c == '-');
                if word == "--scene" && name && !value.is_empty() {
                    assert!(scenes.contains(&value), "{page}: {value} of `{span}`");
                }
                if word == "--lesson" && lessons.contains(&value) {
                    lesson = Some(Lesson::builtin(value).unwrap());
                }
                let is_mode = word == "--mode" && name && !value.is_empty();
                if let Some(lesson) = lesson.as_ref().filter(|_| is_mode) {
                    let mode: Mode = value.parse().unwrap();
                    assert!(lesson.modes.contains(&mode), "{page}: {value} of `{span}`");
                    modes += 1;
                }
            }
        }
    }
    assert!(commands > 20, "{commands} commands were found");
    assert!(modes > 0, "no lesson's mode was found");
}
