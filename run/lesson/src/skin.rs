//! Effects of heat and acid on skin.
//!
//! Heat: how long bare skin lies in hot water until it is burnt through (third degree). The rows from 120 °F on are of the US Consumer
//! Product Safety Commission, "Avoiding Tap Water Scalds", document 5098. The first is of A. R. Moritz and F. C. Henriques, "Studies
//! of Thermal Injury II", American Journal of Pathology 23 (1947): below 44 °C no time that they tried, up to six hours, harmed skin.
//! A disposable glove does not count: 0.1 mm of rubber, with 1e-7 m²/s, is warm through in (0.1 mm)²/1e-7 m²/s = 0.1 s.
//!
//! Acid: specific concentration limits of sulfuric acid in Regulation (EC) 1272/2008 (CLP), annex VI, index number 016-020-00-8.

/// From °F, °C.
const fn celsius(fahrenheit: f64) -> f64 {
    (fahrenheit - 32.0) / 1.8
}

/// (°C, s): time in which water of that temperature burns through skin.
pub const SCALDS: [(f64, f64); 5] = [
    (44.0, 6.0 * 3600.0),
    (celsius(120.0), 300.0),
    (celsius(130.0), 30.0),
    (celsius(140.0), 6.0),
    (celsius(150.0), 2.0),
];

/// Shortest time in which somebody takes a hand away, s: a simple reaction alone takes 0.2 s. Our choice.
const AT_ONCE_S: f64 = 1.0;

/// Mass fraction from which sulfuric acid is Skin Corr. 1A: H314, causes severe skin burns and eye damage.
pub const CORROSIVE: f64 = 0.15;
/// Mass fraction from which it is Skin Irrit. 2 and Eye Irrit. 2: H315, H319.
pub const IRRITANT: f64 = 0.05;

/// A drop, m³: 20 drops of water from a normal dropper weigh 1 g (European Pharmacopoeia, 2.1.1).
pub(crate) const DROP_M3: f64 = 0.05e-6;

/// How many drops a volume (m³) is: each begun one counts, at least one.
pub(crate) fn drops(volume_m3: f64) -> f64 {
    // What rounding leaves over whole drops is none.
    (volume_m3 / DROP_M3 - 1e-9).ceil().max(1.0)
}

/// Effect of hot liquid on bare skin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Heat {
    /// None, in hours.
    Harmless,
    /// Burns it through.
    Within {
        /// After so long, s.
        time_s: f64,
    },
    /// Burns it through in less than a second: at 70 °C and above. Nobody takes a hand away in time.
    AtOnce,
}

/// Effect of liquid of `temperature_c` (°C) on bare skin.
pub fn heat(temperature_c: f64) -> Heat {
    match burn_time_s(temperature_c) {
        None => Heat::Harmless,
        Some(time_s) if time_s < AT_ONCE_S => Heat::AtOnce,
        Some(time_s) => Heat::Within { time_s },
    }
}

/// How long it takes to burn bare skin through, s; `None` below 44 °C. Between the table's rows, and beyond its last, the logarithm
/// of the time falls in a straight line, as it does nearly in Moritz's and Henriques's own curve.
pub fn burn_time_s(temperature_c: f64) -> Option<f64> {
    if temperature_c.is_nan() || temperature_c < SCALDS[0].0 {
        return None;
    }
    let mut rows = SCALDS.windows(2);
    let row = rows.find(|row| temperature_c <= row[1].0);
    let row = row.unwrap_or(&SCALDS[SCALDS.len() - 2..]);
    let [(cool, long), (hot, short)] = [row[0], row[1]];
    let share = (temperature_c - cool) / (hot - cool);
    Some(long * (short / long).powf(share))
}

/// Effect of acid on skin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Acid {
    /// Not classified.
    Harmless,
    /// Irritates skin and eyes.
    Irritant,
    /// Burns skin and damages eyes.
    Corrosive,
}

/// Effect of sulfuric acid of a mass fraction on skin.
pub fn acid(fraction: f64) -> Acid {
    if fraction >= CORROSIVE {
        Acid::Corrosive
    } else if fraction >= IRRITANT {
        Acid::Irritant
    } else {
        Acid::Harmless
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// The rows as the Commission prints them, in °F.
    #[test]
    fn the_table_is_the_commissions() {
        for (fahrenheit, seconds) in [(150.0, 2.0), (140.0, 6.0), (130.0, 30.0), (120.0, 300.0)] {
            let time = burn_time_s((fahrenheit - 32.0) * 5.0 / 9.0).unwrap();
            assert!((time / seconds - 1.0).abs() < 1e-9, "{fahrenheit} °F");
        }
        assert!((burn_time_s(44.0).unwrap() - 21_600.0).abs() < 1e-6);
        assert_eq!(heat(43.9), Heat::Harmless);
        assert_eq!(heat(f64::NAN), Heat::Harmless);
    }

    /// Tables that go on have 155 °F as one second (Burn Foundation); 70 °C is above.
    #[test]
    fn from_seventy_degrees_it_is_at_once() {
        let at_155 = burn_time_s(celsius(155.0)).unwrap();
        assert!((at_155 - 1.0).abs() < 0.2, "{at_155}");
        for hot in [70.0, 100.0, 134.0, 300.0] {
            assert_eq!(heat(hot), Heat::AtOnce);
        }
        assert!(matches!(heat(60.0), Heat::Within { .. }));
    }

    #[test]
    fn each_begun_drop_counts() {
        let counted = [0.0, 1e-12, 0.05e-6, 0.051e-6, 0.1e-6, 0.15e-6, 1e-6].map(drops);
        assert_eq!(counted, [1.0, 1.0, 1.0, 2.0, 2.0, 3.0, 20.0]);
    }

    #[test]
    fn hotter_is_never_slower() {
        let times = (440..1400).map(|tenths| burn_time_s(f64::from(tenths) / 10.0).unwrap());
        let times: Vec<f64> = times.collect();
        assert!(times.windows(2).all(|pair| pair[1] < pair[0]));
    }

    #[test]
    fn acid_is_classified_as_the_regulation_has_it() {
        let found = [0.0, 0.049, 0.05, 0.149, 0.15, 0.98].map(acid);
        use Acid::{Corrosive, Harmless, Irritant};
        assert_eq!(
            found,
            [Harmless, Harmless, Irritant, Irritant, Corrosive, Corrosive]
        );
    }
}
