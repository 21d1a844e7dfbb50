//! A recording's settings for its replay, and what is asked for instead.

use serde::de::DeserializeOwned;
use serde_json::Value;
use vitriol_lesson::procedure::Progress;
use vitriol_lesson::{Event, Language, whole_nanoseconds};
use vitriol_run::texts::Texts;
use vitriol_run::track::{BROKEN_OFF, DEVICE, DRIVER, PRESET, key};
use vitriol_run::units::{grouped, three_digits};
use vitriol_run::{Action, Blame, DeviceStatement, Failure, Scenes, escaped, in_a_line};
use vitriol_sim::scene::Preset;
use vitriol_xr::Pose;
use vitriol_xr::track::{Hole, Track, TrackMetadata};

use crate::cli::CameraName;

/// The track, if all of it is there, or what of it is whole where that is `accepted`. Else what its film shows would
/// not be what was recorded, and nothing would report that. What is wrong with it is said in that language.
pub fn whole(
    name: &str,
    track: Track,
    accepted: bool,
    language: Language,
) -> Result<Track, Failure> {
    let texts = Texts::of(language)?.track;
    let first = track.missing_first();
    if first > 0 {
        let template = match first {
            1 => &texts.no_first,
            _ => &texts.no_firsts,
        };
        let problem = template.fill(&[("name", name), ("steps", &grouped(first))]);
        return Err(problem).input();
    }
    let broken_off = track.outcome.get(BROKEN_OFF).map(|cause| in_a_line(cause));
    let hole = track.holes().next();
    let why = match (hole, broken_off) {
        (Some(Hole { steps: 1, .. }), _) => texts.hole.fill(&[]),
        (Some(Hole { steps, .. }), _) => texts.holes.fill(&[("steps", &steps.to_string())]),
        (None, Some(cause)) => cause,
        (None, None) if track.recovered => texts.cut.fill(&[]),
        (None, None) => return Ok(track),
    };
    let track = track.up_to_the_first_hole();
    let end = three_digits(track.duration());
    let (template, name) = match accepted {
        true => (&texts.replayed, escaped(name)),
        false => (&texts.breaks_off, name.to_owned()),
    };
    let text = template.fill(&[("name", &name), ("end", &end), ("why", &why)]);
    if accepted {
        tracing::warn!("{text}");
        return Ok(track);
    }
    Err(text).input()
}

/// Name of the scene that was asked for, or else of the one that the track names; `scenes` has it then.
pub fn scene_of(
    scenes: &mut Scenes,
    name: &str,
    asked: Option<&str>,
    track: &Track,
) -> Result<String, Failure> {
    let found = match asked {
        Some(scene) => scenes.open(scene)?,
        None if track.metadata.scene.is_empty() => {
            return Err(format!(
                "{name}: the track names no scene; give one with --scene (see `vitriol scenes`)"
            ))
            .input();
        }
        None => track.metadata.scene.clone(),
    };
    scenes.carry(&track.metadata);
    Ok(found)
}

/// Whether the track is a recording, and not made of keyframes, which hold their own name.
pub fn is_recording(metadata: &TrackMetadata) -> bool {
    !metadata.parameters.contains_key("track")
}

/// In what a replay differs from its recording, each in a sentence: its bits may differ then. Empty where nothing that
/// is known does. `device` is `None` before one is open; `asked` are options that ask for something else.
pub fn differences(
    metadata: &TrackMetadata,
    (name, scenes): (&str, &Scenes),
    device: Option<&DeviceStatement>,
    asked: &[&str],
) -> Vec<String> {
    let mut differs = Vec::new();
    let version = env!("CARGO_PKG_VERSION");
    if metadata.program_version != version {
        let recorded = in_a_line(&metadata.program_version);
        differs.push(format!(
            "recorded by version {recorded}, replayed by {version}"
        ));
    }
    let of_device = device.map(|now| [(DEVICE, &now.name), (DRIVER, &now.driver)]);
    for (key, now) in of_device.into_iter().flatten() {
        let recorded = metadata.parameters.get(key);
        if let Some(recorded) = recorded.filter(|recorded| *recorded != now) {
            let recorded = in_a_line(recorded);
            differs.push(format!(
                "recorded with the {key} {recorded}, replayed with {now}"
            ));
        }
    }
    if name != metadata.scene {
        differs.push(format!(
            "recorded with the scene {}, replayed with {}",
            in_a_line(&metadata.scene),
            in_a_line(name)
        ));
    } else if !has_recorded_text(metadata, name, scenes) {
        let name = in_a_line(name);
        differs.push(format!(
            "the scene {name} has another text than the recorded one"
        ));
    }
    differs.extend(asked.iter().map(|option| format!("replayed with {option}")));
    differs
}

/// Whether the scene of that name is the recorded one, as far as that is known: older tracks carry no text.
fn has_recorded_text(metadata: &TrackMetadata, name: &str, scenes: &Scenes) -> bool {
    let recorded = metadata.scenes.get(name);
    recorded.is_none_or(|recorded| scenes.text(name).is_some_and(|own| own == *recorded))
}

/// The events that the session recorded; one that this version cannot read is left out.
pub fn recorded_events(track: &Track) -> Vec<Event> {
    let events = track.events.iter();
    events.filter_map(|(_, json)| noted(json)).collect()
}

/// The progress that the session recorded of its lesson; what this version cannot read is left out.
pub fn recorded_progress(track: &Track) -> Vec<Progress> {
    let said = track.progress.iter();
    said.filter_map(|(_, json)| noted(json)).collect()
}

