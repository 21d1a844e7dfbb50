//! Weights and limits by which points are given.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::caps::{Caps, WHOLE};
use crate::skin::IRRITANT;

/// Points of a criterion: all up to a limit, none from another, and in between in a straight line, rounded down. The limits are in the
/// criterion's unit.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ramp {
    /// Most points.
    pub points: u32,
    /// Value up to which all points are given.
    pub full_to: f64,
    /// Value from which on no points are given.
    pub none_from: f64,
}

impl Ramp {
    const fn new(points: u32, full_to: f64, none_from: f64) -> Self {
        Self {
            points,
            full_to,
            none_from,
        }
    }

    /// Points for `value`; none for NaN.
    pub fn points(&self, value: f64) -> u32 {
        if value <= self.full_to {
            return self.points;
        }
        let share = (self.none_from - value) / (self.none_from - self.full_to);
        // A float cast to an integer stops at the integer's ends, and NaN becomes 0.
        let points = (f64::from(self.points) * share.clamp(0.0, 1.0)) as u32;
        points.min(self.points)
    }
}

/// Weights and limits of a score. Its default is for a dilution in a beaker.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Rubric {
    /// Acid into water: volume of water that came to acid, m³.
    pub right_order: Ramp,
    /// Poured slowly: highest flow rate over any half second, m³/s.
    pub poured_slowly: Ramp,
    /// Stayed cool: mean temperature of the mixed liquid, °C.
    pub stayed_cool: Ramp,
    /// Nothing boiled over: volume, m³.
    pub nothing_thrown_out: Ramp,
    /// Nothing spilt: volume, m³.
    pub nothing_spilt: Ramp,
    /// Nothing on hands and face: number of drops of 0.05 mL, of which each begun one counts.
    pub nothing_on_skin: Ramp,
    /// Glass handled well: number of flasks.
    pub glass_whole: Ramp,
    /// Weight of a volume whose acid does not even irritate, 0 to 1.
    pub harmless_share: f64,
    /// Weight of a drop on glove or goggles against one on skin, 0 to 1.
    pub protected_share: f64,
    /// Weight of a flask that is dropped and stays whole against one that breaks, 0 to 1.
    pub whole_share: f64,
    /// Least volume that must be poured for the pouring to be judged, m³.
    pub least_m3: f64,
    /// Most points in all where something dangerous was done.
    pub caps: Caps,
}

impl Default for Rubric {
    /// Our choice, but for 60 and 100 °C: water of 60 °C leaves skin six seconds ([`crate::skin`]), and at 100 °C it boils.
    /// 20 mL of 98 % acid in 160 mL of water become 55 °C.
    fn default() -> Self {
        Self {
            // 1 mL: the rest in a rinsed measuring glass is no wrong order.
            right_order: Ramp::new(25, 0.0, 1e-6),
            // mL/s: a thin stream, and a gush.
            poured_slowly: Ramp::new(15, 5e-6, 20e-6),
            stayed_cool: Ramp::new(15, 60.0, 100.0),
            nothing_thrown_out: Ramp::new(15, 0.0, 1e-6),
            // 5 mL: a tea spoon.
            nothing_spilt: Ramp::new(10, 0.0, 5e-6),
            // One drop of concentrated acid burns.
            nothing_on_skin: Ramp::new(15, 0.0, 1.0),
            glass_whole: Ramp::new(5, 0.0, 1.0),
            harmless_share: 0.25,
            protected_share: 0.25,
            whole_share: 0.5,
            least_m3: 5e-6,
            caps: Caps::default(),
        }
    }
}

