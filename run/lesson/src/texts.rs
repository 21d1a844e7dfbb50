//! The string table: sentences about an attempt and in a lesson, in one language.

mod template;

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use vitriol_sim::flask::glassware::Vessel;

use crate::language::Language;
use crate::procedure::{Lesson, LessonTexts};

pub use self::template::Template;
use self::template::{Part, parts};

const ENGLISH: &str = concat!(
    include_str!("../texts/en.toml"),
    include_str!("../texts/report/en.toml"),
    include_str!("../texts/fault/en.toml")
);
const GERMAN: &str = concat!(
    include_str!("../texts/de.toml"),
    include_str!("../texts/report/de.toml"),
    include_str!("../texts/fault/de.toml")
);
const SPANISH: &str = concat!(
    include_str!("../texts/es.toml"),
    include_str!("../texts/report/es.toml"),
    include_str!("../texts/fault/es.toml")
);
const CHINESE: &str = concat!(
    include_str!("../texts/zh.toml"),
    include_str!("../texts/report/zh.toml"),
    include_str!("../texts/fault/zh.toml")
);

/// Why a string table is refused.
#[derive(Debug, thiserror::Error)]
pub enum TextsError {
    /// It is no TOML, or a key is missing or unknown.
    #[error("the string table does not have the keys of the English one in run/lesson/texts: {0}")]
    Keys(#[from] toml::de::Error),
    /// A sentence is there in one of the two tables alone.
    #[error("{key}: is only in {only}; in run/lesson/texts each language has the same keys")]
    Alone {
        /// The sentence's key.
        key: String,
        /// The table that has it.
        only: &'static str,
    },
    /// A sentence has other holes than the English one.
    #[error("{key}: has the holes {found:?}; the English one in run/lesson/texts has {needed:?}")]
    Holes {
        /// The sentence's key.
        key: String,
        /// Holes that it has.
        found: Vec<String>,
        /// Holes that it needs.
        needed: Vec<String>,
    },
}

/// Declares a section of the table: each of its keys is a sentence; other keys are refused.
macro_rules! section {
    ($name:ident: $($key:ident)+) => {
        #[derive(Clone, Debug, PartialEq, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct $name { $(pub(crate) $key: Template,)+ }
    };
    (pub $name:ident, $what:literal: $($key:ident)+) => {
        #[doc = $what]
        #[derive(Clone, Debug, PartialEq, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            $(
                #[doc = concat!("Text `", stringify!($key), "`.")]
                pub $key: Template,
            )+
        }
    };
}

section!(Number: decimal);
section!(Unit: millilitres litres millilitres_a_second seconds minutes hours celsius percent metres_a_second
    centimetres centimetres_a_second milligrams grams);
section!(Amount: water acid);
section!(Join: two glass);
section!(Pour: acid_into_water plain beside nothing);
section!(Wrong: water_into_acid water_into_acid_at poured_too_fast boiled_over hot spilt_bench spilt_floor left_hand right_hand face
    left_glove right_glove goggles dropped broke);
section!(Contact: acid acid_at water_at hand glove face goggles drops less);
section!(Cause: pouring boiling breaking letting_go splashing mixing heating unknown swirling);
section!(Effect: water_into_acid too_fast heat_at_once heat_within corrosive irritant rinse protected wipe);
section!(End: holds holds_at hottest hottest_outside broken_off);
section!(Well: slowly cool kept clean skin glass);
section!(BoilingTexts: steam steam_note gas gas_note thrown thrown_note drop drop_note nuclei nuclei_note);
section!(CriterionNames: right_order poured_slowly stayed_cool nothing_thrown_out nothing_spilt nothing_on_skin glass_whole);
section!(Rule: right_order up_to nothing skin glass);
section!(CapTexts: most wrong_order acid_on_skin no_goggles);
section!(Evidence: too_little too_little_acid mean at);
section!(LeftOut: nothing_poured no_acid no_heat);
section!(WhyTexts: too_fast too_much water_into_acid poured_too_fast boiled_over hot on_skin dropped spilt too_hot no_goggles no_gloves
    sash_open time_up wrong_answer skipped not_done);
section!(ModeNames: guided free examination);
section!(pub PanelTexts, "Labels on the panel around a lesson's steps.": hint skip finish steps more);
section!(GlassTexts: water acid layers empty left right nth);
section!(Done: water_into_acid acid_into_water);
section!(Forms: label subject into of);
section!(pub ReportTexts, "Headings and fixed sentences of a report.": kicker kicker_told happened wrong well other instructor
    score score_of attempt lesson lesson_again criterion points evidence step rule done failed missed kept broken share_of_steps
    after_failure in_all judged not_judged part total at_most uncapped line no_points show film frames idle click click_words liquid speed temperature acid
    solver figures ran none_lost whereabouts shares place mass share all table floor air over_time unsampled made_by hash numbers
    incidents);
