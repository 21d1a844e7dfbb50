//! Whether what is to be kept is.

use super::condition::Keep;
use super::progress::{Gear, Why};
use super::sight::Sight;
use super::watch::m3;
use crate::event::{Incident, What};

/// See the module.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Keeping {
    /// What was spilt, m³.
    spilt: f64,
    /// Whether it is not so now: one failure is said once.
    pub breached: bool,
}

impl Keeping {
    /// Something went wrong in its span. Why it is not kept then.
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

    /// A new try begins: what was spilt before is not of it. What is not so now stays so.
    pub fn forget(&mut self) {
        self.spilt = 0.0;
    }

    /// What is so at an instant. Why it ceases to be kept, at the first instant at which it is not.
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
