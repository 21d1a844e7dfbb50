//! Named vessels of real size.
//!
//! The standards give outer diameter and overall height; wall and base are
//! taken as 2 mm throughout ([`WALL`]), within what they allow. Spouts,
//! flanged rims and the cylinder's foot are left out: they are not
//! axisymmetric or never wetted.

use serde::{Deserialize, Serialize};

use super::profile::{Profile, ProfileError};

/// Wall thickness, metres.
pub const WALL: f64 = 0.002;

/// Density of borosilicate glass 3.3 (ISO 3585), kg/m³.
pub const BOROSILICATE: f64 = 2230.0;

/// Density of stainless steel 1.4301 (EN 10088-1), kg/m³.
pub const STAINLESS_STEEL: f64 = 7900.0;

/// What kind of vessel a flask is: texts name it by that.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Vessel {
    /// A beaker.
    Beaker,
    /// A measuring cylinder.
    Cylinder,
    /// A conical flask.
    ConicalFlask,
    /// A round-bottomed flask.
    RoundFlask,
    /// A laboratory bottle.
    Bottle,
    /// A funnel.
    Funnel,
    /// A tray.
    Tray,
    /// A cooking pot.
    Pot,
    /// A vessel of no such kind.
    #[default]
    Other,
}

impl Vessel {
    /// All kinds.
    pub const ALL: [Self; 9] = [
        Self::Beaker,
        Self::Cylinder,
        Self::ConicalFlask,
        Self::RoundFlask,
        Self::Bottle,
        Self::Funnel,
        Self::Tray,
        Self::Pot,
        Self::Other,
    ];
}

/// A vessel that a scene can name: outer dimensions in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glass {
    /// Name in scene files.
    pub name: &'static str,
    /// Its kind.
    pub vessel: Vessel,
    /// Density of the wall, kg/m³.
    pub density: f64,
    diameter: f64,
    neck: f64,
    height: f64,
}

const fn glass(name: &'static str, vessel: Vessel, [diameter, neck, height]: [f64; 3]) -> Glass {
    Glass {
        name,
        vessel,
        density: BOROSILICATE,
        diameter,
        neck,
        height,
    }
}

/// All named vessels.
pub const GLASSWARE: [Glass; 9] = [
    // ISO 3819, low form, 250, 400 and 600 mL.
    glass("beaker-250", Vessel::Beaker, [0.070, 0.070, 0.095]),
    glass("beaker-400", Vessel::Beaker, [0.080, 0.080, 0.110]),
    glass("beaker-600", Vessel::Beaker, [0.090, 0.090, 0.125]),
    // ISO 4788, tall form, 100 mL, without its foot.
    glass("cylinder-100", Vessel::Cylinder, [0.030, 0.030, 0.256]),
    // ISO 1773, conical flask, narrow neck, 250 mL.
    glass(
        "erlenmeyer-250",
        Vessel::ConicalFlask,
        [0.085, 0.034, 0.145],
    ),
    // ISO 1773, round-bottomed boiling flask, narrow neck, 250 mL.
    glass(
        "round-bottom-250",
        Vessel::RoundFlask,
        [0.085, 0.034, 0.140],
    ),
    // ISO 4796-1, laboratory bottles of 250 and 500 mL, with the neck within the thread of a GL 45 cap.
    glass("bottle-250", Vessel::Bottle, [0.070, 0.040, 0.138]),
    glass("bottle-500", Vessel::Bottle, [0.086, 0.040, 0.176]),
    // A common cooking pot, 16 cm by 10 cm inside: our choice.
    Glass {
        density: STAINLESS_STEEL,
        ..glass("pot-2l", Vessel::Pot, [0.164, 0.164, 0.102])
    },
];

/// The vessel of that name.
pub fn find(name: &str) -> Option<&'static Glass> {
    GLASSWARE.iter().find(|glass| glass.name == name)
}

impl Glass {
    /// Its inner profile as (height, radius) points, metres, for
    /// [`Profile::new`] with [`WALL`].
    pub fn points(&self) -> Vec<[f64; 2]> {
        let [body, neck] = [self.diameter, self.neck].map(|outer| 0.5 * outer - WALL);
        let height = self.height - WALL;
        match self.vessel {
            Vessel::ConicalFlask => conical(body, neck, height),
            Vessel::RoundFlask => round(body, neck, height),
            Vessel::Bottle => bottle(body, neck, height),
            _ => vec![[0.0, body], [height, body]],
        }
    }

    /// The vessel `times` as large as it is.
    ///
    /// # Errors
    /// [`ProfileError`] where `times` is not a positive number.
    pub fn profile(&self, times: f64) -> Result<Profile, ProfileError> {
        let points: Vec<_> = self
            .points()
            .into_iter()
            .map(|point| point.map(|x| x * times))
            .collect();
        Profile::new(&points, WALL * times)
    }
}

/// Straight up to half of the height and a little more, a shoulder, and a neck of the uppermost quarter: ours, by the look of such bottles.
fn bottle(body: f64, neck: f64, height: f64) -> Vec<[f64; 2]> {
    vec![
        [0.0, body],
        [0.55 * height, body],
        [0.72 * height, neck],
        [height, neck],
    ]
}

/// Rounded base edge, cone, neck of a quarter of the height.
fn conical(body: f64, neck: f64, height: f64) -> Vec<[f64; 2]> {
    let edge = 0.1 * body;
    let mut points: Vec<_> = (0..=6)
        .map(|i| f64::from(i) / 6.0 * std::f64::consts::FRAC_PI_2)
        .map(|angle| {
            [
                edge * (1.0 - angle.cos()),
                body - edge * (1.0 - angle.sin()),
            ]
        })
        .collect();
    points.extend([[0.75 * height, neck], [height, neck]]);
    points
}

/// Sphere up to where it meets the neck, then the neck.
fn round(body: f64, neck: f64, height: f64) -> Vec<[f64; 2]> {
    const ARC: u32 = 64;
    let top = std::f64::consts::PI - (neck / body).asin();
    let mut points: Vec<_> = (0..=ARC)
        .map(|i| f64::from(i) / f64::from(ARC) * top)
        .map(|angle| [body * (1.0 - angle.cos()), body * angle.sin()])
        .collect();
    points.push([height, neck]);
    points
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn holds_what_its_name_says() {
        let nominal_ml = [
            250.0, 400.0, 600.0, 100.0, 250.0, 250.0, 250.0, 500.0, 2000.0,
        ];
        assert_eq!(GLASSWARE.len(), nominal_ml.len());
        for (glass, nominal) in GLASSWARE.iter().zip(nominal_ml) {
            let capacity = glass.profile(1.0).unwrap().capacity() * 1e6;
            // To the brim a vessel holds its nominal volume and up to 40 %
            // more (the standards ask for at least 10 % on beakers).
            assert!(
                capacity > nominal && capacity < 1.4 * nominal,
                "{}: {capacity}",
                glass.name
            );
        }
    }

    #[test]
    fn weighs_what_the_catalogues_say() {
        // A 250 mL beaker weighs about 100 g, a 400 mL one 140 g.
        for (name, mass) in [("beaker-250", 0.100), ("beaker-400", 0.135)] {
            let glass = find(name).unwrap();
            let own = glass.profile(1.0).unwrap().glass_volume() * glass.density;
            assert!((own / mass - 1.0).abs() < 0.25, "{name}: {own} kg");
        }
    }
}
