//! What must hold of a track that is graded. It comes from the command line; a track's own metadata is only compared with
//! it, since a student could have diluted "acid" in a scene of the same name.

use serde::{Deserialize, Serialize};
use vitriol_lesson::{Attempt, Language, Lesson, Mode, Rubric};
use vitriol_record::Uuid;
use vitriol_run::texts::Otherwise;
use vitriol_run::track::{LESSON, PRESET};
use vitriol_run::{Action, Blame, Failure, Scenes};
use vitriol_sim::scene::{Preset, Scene};
use vitriol_xr::track::{Track, TrackMetadata};

use crate::command::course::{self, AskedLesson};
use crate::command::recorded::actions;

/// What must hold of a track, and how it is scored.
#[derive(Clone, Debug)]
pub struct Expected {
    /// What is asked for.
    pub asked: Asked,
    /// The lesson, and its mode.
    pub lesson: Option<(Lesson, Mode)>,
    /// The scene as it was named: a built-in one, or a file.
    pub source: String,
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
    /// What tracks may be made with: these scenes, by name or file, of which some have a lesson. Without scenes those of the lessons;
    /// without lessons all built-in ones. An error with a lesson is in that language.
    ///
    /// # Errors
    /// [`Failure::Input`] where there is no such scene, or something is wrong with it, or a lesson is of another one.
    pub fn all(
        scenes: &[String],
        preset: Option<Preset>,
        lessons: &[(Lesson, Mode)],
        language: Language,
    ) -> Result<Vec<Self>, Failure> {
        let named: Vec<&str> = match (scenes, lessons) {
            ([], []) => Scene::builtin_names(),
            ([], _) => lessons.iter().map(|(it, _)| it.scene.as_str()).collect(),
            _ => scenes.iter().map(String::as_str).collect(),
        };
        let plain = named.into_iter().map(|it| Self::of_scene(it, preset));
        let plain = plain.collect::<Result<Vec<_>, _>>()?;
        let mut all: Vec<Self> = Vec::new();
        for lesson in lessons {
            let tried = plain.iter().map(|it| it.with_lesson(lesson, language));
            all.extend(tried.reduce(Result::or).transpose()?);
        }
        for it in plain {
            if !all.iter().any(|of| of.asked.scene == it.asked.scene) {
                all.push(it);
            }
        }
        Ok(all)
    }

    fn of_scene(scene: &str, preset: Option<Preset>) -> Result<Self, Failure> {
        let mut scenes = Scenes::default();
        let name = scenes.open(scene)?;
        scenes.get(&name)?;
        let text = scenes.text(&name).ok_or("the scene has no text").other()?;
        Ok(Self {
            asked: Asked {
                scene_id: Uuid::new_v5(&Uuid::NAMESPACE_OID, text.as_bytes()).to_string(),
                preset: preset.map(|it| it.name().to_owned()),
                rubric: Rubric::default(),
                lesson: None,
                scene: name,
            },
            text: text.into_owned(),
            lesson: None,
            source: scene.to_owned(),
        })
    }

    fn with_lesson(
        &self,
        (lesson, mode): &(Lesson, Mode),
        language: Language,
    ) -> Result<Self, Failure> {
        let scene = (self.asked.scene.as_str(), Some(self.text.as_str()));
        course::judging((lesson, *mode), scene, language)?;
        let mut taught = self.clone();
        taught.asked.rubric = lesson.rubric();
        taught.asked.lesson = Some(AskedLesson::of(lesson, *mode));
        taught.lesson = Some((lesson.clone(), *mode));
        Ok(taught)
    }

    /// The one that a track is graded by: of its scene, and of the lesson that it names if that is among them. `None` where all is
    /// empty; one that the track was not made with tells so.
    pub fn of_track<'a>(all: &'a [Self], made: &TrackMetadata) -> Option<&'a Self> {
        let lesson = made.parameters.get(LESSON);
        let of_scene = || all.iter().filter(move |it| it.asked.scene == made.scene);
        let of_lesson = |it: &&Self| it.asked.lesson.as_ref().map(|it| &it.name) == lesson;
        let found = of_scene().find(of_lesson).or_else(|| of_scene().next());
        found.or(all.first())
    }

    /// In what the track was made otherwise; `None` where nothing is known.
    pub fn otherwise(&self, track: &Track, attempts: &[Attempt]) -> Option<Otherwise> {
        let (asked, made) = (&self.asked, &track.metadata);
        let actions: Vec<Action> = actions(track).collect();
        let brought_up = actions.iter().filter_map(Action::brings_up);
        let mut scenes = std::iter::once(made.scene.as_str())
            .chain(brought_up)
            .chain(attempts.iter().map(|it| it.scene.as_str()));
        if let Some(other) = scenes.find(|name| *name != asked.scene) {
            return Some(match other {
                "" => Otherwise::UnnamedScene,
                other => Otherwise::Scene(other.into()),
            });
        }
        match made.scenes.get(&asked.scene) {
            Some(text) if *text == self.text => {}
            Some(_) => return Some(Otherwise::SceneText(asked.scene.clone())),
            None => return Some(Otherwise::NoSceneText),
        }
        if let Some(k_v) = actions.iter().find_map(|it| match it {
            Action::Intensity(k_v) => Some(k_v),
            _ => None,
        }) {
            return Some(Otherwise::Intensity(k_v.to_string()));
        }
        let lesson = asked.lesson.as_ref();
        if let Some(otherwise) = lesson.and_then(|it| it.otherwise(track)) {
            return Some(otherwise);
        }
        let preset = made.parameters.get(PRESET);
        match (&asked.preset, preset) {
            (Some(asked), Some(made)) if asked != made => Some(Otherwise::Preset(made.clone())),
            (Some(_), None) => Some(Otherwise::NoPreset),
            _ => None,
        }
    }
}
