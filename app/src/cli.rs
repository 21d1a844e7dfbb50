//! The command line: the subcommands here, their arguments in `arguments` and beside it, those
//! of what measures in the crate `vitriol_study`.

mod arguments;
mod drawn;
mod lesson;
mod picture;

use clap::{Parser, Subcommand};

pub use arguments::{
    CameraName, ConsoleArgs, ExportArgs, ForgetArgs, GradeArgs, HubArgs, KeepArgs, PagesArgs,
    ReplayArgs, ScenesArgs, TrackArgs, VrArgs,
};
pub use drawn::DrawnArgs;
pub use lesson::{JudgeArgs, LessonArgs};
pub use picture::PictureArgs;

/// Acid dilution in virtual glassware: particle fluid on Vulkan, driven by
/// recorded or live hands.
#[derive(Debug, Parser)]
#[command(name = "vitriol", version, propagate_version = true)]
#[command(after_help = "Exit codes: 0 done, 1 failed, 2 bad scene, track or \
                        argument, 3 no device or runtime.")]
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
    Replay(ReplayArgs),
    /// Grade a class's recordings: a table of students with points and incidents
    Grade(GradeArgs),
    /// Write a run for other programs: particles, surfaces, measurements, recordings
    Export(ExportArgs),
    /// Replay a recorded pour up to a time and take one picture
    Picture(PictureArgs),
    /// Pour by hand, in a headset
    Vr(VrArgs),
    /// Serve the instructor's console for a class, whose programs dial it
    Hub(HubArgs),
    /// Convert, list or look into pose tracks
    Track(TrackArgs),
    /// List the scenes, each with its scale and what it models
    Scenes(ScenesArgs),
    /// What measures.
    #[command(flatten)]
    Study(vitriol_study::cli::Command),
    /// List the lessons, or check and show one
    Lesson(LessonArgs),
    /// Delete all that is kept of a student
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
