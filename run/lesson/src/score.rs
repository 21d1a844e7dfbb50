//! Points of an attempt, with the evidence for them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::rubric::{Ramp, Rubric};
use crate::texts::Texts;
use crate::{Attempt, Incident, Pour, What};

/// A criterion of the score.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, JsonSchema, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Criterion {
    /// Acid was poured into water, not water into acid.
    RightOrder,
    /// Acid and water came together slowly.
    PouredSlowly,
    /// The mixed liquid stayed below a temperature.
    StayedCool,
    /// Nothing boiled over.
    NothingThrownOut,
    /// Nothing came to lie on bench or floor.
    NothingSpilt,
    /// Nothing came to hands or face.
    NothingOnSkin,
    /// No flask was dropped or broken.
    GlassWhole,
}

impl Criterion {
    /// All criteria, in the order of a score's lines.
    pub const ALL: [Self; 7] = [
        Self::RightOrder,
        Self::PouredSlowly,
        Self::StayedCool,
        Self::NothingThrownOut,
        Self::NothingSpilt,
        Self::NothingOnSkin,
        Self::GlassWhole,
    ];

    /// Its name, in a few words.
    pub fn name(self, texts: &Texts) -> String {
        let names = &texts.criterion;
        let name = match self {
            Self::RightOrder => &names.right_order,
            Self::PouredSlowly => &names.poured_slowly,
            Self::StayedCool => &names.stayed_cool,
            Self::NothingThrownOut => &names.nothing_thrown_out,
            Self::NothingSpilt => &names.nothing_spilt,
            Self::NothingOnSkin => &names.nothing_on_skin,
            Self::GlassWhole => &names.glass_whole,
        };
        name.text()
    }

    fn ramp(self, rubric: &Rubric) -> Ramp {
        match self {
            Self::RightOrder => rubric.right_order,
            Self::PouredSlowly => rubric.poured_slowly,
            Self::StayedCool => rubric.stayed_cool,
            Self::NothingThrownOut => rubric.nothing_thrown_out,
            Self::NothingSpilt => rubric.nothing_spilt,
            Self::NothingOnSkin => rubric.nothing_on_skin,
            Self::GlassWhole => rubric.glass_whole,
        }
    }

    /// Formats a value in the unit of its limits.
    fn value(self, value: f64, texts: &Texts) -> String {
        match self {
            Self::PouredSlowly => texts.rate(value),
            Self::StayedCool => texts.temperature(value),
            _ => texts.volume(value),
        }
    }

    /// A sentence that states how its points are given.
    fn rule(self, rubric: &Rubric, texts: &Texts) -> String {
        let (ramp, rule) = (self.ramp(rubric), &texts.rule);
        let (template, share) = match self {
            Self::RightOrder => (&rule.right_order, 1.0),
            Self::PouredSlowly | Self::StayedCool => (&rule.up_to, 1.0),
            Self::NothingThrownOut | Self::NothingSpilt => (&rule.nothing, rubric.harmless_share),
            Self::NothingOnSkin => (&rule.skin, rubric.protected_share),
            Self::GlassWhole => (&rule.glass, 1.0),
        };
        template.fill(&[
            ("full_to", &self.value(ramp.full_to, texts)),
            ("none_from", &self.value(ramp.none_from, texts)),
            ("share", &texts.fraction(share)),
        ])
    }
}

/// Evidence for points that are given or withheld.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Evidence {
    /// The moment, simulated time of the run, s; `None` of the whole attempt.
    pub t_s: Option<f64>,
    /// The evidence, in a sentence.
    pub text: String,
}

/// The points of one criterion.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct ScoreLine {
    /// The criterion.
    pub criterion: Criterion,
    /// Points given.
    pub points: u32,
    /// Points that can be given.
    pub of: u32,
    /// How points are given, in a sentence.
    pub rule: String,
    /// Evidence for the points; never empty.
    pub evidence: Vec<Evidence>,
}

/// A criterion that is not judged.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct LeftOut {
    /// The criterion.
    pub criterion: Criterion,
    /// Why, in a sentence.
    pub why: String,
}

