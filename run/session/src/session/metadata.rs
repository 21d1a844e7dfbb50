//! The metadata of a session's recording.

use vitriol_run::DeviceStatement;
use vitriol_run::track::{DEVICE, DRIVER, LANGUAGE, LESSON, LESSON_HASH, MODE, PRESET, STUDENT};
use vitriol_xr::track::TrackMetadata;

use super::guide::Course;
use crate::workbench::Plan;
use vitriol_run::choices::CHOICES;

/// With all scenes that the session may bring up: a crash leaves no time to add the one that it did.
pub(super) fn metadata(
    plan: &Plan,
    (course, student): (Option<&Course>, Option<&str>),
    device: &DeviceStatement,
) -> TrackMetadata {
    let choices = CHOICES.iter().map(|choice| choice.scene);
    let scenes = choices
        .chain(plan.scenes.own())
        .chain([plan.scene.as_str()]);
    let scenes = scenes.filter_map(|name| {
        let text = plan.scenes.text(name)?;
        Some((name.to_owned(), text.into_owned()))
    });
    let parameters = [
        (PRESET, plan.preset.name()),
        (DEVICE, &device.name),
        (DRIVER, &device.driver),
    ];
    let of_course = course.map(|it| {
        [
            (LESSON, it.lesson.name.as_str()),
            (LESSON_HASH, it.lesson.hash()),
            (MODE, it.mode.name()),
            (LANGUAGE, it.language.code()),
        ]
    });
    let parameters = parameters
        .into_iter()
        .chain(of_course.into_iter().flatten())
        .chain(student.map(|name| (STUDENT, name)));
    TrackMetadata {
        scene: plan.scene.clone(),
        seed: plan.seed,
        parameters: parameters
            .map(|(name, value)| (name.to_owned(), value.to_owned()))
            .collect(),
        program_version: env!("CARGO_PKG_VERSION").into(),
        scenes: scenes.collect(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_run::Scenes;
    use vitriol_sim::scene::{Preset, Scene};

    fn plan() -> Plan {
        Plan {
            scene: "two-flasks".into(),
            scenes: Scenes::default(),
            preset: Preset::Fast,
            solver: None,
            filter: None,
            tint: None,
            room: None,
            breakable: false,
            seed: 7,
        }
    }

    fn device() -> DeviceStatement {
        DeviceStatement {
            name: "a device".into(),
            driver: "a driver 1.2".into(),
            api: "1.3".into(),
        }
    }

    /// Its own scene, and those that the user may choose.
    #[test]
    fn it_has_the_text_of_each_scene() {
        // No name is in a recording that was given none.
        let unnamed = metadata(&plan(), (None, None), &device());
        assert!(!unnamed.parameters.contains_key("student"));
        let metadata = metadata(&plan(), (None, Some("Ada")), &device());
        assert_eq!((metadata.scene.as_str(), metadata.seed), ("two-flasks", 7));
        for (name, value) in [
            ("preset", "fast"),
            ("device", "a device"),
            ("driver", "a driver 1.2"),
            ("student", "Ada"),
        ] {
            assert_eq!(metadata.parameters[name], value);
        }
        for name in ["two-flasks", "acid-into-water", "vr-dilution"] {
            let text = Scene::builtin_text(name).unwrap();
            assert_eq!(metadata.scenes[name], Scene::complete(text));
        }
    }
}