section!(pub FigureTexts, "Names of figures of a run, each with its note.": density_error_mean density_error_mean_note
    density_error_p99 density_error_p99_note lost_particles lost_particles_note nan_particles nan_particles_note temperature_max_c
    temperature_max_c_note steam_kg steam_kg_note spray_fallen_kg spray_fallen_kg_note air_kg air_kg_note ledger_closure
    ledger_closure_note frames frames_note wall_s wall_s_note);
section!(pub PlotTexts, "Titles and units of a report's plots.": density_error kinetic_energy by_place above_rim left_flask lost
    temperature acid by_mass superheat superheated enthalpy bubbles ledger millionths rebuilt times);
section!(pub CurveTexts, "Legends of a report's plots.": mean p99 maximum least most kinetic_energy spilled evaporated mist
    superheat particles lost given steam all foam closure rebuilds);
section!(pub FaultTexts, "What is wrong with a lesson's file or with what is asked for, each with what would be right.": line field none
    no_toml duplicate no_lesson a_scene a_track quote unread unread_scene no_table no_list no_list_of_tables unknown unknown_and_missing
    variant missing one_of_all unfit unfit_kind whole number boolean text list keys table range version no_scene modes examination count no_points no_id twice before no_end ends
    parts deep question no_texts texts_missing texts_unknown answers empty long control brace lacks heat goggles gloves sash rod
    thermometer cloth rinsing no_flask fixed same_flask too_much new_name reserved from no_file other_file folder too_long encoding
    unopened alike builtin toml mode other_scene hundred);

/// The texts of one language: its file in `run/lesson/texts`, and its files in `report` and `fault` there. Each key is used and none is
/// missing.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Texts {
    #[serde(skip)]
    language: Language,
    pub(crate) number: Number,
    pub(crate) unit: Unit,
    pub(crate) amount: Amount,
    pub(crate) join: Join,
    pub(crate) pour: Pour,
    pub(crate) wrong: Wrong,
    pub(crate) contact: Contact,
    pub(crate) cause: Cause,
    pub(crate) effect: Effect,
    pub(crate) end: End,
    pub(crate) well: Well,
    pub(crate) boiling: BoilingTexts,
    pub(crate) criterion: CriterionNames,
    pub(crate) rule: Rule,
    pub(crate) cap: CapTexts,
    pub(crate) evidence: Evidence,
    pub(crate) left_out: LeftOut,
    pub(crate) why: WhyTexts,
    pub(crate) mode: ModeNames,
    /// Labels on the panel around a lesson's steps.
    pub panel: PanelTexts,
    pub(crate) glass: GlassTexts,
    /// Kinds of flasks, each in the forms that sentences ask for.
    pub(crate) vessel: BTreeMap<Vessel, Forms>,
    pub(crate) done: Done,
    /// Titles of the built-in scenes, by name.
    scene: BTreeMap<String, String>,
    /// Texts of the built-in lessons, by name.
    pub(crate) lesson: BTreeMap<String, LessonTexts>,
    /// Headings and fixed sentences of a report.
    pub report: ReportTexts,
    /// Names of figures of a run.
    pub figure: FigureTexts,
    /// Titles and units of a report's plots.
    pub plot: PlotTexts,
    /// Legends of a report's plots.
    pub curve: CurveTexts,
    /// What is wrong with a lesson.
    pub fault: FaultTexts,
}

impl Texts {
    /// The English texts, which the program carries.
    ///
    /// # Errors
    /// As for [`Texts::parse`], which a test rules out.
    pub fn english() -> Result<Self, TextsError> {
        Self::of(Language::En)
    }

    /// The texts of a language, which the program carries.
    ///
    /// # Errors
    /// As for [`Texts::parse`], which a test rules out.
    pub fn of(language: Language) -> Result<Self, TextsError> {
        let texts = Self::parse(table(language))?;
        Ok(Self { language, ..texts })
    }

    /// The language of the texts.
    pub fn language(&self) -> Language {
        self.language
    }

    /// Title of the scene of that name; of one that is not built in its name.
    pub fn scene<'a>(&'a self, name: &'a str) -> &'a str {
        self.scene.get(name).map_or(name, String::as_str)
    }

