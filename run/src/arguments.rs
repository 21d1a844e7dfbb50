//! Values of arguments that commands of the program and of the study have.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use vitriol_sim::scene::{PictureFilter, PictureRoom, PictureTint, Preset};

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positive_numbers_are_finite() {
        assert_eq!(positive("2.5"), Ok(2.5));
        for wrong in ["0", "-1", "NaN", "inf", "2,5"] {
            assert!(positive(wrong).is_err(), "{wrong}");
        }
    }
}
