//! Which pours of an attempt mixed acid and water.

use std::collections::BTreeSet;

use vitriol_sim::scene::Scene;

use crate::skin::CORROSIVE;
use crate::{Attempt, Incident, Pour, What};

/// Liquids whose acid mass fractions differ by less are the same liquid. Our choice.
const DIFFERENCE: f64 = 0.1;

/// Whether liquid of mass fraction `acid` is acid, and liquid of mass fraction `water` is thinner.
fn dilutes(acid: f64, water: f64) -> bool {
    acid >= CORROSIVE && acid >= water + DIFFERENCE
}

/// The name of a flask in which acid and water, or thinner acid, lie on one another at the scene's start, the first of them.
pub fn layered(scene: &Scene) -> Option<&str> {
    let liquids = &scene.liquids;
    let is_on_other = |flask: usize, acid: f64| {
        let mut others = liquids.iter().filter(|other| other.flask == flask);
        others.any(|other| dilutes(acid, other.acid_fraction))
    };
    let acid = liquids
        .iter()
        .find(|liquid| is_on_other(liquid.flask, liquid.acid_fraction))?;
    Some(scene.flasks.get(acid.flask)?.name.as_str())
}

impl Pour {
    /// Whether acid came into water, or into thinner acid.
    pub(crate) fn is_acid_into_water(&self) -> bool {
        self.met.is_some_and(|met| dilutes(self.acid, met.acid))
    }

    /// Whether acid and water came together, in either order.
    pub(crate) fn mixes(&self) -> bool {
        self.is_acid_into_water() || self.met.is_some_and(|met| dilutes(met.acid, self.acid))
    }
}

impl Attempt {
    /// Pours in which acid and water came together.
    pub(crate) fn mixing(&self) -> impl Iterator<Item = &Pour> {
        self.pours.iter().filter(|pour| pour.mixes())
    }

    /// When acid and water first came together by a pour, simulated time of the run, s, and the flask in which they did.
    pub fn first_contact(&self) -> Option<(f64, &str)> {
        let pour = self.mixing().next()?;
        Some((pour.t_s, pour.into.as_deref()?))
    }

    /// Whether acid and water can be mixed: two flasks hold acid and something thinner at the start, or a pour mixed them anyhow.
    pub(crate) fn can_mix(&self) -> bool {
        let acids = || self.contents.values().map(|content| content.acid);
        let most = acids().fold(0.0, f64::max);
        let least = acids().fold(1.0, f64::min);
        dilutes(most, least) || self.mixing().next().is_some()
    }

    /// Volume of all pours, m³.
    pub(crate) fn poured_m3(&self) -> f64 {
        self.pours.iter().map(|pour| pour.volume_m3).sum()
    }

    /// Volume of water that came to concentrated acid, m³.
    pub(crate) fn water_into_acid_m3(&self) -> f64 {
        let volumes = self.incidents.iter().map(|incident| match incident.what {
            What::WaterIntoAcid { volume_m3, .. } => volume_m3,
            _ => 0.0,
        });
        volumes.sum()
    }

    /// Highest known mean temperature of the mixed liquid, as (time s, °C): before each later pour into it, in its heat incidents, and at
    /// the end.
    pub(crate) fn warmest(&self) -> Option<(f64, f64)> {
        let into = |pour: &Pour| pour.into.clone();
        let mixed: BTreeSet<String> = self.mixing().filter_map(into).collect();
        let first = self.mixing().next()?.t_s;
        let met = self.pours.iter().filter(|pour| pour.t_s > first);
        let met = met.filter(|pour| pour.into.as_ref().is_some_and(|it| mixed.contains(it)));
        let met = met.filter_map(|pour| Some((pour.t_s, pour.met?.temperature_c?)));
        let end = self.ending.iter().flat_map(|ending| {
            let held = mixed.iter().filter_map(|flask| ending.contents.get(flask));
            held.filter_map(|content| Some((ending.t_s, content.temperature_c?)))
        });
        let hot = self
            .incidents
            .iter()
            .filter_map(|incident| match &incident.what {
                What::Hot {
                    flask,
                    temperature_c,
                } => mixed
                    .contains(flask)
                    .then_some((incident.t_s, *temperature_c)),
                _ => None,
            });
        met.chain(hot)
            .chain(end)
            .reduce(|a, b| if b.1 > a.1 { b } else { a })
    }

    /// The pour that brought water to acid in that incident.
    pub(crate) fn pour_of(&self, incident: &Incident) -> Option<&Pour> {
        let What::WaterIntoAcid { flask, .. } = &incident.what else {
            return None;
        };
        self.pours.iter().find(|pour| {
            let together = pour.t_s <= incident.until_s && incident.t_s <= pour.until_s;
            together && !pour.is_acid_into_water() && pour.into.as_ref() == Some(flask)
        })
    }
}
