//! Texts of a class's grades: the table and its page.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use vitriol_lesson::Template;

use crate::in_a_line;

section!("Texts of a class's grades.", GradesTexts:
    pub String { title sort student scene points first_wrong cap lesson notes not_graded failed nothing broken_off }
    pub Template { taken refuted }
    pub VerifiedTexts { verified }
    pub FilesTexts { files }
    BTreeMap<String, String> { kind }
    MadeTexts { made }
    String { unread otherwise counted });
section!("Texts on whether a simulation finds what a recording says.", VerifiedTexts:
    pub String { head to_the_bit within_tolerance differs bench floor left_hand right_hand face }
    pub Template { same_device apart values attempts lessons attempt points_of at poured poured_beside broken protected });
section!("What is wrong with the files of a class.", FilesTexts:
    pub Template { passed_over bad nothing more same_name no_folder no_recordings unlisted no_file no_events });
section!("In what a recording was made otherwise.", MadeTexts:
    Template { scene unnamed_scene scene_text no_scene_text intensity no_lesson lesson lesson_text mode progress preset no_preset });

/// In what a recording was made otherwise than a class is graded by, with the name of what it was made with.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Otherwise {
    /// Another scene.
    Scene(String),
    /// A scene without a name.
    UnnamedScene,
    /// A scene of that name with another text.
    SceneText(String),
    /// The scene's text is not in it.
    NoSceneText,
    /// Another intensity of boiling.
    Intensity(String),
    /// No lesson.
    NoLesson,
    /// Another lesson.
    Lesson(String),
    /// A lesson of that name with another text.
    LessonText(String),
    /// Another mode of the lesson.
    Mode(String),
    /// Its progress is of another lesson or mode.
    Progress,
    /// Another preset.
    Preset(String),
    /// It names no preset.
    NoPreset,
}

impl GradesTexts {
    /// A kind of incident in a word or two; of one without a text its name.
    pub fn kind<'a>(&'a self, name: &'a str) -> &'a str {
        self.kind.get(name).map_or(name, String::as_str)
    }

    /// A recording could not be read, for this cause.
    pub fn unread(&self, why: &str) -> String {
        self.unread.replace("{why}", why)
    }

    /// A recording is not graded, for this cause.
    pub fn otherwise(&self, why: &Otherwise) -> String {
        let made = &self.made;
        let (template, name) = match why {
            Otherwise::Scene(name) => (&made.scene, name.as_str()),
            Otherwise::UnnamedScene => (&made.unnamed_scene, ""),
            Otherwise::SceneText(name) => (&made.scene_text, name.as_str()),
            Otherwise::NoSceneText => (&made.no_scene_text, ""),
            Otherwise::Intensity(k_v) => (&made.intensity, k_v.as_str()),
            Otherwise::NoLesson => (&made.no_lesson, ""),
            Otherwise::Lesson(name) => (&made.lesson, name.as_str()),
            Otherwise::LessonText(name) => (&made.lesson_text, name.as_str()),
            Otherwise::Mode(name) => (&made.mode, name.as_str()),
            Otherwise::Progress => (&made.progress, ""),
            Otherwise::Preset(name) => (&made.preset, name.as_str()),
            Otherwise::NoPreset => (&made.no_preset, ""),
        };
        let why = template.fill(&[("name", &in_a_line(name))]);
        self.otherwise.replace("{why}", &why)
    }

    /// How many recordings were graded, were made otherwise, and could not be read.
    pub fn counted(&self, graded: usize, otherwise: usize, unread: usize) -> String {
        self.counted
            .replace("{graded}", &graded.to_string())
            .replace("{otherwise}", &otherwise.to_string())
            .replace("{unread}", &unread.to_string())
    }
}
