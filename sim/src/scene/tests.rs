#![allow(clippy::unwrap_used, clippy::panic)]
mod base;
mod bounds;
mod builtin;
mod refused;
mod sizes;
mod tools;

use super::*;

/// Fails if a part is not in the message.
fn assert_parts(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "{part:?} is not in: {message}");
    }
}

/// Two flasks of water, small, that the cases below break in one place each.
const GOOD: &str = r#"
name = "good"
description = "two flasks"
model = []
[scale]
spacing = 0.005
support_ratio = 2.0
frame_time = 0.01
gravity = 9.81
rest_density = 1000.0
length_scale = 1.0
boundary_spacing_ratio = 0.5
[solver]
substeps = 3
iterations = 2
relaxation = "jacobi"
omega = 0.5
carry_rate = 0.0
v_max = 10.0
boundary = "map"
viscosity = 0.1
[floor]
height = 0.0
[[flask]]
name = "a"
profile = "beaker-250"
position = [0.0, 0.5, 0.0]
fixed = false
[[flask]]
name = "b"
points = [[0.0, 0.03], [0.08, 0.03]]
wall = 0.002
position = [0.2, 0.5, 0.0]
rotation = [0.0, 0.0, 90.0]
fixed = true
[[liquid]]
flask = "a"
volume_ml = 100.0
temperature = 20.0
acid_fraction = 0.0
"#;

#[test]
fn nested_flasks_do_not_overlap() {
    let inside = GOOD
        .replace("[0.08, 0.03]", "[0.08, 0.015]")
        .replace("[0.0, 0.03]", "[0.0, 0.015]")
        .replace("[0.2, 0.5, 0.0]", "[0.0, 0.502, 0.0]")
        // The narrow one may be filled to its rim.
        .replace("substeps = 3", "substeps = 4")
        .replace("90.0]", "0.0]");
    Scene::parse(&inside, "nested.toml").unwrap();
    let through = inside.replace("[0.0, 0.502, 0.0]", "[0.0, 0.501, 0.0]");
    assert!(Scene::parse(&through, "through.toml").is_err());
}

#[test]
fn brim_full_is_every_site_and_no_more() {
    // So deep, it takes a substep more.
    let full = GOOD
        .replace("substeps = 3", "substeps = 4")
        .replace("volume_ml = 100.0", "fraction = 1.0");
    let scene = Scene::parse(&full, "full.toml").unwrap();
    let sites: usize = fill::sites(&scene.flasks[0].profile, 0.005)
        .iter()
        .map(Vec::len)
        .sum();
    assert_eq!(scene.start(None).unwrap().len(), sites);
}

#[test]
fn liquids_share_a_flask_from_the_bottom_up() {
    let text = GOOD.to_owned()
        + "[[liquid]]\nflask = \"a\"\nparticles = 300\ntemperature = 60.0\nacid_fraction = 0.5\n";
    let start = Scene::parse(&text, "layers.toml")
        .unwrap()
        .start(None)
        .unwrap();
    assert_eq!(start.len(), 1100);
    let top_of_water = start[..800]
        .iter()
        .map(|p| p.position.y)
        .fold(0.0, f64::max);
    assert!(
        start[800..]
            .iter()
            .all(|p| p.temperature == 60.0 && p.acid_fraction == 0.5)
    );
    assert!(start[800..].iter().all(|p| p.position.y >= top_of_water));
}

#[test]
fn presets_keep_the_volume() {
    let text = GOOD.to_owned() + "[preset.reference]\nspacing = 0.004\niterations = 7\n";
    let scene = Scene::parse(&text, "good.toml").unwrap();
    let fine = scene.with_preset(Preset::Reference);
    assert_eq!(scene.start(None).unwrap().len(), 800);
    // 100 mL / (4 mm)³ = 1562.5.
    assert!((1562..=1563).contains(&fine.start(None).unwrap().len()));
    assert_eq!((fine.solver.iterations, fine.solver.substeps), (7, 3));
    assert_eq!(scene.with_preset(Preset::Fast), scene);
}

#[test]
fn what_is_built_upon_a_feature_goes_with_it() {
    let scene = Scene::builtin("water-into-acid").unwrap();
    let (less, gone) = scene.without(Feature::Evaporation);
    assert_eq!(
        gone,
        [
            Feature::Evaporation,
            Feature::Bubbles,
            Feature::Spray,
            Feature::Air
        ]
    );
    assert!(gone.iter().all(|&feature| !less.models(feature)));
    assert!(less.models(Feature::Density));
    let (bare, _) = scene.without(Feature::Dilution);
    assert_eq!(bare.model, [Feature::Tension]);
}

#[test]
fn a_scene_chooses_its_filter() {
    let with = |filter: &str| {
        let key = format!("[picture]\nfilter = \"{filter}\"\n[floor]");
        Scene::parse(&GOOD.replacen("[floor]", &key, 1), "picture.toml")
    };
    let filter = |scene: Scene| scene.picture.filter;
    let default = Scene::parse(GOOD, "good.toml").unwrap();
    assert_eq!(filter(default), PictureFilter::NarrowRange);
    let flow = with("curvature-flow").unwrap();
    assert_eq!(filter(flow), PictureFilter::CurvatureFlow);
    let error = with("gaussian").unwrap_err().to_string();
    assert!(error.contains("narrow-range"), "{error}");
}

#[test]
fn a_scene_chooses_its_tint() {
    let with = |tint: &str| {
        let key = format!("[picture]\ntint = \"{tint}\"\n[floor]");
        Scene::parse(&GOOD.replacen("[floor]", &key, 1), "picture.toml")
    };
    let default = Scene::parse(GOOD, "good.toml").unwrap();
    assert_eq!(default.picture.tint, PictureTint::Artificial);
    assert_eq!(with("none").unwrap().picture.tint, PictureTint::None);
    let error = with("blue").unwrap_err().to_string();
    assert!(error.contains("artificial"), "{error}");
}

/// A whole scene elsewhere is the same scene.
#[test]
fn a_scene_far_off_is_the_same_but_for_its_origin() {
    let near = Scene::parse(GOOD, "near.toml").unwrap();
    let text = GOOD.replace("model = []", "origin = [1e7, -3.0, 0.125]\nmodel = []");
    let far = Scene::parse(&text, "far.toml").unwrap();
    assert_eq!(far.origin, DVec3::new(1e7, -3.0, 0.125));
    let moved = Scene {
        origin: DVec3::ZERO,
        ..far
    };
    assert_eq!(moved, near);
}