/// The points of an attempt.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Score {
    /// Points given.
    pub points: u32,
    /// Points that can be given by the criteria that are judged; 0 of an attempt in which nothing was done.
    pub of: u32,
    /// A line for each criterion that is judged.
    pub lines: Vec<ScoreLine>,
    /// Criteria that cannot be judged, and count neither way.
    pub left_out: Vec<LeftOut>,
}

/// Finding for a criterion.
enum Found {
    /// A value in the unit of its limits, and its evidence.
    Value(f64, Vec<Evidence>),
    /// No points, whatever the limits.
    None(Vec<Evidence>),
    /// Nothing to judge, and the reason.
    LeftOut(String),
}

impl Score {
    /// Scores an attempt by `rubric`, in the language of `texts`.
    pub fn of(attempt: &Attempt, rubric: &Rubric, texts: &Texts) -> Self {
        let mut score = Self {
            points: 0,
            of: 0,
            lines: Vec::new(),
            left_out: Vec::new(),
        };
        let judge = Judge {
            attempt,
            rubric,
            texts,
        };
        for criterion in Criterion::ALL {
            let ramp = criterion.ramp(rubric);
            let (points, evidence) = match judge.found(criterion) {
                Found::Value(value, evidence) => (ramp.points(value), evidence),
                Found::None(evidence) => (0, evidence),
                Found::LeftOut(why) => {
                    score.left_out.push(LeftOut { criterion, why });
                    continue;
                }
            };
            score.points = score.points.saturating_add(points);
            score.of = score.of.saturating_add(ramp.points);
            score.lines.push(ScoreLine {
                criterion,
                points,
                of: ramp.points,
                rule: criterion.rule(rubric, texts),
                evidence,
            });
        }
        score
    }
}

struct Judge<'a> {
    attempt: &'a Attempt,
    rubric: &'a Rubric,
    texts: &'a Texts,
}

