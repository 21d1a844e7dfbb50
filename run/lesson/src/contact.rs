//! The gravest contact of an attempt with acid or hot liquid: what a report says before anything else.

use crate::skin::{DROP_M3, IRRITANT, drops};
use crate::{Attempt, Incident, Skin, Texts, What};

/// What a contact is in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ContactTexts {
    /// What came where, such as that acid of 148 °C came to a hand.
    pub text: String,
    /// How many drops it was, and of what.
    pub amount: String,
}

/// How grave a contact is, the least first: what came to bare skin before what gloves or goggles kept off, the eyes before hands, and much
/// acid before little; `None` of what is no contact.
fn order(incident: &Incident) -> Option<(bool, bool, f64)> {
    let What::OnSkin {
        skin,
        volume_m3,
        acid,
        protected,
        ..
    } = &incident.what
    else {
        return None;
    };
    let eyes = *skin == Skin::Face;
    // Hot water is a contact too.
    Some((*protected, !eyes, -volume_m3 * (*acid).max(IRRITANT)))
}

impl Attempt {
    /// The incident in which acid or hot liquid touched the user that is the gravest; `None` where nothing did.
    pub fn gravest_contact(&self) -> Option<&Incident> {
        let contacts = self.incidents.iter();
        let contacts = contacts.filter_map(|it| Some((order(it)?, it)));
        let gravest = contacts.min_by(|((bare, eyes, acid), _), (other, _)| {
            (bare, eyes)
                .cmp(&(&other.0, &other.1))
                .then(acid.total_cmp(&other.2))
        });
        gravest.map(|(_, incident)| incident)
    }
}

impl Texts {
    /// A contact in words; `None` of an incident of another kind.
    pub fn contact(&self, incident: &Incident) -> Option<ContactTexts> {
        let What::OnSkin {
            skin,
            volume_m3,
            acid,
            temperature_c,
            protected,
        } = &incident.what
        else {
            return None;
        };
        let texts = &self.contact;
        let temperature = temperature_c.map(|celsius| self.temperature(celsius));
        let liquid = match &temperature {
            Some(_) if *acid < IRRITANT => &texts.water_at,
            Some(_) => &texts.acid_at,
            None => &texts.acid,
        };
        let liquid = liquid.fill(&[("temperature", temperature.as_deref().unwrap_or(""))]);
        let text = match (skin, protected) {
            (Skin::Face, false) => &texts.face,
            (Skin::Face, true) => &texts.goggles,
            (Skin::LeftHand | Skin::RightHand, false) => &texts.hand,
            (Skin::LeftHand | Skin::RightHand, true) => &texts.glove,
        };
        let drops = self.count(drops(*volume_m3));
        let amount = self.amount(*volume_m3, *acid);
        let amount = if *volume_m3 < DROP_M3 {
            texts.less.fill(&[("amount", &amount)])
        } else {
            texts.drops.fill(&[("drops", &drops), ("amount", &amount)])
        };
        Some(ContactTexts {
            text: text.fill(&[("liquid", &liquid)]),
            amount,
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{Cause, Language};

    fn contact(skin: Skin, protected: bool, volume_m3: f64) -> Incident {
        Incident {
            t_s: 1.0,
            until_s: 2.0,
            what: What::OnSkin {
                skin,
                volume_m3,
                acid: 0.68,
                temperature_c: Some(148.2),
                protected,
            },
            cause: Cause::Unknown,
            place_m: [0.0; 3],
        }
    }

    /// A bare face is graver than a bare hand, that than goggles and these than a glove, however much it was; else more is graver.
    #[test]
    fn bare_skin_and_eyes_come_first() {
        let in_order = [
            contact(Skin::Face, false, 1e-9),
            contact(Skin::RightHand, false, 2e-6),
            contact(Skin::LeftHand, false, 1e-6),
            contact(Skin::Face, true, 1e-6),
            contact(Skin::LeftHand, true, 9e-6),
        ];
        let dropped = Incident {
            what: What::Hot {
                flask: "target".into(),
                temperature_c: 148.0,
            },
            ..contact(Skin::Face, false, 1e-9)
        };
        let mut attempt = Attempt {
            incidents: in_order.iter().rev().cloned().collect(),
            ..Attempt::default()
        };
        attempt.incidents.insert(0, dropped);
        for gravest in &in_order {
            assert_eq!(attempt.gravest_contact(), Some(gravest));
            attempt.incidents.retain(|it| it != gravest);
        }
        assert_eq!(attempt.gravest_contact(), None);
    }

    /// 0.12 mL are two drops of 0.05 mL and a begun one.
    #[test]
    fn a_contact_says_how_hot_it_was() {
        let texts = Texts::english().unwrap();
        let said = |skin, protected| {
            let said = texts.contact(&contact(skin, protected, 0.12e-6)).unwrap();
            [said.text, said.amount].map(|it| it.replace('\u{a0}', " "))
        };
        assert_eq!(
            said(Skin::LeftHand, false),
            [
                "Acid at 148 °C on your hand.",
                "Drops of 0.05 mL (part of a drop counts as one): 3. In all: 0.12 mL of 68 % acid."
            ]
        );
        assert_eq!(said(Skin::Face, true)[0], "Acid at 148 °C on your goggles.");
    }

    /// A hundredth of a drop is said to be less than one, in each language; a whole one is one.
    #[test]
    fn less_than_a_drop_is_not_said_to_be_one() {
        let said = |volume_m3| {
            Language::ALL.map(|language| {
                let texts = Texts::of(language).unwrap();
                let told = texts.contact(&contact(Skin::LeftHand, false, volume_m3));
                told.unwrap().amount.replace('\u{a0}', " ")
            })
        };
        assert_eq!(
            said(0.41e-9),
            [
                "Less than a drop of 0.05 mL, which counts as a whole one. In all: 0.0004 mL of 68 % acid.",
                "Weniger als ein Tropfen von 0,05 mL, gezählt als ein ganzer. Insgesamt: 0,0004 mL Säure (68 %).",
                "Menos de una gota de 0,05 mL, que cuenta como entera. En total: 0,0004 mL de ácido al 68 %.",
                "不到一滴（每滴0.05 mL），按一滴计。总量：0.0004 mL质量分数为68%的硫酸。",
            ]
        );
        let [one, ..] = said(0.05e-6);
        assert_eq!(
            one,
            "Drops of 0.05 mL (part of a drop counts as one): 1. In all: 0.050 mL of 68 % acid."
        );
    }
}
