//! An attempt in plain sentences.

use std::collections::BTreeSet;

use crate::skin::{self, Acid, Heat};
use crate::texts::{Template, Texts};
use crate::{
    Attempt, Cap, Cause, Content, Criterion, Ending, Evidence, Incident, Pour, Score, Skin,
    Surface, What,
};

/// By how much the hottest particle has to be above the warmest liquid at the start to be told, K. Our choice: temperatures are told in
/// whole degrees.
const WARMER: f64 = 1.0;

/// Tone of a sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Tone {
    /// It went well.
    Good,
    /// It went wrong.
    Bad,
    /// Neutral.
    Plain,
}

/// A sentence about a moment, or about the whole attempt.
#[derive(Clone, Debug, PartialEq)]
pub struct Sentence {
    /// The moment, simulated time of the run, s: the film's time. `None`: the whole attempt.
    pub t_s: Option<f64>,
    /// Its tone.
    pub tone: Tone,
    /// The fact.
    pub text: String,
    /// Cause, danger and remedy: sentences for a page that has room for them.
    pub more: Option<String>,
}

/// An attempt in sentences: the caps of its score, then those of a moment in the order of time, then those of the whole. `score` is
/// the attempt's own: a criterion with all points gives a sentence that it went well.
pub fn sentences(attempt: &Attempt, score: &Score, texts: &Texts) -> Vec<Sentence> {
    let mut said = Vec::new();
    let mut say = |t_s, tone, text, more| {
        said.push(Sentence {
            t_s,
            tone,
            text,
            more,
        });
    };
    for pour in attempt.pours.iter().filter(|it| !attempt.says(it)) {
        let good = pour.is_acid_into_water();
        let tone = if good { Tone::Good } else { Tone::Plain };
        say(Some(pour.t_s), tone, texts.pour(attempt, pour), None);
    }
    if attempt.pours.is_empty() {
        say(None, Tone::Plain, texts.pour.nothing.text(), None);
    }
    let mut dangers = BTreeSet::new();
    for incident in &attempt.incidents {
        let more = texts.more(attempt, incident, &mut dangers);
        let text = texts.wrong(attempt, incident);
        say(Some(incident.t_s), Tone::Bad, text, more);
    }
    // Fewer drops than a boil-over counts can reach skin. The criterion then has all its points, and is no success all the same.
    let boiled_onto_skin = attempt.incidents.iter().any(|it| {
        matches!(it.what, What::OnSkin { .. }) && matches!(it.cause, Cause::Boiling { .. })
    });
    for line in &score.lines {
        let praised = match line.criterion {
            // The sentences of the pours state the right order themselves.
            Criterion::RightOrder => false,
            Criterion::NothingThrownOut => !boiled_onto_skin,
            _ => true,
        };
        if line.points == line.of && praised {
            for evidence in &line.evidence {
                say(evidence.t_s, Tone::Good, evidence.text.clone(), None);
            }
        }
    }
    match &attempt.ending {
        None => say(None, Tone::Plain, texts.end.broken_off.text(), None),
        Some(ending) => {
            for (t_s, text) in texts.ending(attempt, ending) {
                say(t_s, Tone::Plain, text, None);
            }
        }
    }
    let moment = |sentence: &Sentence| sentence.t_s.unwrap_or(f64::INFINITY);
    // Stable: sentences of one moment stay in the order of above.
    said.sort_by(|a, b| moment(a).total_cmp(&moment(b)));
    let caps = score.caps.iter().map(|cap| Sentence {
        t_s: cap.t_s(),
        tone: Tone::Bad,
        text: cap.text.clone(),
        more: None,
    });
    caps.chain(said).collect()
}

impl Attempt {
    /// Whether the sentence of an incident already describes that pour.
    fn says(&self, pour: &Pour) -> bool {
        self.incidents.iter().any(|incident| match &incident.what {
            What::WaterIntoAcid { .. } => self.pour_of(incident) == Some(pour),
            What::Spilt { .. } => {
                pour.into.is_none() && incident.cause.flask() == Some(&*pour.from)
            }
            _ => false,
        })
    }
}

