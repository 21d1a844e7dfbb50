//! Values of arguments that commands of the program and of the study have.
//!
//! Options with numbers take negative ones too (`allow_negative_numbers`): their parser names the bound, where clap would
//! advise to give the number as a file.

use std::path::PathBuf;

use clap::builder::{PathBufValueParser, PossibleValue, PossibleValuesParser, TypedValueParser};
use vitriol_sim::scene::{PictureFilter, PictureRoom, PictureTint, Preset};
use vitriol_xr::track::limits;

/// One of a type's values by its name; each value is given with its help.
pub fn named<T: Copy + Send + Sync + 'static>(
    values: &'static [(T, &'static str)],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let possible = values.iter();
    let possible = possible.map(|&(value, help)| PossibleValue::new(name(value)).help(help));
    PossibleValuesParser::new(possible).try_map(move |given| {
        let mut known = values.iter().map(|(value, _)| *value);
        known
            .find(|&value| name(value) == given)
            .ok_or("no such value")
    })
}

/// A preset: a point on the trade of speed for accuracy.
pub fn preset() -> impl TypedValueParser<Value = Preset> {
    const PRESETS: [(Preset, &str); 3] = [
        (Preset::Fast, "Fewest particles and iterations"),
        (Preset::Balanced, "The default"),
        (Preset::Reference, "Smallest error, however long it takes"),
    ];
    named(&PRESETS, Preset::name)
}

/// How the splatted particles become a surface.
pub fn filter() -> impl TypedValueParser<Value = PictureFilter> {
    const FILTERS: [(PictureFilter, &str); 2] = [
        (PictureFilter::NarrowRange, "Truong and Yuksel's of 2018"),
        (
            PictureFilter::CurvatureFlow,
            "Van der Laan's of 2009, the paper's",
        ),
    ];
    named(&FILTERS, PictureFilter::name)
}

/// What tells the liquids apart.
pub fn tint() -> impl TypedValueParser<Value = PictureTint> {
    const TINTS: [(PictureTint, &str); 2] = [
        (
            PictureTint::Artificial,
            "Tints that they have not: water bluish, acid yellow",
        ),
        (
            PictureTint::None,
            "None: acid in water is seen by how it bends light",
        ),
    ];
    named(&TINTS, PictureTint::name)
}

/// How bright the room is.
pub fn room() -> impl TypedValueParser<Value = PictureRoom> {
    const ROOMS: [(PictureRoom, &str); 4] = [
        (PictureRoom::Day, "800 lx on the bench"),
        (PictureRoom::Bright, "A sunny noon, 1,700 lx"),
        (PictureRoom::Dark, "By evening, 70 lx"),
        (
            PictureRoom::Bare,
            "By day, without furniture and print on glass",
        ),
    ];
    named(&ROOMS, PictureRoom::name)
}

/// A finite number above zero.
pub fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("give a number above 0, such as 2.5".into()),
    }
}

/// A finite number, zero or above: a moment may be a run's first.
pub fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number >= 0.0 => Ok(number),
        _ => Err("give a number of 0 or more, such as 2.5".into()),
    }
}

/// A whole number from `least` on, as far as its type counts.
pub fn whole<T>(least: u64) -> impl TypedValueParser<Value = T>
where
    T: TryFrom<u64> + Clone + Send + Sync + 'static,
{
    between::<T>(least, u64::MAX >> (64 - 8 * size_of::<T>()))
}

/// A whole number from `least` to `most`.
pub fn between<T>(least: u64, most: u64) -> impl TypedValueParser<Value = T>
where
    T: TryFrom<u64> + Clone + Send + Sync + 'static,
{
    move |text: &str| -> Result<T, String> {
        let number = text.parse::<u64>().ok();
        let number = number.filter(|number| (least..=most).contains(number));
        number
            .and_then(|number| T::try_from(number).ok())
            .ok_or_else(|| format!("give a whole number from {least} to {most}"))
    }
}

/// Most frames that are counted: as many as a track holds.
pub const MOST_FRAMES: u64 = limits::FRAMES as u64;

/// Most pixels along a side of a picture: the widest image of most devices. A device with a smaller limit names its own.
pub const MOST_PIXELS: u32 = 16_384;

/// Two whole numbers above zero; `example` is what is meant by them.
fn pair(text: &str, example: &str) -> Result<[u32; 2], String> {
    let numbers = text.split_once('x').map(|(a, b)| [a.parse(), b.parse()]);
    match numbers {
        Some([Ok(first), Ok(second)]) if first > 0 && second > 0 => Ok([first, second]),
        _ => Err(format!(
            "give two whole numbers above 0 with an x between them, such as {example}"
        )),
    }
}

