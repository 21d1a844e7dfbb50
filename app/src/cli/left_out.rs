//! Commands and options that this build leaves out, and how to have them.

use clap::error::{ContextKind, ContextValue, ErrorKind};

/// A feature of `app/Cargo.toml`.
struct Part {
    feature: &'static str,
    is_in: bool,
    /// Its commands.
    commands: &'static [&'static str],
    /// Its options of commands that all builds have: command and option.
    options: &'static [(&'static str, &'static str)],
}

const PARTS: [Part; 4] = [
    Part {
        feature: "session",
        is_in: cfg!(feature = "session"),
        commands: &["desk", "vr"],
        options: &[],
    },
    Part {
        feature: "class",
        is_in: cfg!(feature = "class"),
        commands: &["hub", "grade", "forget"],
        options: &[
            ("replay", "--live"),
            ("replay", "--listen"),
            ("replay", "--hub"),
            ("replay", "--name"),
            ("replay", "--pseudonym"),
            ("replay", "--class"),
            ("replay", "--lrs"),
            ("replay", "--lrs-token"),
        ],
    },
    Part {
        feature: "export",
        is_in: cfg!(feature = "export"),
        commands: &["export"],
        options: &[],
    },
    Part {
        feature: "study",
        is_in: cfg!(feature = "study"),
        commands: &[
            "bench",
            "fig5",
            "dam-break",
            "fidelity",
            "calorimeter",
            "trade",
            "extremes",
        ],
        options: &[],
    },
];

/// How the whole program is had.
pub const REMEDY: &str = "`./lab build` in Vitriol's sources builds the whole program";

/// What stands below the help of the program.
pub fn after_help() -> String {
    let mut text =
        "Exit codes: 0 done, 1 failed, 2 bad scene, track or argument, 3 no device or runtime."
            .to_owned();
    let commands = PARTS.iter().filter(|part| !part.is_in);
    let commands: Vec<_> = commands.flat_map(|part| part.commands).copied().collect();
    if !commands.is_empty() {
        text += &format!(
            "\nLeft out of this build: {}; {REMEDY}.",
            commands.join(", ")
        );
    }
    text
}

/// What to say in place of `error` where the command line `given` asks for something that this build leaves out.
pub fn answer(error: &clap::Error, given: &[String]) -> Option<String> {
    answer_of(error, given, &PARTS)
}

fn answer_of(error: &clap::Error, given: &[String], parts: &[Part]) -> Option<String> {
    let said = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.as_str()),
        _ => None,
    };
    let mut missing = parts.iter().filter(|part| !part.is_in);
    let (feature, name) = match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let name = said(ContextKind::InvalidSubcommand)?;
            let part = missing.find(|part| part.commands.contains(&name))?;
            (part.feature, format!("vitriol {name}"))
        }
        ErrorKind::UnknownArgument => {
            let name = said(ContextKind::InvalidArg)?;
            let mut options = missing.flat_map(|part| {
                let options = part.options.iter();
                options.map(move |(command, option)| (part.feature, *command, *option))
            });
            let is_given = |command: &str| given.iter().any(|word| word == command);
            let (feature, command, _) =
                options.find(|(_, command, option)| *option == name && is_given(command))?;
            (feature, format!("vitriol {command} {name}"))
        }
        _ => return None,
    };
    Some(format!(
        "{name} is not in this build, which was made without its part `{feature}`: {REMEDY}"
    ))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use clap::{Arg, ArgAction, Command};

    use super::*;

    /// A program without a part, which has one command and one option.
    fn answered(line: &str) -> Option<String> {
        let parts = [Part {
            feature: "extras",
            is_in: false,
            commands: &["serve"],
            options: &[("replay", "--shown")],
        }];
        let json = Arg::new("json").long("json").action(ArgAction::SetTrue);
        let program = Command::new("vitriol").arg(json.global(true));
        let program = program.subcommand(Command::new("replay").arg(Arg::new("track")));
        let program = program.subcommand(Command::new("scenes"));
        let given: Vec<String> = line.split(' ').map(str::to_owned).collect();
        let error = program.try_get_matches_from(&given).unwrap_err();
        answer_of(&error, &given, &parts)
    }

    #[test]
    fn what_is_left_out_is_said_with_its_remedy() {
        for line in [
            "vitriol serve",
            "vitriol serve --help",
            "vitriol help serve",
            "vitriol --json serve a b",
        ] {
            let text = answered(line).unwrap();
            assert!(text.starts_with("vitriol serve is not in"), "{text}");
            assert!(text.contains("`extras`") && text.contains("./lab build"));
        }
        for line in ["vitriol replay x --shown", "vitriol replay x --shown=3"] {
            let text = answered(line).unwrap();
            assert!(
                text.starts_with("vitriol replay --shown is not in"),
                "{text}"
            );
        }
    }

    #[test]
    fn mistakes_stay_mistakes() {
        for line in [
            "vitriol sreve",
            "vitriol scenes --shown",
            "vitriol replay x --showm",
            "vitriol replay x y",
            "vitriol --help",
        ] {
            assert_eq!(answered(line), None, "{line}");
        }
    }
}

/// The whole program has what the table names, and nothing but what every build has besides.
#[cfg(all(
    test,
    feature = "session",
    feature = "class",
    feature = "export",
    feature = "study"
))]
mod whole {
    use std::collections::BTreeSet;

    use clap::{Arg, Args, Command, CommandFactory};

    use super::PARTS;
    use crate::cli::KeepArgs;
    use vitriol_live::ConsoleArgs;

    #[test]
    fn each_command_is_in_every_build_or_of_one_part() {
        let program = crate::cli::Cli::command();
        let has: BTreeSet<&str> = program.get_subcommands().map(|it| it.get_name()).collect();
        let every = [
            "replay", "picture", "track", "scenes", "lesson", "doctor", "pages",
        ];
        let parts = PARTS.iter().flat_map(|part| part.commands).copied();
        let named: Vec<&str> = parts.chain(every).collect();
        assert_eq!(named.iter().copied().collect::<BTreeSet<_>>(), has);
        assert_eq!(named.len(), has.len(), "one is named twice");
    }

    /// The class's options of a replay.
    #[test]
    fn each_option_of_a_part_is_named() {
        let of_class = ConsoleArgs::augment_args(KeepArgs::augment_args(Command::new("class")));
        let options = of_class.get_arguments().filter_map(Arg::get_long);
        let options = options.chain(["live"]);
        let options: BTreeSet<String> = options.map(|it| format!("--{it}")).collect();
        let named = PARTS.iter().flat_map(|part| part.options);
        let named: BTreeSet<String> = named.map(|(_, option)| (*option).to_owned()).collect();
        assert_eq!(named, options);
        let program = crate::cli::Cli::command();
        let has = |option: &str| {
            let mut replay = program.find_subcommand("replay").into_iter();
            let long = option.strip_prefix("--");
            replay.any(|it| it.get_arguments().any(|it| it.get_long() == long))
        };
        assert!(named.iter().all(|option| has(option)), "{named:?}");
    }
}
