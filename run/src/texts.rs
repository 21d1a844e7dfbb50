//! The string table: what is said to a user, in the user's language.

/// Declares a section of the table, with its keys by visibility and type; other keys are refused.
macro_rules! section {
    ($what:literal, $name:ident: $($vis:vis $kind:ty { $($key:ident)+ })+) => {
        #[doc = $what]
        #[derive(Clone, Debug, PartialEq, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            $($(
                #[doc = concat!("Key `", stringify!($key), "`.")]
                $vis $key: $kind,
            )+)+
        }
    };
}

mod grades;
mod panel;
mod pointed;

use crate::units::three_digits;
use crate::{Action, Blame, Failure};
use serde::Deserialize;
use vitriol_lesson::{Language, Template};
use vitriol_sound::Caption;

pub use self::grades::{FilesTexts, GradesTexts, Otherwise, VerifiedTexts};
pub use self::panel::{AcidOnTexts, EffortTexts, PanelTexts, SpiltTexts};
pub use self::pointed::PointedTexts;

section!("The texts of one language: a file of `run/texts`, of which each key is used and none is missing.", Texts:
    Heard { heard }
    pub InstructorTexts { instructor }
    pub LessonTexts { lesson }
    pub SummaryTexts { summary }
    pub PanelTexts { panel }
    pub PointedTexts { pointed }
    pub GradesTexts { grades }
    pub TrackTexts { track }
    pub LegendTexts { legend });
section!("Texts in a film's pictures, of Latin letters.", LegendTexts: pub String { temperature acid tints });
section!("What of a recording is not whole.", TrackTexts:
    pub Template { no_first no_firsts hole holes cut replayed breaks_off });
section!("Texts around a lesson's own.", LessonTexts: String { step points });
section!("Texts on an instructor's actions.", InstructorTexts:
    pub String { start held end }
    String { scene goes_on speed full_speed muted heard intensity message unsaid });
section!("Texts around the summary of an attempt, whose sentences are of [`vitriol_lesson::Texts`].", SummaryTexts:
    pub String { title before nothing back }
    String { scene points more });
section!("Sounds in words.", Heard:
    String { pouring simmering boiling bubbling drops glass_on_bench glass_on_glass knock glass_breaks acid_on_glove });

impl LessonTexts {
    /// A step, of how many, and what is to be done.
    pub fn step(&self, number: usize, of: usize, text: &str) -> String {
        let numbered = self.step.replace("{number}", &number.to_string());
        numbered
            .replace("{of}", &of.to_string())
            .replace("{text}", text)
    }

    /// Points, of how many.
    pub fn points(&self, points: u32, of: u32) -> String {
        let text = self.points.replace("{points}", &points.to_string());
        text.replace("{of}", &of.to_string())
    }
}

impl InstructorTexts {
    /// Another scene of that title is brought up.
    pub fn scene(&self, title: &str) -> String {
        self.scene.replace("{scene}", title)
    }

    /// The message to the student.
    pub fn message(&self, text: &str) -> String {
        self.message.replace("{text}", text)
    }

    /// What an instructor did, in words; empty of an action that is not an instructor's.
    pub fn instruction(&self, instruction: &Action) -> String {
        match instruction {
            Action::Intensity(value) => self.intensity.replace("{value}", &three_digits(*value)),
            Action::Pause(true) => self.held.clone(),
            Action::Pause(false) => self.goes_on.clone(),
            Action::Speed(rate) if *rate >= 1.0 => self.full_speed.clone(),
            Action::Speed(rate) => {
                let per_cent = format!("{:.0}", 100.0 * rate);
                self.speed.replace("{percent}", &per_cent)
            }
            Action::Mute(true) => self.muted.clone(),
            Action::Mute(false) => self.heard.clone(),
            Action::Message(text) if text.is_empty() => self.unsaid.clone(),
            Action::Message(text) => self.message(text),
            // What no instructor does.
            _ => String::new(),
        }
    }
}

impl SummaryTexts {
    /// The scene of an earlier attempt, by its title.
    pub fn scene(&self, title: &str) -> String {
        self.scene.replace("{scene}", title)
    }

    /// Points, of how many.
    pub fn points(&self, points: u32, of: u32) -> String {
        let text = self.points.replace("{points}", &points.to_string());
        text.replace("{of}", &of.to_string())
    }

    /// Note that so many sentences do not fit; `None` for 0.
    pub fn more(&self, count: usize) -> Option<String> {
        (count > 0).then(|| self.more.replace("{number}", &count.to_string()))
    }
}

/// The table of a language.
fn table(language: Language) -> &'static str {
    match language {
        Language::En => include_str!("../texts/en.toml"),
        Language::De => include_str!("../texts/de.toml"),
        Language::Es => include_str!("../texts/es.toml"),
        Language::Zh => include_str!("../texts/zh.toml"),
    }
}

impl Texts {
    /// The texts in English.
    ///
    /// # Errors
    /// As for [`Texts::of`].
    pub fn english() -> Result<Self, Failure> {
        Self::of(Language::En)
    }

