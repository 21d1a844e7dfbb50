//! The command line: the subcommands here, their arguments in `arguments` and beside it, those
//! of what measures in the crate `vitriol_study`.

mod arguments;
#[cfg(feature = "class")]
mod class;
#[cfg(feature = "session")]
mod desk;
mod drawn;
#[cfg(feature = "export")]
mod export;
pub mod left_out;
mod lesson;
mod picture;
#[cfg(feature = "session")]
mod session;
#[cfg(feature = "session")]
mod vr;

use clap::{Parser, Subcommand};

pub use arguments::{CameraName, PagesArgs, ReplayArgs, ScenesArgs, TrackArgs};
#[cfg(feature = "class")]
pub use class::{ForgetArgs, GradeArgs, HubArgs, KeepArgs};
#[cfg(feature = "session")]
pub use desk::DeskArgs;
pub use drawn::DrawnArgs;
#[cfg(feature = "export")]
pub use export::ExportArgs;
pub use lesson::{
    CheckLessonArgs, JudgeArgs, LessonArgs, LessonCommand, NewLessonArgs, no_subcommand,
};
pub use picture::PictureArgs;
#[cfg(feature = "session")]
pub use session::SessionArgs;
#[cfg(feature = "session")]
pub use vr::VrArgs;

/// Acid dilution in virtual glassware: particle fluid on Vulkan, driven by
/// recorded or live hands.
#[derive(Debug, Parser)]
#[command(name = "vitriol", version, propagate_version = true)]
#[command(after_help = left_out::after_help())]
pub struct Cli {
    /// Print one JSON object on standard output and nothing else there; progress, warnings and
    /// errors are JSON lines on standard error
    #[arg(long, global = true)]
    pub json: bool,

    /// Say more on standard error; twice for debugging
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,

    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    // In the order of the help: the laboratory, the program itself, a class, what measures.
    /// Replay a recorded pour and make its film and report
    Replay(Box<ReplayArgs>),
    /// Pour with mouse and keyboard, in a window
    #[cfg(feature = "session")]
    Desk(Box<DeskArgs>),
    /// Pour by hand, in a headset
    #[cfg(feature = "session")]
    Vr(Box<VrArgs>),
    /// Replay a recorded pour up to a time and take one picture
    Picture(PictureArgs),
    /// Write a run for other programs: particles, surfaces, measurements, recordings
    #[cfg(feature = "export")]
    Export(ExportArgs),
    /// Convert, list or look into pose tracks
    Track(TrackArgs),
    /// List the scenes, each with its scale and what it models
    Scenes(ScenesArgs),
    /// List the lessons, check and show one, or begin one of your own
    Lesson(LessonArgs),
    /// Look for devices, driver and OpenXR runtime; name what is missing
    Doctor,
    /// Write the manual's pages, completions for bash, fish and zsh, and the report's JSON schema
    Pages(PagesArgs),
    /// Grade a class's recordings: a table of students with points and incidents
    #[cfg(feature = "class")]
    Grade(GradeArgs),
    /// Serve the instructor's console for a class, whose programs dial it
    #[cfg(feature = "class")]
    Hub(HubArgs),
    /// Delete all that is kept of a student
    #[cfg(feature = "class")]
    Forget(ForgetArgs),
    /// What measures.
    #[cfg(feature = "study")]
    #[command(flatten)]
    Study(vitriol_study::cli::Command),
}

#[cfg(test)]
mod tests {
    use std::any::TypeId;

    use super::*;
    use clap::CommandFactory;

    #[test]
    fn definition_is_consistent() {
        Cli::command().debug_assert();
    }

    /// Without it `--seconds -1` would be advised to be a file's name.
    #[test]
    fn each_number_may_be_negative_so_that_its_bound_is_named() {
        let numbers = [
            TypeId::of::<f32>(),
            TypeId::of::<f64>(),
            TypeId::of::<u32>(),
            TypeId::of::<u64>(),
            TypeId::of::<usize>(),
        ];
        let mut found = 0;
        for command in Cli::command().get_subcommands() {
            for argument in command.get_arguments() {
                let holds = argument.get_value_parser().type_id();
                if argument.get_action().takes_values() && numbers.iter().any(|it| holds == *it) {
                    let name = (command.get_name(), argument.get_id());
                    assert!(argument.is_allow_negative_numbers_set(), "{name:?}");
                    found += 1;
                }
            }
        }
        assert!(found >= 4, "{found} numbers");
    }

    /// A teacher's commands stand together, below those of the laboratory.
    #[cfg(all(
        feature = "session",
        feature = "class",
        feature = "export",
        feature = "study"
    ))]
    #[test]
    fn help_begins_with_the_laboratory() {
        let command = Cli::command();
        let names: Vec<&str> = command.get_subcommands().map(|it| it.get_name()).collect();
        assert_eq!(names[..5], ["replay", "desk", "vr", "picture", "export"]);
        let of_class = names.iter().position(|it| *it == "grade");
        let after = of_class.map(|at| &names[at..at + 4]);
        assert_eq!(after, Some(&["grade", "hub", "forget", "bench"][..]));
    }
}
