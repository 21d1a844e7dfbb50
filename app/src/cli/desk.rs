//! Arguments of `vitriol desk`.

use clap::Args;
use vitriol_run::arguments::size;
use vitriol_session::desk::{FOV, FOVS, SCALES};

use super::session::SessionArgs;

/// Arguments of `vitriol desk`.
#[derive(Debug, Args)]
pub struct DeskArgs {
    /// What all sessions have
    #[command(flatten)]
    pub session: SessionArgs,
    /// Width and height of the window when it opens, pixels; a screen of high density scales them
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size, allow_hyphen_values = true)]
    pub size: [u32; 2],
    /// Let the window fill the screen; F11 changes that
    #[arg(long)]
    pub full_screen: bool,
    /// Angle that the first view sees from top to bottom, degrees: less shows flasks larger, more shows more of the room
    #[arg(long, value_name = "DEGREES", default_value_t = FOV, value_parser = fov, allow_negative_numbers = true)]
    pub fov: f32,
    /// Height of the text that stands over the picture, times the usual: the strip at the upper edge and the label at the pointer
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = scale, allow_negative_numbers = true)]
    pub scale: f32,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

/// The first view's angle, degrees.
fn fov(text: &str) -> Result<f32, String> {
    let [least, most] = FOVS;
    match text.parse::<f32>() {
        Ok(angle) if (least..=most).contains(&angle) => Ok(angle),
        _ => Err(format!(
            "give {least} to {most} degrees, such as {FOV}; `+` and `-` in the window change them later"
        )),
    }
}

/// The height of text over the picture, times the usual.
fn scale(text: &str) -> Result<f32, String> {
    let [least, most] = SCALES;
    match text.parse::<f32>() {
        Ok(factor) if (least..=most).contains(&factor) => Ok(factor),
        _ => Err(format!("give {least} to {most}, such as 1.5")),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use clap::Parser;

    use crate::cli::{Cli, Command};

    /// What `vitriol desk` is told: the first view's angle, degrees, and the text's height, times the usual.
    fn told(arguments: &[&str]) -> Result<[f32; 2], String> {
        let cli = Cli::try_parse_from([&["vitriol", "desk"][..], arguments].concat());
        match cli.map_err(|error| error.to_string())?.command {
            Command::Desk(args) => Ok([args.fov, args.scale]),
            _ => Err("another command".into()),
        }
    }

    /// A recording is named for the grades with and without a console.
    #[test]
    fn a_session_without_a_console_has_a_name() {
        let cli = Cli::try_parse_from(["vitriol", "desk", "--no-console", "--name", "Ada"]);
        let name = match cli.unwrap().command {
            Command::Desk(args) => args.session.console.name,
            _ => None,
        };
        assert_eq!(name.as_deref(), Some("Ada"));
    }

    #[test]
    fn a_field_of_view_has_bounds() {
        let fov = |arguments: &[&str]| told(arguments).map(|[fov, _]| fov);
        assert_eq!(fov(&[]), Ok(56.0));
        for (given, expected) in [("20", 20.0), ("62.5", 62.5), ("75", 75.0)] {
            assert_eq!(fov(&["--fov", given]), Ok(expected));
        }
        for wrong in ["19.9", "75.1", "-40", "0", "nan", "inf", "40°"] {
            let said = fov(&["--fov", wrong]).unwrap_err();
            assert!(said.contains("20 to 75 degrees"), "{wrong}: {said}");
        }
    }

    #[test]
    fn a_texts_height_has_bounds() {
        let scale = |arguments: &[&str]| told(arguments).map(|[_, scale]| scale);
        assert_eq!(scale(&[]), Ok(1.0));
        for (given, expected) in [("0.5", 0.5), ("1.25", 1.25), ("2", 2.0)] {
            assert_eq!(scale(&["--scale", given]), Ok(expected));
        }
        for wrong in ["0.49", "2.1", "-1", "0", "nan", "inf", "150%"] {
            let said = scale(&["--scale", wrong]).unwrap_err();
            assert!(said.contains("0.5 to 2"), "{wrong}: {said}");
        }
    }
}