    /// The texts in that language, which the program carries.
    ///
    /// # Errors
    /// [`Failure::Other`] where a key is missing or unknown, which a test rules out.
    pub fn of(language: Language) -> Result<Self, Failure> {
        toml::from_str(table(language)).other()
    }

    /// Sounds in words, for users who do not hear them; `None` in silence.
    pub fn heard(&self, captions: &[Caption]) -> Option<String> {
        let words: Vec<&str> = captions
            .iter()
            .map(|caption| self.caption(*caption))
            .collect();
        (!words.is_empty()).then(|| format!("[{}]", words.join(", ")))
    }

    fn caption(&self, caption: Caption) -> &str {
        let heard = &self.heard;
        match caption {
            Caption::Pouring => &heard.pouring,
            Caption::Simmering => &heard.simmering,
            Caption::Boiling => &heard.boiling,
            Caption::Bubbling => &heard.bubbling,
            Caption::Drops => &heard.drops,
            Caption::GlassOnBench => &heard.glass_on_bench,
            Caption::GlassOnGlass => &heard.glass_on_glass,
            Caption::Knock => &heard.knock,
            Caption::GlassBreaks => &heard.glass_breaks,
            Caption::AcidOnGlove => &heard.acid_on_glove,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::choices::on_panel;
    use std::collections::{BTreeMap, BTreeSet};

    #[test]
    fn a_summary_says_its_numbers() {
        let words = Texts::english().unwrap().summary;
        assert_eq!(words.points(61, 100), "61 of 100 points");
        assert_eq!(words.more(3).as_deref(), Some("3 more in the report"));
        assert_eq!(words.more(0), None);
        assert_eq!(words.scene("Acid into water"), "Scene: Acid into water");
    }

    /// Each sound has words of its own, short enough for three of them in a line of the panel.
    #[test]
    fn every_sound_has_its_words() {
        let texts = Texts::english().unwrap();
        let words: BTreeSet<&str> = Caption::ALL.map(|it| texts.caption(it)).into();
        assert_eq!(words.len(), Caption::ALL.len());
        assert!(words.iter().all(|it| !it.is_empty() && it.len() < 30));
        assert_eq!(texts.heard(&[]), None);
        let both = texts.heard(&[Caption::Pouring, Caption::Drops]);
        assert_eq!(both.as_deref(), Some("[pouring, drops fall]"));
    }

    /// A text's holes, in the order of their names.
    fn holes(text: &str) -> BTreeSet<&str> {
        let parts = text.split('{').skip(1);
        parts.map(|part| part.split('}').next().unwrap()).collect()
    }

    /// All texts of a table, each by its key.
    fn leaves(prefix: &str, value: &toml::Value, found: &mut BTreeMap<String, String>) {
        match value {
            toml::Value::Table(table) => {
                for (key, value) in table {
                    leaves(&format!("{prefix}.{key}"), value, found);
                }
            }
            other => {
                found.insert(prefix.to_owned(), other.as_str().unwrap().to_owned());
            }
        }
    }

    /// Each language has each key of English, with its holes, and says it in words of its own.
    #[test]
    fn each_language_says_all_that_english_says() {
        let of = |language| {
            let mut found = BTreeMap::new();
            let value: toml::Value = toml::from_str(table(language)).unwrap();
            leaves("", &value, &mut found);
            assert!(Texts::of(language).is_ok(), "{language}");
            found
        };
        let english = of(Language::En);
        for language in Language::ALL {
            let other = of(language);
            assert!(other.keys().eq(english.keys()), "{language}");
            let mut same = Vec::new();
            for (key, text) in &english {
                assert_eq!(holes(&other[key]), holes(text), "{language} {key}");
                assert!(!other[key].is_empty(), "{language} {key}");
                // What has no word in it is the same in each language.
                let worded = text.chars().filter(|it| it.is_alphabetic()).count() > 4;
                if worded && &other[key] == text {
                    same.push(key);
                }
            }
            // {number} / {of}   {text}, {points} / {of}
            same.retain(|key| !key.starts_with(".lesson."));
            assert!(
                same.is_empty() || language == Language::En,
                "{language}: {same:?}"
            );
        }
    }

    /// Each scene that the panel offers has its text, and no other has one.
    #[test]
    fn each_choice_has_its_text() {
        let choices: BTreeSet<&str> = on_panel().map(|choice| choice.scene).collect();
        for language in Language::ALL {
            let words = Texts::of(language).unwrap().panel;
            let named: BTreeSet<&str> = words.button.keys().map(String::as_str).collect();
            assert_eq!(named, choices, "{language}");
        }
    }

    #[test]
    fn a_table_lacks_nothing_and_has_nothing_else() {
        let text = table(Language::En);
        assert!(toml::from_str::<Texts>(&text.replace("knock =", "# knock =")).is_err());
        assert!(toml::from_str::<Texts>(&format!("bang = \"a bang\"\n{text}")).is_err());
    }
}
