//! An incident as an activity, a verb and extensions.

use std::collections::BTreeMap;

use serde_json::Value;
use vitriol_lesson::{Incident, What};

use super::activity::Activity;
use super::vocabulary::{EVENT, EXPERIENCED, INTERACTED, Key, Verb, ours};

/// Values by IRI.
pub(super) type Extensions = BTreeMap<String, Value>;

/// Names, verb and description of a kind of incident.
pub(super) struct Kind {
    /// Its name in a recording's `/events`.
    pub name: &'static str,
    pub verb: Verb,
    title: &'static str,
    description: &'static str,
}

impl Kind {
    pub(super) fn of(what: &What) -> Self {
        let kind = |verb, title, description| Self {
            name: what.kind(),
            verb,
            title,
            description,
        };
        match what {
            What::WaterIntoAcid { .. } => kind(
                INTERACTED,
                "Water into acid",
                "Liquid that is mostly water was poured into concentrated acid.",
            ),
            What::PouredTooFast { .. } => kind(
                INTERACTED,
                "Poured too fast",
                "Acid and water came together faster than is safe.",
            ),
            What::BoiledOver { .. } => kind(
                EXPERIENCED,
                "Boiled over",
                "Liquid left an upright flask over its rim while it boiled.",
            ),
            What::Hot { .. } => kind(
                EXPERIENCED,
                "Hot",
                "Liquid became so hot that it burns skin.",
            ),
            What::Spilt { .. } => {
                kind(INTERACTED, "Spilt", "Liquid came to lie beside the flasks.")
            }
            What::OnSkin { .. } => kind(
                EXPERIENCED,
                "On skin",
                "Acid, or hot liquid, came to the user.",
            ),
            What::Dropped { .. } => kind(
                INTERACTED,
                "Dropped",
                "A flask that nobody held struck bench or floor hard.",
            ),
        }
    }

    /// The activity. Its description defines the keys of the extensions beside it, since they lead to no page that would.
    pub(super) fn activity(&self, extensions: &Extensions) -> Activity {
        let mut text = self.description.to_owned();
        let keys = super::KEYS
            .iter()
            .filter(|key| extensions.contains_key(&key.iri()));
        for (i, key) in keys.enumerate() {
            text.push_str(if i == 0 { " Extensions: " } else { "; " });
            let unit = if key.unit.is_empty() {
                String::new()
            } else {
                format!(" ({})", key.unit)
            };
            text.push_str(&format!("{}{unit}, {}", key.name, key.meaning));
        }
        if !extensions.is_empty() {
            text.push('.');
        }
        Activity::new(ours("incident", self.name), EVENT, self.title, Some(text))
    }
}

/// The known values of an incident, each under its key.
pub(super) fn extensions(incident: &Incident) -> Extensions {
    let mut found = Extensions::new();
    let mut add = |name: &str, value: Value| {
        // JSON has no infinity: serde_json makes it null, like an unknown value.
        if let Some(key) = Key::named(name).filter(|_| !value.is_null()) {
            found.insert(key.iri(), value);
        }
    };
    // The fields of its kind have keys already.
    if let Ok(Value::Object(fields)) = serde_json::to_value(&incident.what) {
        for (name, value) in fields {
            add(&name, value);
        }
    }
    if incident.place_m.iter().all(|x| x.is_finite()) {
        add("place_m", incident.place_m.as_slice().into());
    }
    add("film_s", incident.t_s.into());
    add("cause", incident.cause.name().into());
    add("cause_flask", incident.cause.flask().into());
    found
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::example;

    /// serde's names of kinds and causes, and each field but those two, have a name here.
    #[test]
    fn names_are_the_recordings_and_each_field_has_its_key() {
        for incident in example::incidents() {
            let what = serde_json::to_value(&incident.what).unwrap();
            let mut fields = what.as_object().unwrap().clone();
            assert_eq!(
                fields.remove("kind").unwrap(),
                Kind::of(&incident.what).name
            );
            let said = extensions(&incident);
            for (name, value) in &fields {
                let key = Key::named(name).unwrap_or_else(|| unreachable!("{name} has no key"));
                assert_eq!(said.get(&key.iri()), Some(value).filter(|v| !v.is_null()));
            }
            let told = serde_json::to_value(&incident.cause).unwrap();
            assert_eq!(told["cause"], incident.cause.name());
            let flask = told
                .get("flask")
                .or(told.get("from"))
                .and_then(Value::as_str);
            assert_eq!(flask, incident.cause.flask());
        }
    }

    #[test]
    fn what_is_no_number_is_left_out() {
        let mut incident = example::incidents().swap_remove(0);
        incident.t_s = f64::NAN;
        incident.place_m[1] = f64::INFINITY;
        let said = extensions(&incident);
        for name in ["film_s", "place_m"] {
            assert!(
                !said.contains_key(&Key::named(name).unwrap().iri()),
                "{name}"
            );
        }
    }
}
