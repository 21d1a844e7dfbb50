//! Vessels and numbers of any size: refused or simulated, in finite time.

use super::{GOOD, assert_parts};
use crate::flask::Profile;
use crate::scene::{Preset, Scene};
use proptest::prelude::*;

/// The walk over a vessel's surface ends, though the other's wall is below its resolution in f64.
#[test]
fn vessels_of_any_sizes_are_compared() {
    let huge = |size: &str| {
        let huge = GOOD.replace("[0.08, 0.03]", &format!("[{size}, 0.03]"));
        huge.replace("wall = 0.002", &format!("wall = {size}"))
    };
    for size in ["1.0", "1e9", "1e20"] {
        // Its wall takes in the first vessel.
        let error = Scene::parse(&huge(size), "huge.toml").unwrap_err();
        assert!(error.to_string().starts_with("huge.toml: "), "{error}");
    }
    // Its squares overflow, so where it stands is not known.
    let _ = Scene::parse(&huge("1e300"), "huge.toml");
}

/// A vessel whose table of walls, or whose lattice of sites, would never be done is refused at once.
#[test]
fn a_vessel_too_large_for_its_particles_is_refused() {
    let alone = |points: &str, wall: &str| {
        let from = GOOD.find("[[flask]]").unwrap();
        let to = GOOD.find("name = \"b\"").unwrap();
        let text = GOOD[..from].to_owned() + "[[flask]]\n" + &GOOD[to..];
        let text = text.replace("flask = \"a\"", "flask = \"b\"");
        let text = text.replace("[[0.0, 0.03], [0.08, 0.03]]", points);
        let text = text.replace("wall = 0.002", &format!("wall = {wall}"));
        Scene::parse(&text.replace("v_max = 10.0", "v_max = 1e9"), "alone.toml")
    };
    let beaker = "[[0.0, 0.03], [0.08, 0.03]]";
    for (points, wall) in [
        (beaker, "1e3"),
        (beaker, "1e6"),
        (beaker, "1e300"),
        ("[[0.0, 0.003], [500.0, 0.003]]", "500.0"),
        ("[[0.0, 0.003], [0.01, 1e6]]", "1e3"),
        ("[[0.0, 1e-9], [1e200, 1e100]]", "1e200"),
    ] {
        let error = alone(points, wall).unwrap_err().to_string();
        assert!(
            error.starts_with("alone.toml: scale.spacing: "),
            "{points} {wall}: {error}"
        );
    }
    // A wall as thick as the vessel is high, and a stove pipe, are allowed.
    alone(beaker, "0.08").unwrap();
    alone("[[0.0, 0.03], [20.0, 0.03]]", "0.02").unwrap();
}

/// An empty flask may be poured into: the limit is that of the column which it may hold, 0.4 d/√(gH) times 1.4.
#[test]
fn what_may_be_poured_in_counts() {
    let scene = |volume: &str, substeps: &str| {
        let text = Scene::builtin_text("two-flasks").unwrap();
        let text = text
            .replace("beaker-400", "cylinder-100")
            .replace("volume_ml = 150.0", &format!("volume_ml = {volume}"))
            .replace("substeps = 10", &format!("substeps = {substeps}"));
        let presets = text.find("[preset.fast]").unwrap();
        Scene::parse(&text[..presets], "cylinder.toml")
    };
    // 256 mm high: 0.89 ms is the longest, of 11.1.
    let error = scene("150.0", "12").unwrap_err().to_string();
    assert_parts(&error, &["\"target\" may hold", "take 13 or more"]);
    scene("150.0", "13").unwrap();
    // 20 mL stand 33 mm high in it: 2.4 ms.
    scene("20.0", "5").unwrap();
}

