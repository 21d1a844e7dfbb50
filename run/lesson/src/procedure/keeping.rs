//! Whether a requirement of a step or a rule holds.

use super::condition::Keep;
use super::progress::{Gear, Why};
use super::sight::Sight;
use super::watch::m3;
use crate::event::{Incident, What};

/// State of one requirement ([`Keep`]) while it must hold.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Keeping {
    /// Volume spilt so far, m³.
    spilt: f64,
    /// Whether it is breached now, so that one breach is reported once.
    pub breached: bool,
}

impl Keeping {
    /// Takes in an incident of its span. Returns why the requirement is breached, if the incident breaches it.
    pub fn hear(&mut self, keep: &Keep, incident: &Incident) -> Option<Why> {
        match (keep, &incident.what) {
            (Keep::Never(kind), what) if kind.is(what) => Some(Why::Incident { kind: *kind }),
            (Keep::Spilt(it), What::Spilt { volume_m3, .. }) => {
                self.spilt += volume_m3;
                let limit_m3 = m3(it.at_most_ml);
                (self.spilt > limit_m3).then_some(Why::Spilt {
                    volume_m3: self.spilt,
                    limit_m3,
                })
            }
            _ => None,
        }
    }

    /// Begins a new try: earlier spills do not count. A present breach remains.
    pub fn forget(&mut self) {
        self.spilt = 0.0;
    }

    /// Takes in an observation. Returns why the requirement is breached, at the first observation that breaches it.
    pub fn see(&mut self, keep: &Keep, sight: &Sight) -> Option<Why> {
        let why = is_breached(keep, sight);
        let before = std::mem::replace(&mut self.breached, why.is_some());
        why.filter(|_| !before)
    }
}

fn is_breached(keep: &Keep, sight: &Sight) -> Option<Why> {
    let bare = |worn, gear| (worn == Some(false)).then_some(Why::NotWorn { gear });
    match keep {
        Keep::Never(_) | Keep::Spilt(_) => None,
        Keep::Cool(it) => {
            let temperature_c = sight.flask(&it.flask)?.temperature_c?;
            (temperature_c >= it.below_c).then(|| Why::TooHot {
                flask: it.flask.clone(),
                temperature_c,
                limit_c: it.below_c,
            })
        }
        Keep::Goggles => bare(sight.goggles, Gear::Goggles),
        Keep::Gloves => bare(sight.gloves.map(|on| on == [true; 2]), Gear::Gloves),
        Keep::Sash(it) => {
            let height_m = sight.sash_m?;
            (height_m > it.at_most_m).then_some(Why::SashOpen {
                height_m,
                limit_m: it.at_most_m,
            })
        }
    }
}
