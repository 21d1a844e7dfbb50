//! Texts of a class's grades: the table and its page.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use vitriol_lesson::Template;

use crate::in_a_line;

/// Texts of a class's grades.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GradesTexts {
    /// Title of the page.
    pub title: String,
    /// Note that the rows can be sorted.
    pub sort: String,
    /// Head of the column of students.
    pub student: String,
    /// Head of the column of scenes.
    pub scene: String,
    /// Head of the column of points.
    pub points: String,
    /// Head of the column of what went wrong first.
    pub first_wrong: String,
    /// Head of the column of caps.
    pub cap: String,
    /// Head of the column of lessons.
    pub lesson: String,
    /// Head of the column of incidents and notes, in a terminal.
    pub notes: String,
    /// Of a recording that is not graded, in the column of points of a terminal.
    pub not_graded: String,
    /// Likewise of one that could not be read.
    pub failed: String,
    /// How many results an earlier call left.
    pub taken: Template,
    /// How many attempts a simulation finds otherwise.
    pub refuted: Template,
    /// Where nothing went wrong.
    pub nothing: String,
    /// Where an attempt has no end.
    pub broken_off: String,
    /// Texts on simulating a recording again.
    pub verified: VerifiedTexts,
    /// What is wrong with the files of a class.
    pub files: FilesTexts,
    /// Kinds of incidents in a word or two, by their names in a recording.
    kind: BTreeMap<String, String>,
    made: MadeTexts,
    unread: String,
    otherwise: String,
    counted: String,
}

/// Texts on whether a simulation finds what a recording says.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VerifiedTexts {
    /// Head of the column.
    pub head: String,
    /// All is the same, to the bit.
    pub to_the_bit: String,
    /// All is the same within the tolerance, on another device.
    pub within_tolerance: String,
    /// Something is not.
    pub differs: String,
    /// The bits differ, though nothing is known that would change them.
    pub same_device: Template,
    /// How far apart moments and volumes are that are within the tolerance.
    pub apart: Template,
    /// What is in the recording, and what was found.
    pub values: Template,
    /// How many attempts there are.
    pub attempts: Template,
    /// How often the lesson was begun.
    pub lessons: Template,
    /// What differs in an attempt.
    pub attempt: Template,
    /// Points of a step.
    pub points_of: Template,
    /// A moment.
    pub at: Template,
    /// Pours between two flasks.
    pub poured: Template,
    /// Pours that came to no flask.
    pub poured_beside: Template,
    /// A flask that broke.
    pub broken: Template,
    /// A part of the body that gloves or goggles protected.
    pub protected: Template,
    /// The bench.
    pub bench: String,
    /// The floor.
    pub floor: String,
    /// The left hand.
    pub left_hand: String,
    /// The right hand.
    pub right_hand: String,
    /// The face.
    pub face: String,
}

/// What is wrong with the files of a class.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FilesTexts {
    /// Files that are no recordings.
    pub passed_over: Template,
    /// Recordings that could not be read.
    pub bad: Template,
    /// No recording is graded, though all could be read.
    pub nothing: Template,
    /// The first few of several names.
    pub more: Template,
    /// Two recordings have one name.
    pub same_name: Template,
    /// A folder is not there.
    pub no_folder: Template,
    /// A folder has no recordings.
    pub no_recordings: Template,
    /// A folder cannot be listed.
    pub unlisted: Template,
    /// A recording is not there.
    pub no_file: Template,
    /// A recording has no events.
    pub no_events: Template,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct MadeTexts {
    scene: Template,
    unnamed_scene: Template,
    scene_text: Template,
    no_scene_text: Template,
    intensity: Template,
    no_lesson: Template,
    lesson: Template,
    lesson_text: Template,
    mode: Template,
    progress: Template,
    preset: Template,
    no_preset: Template,
}

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
