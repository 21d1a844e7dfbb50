//! `vitriol pages`: the manual's pages and the shells' completions, from the command line's own definition, and the report's
//! JSON schema from its types.

use std::path::Path;

use clap::CommandFactory;
use clap_complete::{Shell, generate};
use clap_mangen::Man;
use serde::Serialize;
use vitriol_run::output::{new_file, write_new};
use vitriol_run::{Blame, Failure, Format, emit};

use crate::cli::{Cli, PagesArgs};
use crate::report::Report;

/// JSON schema of `report.json`.
const SCHEMA: &str = "report.schema.json";

const NAME: &str = "vitriol";

/// The completions, each under the name by which its shell finds it.
const COMPLETIONS: [(Shell, &str); 3] = [
    (Shell::Bash, "vitriol"),
    (Shell::Fish, "vitriol.fish"),
    (Shell::Zsh, "_vitriol"),
];

/// What `vitriol pages` prints.
#[derive(Debug, Serialize)]
struct Pages {
    /// The files.
    files: Vec<String>,
}

/// Runs `vitriol pages`.
///
/// # Errors
/// [`Failure::Input`] where a file is there already; [`Failure::Other`] where one cannot be written.
pub fn run(args: &PagesArgs, format: Format) -> Result<(), Failure> {
    let mut command = Cli::command();
    command.build();
    let mut files = Vec::new();
    let commands = || {
        let all = command.get_subcommands();
        all.filter(|it| it.get_name() != "help")
    };
    let inner = commands().flat_map(|it| it.get_subcommands());
    for page in [&command].into_iter().chain(commands()).chain(inner) {
        let page = Man::new(page.clone());
        let mut text = Vec::new();
        page.render(&mut text).other()?;
        files.push(write(&args.out, &page.get_filename(), &text)?);
    }
    for (shell, name) in COMPLETIONS {
        let mut text = Vec::new();
        generate(shell, &mut Cli::command(), NAME, &mut text);
        files.push(write(&args.out, name, &text)?);
    }
    let schema = serde_json::to_vec_pretty(&Report::schema()).other()?;
    files.push(write(&args.out, SCHEMA, &schema)?);
    emit(format, &Pages { files }, |pages| pages.files.join("\n"))
}

fn write(folder: &Path, name: &str, text: &[u8]) -> Result<String, Failure> {
    let path = new_file(folder, name)?;
    write_new(&path, text)?;
    Ok(path.display().to_string())
}
