//! Scenes that say how they differ from one that comes with the program.

use crate::scene::Scene;

const OWN: &str = r#"
base = "water-into-acid"
name = "mine"
description = "Mine."

[physical]
ambient = 25.0

[[liquid]]
flask = "target"
volume_ml = 50.0
temperature = 25.0
acid_fraction = 0.5
"#;

#[test]
fn what_a_scene_leaves_out_is_its_bases() {
    let base = Scene::builtin("water-into-acid").unwrap();
    let own = Scene::parse(OWN, "mine.toml").unwrap();
    assert_eq!(own.name, "mine");
    assert_eq!(own.liquids.len(), 1);
    assert_eq!(own.physical.unwrap().ambient, Some(25.0));
    assert_eq!(
        own.physical.unwrap().nuclei_spacing,
        base.physical.unwrap().nuclei_spacing
    );
    assert_eq!(own.flasks.len(), base.flasks.len());
    assert_eq!(own.presets, base.presets);
    assert_eq!(own.scale.spacing, base.scale.spacing);
}

/// What a track carries of it is the same scene, whatever its base is later.
#[test]
fn a_completed_text_stands_alone() {
    let complete = Scene::complete(OWN);
    assert!(!complete.contains("base ="));
    let scenes = [&complete, OWN].map(|text| Scene::parse(text, "mine.toml").unwrap());
    assert_eq!(format!("{:?}", scenes[0]), format!("{:?}", scenes[1]));
    for text in ["name = 3", "no TOML", "base = \"nowhere\""] {
        assert_eq!(Scene::complete(text), text);
    }
}

#[test]
fn what_is_wrong_is_named() {
    let error = |from: &str, to: &str| {
        let text = OWN.replacen(from, to, 1);
        Scene::parse(&text, "mine.toml").unwrap_err().to_string()
    };
    let nowhere = error("water-into-acid", "nowhere");
    assert!(
        nowhere.contains("mine.toml: base: \"nowhere\" is not built in"),
        "{nowhere}"
    );
    assert!(nowhere.contains("two-flasks"), "{nowhere}");
    assert!(error("\"water-into-acid\"", "3").contains("base: 3 is not"));
    // A base has a name and a description of its own.
    assert!(error("description = \"Mine.\"", "").contains("description: is missing"));
    assert!(error("name = \"mine\"", "").contains("name: is missing"));
    assert!(error("ambient", "ambience").contains("ambience"));
    // `name` is in the third line.
    let quote = error("name = \"mine\"", "name = \"mine");
    assert!(
        quote.starts_with("mine.toml: line 3: a quote is missing"),
        "{quote}"
    );
    assert!(!quote.contains("TOML"), "{quote}");
}