/// What a session noted. Recordings of older versions have times with rounding errors, and a comparison to the bit would find these.
fn noted<T: DeserializeOwned>(json: &str) -> Option<T> {
    let mut noted = serde_json::from_str(json).ok()?;
    round_times(&mut noted);
    serde_json::from_value(noted).ok()
}

fn round_times(value: &mut Value) {
    let Value::Object(fields) = value else { return };
    for (name, value) in fields {
        match value.as_f64() {
            Some(seconds) if ["t_s", "until_s", "evidence_s"].contains(&name.as_str()) => {
                *value = whole_nanoseconds(seconds).into();
            }
            _ => round_times(value),
        }
    }
}

/// The preset that was asked for, or else the one that the track was recorded
/// with, or else the default.
pub fn preset_of(asked: Option<Preset>, track: &Track) -> Preset {
    let recorded = track.metadata.parameters.get(PRESET);
    let recorded =
        recorded.and_then(|name| Preset::ALL.into_iter().find(|preset| preset.name() == name));
    asked.or(recorded).unwrap_or(Preset::Balanced)
}

/// Leaves out what a session changed in the solver to keep pace, where something else was asked for: substeps
/// and iterations themselves, another preset, or another scene than the recorded one. Whether there was any.
pub fn own_solver(
    (asked, preset): (bool, Option<Preset>),
    (scene, scenes): (&str, &Scenes),
    track: &mut Track,
) -> bool {
    let other_preset = preset.is_some_and(|preset| preset != preset_of(None, track));
    let same_scene =
        scene == track.metadata.scene && has_recorded_text(&track.metadata, scene, scenes);
    if !asked && !other_preset && same_scene {
        return false;
    }
    let mut any = false;
    for frame in &mut track.frames {
        frame.scenario.retain(|switch| {
            // Also one that cannot be read.
            let kept = switch.key != key::SOLVER;
            any |= !kept;
            kept
        });
    }
    any
}

/// Whether someone changed the scene, or began it anew, while the track was recorded.
pub fn changes_scene(track: &Track) -> bool {
    let mut actions = actions(track);
    actions.any(|action| action.brings_up().is_some())
}

/// What is done in a track, in its order, without what this version cannot read.
pub fn actions(track: &Track) -> impl Iterator<Item = Action> {
    let switches = track.frames.iter().flat_map(|frame| &frame.scenario);
    switches.filter_map(|switch| Action::of(switch).ok().flatten())
}

/// Where the head is at the start, if the film is to show what it sees.
pub fn head(camera: CameraName, name: &str, track: &Track) -> Result<Option<Pose>, Failure> {
    match (camera, track.frames.first()) {
        (CameraName::Fixed | CameraName::Director, _) => Ok(None),
        (CameraName::Head, Some(frame)) => Ok(Some(frame.stage_from_view)),
        (CameraName::Head, None) => Err(format!(
            "--camera head: {name} holds no pose of a head; take --camera fixed"
        ))
        .input(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic)]
mod tests {
    use super::*;
    use vitriol_run::track;

    /// 108 steps of 0.011111111111111 s, as an older version noted their time.
    #[test]
    fn what_was_noted_has_times_of_whole_nanoseconds() {
        let mut recorded = track::load("hands-off").unwrap();
        let old = "1.199999999999988";
        let notes = |texts: [String; 2]| texts.map(|json| (0, json)).to_vec();
        recorded.events = notes([
            format!(
                r#"{{"event":"ended","t_s":2.5,"contents":{{}},"bench_m3":{old},"floor_m3":0.0,
                "hottest":{{"t_s":{old},"flask":null,"temperature_c":20.0}}}}"#
            ),
            r#"{"event":"of a later version","t_s":1.0}"#.into(),
        ]);
        recorded.progress = notes([
            format!(r#"{{"progress":"step-done","t_s":{old},"id":"a","evidence_s":{old}}}"#),
            format!(r#"{{"progress":"over","t_s":{old}}}"#),
        ]);
        let events = recorded_events(&recorded);
        let [Event::Ended(ending)] = &events[..] else {
            panic!("{events:?}");
        };
        let hottest = ending.hottest.as_ref().unwrap().t_s;
        // A volume is no time.
        assert_eq!(
            [ending.t_s, hottest, ending.bench_m3],
            [2.5, 1.2, 1.199999999999988]
        );
        let done = Progress::StepDone {
            t_s: 1.2,
            id: "a".into(),
            evidence_s: 1.2,
        };
        let over = Progress::Over { t_s: 1.2 };
        assert_eq!(recorded_progress(&recorded), [done, over]);
    }

    /// A recording's own changes of the solver are repeated, unless something else is asked for.
    #[test]
    fn what_is_asked_for_comes_before_what_was_recorded() {
        let mut recorded = track::load("hands-off").unwrap();
        recorded.metadata.scene = "beaker".into();
        let parameters = &mut recorded.metadata.parameters;
        parameters.insert(PRESET.into(), "fast".into());
        let start = Action::Start(Some("beaker".into()));
        recorded.frames[0].scenario = vec![Action::Solver([8, 4]).switch(), start.switch()];
        let repeats = |asked, scene| {
            let mut track = recorded.clone();
            let any = own_solver(asked, (scene, &Scenes::default()), &mut track);
            let keys = track.frames[0].scenario.iter();
            let keys: Vec<&str> = keys.map(|switch| switch.key.as_str()).collect();
            assert_eq!(any, keys == [key::START]);
            keys == [key::SOLVER, key::START]
        };
        assert!(repeats((false, None), "beaker"));
        assert!(repeats((false, Some(Preset::Fast)), "beaker"));
        assert!(!repeats((true, None), "beaker"));
        assert!(!repeats((false, Some(Preset::Balanced)), "beaker"));
        assert!(!repeats((false, None), "two-flasks"));
    }
}