impl Judge<'_> {
    fn found(&self, criterion: Criterion) -> Found {
        let well = &self.texts.well;
        match criterion {
            Criterion::RightOrder => self.right_order(),
            Criterion::PouredSlowly => self.poured_slowly(),
            Criterion::StayedCool => self.stayed_cool(),
            Criterion::NothingThrownOut => self.mishaps(&well.kept.text(), |what| match what {
                What::BoiledOver {
                    volume_m3, acid, ..
                } => Some(self.rubric.counted(*volume_m3, *acid)),
                _ => None,
            }),
            Criterion::NothingSpilt => self.mishaps(&well.clean.text(), |what| match what {
                What::Spilt {
                    volume_m3, acid, ..
                } => Some(self.rubric.counted(*volume_m3, *acid)),
                _ => None,
            }),
            Criterion::NothingOnSkin => self.mishaps(&well.skin.text(), |what| match what {
                // Hot water alone makes an incident, so its acid does not matter.
                What::OnSkin {
                    volume_m3,
                    protected,
                    ..
                } if *protected => Some(volume_m3 * self.rubric.protected_share),
                What::OnSkin { volume_m3, .. } => Some(*volume_m3),
                _ => None,
            }),
            Criterion::GlassWhole => self.mishaps(&well.glass.text(), |what| match what {
                What::Dropped { broke: true, .. } => Some(1.0),
                What::Dropped { .. } => Some(self.rubric.whole_share),
                _ => None,
            }),
        }
    }

    /// Sum of `counts` over the incidents; where none counts, 0 with the sentence `well` as its evidence.
    fn mishaps(&self, well: &str, counts: impl Fn(&What) -> Option<f64>) -> Found {
        let incidents = self.attempt.incidents.iter();
        let counted: Vec<_> = incidents
            .filter_map(|it| Some((it, counts(&it.what)?)))
            .collect();
        let evidence = counted.iter().map(|(it, _)| self.incident(it)).collect();
        let value = counted.iter().map(|(_, value)| value).sum();
        match (self.nothing_poured(), counted.is_empty()) {
            (true, true) => Found::LeftOut(self.texts.left_out.nothing_poured.text()),
            // Otherwise a spilt drop would score more than an attempt in which nothing was poured.
            (true, false) => Found::None(evidence),
            (false, true) => Found::Value(0.0, vec![whole(well.to_owned())]),
            (false, false) => Found::Value(value, evidence),
        }
    }

    fn nothing_poured(&self) -> bool {
        self.attempt.poured_m3() < self.rubric.least_m3
    }

    fn right_order(&self) -> Found {
        if let Some(left_out) = self.no_dilution() {
            return left_out;
        }
        let (mut wrong_m3, mut evidence) = (0.0, Vec::new());
        for incident in &self.attempt.incidents {
            if let What::WaterIntoAcid { volume_m3, .. } = incident.what {
                wrong_m3 += volume_m3;
                evidence.push(self.incident(incident));
            }
        }
        let right = || {
            self.attempt
                .pours
                .iter()
                .filter(|it| it.is_acid_into_water())
        };
        evidence.extend(right().map(|pour| self.pour(pour)));
        if right().map(|pour| pour.volume_m3).sum::<f64>() < self.rubric.least_m3 {
            let least = self.texts.volume(self.rubric.least_m3);
            let template = &self.texts.evidence.too_little_acid;
            evidence.push(whole(template.fill(&[("least", &least)])));
            return Found::None(evidence);
        }
        evidence.sort_by(|a, b| moment(a).total_cmp(&moment(b)));
        Found::Value(wrong_m3, evidence)
    }

    fn poured_slowly(&self) -> Found {
        if let Some(not) = self.no_dilution().or_else(|| self.too_little()) {
            return not;
        }
        let pours = self.attempt.mixing().map(|it| (it.fastest_m3_s, it.t_s));
        let fastest = pours.reduce(|a, b| if b.0 > a.0 { b } else { a });
        let (mut most, at) = fastest.unwrap_or((0.0, 0.0));
        let mut evidence = Vec::new();
        for incident in &self.attempt.incidents {
            if let What::PouredTooFast { rate_m3_s, .. } = incident.what {
                most = most.max(rate_m3_s);
                evidence.push(self.incident(incident));
            }
        }
        if evidence.is_empty() {
            let rate = self.texts.rate(most);
            evidence.push(Evidence {
                t_s: Some(at),
                text: self.texts.well.slowly.fill(&[("rate", &rate)]),
            });
        }
        Found::Value(most, evidence)
    }

    fn stayed_cool(&self) -> Found {
        if let Some(not) = self.no_dilution().or_else(|| self.too_little()) {
            return not;
        }
        let Some((t_s, warmest_c)) = self.attempt.warmest() else {
            return Found::LeftOut(self.texts.left_out.no_heat.text());
        };
        let temperature = self.texts.temperature(warmest_c);
        let template = if warmest_c <= self.rubric.stayed_cool.full_to {
            &self.texts.well.cool
        } else {
            &self.texts.evidence.mean
        };
        let evidence = Evidence {
            t_s: Some(t_s),
            text: template.fill(&[("temperature", &temperature)]),
        };
        Found::Value(warmest_c, vec![evidence])
    }

    /// Why no dilution can be judged, if that is so.
    fn no_dilution(&self) -> Option<Found> {
        let why = &self.texts.left_out;
        if !self.attempt.can_mix() {
            return Some(Found::LeftOut(why.no_acid.text()));
        }
        self.nothing_poured()
            .then(|| Found::LeftOut(why.nothing_poured.text()))
    }

    /// No points, with the reason, where acid and water were not mixed although they could have been.
    fn too_little(&self) -> Option<Found> {
        let mixed: f64 = self.attempt.mixing().map(|pour| pour.volume_m3).sum();
        let least = self.texts.volume(self.rubric.least_m3);
        let template = &self.texts.evidence.too_little;
        let text = || template.fill(&[("least", &least)]);
        (mixed < self.rubric.least_m3).then(|| Found::None(vec![whole(text())]))
    }

    fn incident(&self, incident: &Incident) -> Evidence {
        Evidence {
            t_s: Some(incident.t_s),
            text: self.texts.wrong(self.attempt, incident),
        }
    }

    fn pour(&self, pour: &Pour) -> Evidence {
        Evidence {
            t_s: Some(pour.t_s),
            text: self.texts.pour(pour),
        }
    }
}

fn whole(text: String) -> Evidence {
    Evidence { t_s: None, text }
}

fn moment(evidence: &Evidence) -> f64 {
    evidence.t_s.unwrap_or(f64::INFINITY)
}
