//! Errors of the checks on a user's input; inside the crate all values are within bounds.

use super::constants::ABSOLUTE_ZERO;
use thiserror::Error;

/// A composition or temperature that no liquid has.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum OutOfRange {
    /// Mass fraction outside of 0 to 1, or not a number.
    #[error("acid mass fraction {0} is not between 0 and 1; give 0.98 for 98 %")]
    Acid(f64),
    /// Below absolute zero, or not a number.
    #[error("temperature {0} °C is not above −273.15 °C; give it in degrees Celsius")]
    Temperature(f64),
    /// Not above zero, or not a number.
    #[error("mass {0} kg is not a finite number above zero; give it in kilograms")]
    Mass(f64),
    /// Not above 0 °C, or not a number.
    #[error(
        "boiling point {0} °C is not above 0 °C; Eq. 17 divides by it in degrees \
         Celsius, so raise it"
    )]
    BoilingPoint(f64),
}

/// Checks a liquid's acid mass fraction `acid` and its `temperature` (°C).
///
/// # Errors
/// [`OutOfRange`], also for values that are not numbers.
pub fn check_content(acid: f64, temperature: f64) -> Result<(), OutOfRange> {
    if !(0.0..=1.0).contains(&acid) {
        Err(OutOfRange::Acid(acid))
    } else if temperature.is_finite() && temperature > ABSOLUTE_ZERO {
        Ok(())
    } else {
        Err(OutOfRange::Temperature(temperature))
    }
}