/// Why a rubric is refused.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub enum RubricError {
    /// A criterion's limits or points are out of range, or its limits are in the wrong order.
    #[error("{0}: full_to must be at least 0 and less than none_from, and points at most 1000")]
    Limits(&'static str),
    /// A share is not between 0 and 1.
    #[error("{0}: must lie between 0 and 1")]
    Share(&'static str),
    /// The least volume is negative or not finite.
    #[error("least_m3: must be a volume, 0 or more")]
    Least,
    /// A cap is higher than the points that can be had.
    #[error("caps.{0}: must be at most 100, which caps nothing")]
    Cap(&'static str),
}

impl Rubric {
    /// Checks its numbers, which come from a lesson's file.
    ///
    /// # Errors
    /// [`RubricError`] for the first number that is out of range, with the range.
    pub fn check(&self) -> Result<(), RubricError> {
        let ramps = [
            ("right_order", self.right_order),
            ("poured_slowly", self.poured_slowly),
            ("stayed_cool", self.stayed_cool),
            ("nothing_thrown_out", self.nothing_thrown_out),
            ("nothing_spilt", self.nothing_spilt),
            ("nothing_on_skin", self.nothing_on_skin),
            ("glass_whole", self.glass_whole),
        ];
        let wrong = |ramp: &Ramp| {
            let ordered = 0.0 <= ramp.full_to && ramp.full_to < ramp.none_from;
            !ordered || !ramp.none_from.is_finite() || ramp.points > 1000
        };
        if let Some((name, _)) = ramps.iter().find(|(_, ramp)| wrong(ramp)) {
            return Err(RubricError::Limits(name));
        }
        let shares = [
            ("harmless_share", self.harmless_share),
            ("protected_share", self.protected_share),
            ("whole_share", self.whole_share),
        ];
        let none = |share: f64| !(0.0..=1.0).contains(&share);
        if let Some((name, _)) = shares.iter().find(|(_, share)| none(*share)) {
            return Err(RubricError::Share(name));
        }
        let caps = self.caps.named();
        if let Some((name, _)) = caps.iter().find(|(_, most)| *most > WHOLE) {
            return Err(RubricError::Cap(name));
        }
        if self.least_m3 >= 0.0 && self.least_m3.is_finite() {
            Ok(())
        } else {
            Err(RubricError::Least)
        }
    }

    /// A volume weighted by its acid, m³.
    pub(crate) fn counted(&self, volume_m3: f64, acid: f64) -> f64 {
        if acid < IRRITANT {
            volume_m3 * self.harmless_share
        } else {
            volume_m3
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_is_full_then_falls_then_is_none() {
        let ramp = Ramp::new(10, 5.0, 20.0);
        let values = [0.0, 5.0, 5.001, 12.5, 18.6, 20.0, 1e300, f64::INFINITY];
        assert_eq!(values.map(|it| ramp.points(it)), [10, 10, 9, 5, 0, 0, 0, 0]);
        assert_eq!(ramp.points(f64::NAN), 0);
    }

    /// The points add up to 100, so a score is a percentage.
    #[test]
    fn the_default_makes_sense_and_has_a_hundred_points() {
        let rubric = Rubric::default();
        rubric.check().unwrap();
        let json = serde_json::to_value(&rubric).unwrap();
        let points = json.as_object().unwrap().values();
        let points: u64 = points.filter_map(|it| it["points"].as_u64()).sum();
        assert_eq!(points, 100);
        // A lesson names only the values that differ from the default.
        assert_eq!(toml::from_str::<Rubric>("").unwrap(), rubric);
        assert!(toml::from_str::<Rubric>("right_ordre = 1").is_err());
    }

    #[test]
    fn nonsense_is_refused_by_its_name() {
        let with = |change: &dyn Fn(&mut Rubric)| {
            let mut rubric = Rubric::default();
            change(&mut rubric);
            rubric.check().unwrap_err().to_string()
        };
        assert!(with(&|it| it.nothing_spilt.none_from = 0.0).contains("nothing_spilt"));
        assert!(with(&|it| it.stayed_cool.full_to = f64::NAN).contains("stayed_cool"));
        assert!(with(&|it| it.whole_share = -0.1).contains("whole_share"));
        assert!(with(&|it| it.caps.no_goggles = 101).contains("caps.no_goggles"));
        assert!(with(&|it| it.least_m3 = f64::NAN).contains("least_m3"));
    }
}
