//! Arguments of how a scene is drawn, which all have that draw it.

use clap::Args;
use vitriol_run::arguments::{room, tint};
use vitriol_sim::scene::{PictureRoom, PictureTint};

/// How a scene is drawn, in place of what it says itself.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct DrawnArgs {
    /// What tells the liquids apart; without it the scene's
    #[arg(long, value_parser = tint(), value_name = "TINT")]
    pub tint: Option<PictureTint>,
    /// How bright the room is; without it the scene's
    #[arg(long, value_parser = room(), value_name = "ROOM")]
    pub room: Option<PictureRoom>,
}

#[cfg(all(test, feature = "session"))]
#[allow(clippy::unwrap_used, clippy::panic)]
mod tests {
    use clap::{CommandFactory, Parser};

    use super::*;
    use crate::cli::{Cli, Command};

    fn drawn(line: &str) -> Result<DrawnArgs, clap::Error> {
        let cli = Cli::try_parse_from(line.split(' '))?;
        Ok(match cli.command {
            Command::Picture(args) => args.drawn,
            Command::Replay(args) => args.drawn,
            Command::Desk(args) => args.session.drawn,
            Command::Vr(args) => args.session.drawn,
            _ => panic!("{line} is another command"),
        })
    }

    /// All that draw a scene take the same rooms, and say the same of them.
    #[test]
    fn pictures_films_and_sessions_have_the_same_rooms() {
        let lines = [
            "vitriol picture dilute --at 1 -o x.png",
            "vitriol replay dilute",
            "vitriol desk",
            "vitriol vr",
        ];
        let mut help = Vec::new();
        for line in lines {
            assert_eq!(drawn(line).unwrap().room, None);
            for room in [
                PictureRoom::Day,
                PictureRoom::Bright,
                PictureRoom::Dark,
                PictureRoom::Bare,
            ] {
                let asked = drawn(&format!("{line} --room {}", room.name())).unwrap();
                assert_eq!((asked.room, asked.tint), (Some(room), None), "{line}");
            }
            assert!(drawn(&format!("{line} --room night")).is_err());
            let mut cli = Cli::command();
            let name = line.split(' ').nth(1).unwrap();
            let command = cli.find_subcommand_mut(name).unwrap();
            let mut arguments = command.get_arguments();
            let room = arguments.find(|it| it.get_id() == "room").unwrap();
            help.push(room.get_help().unwrap().to_string());
        }
        assert!(help.iter().all(|it| *it == help[0]), "{help:?}");
    }

    /// A report without a film has no room to draw.
    #[test]
    fn what_is_not_drawn_has_no_room() {
        for option in ["--room dark", "--tint none"] {
            let line = format!("vitriol replay dilute --no-video {option}");
            assert!(drawn(&line).is_err(), "{line}");
        }
    }
}
