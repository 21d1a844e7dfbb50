//! Numbers as people read them.

/// A unit with a prefix that suits the largest value to be shown in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scaled {
    /// Factor from the SI unit.
    pub factor: f64,
    /// The unit's symbol.
    pub symbol: &'static str,
}

/// Mass: kg from 1 kg on, else g or mg.
pub fn mass(largest_kg: f64) -> Scaled {
    pick(largest_kg, &[(1.0, "kg"), (1e3, "g"), (1e6, "mg")])
}

/// Volume: L, mL or µL.
pub fn volume(largest_m3: f64) -> Scaled {
    pick(largest_m3, &[(1e3, "L"), (1e6, "mL"), (1e9, "µL")])
}

/// Energy: J, mJ or µJ.
pub fn energy(largest_j: f64) -> Scaled {
    pick(largest_j, &[(1.0, "J"), (1e3, "mJ"), (1e6, "µJ")])
}

/// Length: m, cm (from 1 cm) or mm.
pub fn length(metres: f64) -> Scaled {
    pick(metres, &[(1.0, "m"), (1e2, "cm"), (1e3, "mm")])
}

/// Length of data: MB, kB or B.
pub fn data(bytes: u64) -> String {
    let bytes = bytes as f64;
    with_unit(
        bytes,
        pick(bytes, &[(1e-6, "MB"), (1e-3, "kB"), (1.0, "B")]),
    )
}

/// The first unit in which the largest value is 1 or more, else the last; for
/// zero the second, which is the one that laboratory quantities come in.
fn pick(largest: f64, units: &[(f64, &'static str); 3]) -> Scaled {
    let (factor, symbol) = if largest == 0.0 {
        units[1]
    } else {
        units
            .iter()
            .copied()
            .find(|(factor, _)| largest.abs() * factor >= 1.0)
            .unwrap_or(units[2])
    };
    Scaled { factor, symbol }
}

/// Three significant digits, without exponent in the range people read.
pub fn three_digits(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return "not finite".into();
    }
    // The exponent after rounding: 0.9999 is 1.00 and not 1.000.
    let rounded = format!("{value:.2e}");
    let exponent = rounded
        .split_once('e')
        .map(|(_, exponent)| exponent.parse());
    let Some(Ok(magnitude @ -4..=6)) = exponent else {
        return rounded;
    };
    let decimals = (2_i32 - magnitude).max(0) as usize;
    format!("{value:.decimals$}")
}

/// A value with its scaled unit, such as `212 g`.
pub fn with_unit(value: f64, unit: Scaled) -> String {
    format!("{} {}", three_digits(value * unit.factor), unit.symbol)
}

/// A fraction in per cent, such as `1.24 %`.
pub fn percent(fraction: f64) -> String {
    format!("{} %", three_digits(fraction * 100.0))
}

/// A whole number with thin spaces between groups of three.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            out.push('\u{202f}');
        }
        out.push(digit);
    }
    out
}

/// A number of things, such as `1 file` or `2 passes`; `noun` is one of them, whose plural takes s or es.
pub fn count(number: u64, noun: &str) -> String {
    let ending = match number {
        1 => "",
        _ if noun.ends_with(['s', 'x', 'h']) => "es",
        _ => "s",
    };
    format!("{} {noun}{ending}", grouped(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(with_unit(0.2171, mass(0.2171)), "217 g");
        assert_eq!(with_unit(0.002_5, length(0.002_5)), "2.50 mm");
        assert_eq!(with_unit(0.0, mass(0.0)), "0 g");
        assert_eq!(percent(0.012_44), "1.24 %");
        assert_eq!(three_digits(13_894.0), "13894");
        assert_eq!(three_digits(0.999_999), "1.00");
        assert_eq!(three_digits(-3e-9), "-3.00e-9");
        assert_eq!(three_digits(f64::NAN), "not finite");
        assert_eq!(grouped(13_894), "13\u{202f}894");
        assert_eq!(grouped(999), "999");
        assert_eq!(data(512), "512 B");
        assert_eq!(data(1_200_000), "1.20 MB");
    }

    #[test]
    fn one_thing_is_not_called_many() {
        assert_eq!(count(1, "moment"), "1 moment");
        assert_eq!(count(0, "moment"), "0 moments");
        assert_eq!(count(2, "switch"), "2 switches");
        assert_eq!(count(1, "dispatch"), "1 dispatch");
    }
}