/// 20 mL of acid (1.836 g/cm³ at 98 %) above 160 mL of water press on its bottom as 1 + (1.836/0.998 − 1)/9 = 1.093 times the
/// column of water would.
#[test]
fn what_is_heavier_may_lie_above() {
    let needed = |acid: &str| {
        let text = Scene::builtin_text("acid-into-water").unwrap();
        let presets = text.find("[preset.fast]").unwrap();
        let text = text[..presets]
            .replace("acid_fraction = 0.98", &format!("acid_fraction = {acid}"))
            .replace("substeps = 10", "substeps = 2");
        let error = Scene::parse(&text, "layers.toml").unwrap_err().to_string();
        let (_, rest) = error.split_once("too long for the ").unwrap();
        rest.split(' ').next().unwrap().parse::<f64>().unwrap()
    };
    let ratio = needed("0.98") / needed("0.0");
    // The message has millimetres, of 29.
    assert!((ratio - 1.093).abs() < 0.03, "{ratio}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None,
        ..ProptestConfig::default() })]

    /// Any number of the file may become any other: the scene is refused by name,
    /// or it can be filled, under all of its presets.
    #[test]
    fn a_changed_number_is_refused_or_can_be_filled(
        edits in prop::collection::vec((any::<prop::sample::Index>(), numbers()), 1..4),
    ) {
        let text = GOOD.to_owned() + "[preset.fast]\nsubsteps = 4\nspacing = 0.006\n";
        let text = edits.iter().fold(text, |text, (at, number)| {
            let places: Vec<_> = number_places(&text);
            let place = places[at.index(places.len())].clone();
            text[..place.start].to_owned() + number + &text[place.end..]
        });
        match Scene::parse(&text, "edited.toml") {
            Err(error) => prop_assert!(error.to_string().starts_with("edited.toml: ")),
            Ok(scene) => {
                for preset in [Preset::Fast, Preset::Balanced] {
                    let scene = scene.with_preset(preset);
                    let count: usize =
                        scene.liquids.iter().map(|l| scene.particle_count(l)).sum();
                    let start = scene.start(Some(1)).unwrap();
                    prop_assert_eq!(start.len(), count);
                    prop_assert!(start.iter().all(|p| p.position.is_finite()));
                }
            }
        }
    }

    /// Any list of points is a vessel whose tables are sound, or a message.
    #[test]
    fn any_points_are_a_profile_or_a_message(
        points in prop::collection::vec((coordinate(), coordinate()), 0..8),
        wall in coordinate(),
    ) {
        let points: Vec<[f64; 2]> = points.into_iter().map(|(y, r)| [y, r]).collect();
        if let Ok(profile) = Profile::new(&points, wall) {
            prop_assert!(profile.capacity().is_finite() && profile.capacity() >= 0.0);
            prop_assert!(profile.glass_volume() > 0.0);
            prop_assert!(profile.radius_table().iter().all(|r| r.is_finite() && *r >= 0.0));
            let level = profile.level_for_volume(0.5 * profile.capacity());
            let within = profile.floor_height()..=profile.rim_height();
            prop_assert!(level.is_some_and(|y| within.contains(&y)));
        }
    }
}

/// Coordinates of vessels, and what is none.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => 0.0..0.2f64,
        1 => Just(0.0),
        1 => -0.1..0.1f64,
        1 => prop::num::f64::ANY,
    ]
}

/// Numbers as a file may have them, without those that would give millions of particles.
fn numbers() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => (0.002..2.0f64).prop_map(|number| format!("{number:?}")),
        1 => (-10i32..100).prop_map(|number| number.to_string()),
        1 => prop::sample::select(vec!["nan", "inf", "-inf", "-0.0", "1e300", "-1e-300", "0.0"])
            .prop_map(str::to_owned),
        1 => (-5.0..5.0f64).prop_map(|number| format!("{number:?}")),
    ]
}

/// Where the numbers of a file are.
fn number_places(text: &str) -> Vec<std::ops::Range<usize>> {
    let mut places = Vec::new();
    let mut start = None;
    for (at, c) in text.char_indices() {
        let part = c.is_ascii_digit() || (start.is_some() && ".e-+".contains(c));
        match (part, start) {
            (true, None) => start = Some(at),
            (false, Some(from)) => {
                places.push(from..at);
                start = None;
            }
            _ => {}
        }
    }
    places
}

/// A size allowed for one flask is not allowed for each of many: the sum has to fit.
#[test]
fn all_flasks_together_have_a_size() {
    let from = GOOD.find("[[flask]]").unwrap();
    let to = GOOD.find("[[liquid]]").unwrap();
    let many = |count: usize, points: &str| {
        let flasks: String = (0..count)
            .map(|n| {
                format!(
                    "[[flask]]\nname = \"{n}\"\npoints = {points}\nwall = 0.02\nposition = [{}, 0.0, 0.0]\nfixed = true\n",
                    0.5 * n as f64
                )
            })
            .collect();
        let text = GOOD[..from].to_owned() + &flasks;
        Scene::parse(&text.replace("v_max = 10.0", "v_max = 1e9"), "many.toml")
    };
    assert!(to > from);
    let pipe = "[[0.0, 0.03], [20.0, 0.03]]";
    many(1, pipe).unwrap();
    let error = many(60, pipe).unwrap_err().to_string();
    assert!(error.contains("scale.spacing"), "{error}");
    let cup = "[[0.0, 0.03], [0.08, 0.03]]";
    many(64, cup).unwrap();
    let error = many(65, cup).unwrap_err().to_string();
    assert!(
        error.contains("flask: there are 65; give 64 at most"),
        "{error}"
    );
}
