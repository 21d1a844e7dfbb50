//! The command line: the subcommands here, their arguments in `arguments` and beside it, those
//! of what measures in the crate `vitriol_study`.

mod arguments;
#[cfg(feature = "class")]
mod class;
mod drawn;
#[cfg(feature = "export")]
mod export;
pub mod left_out;
mod lesson;
mod picture;
#[cfg(feature = "session")]
mod vr;

use clap::{Parser, Subcommand};

pub use arguments::{CameraName, PagesArgs, ReplayArgs, ScenesArgs, TrackArgs};
#[cfg(feature = "class")]
pub use class::{ForgetArgs, GradeArgs, HubArgs, KeepArgs};
pub use drawn::DrawnArgs;
#[cfg(feature = "export")]
pub use export::ExportArgs;
pub use lesson::{JudgeArgs, LessonArgs};
pub use picture::PictureArgs;
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
    /// Replay a recorded pour and make its film and report
    Replay(Box<ReplayArgs>),
    /// Grade a class's recordings: a table of students with points and incidents
    #[cfg(feature = "class")]
    Grade(GradeArgs),
    /// Write a run for other programs: particles, surfaces, measurements, recordings
    #[cfg(feature = "export")]
    Export(ExportArgs),
    /// Replay a recorded pour up to a time and take one picture
    Picture(PictureArgs),
    /// Pour by hand, in a headset
    #[cfg(feature = "session")]
    Vr(Box<VrArgs>),
    /// Serve the instructor's console for a class, whose programs dial it
    #[cfg(feature = "class")]
    Hub(HubArgs),
    /// Convert, list or look into pose tracks
    Track(TrackArgs),
    /// List the scenes, each with its scale and what it models
    Scenes(ScenesArgs),
    /// What measures.
    #[cfg(feature = "study")]
    #[command(flatten)]
    Study(vitriol_study::cli::Command),
    /// List the lessons, or check and show one
    Lesson(LessonArgs),
    /// Delete all that is kept of a student
    #[cfg(feature = "class")]
    Forget(ForgetArgs),
    /// Look for devices, driver and OpenXR runtime; name what is missing
    Doctor,
    /// Write the manual's pages, completions for bash, fish and zsh, and the report's JSON schema
    Pages(PagesArgs),
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn definition_is_consistent() {
        Cli::command().debug_assert();
    }
}
