//! What must hold of a track that is graded. It comes from the command line; a track's own metadata is only compared with
//! it, since a student could have diluted "acid" in a scene of the same name.

use serde::{Deserialize, Serialize};
use vitriol_lesson::{Attempt, Lesson, Mode, Rubric};
use vitriol_record::Uuid;
use vitriol_run::track::PRESET;
use vitriol_run::{Action, Blame, Failure, Scenes, in_a_line};
use vitriol_sim::scene::Preset;
use vitriol_xr::track::Track;

use crate::command::course::{self, AskedLesson};
use crate::command::recorded::actions;

/// What must hold of a track, and how it is scored.
#[derive(Clone, Debug)]
pub struct Expected {
    /// What is asked for.
    pub asked: Asked,
    /// The lesson, and its mode.
    pub lesson: Option<(Lesson, Mode)>,
    /// Text of the scene.
    text: String,
}

/// What is asked for, as a result keeps it: one that was made for something else is made anew.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Asked {
    /// Name of the scene.
    pub scene: String,
    /// Follows from the scene's text alone.
    pub scene_id: String,
    /// The preset, where only one will do.
    pub preset: Option<String>,
    /// What is scored.
    pub rubric: Rubric,
    /// The lesson, where one is judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lesson: Option<AskedLesson>,
}

impl Expected {
    /// That a track was made with this scene, by name or file, preset and lesson.
    ///
    /// # Errors
    /// [`Failure::Input`] where there is no such scene, or something is wrong with it, or the lesson is of another one.
    pub fn new(
        scene: &str,
        preset: Option<Preset>,
        lesson: Option<(Lesson, Mode)>,
    ) -> Result<Self, Failure> {
        let mut scenes = Scenes::default();
        let name = scenes.open(scene)?;
        scenes.get(&name)?;
        let text = scenes.text(&name).ok_or("the scene has no text").other()?;
        if let Some((lesson, mode)) = &lesson {
            course::judging((lesson, *mode), (&name, Some(&*text)))?;
        }
        let of_lesson = lesson.as_ref();
        let rubric = of_lesson.map(|(lesson, _)| lesson.rubric());
        Ok(Self {
            asked: Asked {
                scene_id: Uuid::new_v5(&Uuid::NAMESPACE_OID, text.as_bytes()).to_string(),
                preset: preset.map(|it| it.name().to_owned()),
                rubric: rubric.unwrap_or_default(),
                lesson: of_lesson.map(|(lesson, mode)| AskedLesson::of(lesson, *mode)),
                scene: name,
            },
            text: text.into_owned(),
            lesson,
        })
    }

    /// In what the track was made otherwise, in a few words; `None` where nothing is known.
    pub fn otherwise(&self, track: &Track, attempts: &[Attempt]) -> Option<String> {
        let (asked, made) = (&self.asked, &track.metadata);
        let actions: Vec<Action> = actions(track).collect();
        let brought_up = actions.iter().filter_map(Action::brings_up);
        let mut scenes = std::iter::once(made.scene.as_str())
            .chain(brought_up)
            .chain(attempts.iter().map(|it| it.scene.as_str()));
        if let Some(other) = scenes.find(|name| *name != asked.scene) {
            let other = if other.is_empty() {
                "one without a name".into()
            } else {
                in_a_line(other)
            };
            return Some(format!("made with another scene: {other}"));
        }
        match made.scenes.get(&asked.scene) {
            Some(text) if *text == self.text => {}
            Some(_) => {
                let name = in_a_line(&asked.scene);
                return Some(format!("made with another scene: {name} of another text"));
            }
            None => {
                return Some("made with a scene whose text it does not carry".into());
            }
        }
        if let Some(k_v) = actions.iter().find_map(|it| match it {
            Action::Intensity(k_v) => Some(k_v),
            _ => None,
        }) {
            return Some(format!("made with another k_v: {k_v}"));
        }
        let lesson = asked.lesson.as_ref();
        if let Some(otherwise) = lesson.and_then(|it| it.otherwise(track)) {
            return Some(otherwise);
        }
        let preset = made.parameters.get(PRESET);
        match (&asked.preset, preset) {
            (Some(asked), Some(made)) if asked != made => {
                Some(format!("made with another preset: {}", in_a_line(made)))
            }
            (Some(_), None) => Some("made with a preset that it does not name".into()),
            _ => None,
        }
    }
}
