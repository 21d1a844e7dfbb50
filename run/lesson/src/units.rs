//! Numbers as people say them: in the units of a laboratory, with two significant digits; volumes below a hundredth of a millilitre have
//! one.

use crate::texts::{Template, Texts};

/// Below this mass fraction liquid is called water: it would be given as 0 %. Our choice.
pub(crate) const WATER: f64 = 0.005;
/// Below this volume, m³, a second digit says nothing: it is a few drops of spray. Our choice.
const FEW: f64 = 0.01e-6;

impl Texts {
    /// m³ as mL or L.
    pub(crate) fn volume(&self, m3: f64) -> String {
        if m3 < FEW {
            let number = self.with_decimal(&rounded(m3 * 1e6, 1));
            self.unit.millilitres.fill(&[("number", &number)])
        } else if m3 < 1e-3 {
            self.said(&self.unit.millilitres, m3 * 1e6)
        } else {
            self.said(&self.unit.litres, m3 * 1e3)
        }
    }

    /// m³/s as mL/s.
    pub(crate) fn rate(&self, m3_s: f64) -> String {
        self.said(&self.unit.millilitres_a_second, m3_s * 1e6)
    }

    /// s, or minutes from two on, or hours from two on.
    pub(crate) fn duration(&self, s: f64) -> String {
        if s < 120.0 {
            self.said(&self.unit.seconds, s)
        } else if s < 7200.0 {
            self.said(&self.unit.minutes, s / 60.0)
        } else {
            self.said(&self.unit.hours, s / 3600.0)
        }
    }

    /// A moment of simulated time, s, to a tenth.
    pub(crate) fn moment(&self, s: f64) -> String {
        let number = self.with_decimal(&format!("{s:.1}"));
        self.unit.seconds.fill(&[("number", &number)])
    }

    /// Whole °C: 134 °C is not 130 °C to a reader of a thermometer.
    pub(crate) fn temperature(&self, celsius: f64) -> String {
        // Without the sign of -0.
        let whole = format!("{:.0}", celsius.round() + 0.0);
        self.unit.celsius.fill(&[("number", &whole)])
    }

    /// A mass fraction in per cent.
    pub(crate) fn fraction(&self, fraction: f64) -> String {
        self.said(&self.unit.percent, fraction * 100.0)
    }

    /// m/s.
    pub(crate) fn speed(&self, m_s: f64) -> String {
        self.said(&self.unit.metres_a_second, m_s)
    }

    /// m as whole cm.
    pub(crate) fn height(&self, m: f64) -> String {
        let whole = format!("{:.0}", (100.0 * m).round() + 0.0);
        self.unit.centimetres.fill(&[("number", &whole)])
    }

    /// m as cm.
    pub(crate) fn length(&self, m: f64) -> String {
        self.said(&self.unit.centimetres, 100.0 * m)
    }

    /// m/s as cm/s.
    pub(crate) fn slow_speed(&self, m_s: f64) -> String {
        self.said(&self.unit.centimetres_a_second, 100.0 * m_s)
    }

    /// A number without a unit, as it is.
    pub(crate) fn count(&self, number: f64) -> String {
        self.with_decimal(&number.to_string())
    }

    /// kg as mg or g.
    pub(crate) fn mass(&self, kg: f64) -> String {
        if kg < 1e-3 {
            self.said(&self.unit.milligrams, kg * 1e6)
        } else {
            self.said(&self.unit.grams, kg * 1e3)
        }
    }

    /// A volume and the name of its liquid.
    pub(crate) fn amount(&self, m3: f64, acid: f64) -> String {
        let volume = self.volume(m3);
        if acid < WATER {
            self.amount.water.fill(&[("volume", &volume)])
        } else {
            let acid = self.fraction(acid);
            self.amount
                .acid
                .fill(&[("volume", &volume), ("acid", &acid)])
        }
    }

    fn said(&self, unit: &Template, value: f64) -> String {
        let number = self.with_decimal(&rounded(value, 2));
        unit.fill(&[("number", &number)])
    }

    /// A number that was written with a decimal point, with the mark of this language.
    pub fn with_decimal(&self, number: &str) -> String {
        number.replace('.', &self.number.decimal.text())
    }
}

/// So many significant digits, at least one, without exponent.
fn rounded(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{}", value + 0.0);
    }
    let places = digits - 1;
    // The exponent after rounding: 9.96 is 10 and not 10.0.
    let rounded = format!("{value:.places$e}");
    let exponent: Option<i32> = rounded.split_once('e').and_then(|(_, it)| it.parse().ok());
    let value = rounded.parse().unwrap_or(value);
    let decimals = (places as i32 - exponent.unwrap_or(0)).max(0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::Language;

    #[test]
    fn numbers_are_as_people_say_them() {
        let texts = Texts::english().unwrap();
        // Between number and unit stands a space that no line breaks at.
        let plain = |text: String| text.replace('\u{a0}', " ");
        assert_eq!(plain(texts.volume(25.4e-6)), "25 mL");
        assert_eq!(plain(texts.volume(163e-6)), "160 mL");
        assert_eq!(plain(texts.volume(1.26e-3)), "1.3 L");
        assert_eq!(plain(texts.volume(0.0)), "0 mL");
        assert_eq!(plain(texts.volume(0.0156e-6)), "0.016 mL");
        assert_eq!(plain(texts.volume(0.0087e-6)), "0.009 mL");
        assert_eq!(plain(texts.volume(0.00041e-6)), "0.0004 mL");
        assert_eq!(plain(texts.rate(9.96e-6)), "10 mL/s");
        assert_eq!(plain(texts.duration(3.12)), "3.1 s");
        assert_eq!(plain(texts.duration(300.0)), "5.0 min");
        assert_eq!(plain(texts.moment(142.17)), "142.2 s");
        assert_eq!(plain(texts.temperature(133.6)), "134 °C");
        assert_eq!(plain(texts.temperature(-0.2)), "0 °C");
        assert_eq!(plain(texts.fraction(0.9642)), "96 %");
        assert_eq!(plain(texts.height(0.4549)), "45 cm");
        assert_eq!(plain(texts.length(0.0123)), "1.2 cm");
        assert_eq!(plain(texts.slow_speed(0.114)), "11 cm/s");
        assert_eq!(plain(texts.mass(21.4e-6)), "21 mg");
        assert_eq!(plain(texts.mass(1.26e-3)), "1.3 g");
        assert_eq!(plain(texts.amount(3.12e-6, 0.004)), "3.1 mL of water");
        assert_eq!(plain(texts.amount(3.12e-6, 0.19)), "3.1 mL of 19 % acid");
    }

    #[test]
    fn each_language_has_its_own_comma() {
        let said = Language::ALL.map(|it| Texts::of(it).unwrap().duration(3.12));
        assert_eq!(
            said,
            ["3.1\u{a0}s", "3,1\u{a0}s", "3,1\u{a0}s", "3.1\u{a0}s"]
        );
    }
}