/// Substeps and iterations of the solver.
///
/// # Errors
/// What is to be given.
pub fn effort(text: &str) -> Result<[u32; 2], String> {
    pair(text, "10x3")
}

/// Width and height of a picture, pixels.
///
/// # Errors
/// What is to be given.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = pair(text, "960x540")?;
    match sides.iter().max() {
        Some(side) if *side > MOST_PIXELS => Err(format!(
            "give at most {MOST_PIXELS} pixels a side, as devices draw, such as 960x540"
        )),
        _ => Ok(sides),
    }
}

/// The path of a file that is to be made. Its name has the ending of the one format that is written into it, so that it promises no
/// other one.
pub fn file_of(ending: &'static str) -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(move |path: PathBuf| {
        let ends = path.extension();
        if ends.is_some_and(|it| it.eq_ignore_ascii_case(ending)) {
            return Ok(path);
        }
        Err(format!(
            "what is written is a .{ending} file; give a name that ends in .{ending}"
        ))
    })
}

#[cfg(test)]
mod tests {
    use std::ffi::OsStr;

    use clap::{Arg, Command};

    use super::*;

    #[test]
    fn positive_numbers_are_finite() {
        assert_eq!(positive("2.5"), Ok(2.5));
        assert_eq!(not_negative("0"), Ok(0.0));
        for wrong in ["0", "-1", "NaN", "inf", "2,5"] {
            assert!(positive(wrong).is_err(), "{wrong}");
            assert!(wrong == "0" || not_negative(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn pairs_are_two_numbers_above_zero() {
        assert_eq!(size("960x540"), Ok([960, 540]));
        assert_eq!(effort("10x3"), Ok([10, 3]));
        for wrong in ["960", "960x", "0x540", "960,540", "-1x2", "axb"] {
            let says = |example: &'static str| move |error: String| error.contains(example);
            assert!(size(wrong).is_err_and(says("960x540")), "{wrong}");
            assert!(effort(wrong).is_err_and(says("10x3")), "{wrong}");
        }
    }

    fn parsed<T>(parser: &impl TypedValueParser<Value = T>, text: &str) -> Result<T, String> {
        let (command, arg) = (Command::new("x"), Arg::new("n"));
        let value = parser.parse_ref(&command, Some(&arg), OsStr::new(text));
        value.map_err(|error| error.to_string())
    }

    #[test]
    fn whole_numbers_have_the_bounds_of_their_type() {
        let jobs = whole::<u32>(1);
        assert_eq!(parsed(&jobs, "1"), Ok(1));
        assert_eq!(parsed(&jobs, "4294967295"), Ok(u32::MAX));
        for wrong in ["0", "-1", "4294967296", "x", "1.5"] {
            let said = parsed(&jobs, wrong).err().unwrap_or_default();
            assert!(said.contains("from 1 to 4294967295"), "{wrong}: {said}");
        }
        let seed = whole::<u64>(0);
        assert_eq!(parsed(&seed, "18446744073709551615"), Ok(u64::MAX));
        let said = parsed(&seed, "-1").err().unwrap_or_default();
        assert!(said.contains("from 0 to 18446744073709551615"), "{said}");
        let few = between::<u64>(1, 5);
        assert_eq!([parsed(&few, "1"), parsed(&few, "5")], [Ok(1), Ok(5)]);
        for wrong in ["0", "6"] {
            let said = parsed(&few, wrong).err().unwrap_or_default();
            assert!(said.contains("from 1 to 5"), "{wrong}: {said}");
        }
    }

    /// Twice the square of the side fits into 32 bits, in which pixels of two eyes are counted.
    #[test]
    fn a_picture_is_no_wider_than_devices_draw() {
        assert_eq!(size("16384x1"), Ok([MOST_PIXELS, 1]));
        let pixels = MOST_PIXELS.checked_pow(2);
        assert_eq!(pixels.and_then(|it| it.checked_mul(2)), Some(1 << 29));
        for wrong in ["16385x1", "1x16385", "100000x100000", "4294967295x1"] {
            let said = size(wrong).err().unwrap_or_default();
            assert!(said.contains("at most 16384 pixels"), "{wrong}: {said}");
        }
        assert!(size("0x1").is_err_and(|it| it.contains("above 0")));
    }

    #[test]
    fn a_files_name_has_the_ending_of_what_is_written() {
        let picture = file_of("png");
        for right in ["a.png", "b/c.d.PNG"] {
            assert_eq!(parsed(&picture, right), Ok(PathBuf::from(right)));
        }
        for wrong in ["a.jpg", "a", ".png", "png", "a.png.mp4"] {
            let said = parsed(&picture, wrong).err().unwrap_or_default();
            assert!(said.contains("ends in .png"), "{wrong}: {said}");
        }
    }
}
