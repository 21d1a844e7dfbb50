//! Arguments of `vitriol picture`.

use std::path::PathBuf;

use clap::Args;
use glam::Vec3;
use vitriol_run::arguments::{file_of, filter, positive, preset, size};
use vitriol_run::{Colour, HEAD_FIELD, Look};
use vitriol_sim::scene::{PictureFilter, Preset};

use super::arguments::{CameraName, colour};
use super::drawn::DrawnArgs;

/// Arguments of `vitriol picture`.
#[derive(Debug, Args)]
pub struct PictureArgs {
    /// A built-in track's name (see `vitriol track --list`) or an MCAP file
    pub track: String,
    /// A built-in scene's name (see `vitriol scenes`) or a TOML file; without
    /// it the scene that the track names
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<String>,
    /// Take what is whole of a track that breaks off or lacks steps
    #[arg(long)]
    pub accept_truncated: bool,
    /// Trade of speed for accuracy; without it the one that the track was
    /// recorded with, or else balanced
    #[arg(long, value_parser = preset())]
    pub preset: Option<Preset>,
    /// Simulated time of the picture, seconds, within the track
    #[arg(long, value_name = "S", value_parser = positive, allow_negative_numbers = true)]
    pub at: f64,
    /// PNG file to be made
    #[arg(short, long, value_name = "FILE", value_parser = file_of("png"))]
    pub output: PathBuf,
    /// New folder for what each pass of the liquid's picture leaves behind, a PNG file each
    #[arg(long, value_name = "DIR")]
    pub passes: Option<PathBuf>,
    /// Width and height of a view, pixels
    #[arg(long, value_name = "WxH", default_value = "960x540", value_parser = size, allow_hyphen_values = true)]
    pub size: [u32; 2],
    /// Both eyes, side by side
    #[arg(long)]
    pub stereo: bool,
    /// Where it is seen from
    #[arg(long, value_enum, default_value_t = CameraName::Fixed, value_name = "CAMERA")]
    pub camera: CameraName,
    /// See it from here instead, m in the stage: +X to the right, +Y up, +Z towards the user
    #[arg(long, value_name = "X,Y,Z", value_parser = place, requires = "target", conflicts_with = "camera", allow_hyphen_values = true)]
    pub eye: Option<Vec3>,
    /// What the eye looks at, m in the stage
    #[arg(long, value_name = "X,Y,Z", value_parser = place, requires = "eye", allow_hyphen_values = true)]
    pub target: Option<Vec3>,
    /// The eye's field of view from top to bottom, degrees
    #[arg(long, value_name = "DEG", default_value_t = HEAD_FIELD, value_parser = field, allow_negative_numbers = true, requires = "eye")]
    pub field: f32,
    /// Liquid, or particles coloured by this
    #[arg(long, value_parser = colour(), default_value = "liquid", value_name = "COLOUR")]
    pub colour: Colour,
    /// Filter of the liquid's surface; without it the scene's
    #[arg(long, value_parser = filter(), value_name = "FILTER")]
    pub filter: Option<PictureFilter>,
    /// How it is drawn
    #[command(flatten)]
    pub drawn: DrawnArgs,
    /// Device to use: its number or a part of its name (see `vitriol doctor`)
    #[arg(long)]
    pub device: Option<String>,
}

impl PictureArgs {
    /// Where it is seen from, where the arguments give a place.
    pub fn look(&self) -> Option<Look> {
        let (eye, target) = (self.eye?, self.target?);
        Some(Look {
            eye,
            target,
            field: self.field,
        })
    }
}

fn place(text: &str) -> Result<Vec3, String> {
    let parts = text.split(',').map(|part| part.trim().parse::<f32>());
    let parts: Result<Vec<f32>, _> = parts.collect();
    match parts.as_deref() {
        Ok(&[x, y, z]) if [x, y, z].iter().all(|part| part.abs() <= 100.0) => {
            Ok(Vec3::new(x, y, z))
        }
        _ => {
            Err("give three numbers of metres with commas between them, such as 0,1.06,0.36".into())
        }
    }
}

fn field(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(field) if (1.0..=150.0).contains(&field) => Ok(field),
        _ => Err("give an angle of 1 to 150 degrees, such as 40".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_three_numbers_of_metres() {
        assert_eq!(place("0,1.06,-0.36"), Ok(Vec3::new(0.0, 1.06, -0.36)));
        for wrong in [
            "", "1,2", "1,2,3,4", "1,2,x", "nan,0,0", "0,0,inf", "0,1000,0",
        ] {
            assert!(place(wrong).is_err(), "{wrong}");
        }
        assert_eq!(field("30.5"), Ok(30.5));
        for wrong in ["0", "180", "-1", "nan", "x"] {
            assert!(field(wrong).is_err(), "{wrong}");
        }
    }
}
