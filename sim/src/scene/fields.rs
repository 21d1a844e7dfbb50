//! Numbers of a scene's file, and checks of their ranges.

use super::error::Problem;
use super::feature::Feature;
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
