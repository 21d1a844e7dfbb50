//! Points of an attempt, with the evidence for them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::caps::Danger;
use crate::rubric::{Ramp, Rubric};
use crate::skin::drops;
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
            Self::NothingOnSkin => texts.count(value),
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

/// A cap of a score, for a danger that happened.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Cap {
    /// The danger.
    pub danger: Danger,
    /// Most points, of the score's.
    pub most: u32,
    /// Cap and danger, in a sentence.
    pub text: String,
    /// Evidence for the danger; never empty.
    pub evidence: Vec<Evidence>,
}

impl Cap {
    /// When the danger first happened, simulated time of the run, s.
    pub fn t_s(&self) -> Option<f64> {
        self.evidence.first()?.t_s
    }
}

/// The points of an attempt.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Score {
    /// Points given: what the lines add up to, or the lowest cap where that is less.
    pub points: u32,
    /// Points that can be given by the criteria that are judged; 0 of an attempt in which nothing was done.
    pub of: u32,
    /// A line for each criterion that is judged.
    pub lines: Vec<ScoreLine>,
    /// Criteria that cannot be judged, and count neither way.
    pub left_out: Vec<LeftOut>,
    /// Caps for what endangered the user, the lowest first; also those that are higher than the points.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub caps: Vec<Cap>,
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
            caps: Vec::new(),
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
            score.of = score.of.saturating_add(ramp.points);
            score.lines.push(ScoreLine {
                criterion,
                points,
                of: ramp.points,
                rule: criterion.rule(rubric, texts),
                evidence,
            });
        }
        score.caps = judge.caps(score.of);
        let most = score.caps.first().map_or(score.of, |cap| cap.most);
        score.points = score.uncapped().min(most);
        score
    }

    /// Points that the lines add up to, without a cap.
    pub fn uncapped(&self) -> u32 {
        let points = self.lines.iter().map(|line| line.points);
        points.fold(0, u32::saturating_add)
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
                } if *protected => Some(drops(*volume_m3) * self.rubric.protected_share),
                What::OnSkin { volume_m3, .. } => Some(drops(*volume_m3)),
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
        let mut evidence = self.water_into_acid();
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
        Found::Value(self.attempt.water_into_acid_m3(), evidence)
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

    /// The incidents in which water came to acid.
    fn water_into_acid(&self) -> Vec<Evidence> {
        self.incidents(|what| matches!(what, What::WaterIntoAcid { .. }))
    }

    /// The incidents of that kind.
    fn incidents(&self, is: impl Fn(&What) -> bool) -> Vec<Evidence> {
        let incidents = self.attempt.incidents.iter();
        let found = incidents.filter(|it| is(&it.what));
        found.map(|it| self.incident(it)).collect()
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
            text: self.texts.pour(self.attempt, pour),
        }
    }
}

impl Judge<'_> {
    /// The caps of a score of `of` points, the lowest first.
    fn caps(&self, of: u32) -> Vec<Cap> {
        let cap = |danger| {
            let most = self.rubric.caps.most_of(danger, of)?;
            let evidence = self.endangered(danger);
            (of > 0 && !evidence.is_empty()).then(|| Cap {
                danger,
                most,
                text: self.texts.cap(danger, most, of),
                evidence,
            })
        };
        let mut caps: Vec<Cap> = Danger::ALL.into_iter().filter_map(cap).collect();
        caps.sort_by_key(|cap| cap.most);
        caps
    }

    /// Evidence that this danger happened, in the order of time; empty where it did not.
    fn endangered(&self, danger: Danger) -> Vec<Evidence> {
        match danger {
            Danger::WrongOrder if self.attempt.water_into_acid_m3() < self.rubric.least_m3 => {
                Vec::new()
            }
            Danger::WrongOrder => self.water_into_acid(),
            Danger::AcidOnSkin => self.incidents(What::is_acid_on_skin),
            Danger::NoGoggles => {
                let pours = self.attempt.pours.iter();
                let bare = pours.filter(|it| it.lacks_goggles());
                bare.map(|pour| self.pour(pour)).collect()
            }
        }
    }
}

fn whole(text: String) -> Evidence {
    Evidence { t_s: None, text }
}

fn moment(evidence: &Evidence) -> f64 {
    evidence.t_s.unwrap_or(f64::INFINITY)
}
