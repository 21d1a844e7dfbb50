//! A track's metadata records, read and checked.

use std::collections::BTreeMap;
use std::path::Path;

use xxhash_rust::xxh3::xxh3_128;

use super::{TrackError, TrackMetadata, limits, names};

/// Hash of a scene's text, in hexadecimal.
pub(super) fn scene_hash(text: &str) -> String {
    format!("{:032x}", xxh3_128(text.as_bytes()))
}

/// Name and text of the scene that a record carries.
pub(super) fn carried(
    mut map: BTreeMap<String, String>,
    file: &Path,
) -> Result<(String, String), TrackError> {
    let mut text = |field: &str| {
        map.remove(field).ok_or_else(|| {
            let expected = "a carried scene has name, toml and xxh3_128";
            flawed(file, field, "is missing".into(), expected)
        })
    };
    let (name, toml, hash) = (text(names::NAME)?, text(names::TOML)?, text(names::HASH)?);
    check_scene(&name, &toml, file)?;
    if hash != scene_hash(&toml) {
        let problem = format!("is {hash:?} and not that of its text");
        let expected = "a carried scene is the recorded one";
        return Err(flawed(file, names::HASH, problem, expected));
    }
    Ok((name, toml))
}

fn flawed(file: &Path, field: &str, problem: String, expected: &str) -> TrackError {
    TrackError::Metadata {
        file: file.into(),
        field: field.into(),
        problem,
        expected: expected.into(),
    }
}

/// Checks that a metadata record has few texts, and short ones.
pub(super) fn short(map: &BTreeMap<String, String>, file: &Path) -> Result<(), TrackError> {
    let longest = map
        .iter()
        .flat_map(|(key, value)| [key.len(), value.len()])
        .max();
    for (field, count, most) in [
        ("number of entries", map.len(), limits::PARAMETERS),
        ("longest text", longest.unwrap_or(0), limits::TEXT),
    ] {
        if count > most {
            return Err(flawed(
                file,
                field,
                format!("is {count}"),
                &format!("at most {most} are read"),
            ));
        }
    }
    Ok(())
}

/// Checks that a reader would accept the scenes that a writer gets.
pub(super) fn check_carried(
    scenes: &BTreeMap<String, String>,
    file: &Path,
) -> Result<(), TrackError> {
    for (name, text) in scenes {
        check_scene(name, text, file)?;
    }
    check_scenes(scenes.len(), file)
}

fn check_scene(name: &str, toml: &str, file: &Path) -> Result<(), TrackError> {
    for (field, length, most) in [
        (names::NAME, name.len(), limits::TEXT),
        (names::TOML, toml.len(), limits::SCENE),
    ] {
        if length > most {
            let expected = format!("a carried scene's has {most} at most");
            return Err(flawed(
                file,
                field,
                format!("has {length} bytes"),
                &expected,
            ));
        }
    }
    Ok(())
}

pub(super) fn check_scenes(count: usize, file: &Path) -> Result<(), TrackError> {
    if count <= limits::SCENES {
        return Ok(());
    }
    let problem = format!("are more than {}", limits::SCENES);
    let expected = "a recording carries those that it may bring up";
    Err(flawed(file, "carried scenes", problem, expected))
}

pub(super) fn metadata(
    map: BTreeMap<String, String>,
    file: &Path,
) -> Result<TrackMetadata, TrackError> {
    short(&map, file)?;
    let text = |field: &str| {
        map.get(field).cloned().ok_or_else(|| {
            let expected = "a track names scene, seed and program_version";
            flawed(file, field, "is missing".into(), expected)
        })
    };
    let seed = text(names::SEED)?;
    Ok(TrackMetadata {
        scene: text(names::SCENE)?,
        seed: seed.parse().map_err(|_| {
            let expected = "a seed is a whole number from 0 to 2^64 - 1";
            flawed(file, names::SEED, format!("is `{seed}`"), expected)
        })?,
        program_version: text(names::PROGRAM_VERSION)?,
        parameters: map
            .iter()
            .filter_map(|(key, value)| {
                let name = key.strip_prefix(names::PARAMETER)?;
                Some((name.to_owned(), value.clone()))
            })
            .collect(),
        scenes: BTreeMap::new(),
    })
}
