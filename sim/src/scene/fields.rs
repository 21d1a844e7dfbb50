//! Numbers of a scene's file, and checks of their ranges.

use super::error::Problem;
use super::feature::Feature;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use std::ops::RangeInclusive;

/// A number of a table: its name, the feature that needs it, its value, and its range.
pub(super) type Field = (&'static str, Feature, Option<f64>, Must);
/// Whether the number is in its range, and the range in words.
pub(super) type Must = (fn(f64) -> bool, &'static str);

/// Angles of a rotation, degrees: a turn either way.
pub(super) const TURN: RangeInclusive<f64> = -360.0..=360.0;
pub(super) const TURN_IN_WORDS: &str = "from −360 to 360 (degrees)";

/// Refuses `value` unless it is finite and `ok`.
pub(super) fn require(field: &str, value: f64, ok: bool, must: &str) -> Result<(), Problem> {
    if value.is_finite() && ok {
        Ok(())
    } else {
        Err(Problem::new(field, format!("{value} is not {must}")))
    }
}

/// Refuses `value` outside of `range`.
pub(super) fn within(
    field: &str,
    value: f64,
    range: RangeInclusive<f64>,
    must: &str,
) -> Result<(), Problem> {
    require(field, value, range.contains(&value), must)
}

/// Checks that the numbers of `table` that are present are in their ranges.
pub(super) fn check_fields(table: &str, fields: &[Field]) -> Result<(), Problem> {
    for &(name, _, value, (fits, must)) in fields {
        if let Some(value) = value {
            require(&format!("{table}.{name}"), value, fits(value), must)?;
        }
    }
    Ok(())
}

/// Reads exactly `N` numbers. An array of more, such as one in which 0,5 stands for 0.5, would lose its last ones without a word.
pub(super) fn exactly<'de, D: Deserializer<'de>, const N: usize>(
    from: D,
) -> Result<[f64; N], D::Error> {
    let numbers = Vec::<f64>::deserialize(from)?;
    let count = numbers.len();
    numbers.try_into().map_err(|_| {
        D::Error::custom(format!(
            "has {count} numbers; write {N}, each with a decimal point and no comma in it"
        ))
    })
}