    /// Title of the lesson of that name; of one that is neither built in nor [learnt](Self::learn) its name.
    pub fn lesson<'a>(&'a self, name: &'a str) -> &'a str {
        self.lesson.get(name).map_or(name, |texts| &texts.title)
    }

    /// Takes in the texts of `lesson`, so that what is written of one of your own has its title and sentences.
    pub fn learn(&mut self, lesson: &Lesson) {
        let own = lesson.texts(self.language).clone();
        self.lesson.insert(lesson.name.clone(), own);
    }

    /// What the step or rule `id` of that lesson asks for; of a lesson that is neither built in nor [learnt](Self::learn) the id.
    pub fn asked<'a>(&'a self, lesson: &str, id: &'a str) -> &'a str {
        let texts = self.lesson.get(lesson);
        let step = texts.and_then(|texts| Some(&texts.step.get(id)?.text));
        let asked = step.or_else(|| texts?.rule.get(id));
        asked.map_or(id, String::as_str)
    }

    /// Parses the text of a language's files, one behind the other.
    ///
    /// # Errors
    /// [`TextsError`] if a key is missing or unknown, or a sentence's holes are not those of the English one: it would lose a number then,
    /// or show a hole's name.
    pub fn parse(text: &str) -> Result<Self, TextsError> {
        let (found, needed) = (holes(text)?, holes(ENGLISH)?);
        let texts = toml::from_str(text)?;
        for (key, needed) in &needed {
            let Some(found) = found.get(key) else {
                let (key, only) = (key.clone(), "the English table");
                return Err(TextsError::Alone { key, only });
            };
            if found != needed {
                let [found, needed] = [found, needed].map(|it| it.iter().cloned().collect());
                let key = key.clone();
                return Err(TextsError::Holes { key, found, needed });
            }
        }
        if let Some(key) = found.into_keys().find(|key| !needed.contains_key(key)) {
            let only = "the translation";
            return Err(TextsError::Alone { key, only });
        }
        Ok(texts)
    }
}

impl FaultTexts {
    /// Those of a language, without its other texts: each lesson is read with them.
    ///
    /// # Errors
    /// [`TextsError::Keys`] if a key is missing or unknown, which a test rules out.
    pub fn of(language: Language) -> Result<Self, TextsError> {
        let (_, faults) = table(language).rsplit_once("[fault]").unwrap_or_default();
        Ok(toml::from_str(faults)?)
    }
}

/// Text of the string table of a language.
fn table(language: Language) -> &'static str {
    match language {
        Language::En => ENGLISH,
        Language::De => GERMAN,
        Language::Es => SPANISH,
        Language::Zh => CHINESE,
    }
}

/// The lines of a built-in lesson's texts in a language, as its table has them.
pub(crate) fn lesson_lines(language: Language, name: &str) -> Option<&'static str> {
    let (_, rest) = table(language).split_once(&format!("[lesson.{name}]"))?;
    let lines = rest.split_once("\n[").map_or(rest, |(lines, _)| lines);
    Some(lines.trim())
}

/// The holes of each sentence, by its path.
fn holes(text: &str) -> Result<BTreeMap<String, BTreeSet<String>>, toml::de::Error> {
    let sentences = sentences(text)?;
    let of = |sentence: &str| {
        let holes = parts(sentence).filter_map(|part| match part {
            // Its form is each language's own.
            Part::Hole(name) => name.to_lowercase().split(':').next().map(str::to_owned),
            Part::Text(_) => None,
        });
        holes.collect::<BTreeSet<_>>()
    };
    let sentences = sentences.into_iter();
    Ok(sentences.map(|(key, it)| (key, of(&it))).collect())
}

/// Each sentence, by its path.
fn sentences(text: &str) -> Result<BTreeMap<String, String>, toml::de::Error> {
    let table: toml::Table = toml::from_str(text)?;
    let mut found = BTreeMap::new();
    gather("", table, &mut found);
    Ok(found)
}

fn gather(path: &str, table: toml::Table, found: &mut BTreeMap<String, String>) {
    for (name, value) in table {
        let path = match path {
            "" => name,
            path => format!("{path}.{name}"),
        };
        match value {
            toml::Value::Table(table) => gather(&path, table, found),
            toml::Value::String(text) => _ = found.insert(path, text),
            toml::Value::Array(values) => {
                let values = values.into_iter().enumerate();
                let named = values.map(|(index, value)| (index.to_string(), value));
                gather(&path, named.collect(), found);
            }
            // Other values are refused where the table is read into its type.
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests;
