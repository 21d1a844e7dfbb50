//! What a recording says of how it is to be replayed, and what is asked for instead.

use vitriol_experiment::switches::{SWITCH_SCENE, SWITCH_SOLVER, SWITCH_START};
use vitriol_experiment::units::three_digits;
use vitriol_experiment::{Blame, Failure};
use vitriol_sim::scene::Preset;
use vitriol_xr::Pose;
use vitriol_xr::track::Track;

use crate::cli::CameraName;

/// Refuses a track that breaks off: what its film shows would not be what was
/// recorded, and nothing would say so.
pub fn whole(name: &str, track: &Track) -> Result<(), Failure> {
    if !track.recovered {
        return Ok(());
    }
    let end = three_digits(track.duration());
    Err(format!(
        "{name}: breaks off after {end} s, since the file was cut or its recorder stopped hard; \
         a track has an end: copy it again, or save what is there with `vitriol track {name} -o \
         NEW.mcap`"
    ))
    .input()
}

/// The scene that was asked for, or else the one that the track names.
pub fn scene_of(name: &str, scene: Option<&str>, track: &Track) -> Result<String, Failure> {
    match scene {
        Some(scene) => Ok(scene.to_owned()),
        None if track.metadata.scene.is_empty() => Err(format!(
            "{name}: the track names no scene; give one with --scene (see `vitriol scenes`)"
        ))
        .input(),
        None => Ok(track.metadata.scene.clone()),
    }
}

/// The preset that was asked for, or else the one that the track was recorded
/// with, or else the default.
pub fn preset_of(asked: Option<Preset>, track: &Track) -> Preset {
    let recorded = track.metadata.parameters.get("preset");
    let recorded =
        recorded.and_then(|name| Preset::ALL.into_iter().find(|preset| preset.name() == name));
    asked.or(recorded).unwrap_or(Preset::Balanced)
}

/// Leaves out what a session changed in the solver to keep pace, where something else was asked for: substeps
/// and iterations themselves, another preset, or another scene than the recorded one. Whether there was any.
pub fn own_solver((asked, preset): (bool, Option<Preset>), scene: &str, track: &mut Track) -> bool {
    let other_preset = preset.is_some_and(|preset| preset != preset_of(None, track));
    if !asked && !other_preset && scene == track.metadata.scene {
        return false;
    }
    let mut any = false;
    for frame in &mut track.frames {
        frame.scenario.retain(|switch| {
            let kept = switch.key != SWITCH_SOLVER;
            any |= !kept;
            kept
        });
    }
    any
}

/// Whether someone changed the scene, or began it anew, while the track was recorded.
pub fn changes_scene(track: &Track) -> bool {
    let mut switches = track.frames.iter().flat_map(|frame| &frame.scenario);
    switches.any(|switch| [SWITCH_SCENE, SWITCH_START].contains(&&*switch.key))
}

/// Where the head is at the start, if the film is to show what it sees.
pub fn head(camera: CameraName, name: &str, track: &Track) -> Result<Option<Pose>, Failure> {
    match (camera, track.frames.first()) {
        (CameraName::Fixed, _) => Ok(None),
        (CameraName::Head, Some(frame)) => Ok(Some(frame.stage_from_view)),
        (CameraName::Head, None) => Err(format!(
            "--camera head: {name} holds no pose of a head; take --camera fixed"
        ))
        .input(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_experiment::track;
    use vitriol_xr::Switch;

    /// A recording's own changes of the solver are repeated, unless something else is asked for.
    #[test]
    fn what_is_asked_for_comes_before_what_was_recorded() {
        let switch = |key: &str, value: &str| Switch {
            key: key.into(),
            value: value.into(),
        };
        let mut recorded = track::load("hands-off").unwrap();
        recorded.metadata.scene = "beaker".into();
        let parameters = &mut recorded.metadata.parameters;
        parameters.insert("preset".into(), "fast".into());
        recorded.frames[0].scenario =
            vec![switch(SWITCH_SOLVER, "8x4"), switch(SWITCH_START, "beaker")];
        let repeats = |asked, scene| {
            let mut track = recorded.clone();
            let any = own_solver(asked, scene, &mut track);
            let keys = track.frames[0].scenario.iter();
            let keys: Vec<&str> = keys.map(|switch| switch.key.as_str()).collect();
            assert_eq!(any, keys == [SWITCH_START]);
            keys == [SWITCH_SOLVER, SWITCH_START]
        };
        assert!(repeats((false, None), "beaker"));
        assert!(repeats((false, Some(Preset::Fast)), "beaker"));
        assert!(!repeats((true, None), "beaker"));
        assert!(!repeats((false, Some(Preset::Balanced)), "beaker"));
        assert!(!repeats((false, None), "two-flasks"));
    }
}