impl Cause {
    /// The flask that it names.
    pub fn flask(&self) -> Option<&str> {
        match self {
            Self::Pouring { from: flask }
            | Self::Boiling { flask }
            | Self::Breaking { flask }
            | Self::LettingGo { flask }
            | Self::Splashing { flask }
            | Self::Mixing { flask }
            | Self::Swirling { flask }
            | Self::Heating { flask } => Some(flask),
            Self::Unknown => None,
        }
    }
}

impl Texts {
    /// What these attempts came to, as a title: the first that brought acid and water together in the wrong order, or else in the right
    /// one; `None` where none did.
    pub fn done(&self, attempts: &[Attempt]) -> Option<String> {
        let mut incidents = attempts.iter().flat_map(|it| &it.incidents);
        let mut pours = attempts.iter().flat_map(|it| &it.pours);
        let wrong = |it: &Incident| matches!(it.what, What::WaterIntoAcid { .. });
        if incidents.any(wrong) {
            Some(self.done.water_into_acid.text())
        } else if pours.any(Pour::is_acid_into_water) {
            Some(self.done.acid_into_water.text())
        } else {
            None
        }
    }

    /// Evidence with its moment, if it has one.
    pub fn told(&self, evidence: &Evidence) -> String {
        let Some(t_s) = evidence.t_s else {
            return evidence.text.clone();
        };
        let time = self.moment(t_s);
        let holes = [("time", time.as_str()), ("text", evidence.text.as_str())];
        self.evidence.at.fill(&holes)
    }

    /// A cap, and the first evidence for it.
    pub fn capped(&self, cap: &Cap) -> String {
        let Some(first) = cap.evidence.first() else {
            return cap.text.clone();
        };
        let first = self.told(first);
        let two = [("first", cap.text.as_str()), ("second", first.as_str())];
        self.join.two.fill(&two)
    }

    /// A sentence about a pour.
    pub(crate) fn pour(&self, attempt: &Attempt, pour: &Pour) -> String {
        let amount = self.amount(pour.volume_m3, pour.acid);
        let (duration, rate) = (self.duration(pour.lasted_s()), self.rate(pour.fastest_m3_s));
        let template = match &pour.into {
            None => &self.pour.beside,
            Some(_) if pour.is_acid_into_water() => &self.pour.acid_into_water,
            Some(_) => &self.pour.plain,
        };
        let into = pour.into.as_deref().unwrap_or("");
        self.with_flasks(
            template,
            &attempt.glass,
            &[("from", &pour.from), ("into", into)],
            &[
                ("amount", &amount),
                ("duration", &duration),
                ("rate", &rate),
            ],
        )
    }

