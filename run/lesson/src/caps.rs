//! Caps: the most that an attempt can score in which something dangerous was done.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vitriol_sim::solver::SCALDS;

use crate::limits::CONCENTRATED;
use crate::skin::{CORROSIVE, IRRITANT};
use crate::texts::Texts;
use crate::{Pour, What};

/// Points of a score without a cap, of 100.
pub(crate) const WHOLE: u32 = 100;

/// What endangers a student so much that the other points do not make up for it.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, JsonSchema, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Danger {
    /// Water was poured into concentrated acid, the rubric's least volume or more.
    WrongOrder,
    /// Concentrated or hot acid came to a bare hand or a bare face.
    AcidOnSkin,
    /// Acid that burns was poured, or poured into, by somebody who wore no goggles.
    NoGoggles,
}

impl Danger {
    /// All dangers.
    pub const ALL: [Self; 3] = [Self::WrongOrder, Self::AcidOnSkin, Self::NoGoggles];

    /// Its name, as in JSON and in a lesson's file.
    pub fn name(self) -> &'static str {
        match self {
            Self::WrongOrder => "wrong-order",
            Self::AcidOnSkin => "acid-on-skin",
            Self::NoGoggles => "no-goggles",
        }
    }
}

/// By danger, the most points out of 100 that an attempt can have in which it happened; 100: no cap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Caps {
    /// [`Danger::WrongOrder`].
    pub wrong_order: u32,
    /// [`Danger::AcidOnSkin`].
    pub acid_on_skin: u32,
    /// [`Danger::NoGoggles`].
    pub no_goggles: u32,
}

impl Default for Caps {
    /// Our choice: less than half of the points where somebody is hurt or nearly so, and a little more than half where goggles would
    /// have been needed and were not.
    fn default() -> Self {
        Self {
            wrong_order: 40,
            acid_on_skin: 40,
            no_goggles: 60,
        }
    }
}

impl Caps {
    /// The caps by their keys in a lesson's file.
    pub(crate) fn named(&self) -> [(&'static str, u32); 3] {
        [
            ("wrong_order", self.wrong_order),
            ("acid_on_skin", self.acid_on_skin),
            ("no_goggles", self.no_goggles),
        ]
    }

    /// These caps, without one for what a lesson asks for.
    #[must_use]
    pub(crate) fn without(mut self, danger: Danger) -> Self {
        *match danger {
            Danger::WrongOrder => &mut self.wrong_order,
            Danger::AcidOnSkin => &mut self.acid_on_skin,
            Danger::NoGoggles => &mut self.no_goggles,
        } = WHOLE;
        self
    }

    /// Most points out of 100 where that danger happened; `None`: no cap.
    fn most(&self, danger: Danger) -> Option<u32> {
        let most = match danger {
            Danger::WrongOrder => self.wrong_order,
            Danger::AcidOnSkin => self.acid_on_skin,
            Danger::NoGoggles => self.no_goggles,
        };
        (most < WHOLE).then_some(most)
    }

    /// Most points of `of` where that danger happened, rounded down; `None`: no cap.
    pub(crate) fn most_of(&self, danger: Danger, of: u32) -> Option<u32> {
        let points = u64::from(self.most(danger)?) * u64::from(of) / u64::from(WHOLE);
        u32::try_from(points).ok()
    }

    /// A sentence for each danger that has a cap.
    pub fn sentences(&self, texts: &Texts) -> Vec<String> {
        let capped = Danger::ALL.into_iter();
        let capped = capped.filter_map(|danger| Some((danger, self.most(danger)?)));
        capped
            .map(|(danger, most)| texts.cap(danger, most, WHOLE))
            .collect()
    }
}

impl What {
    /// Whether concentrated or hot acid came to bare skin.
    pub(crate) fn is_acid_on_skin(&self) -> bool {
        match self {
            Self::OnSkin {
                acid,
                temperature_c,
                protected: false,
                ..
            } => {
                let is_hot = temperature_c.is_some_and(|it| it >= SCALDS);
                *acid >= CONCENTRATED || (*acid >= IRRITANT && is_hot)
            }
            _ => false,
        }
    }
}

impl Pour {
    /// Whether acid that burns eyes was poured, or poured into, in front of a bare face.
    pub(crate) fn lacks_goggles(&self) -> bool {
        let met = self.met.map_or(0.0, |met| met.acid);
        self.bare_face && self.acid.max(met) >= CORROSIVE
    }
}

impl Texts {
    /// The sentence of a cap of `most` of `of` points.
    pub(crate) fn cap(&self, danger: Danger, most: u32, of: u32) -> String {
        let danger = match danger {
            Danger::WrongOrder => &self.cap.wrong_order,
            Danger::AcidOnSkin => &self.cap.acid_on_skin,
            Danger::NoGoggles => &self.cap.no_goggles,
        };
        self.cap.most.fill(&[
            ("most", &most.to_string()),
            ("of", &of.to_string()),
            ("danger", &danger.text()),
        ])
    }
}
