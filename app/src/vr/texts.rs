//! The string table: what is said to a user, in the user's language.

use serde::Deserialize;
use vitriol_experiment::units::three_digits;
use vitriol_experiment::{Blame, Failure, Instruction};
use vitriol_sound::Caption;

/// The texts of one language: a file of `app/texts`, of which each key is used and none is missing.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Texts {
    heard: Heard,
    /// What an instructor did.
    pub instructor: InstructorTexts,
    /// Around a lesson's own texts.
    pub lesson: LessonTexts,
    /// Around what is said of an attempt.
    pub summary: SummaryTexts,
}

/// Around a lesson's own texts.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LessonTexts {
    step: String,
    points: String,
}

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

/// What an instructor did.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InstructorTexts {
    scene: String,
    /// The present scene from its start.
    pub start: String,
    /// Time is held.
    pub held: String,
    goes_on: String,
    speed: String,
    full_speed: String,
    muted: String,
    heard: String,
    intensity: String,
    message: String,
    unsaid: String,
    /// The session is ended.
    pub end: String,
}

impl InstructorTexts {
    /// Another scene of that title is brought up.
    pub fn scene(&self, title: &str) -> String {
        self.scene.replace("{scene}", title)
    }

    /// What the student is told.
    pub fn message(&self, text: &str) -> String {
        self.message.replace("{text}", text)
    }

    /// In words.
    pub fn instruction(&self, instruction: &Instruction) -> String {
        match instruction {
            Instruction::Intensity(value) => {
                self.intensity.replace("{value}", &three_digits(*value))
            }
            Instruction::Pause(true) => self.held.clone(),
            Instruction::Pause(false) => self.goes_on.clone(),
            Instruction::Speed(rate) if *rate >= 1.0 => self.full_speed.clone(),
            Instruction::Speed(rate) => {
                let per_cent = format!("{:.0}", 100.0 * rate);
                self.speed.replace("{percent}", &per_cent)
            }
            Instruction::Spare(true) => self.muted.clone(),
            Instruction::Spare(false) => self.heard.clone(),
            Instruction::Message(text) if text.is_empty() => self.unsaid.clone(),
            Instruction::Message(text) => self.message(text),
        }
    }
}

/// Around what is said of an attempt, whose sentences are of [`vitriol_lesson::Texts`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SummaryTexts {
    /// What it is.
    pub title: String,
    points: String,
    /// Where nothing has happened.
    pub nothing: String,
    more: String,
    /// Of the button that ends it.
    pub back: String,
}

impl SummaryTexts {
    /// Points, of how many.
    pub fn points(&self, points: u32, of: u32) -> String {
        let text = self.points.replace("{points}", &points.to_string());
        text.replace("{of}", &of.to_string())
    }

    /// That so many sentences do not fit; `None` of none.
    pub fn more(&self, count: usize) -> Option<String> {
        (count > 0).then(|| self.more.replace("{number}", &count.to_string()))
    }
}

/// Sounds in words.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Heard {
    pouring: String,
    simmering: String,
    boiling: String,
    bubbling: String,
    drops: String,
    glass_on_bench: String,
    glass_on_glass: String,
    knock: String,
    glass_breaks: String,
    acid_on_glove: String,
}

impl Texts {
    /// Those of English, which the program carries.
    ///
    /// # Errors
    /// [`Failure::Other`] where a key is missing or unknown, which a test rules out.
    pub fn english() -> Result<Self, Failure> {
        toml::from_str(include_str!("../../texts/en.toml")).other()
    }

    /// Sounds, for who does not hear them; `None` in silence.
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
    use std::collections::BTreeSet;

    #[test]
    fn a_summary_says_its_numbers() {
        let words = Texts::english().unwrap().summary;
        assert_eq!(words.points(61, 100), "61 of 100 points");
        assert_eq!(words.more(3).as_deref(), Some("3 more in the report"));
        assert_eq!(words.more(0), None);
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

    #[test]
    fn a_table_lacks_nothing_and_has_nothing_else() {
        let text = include_str!("../../texts/en.toml");
        assert!(toml::from_str::<Texts>(&text.replace("knock =", "# knock =")).is_err());
        assert!(toml::from_str::<Texts>(&format!("{text}\nbang = \"a bang\"\n")).is_err());
    }
}