    /// A sentence about an incident, without cause and danger.
    pub fn wrong(&self, attempt: &Attempt, incident: &Incident) -> String {
        let wrong = &self.wrong;
        let with = |template: &Template, holes: &[(&str, &str)]| template.fill(holes);
        let of = |template: &Template, flask: &str, holes: &[(&str, &str)]| {
            self.with_flasks(template, &attempt.glass, &[("flask", flask)], holes)
        };
        match &incident.what {
            What::WaterIntoAcid {
                flask,
                met_acid,
                volume_m3,
            } => {
                let pour = attempt.pour_of(incident);
                let rate = pour.map(|it| self.rate(it.fastest_m3_s));
                let template = if rate.is_some() {
                    &wrong.water_into_acid_at
                } else {
                    &wrong.water_into_acid
                };
                of(
                    template,
                    flask,
                    &[
                        ("acid", &self.fraction(*met_acid)),
                        ("volume", &self.volume(*volume_m3)),
                        ("duration", &self.duration(incident.lasted_s())),
                        ("rate", rate.as_deref().unwrap_or("")),
                    ],
                )
            }
            What::PouredTooFast {
                flask,
                rate_m3_s,
                limit_m3_s,
            } => {
                let [rate, limit] = [rate_m3_s, limit_m3_s].map(|it| self.rate(*it));
                let holes = [("rate", &*rate), ("limit", &*limit)];
                of(&wrong.poured_too_fast, flask, &holes)
            }
            What::BoiledOver {
                flask,
                volume_m3,
                acid,
            } => {
                let amount = self.amount(*volume_m3, *acid);
                of(&wrong.boiled_over, flask, &[("amount", &amount)])
            }
            What::Hot {
                flask,
                temperature_c,
            } => {
                let temperature = self.temperature(*temperature_c);
                of(&wrong.hot, flask, &[("temperature", &temperature)])
            }
            What::Spilt {
                surface,
                volume_m3,
                acid,
            } => {
                let template = match surface {
                    Surface::Bench => &wrong.spilt_bench,
                    Surface::Floor => &wrong.spilt_floor,
                };
                with(template, &[("amount", &self.amount(*volume_m3, *acid))])
            }
            What::OnSkin {
                skin,
                volume_m3,
                acid,
                protected,
                ..
            } => {
                let template = match (skin, protected) {
                    (Skin::LeftHand, false) => &wrong.left_hand,
                    (Skin::RightHand, false) => &wrong.right_hand,
                    (Skin::Face, false) => &wrong.face,
                    (Skin::LeftHand, true) => &wrong.left_glove,
                    (Skin::RightHand, true) => &wrong.right_glove,
                    (Skin::Face, true) => &wrong.goggles,
                };
                with(template, &[("amount", &self.amount(*volume_m3, *acid))])
            }
            What::Dropped {
                flask,
                speed_m_s,
                broke,
            } => {
                let template = if *broke { &wrong.broke } else { &wrong.dropped };
                let speed = self.speed(*speed_m_s);
                of(template, flask, &[("speed", &speed)])
            }
        }
    }

    /// Cause, danger and remedy of an incident. A danger that is in `dangers` was named before, and is not repeated.
    fn more(
        &self,
        attempt: &Attempt,
        incident: &Incident,
        dangers: &mut BTreeSet<String>,
    ) -> Option<String> {
        let news = self.dangers(&incident.what).into_iter();
        let news = news.filter(|danger| dangers.insert(danger.clone()));
        let said = self.cause(attempt, incident).into_iter().chain(news);
        said.chain(self.remedy(&incident.what))
            .reduce(|first, second| {
                let two = [("first", first.as_str()), ("second", second.as_str())];
                self.join.two.fill(&two)
            })
    }

    /// The cause; `None` where the kind of incident names it already.
    fn cause(&self, attempt: &Attempt, incident: &Incident) -> Option<String> {
        let causes = &self.cause;
        let template = match (&incident.what, &incident.cause) {
            (What::WaterIntoAcid { .. } | What::PouredTooFast { .. }, Cause::Pouring { .. })
            | (What::BoiledOver { .. }, Cause::Boiling { .. })
            | (What::Dropped { .. }, _) => return None,
            (_, Cause::Pouring { .. }) => &causes.pouring,
            (_, Cause::Boiling { .. }) => &causes.boiling,
            (_, Cause::Breaking { .. }) => &causes.breaking,
            (_, Cause::LettingGo { .. }) => &causes.letting_go,
            (_, Cause::Splashing { .. }) => &causes.splashing,
            (_, Cause::Mixing { .. }) => &causes.mixing,
            (_, Cause::Swirling { .. }) => &causes.swirling,
            (_, Cause::Heating { .. }) => &causes.heating,
            (_, Cause::Unknown) => &causes.unknown,
        };
        let flask = incident.cause.flask().unwrap_or_default();
        Some(self.with_flasks(template, &attempt.glass, &[("flask", flask)], &[]))
    }

    /// Sentences about its dangers.
    fn dangers(&self, what: &What) -> Vec<String> {
        let effect = &self.effect;
        let dangers = match what {
            What::WaterIntoAcid { .. } => [Some(effect.water_into_acid.text()), None],
            What::PouredTooFast { .. } => [Some(effect.too_fast.text()), None],
            What::Hot { temperature_c, .. } => [self.heat_does(*temperature_c), None],
            What::BoiledOver { acid, .. } | What::Spilt { acid, .. } => {
                [self.acid_does(*acid), None]
            }
            What::OnSkin {
                acid,
                temperature_c,
                protected: false,
                ..
            } => {
                let heat = temperature_c.and_then(|it| self.heat_does(it));
                [self.acid_does(*acid), heat]
            }
            What::OnSkin { .. } | What::Dropped { .. } => [None, None],
        };
        dangers.into_iter().flatten().collect()
    }

    /// The remedy.
    fn remedy(&self, what: &What) -> Option<String> {
        let effect = &self.effect;
        let remedy = match what {
            What::Spilt { .. } => &effect.wipe,
            What::OnSkin {
                protected: true, ..
            } => &effect.protected,
            What::OnSkin { .. } => &effect.rinse,
            _ => return None,
        };
        Some(remedy.text())
    }

    fn acid_does(&self, acid: f64) -> Option<String> {
        match skin::acid(acid) {
            Acid::Harmless => None,
            Acid::Irritant => Some(self.effect.irritant.text()),
            Acid::Corrosive => Some(self.effect.corrosive.text()),
        }
    }

    fn heat_does(&self, temperature_c: f64) -> Option<String> {
        match skin::heat(temperature_c) {
            Heat::Harmless => None,
            Heat::AtOnce => Some(self.effect.heat_at_once.text()),
            Heat::Within { time_s } => {
                let holes = [("duration", &*self.duration(time_s))];
                Some(self.effect.heat_within.fill(&holes))
            }
        }
    }

    /// Sentences about the hottest particle, where it is hotter than the liquids were at the start and no incident names it, and
    /// the contents of flasks that were poured from or into.
    fn ending(&self, attempt: &Attempt, ending: &Ending) -> Vec<(Option<f64>, String)> {
        let mut said = Vec::new();
        let hot = |incident: &Incident| matches!(incident.what, What::Hot { .. });
        let start = attempt.contents.values();
        let start = start.filter_map(|it| it.temperature_c);
        let warmest = start.fold(f64::MIN, f64::max);
        if let Some(hottest) = &ending.hottest
            && hottest.temperature_c > warmest + WARMER
            && !attempt.incidents.iter().any(hot)
        {
            let temperature = self.temperature(hottest.temperature_c);
            let (template, flask) = match &hottest.flask {
                Some(flask) => (&self.end.hottest, flask.as_str()),
                None => (&self.end.hottest_outside, ""),
            };
            let text = self.with_flasks(
                template,
                &attempt.glass,
                &[("flask", flask)],
                &[("temperature", &temperature)],
            );
            said.push((Some(hottest.t_s), text));
        }
        for (flask, content) in &ending.contents {
            let mut pours = attempt.pours.iter();
            if pours.any(|pour| pour.from == *flask || pour.into.as_ref() == Some(flask)) {
                said.push((Some(ending.t_s), self.holds(attempt, flask, content)));
            }
        }
        said
    }

    fn holds(&self, attempt: &Attempt, flask: &str, content: &Content) -> String {
        let amount = self.amount(content.volume_m3, content.acid);
        let temperature = content.temperature_c.map(|it| self.temperature(it));
        let template = match temperature {
            Some(_) => &self.end.holds_at,
            None => &self.end.holds,
        };
        self.with_flasks(
            template,
            &attempt.glass,
            &[("flask", flask)],
            &[
                ("amount", &amount),
                ("temperature", temperature.as_deref().unwrap_or("")),
            ],
        )
    }
}
