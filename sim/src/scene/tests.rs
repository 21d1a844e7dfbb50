#![allow(clippy::unwrap_used, clippy::panic)]
use super::*;
use proptest::prelude::*;

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
carry = 0.0
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

fn broken(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from} is not in the good scene");
    Scene::parse(GOOD, "good.toml").unwrap();
    let error = Scene::parse(&GOOD.replacen(from, to, 1), "bad.toml").unwrap_err();
    error.to_string()
}

#[test]
fn malformed_scenes_name_file_field_and_remedy() {
    let cases = [
        (
            "spacing = 0.005\n",
            "spacing = 0.00005\n",
            &["scale.spacing", "larger spacing"][..],
        ),
        (
            "spacing = 0.005\n",
            "",
            &["missing field `spacing`", "line 5"][..],
        ),
        (
            "gravity",
            "gravitas",
            &["unknown field `gravitas`", "`gravity`", "line 9"],
        ),
        ("0.005", "nan", &["scale.spacing", "NaN", "above zero"]),
        (
            "0.005",
            "-0.005",
            &["scale.spacing", "-0.005", "above zero"],
        ),
        ("0.005", "\"wide\"", &["invalid type", "line 6"]),
        ("omega = 0.5", "omega = 3.0", &["solver.omega", "below 2"]),
        (
            "substeps = 3",
            "substeps = 1",
            &["solver.substeps", "leap out", "take 2 or more"],
        ),
        (
            "viscosity = 0.1",
            "viscosity = 1.5",
            &["solver.viscosity", "between 0 and 1"],
        ),
        (
            "frame_time = 0.01",
            "frame_time = 5.0",
            &["scale.frame_time", "at most 0.1"],
        ),
        (
            "support_ratio = 2.0",
            "support_ratio = 1.2",
            &["scale.support_ratio", "between 1.5 and 3"],
        ),
        (
            "[0.2, 0.5, 0.0]",
            "[10000.0, 0.5, 0.0]",
            &["flask[1].position", "`origin`"],
        ),
        (
            "model = []",
            "model = []\norigin = [0.0, inf, 0.0]",
            &["origin", "inf"],
        ),
        (
            "temperature = 20.0\nacid_fraction = 0.0\n",
            "temperature = 400.0\nacid_fraction = 0.0\n[physical]\n",
            &["liquid[0].temperature", "no mixture"],
        ),
        (
            "substeps = 3",
            "substeps = 0",
            &["solver.substeps", "between 1"],
        ),
        (
            "\"map\"",
            "\"mop\"",
            &["unknown variant `mop`", "`map`", "`particles`"],
        ),
        (
            "model = []",
            "model = [\"boiling\"]",
            &["paper", "missing", "boiling", "[physical]"],
        ),
        (
            "[floor]",
            "[paper]\nT_a = 20.0\n[physical]\nambient = 20.0\n[floor]",
            &["physical", "keep one chemistry"],
        ),
        (
            "[floor]",
            "[physical]\nlewis = 1.43\n[floor]",
            &["physical.lewis", "between 0 and 1"],
        ),
        (
            "[floor]",
            "[paper]\nT_B = 0.0\n[floor]",
            &["paper.T_B", "above 0"],
        ),
        (
            "[floor]",
            "[physical]\nambient = 20.0\n[floor]",
            &["physical.ambient", "not used", "heat"],
        ),
        (
            "viscosity = 0.1",
            "viscosity = 0.1\nvorticity = 1.0",
            &["solver.vorticity", "model"],
        ),
        (
            "beaker-250",
            "bucket",
            &["flask[0].profile", "bucket", "beaker-250"],
        ),
        (
            "[0.08, 0.03]",
            "[0.08, 0.001]",
            &["flask[1].points", "narrower than a particle"],
        ),
        (
            "[0.08, 0.03]",
            "[0.0, 0.03]",
            &["flask[1].points", "list the points from the floor up"],
        ),
        ("[0.08, 0.03]", "[0.08, nan]", &["flask[1].points", "NaN"]),
        (
            "wall = 0.002",
            "wall = -1.0",
            &["flask[1].wall", "above zero"],
        ),
        ("wall = 0.002\n", "", &["flask[1].wall", "missing"]),
        (
            "[0.2, 0.5, 0.0]",
            "[0.06, 0.5, 0.0]",
            &["flask[1].position", "overlaps", "move them apart"],
        ),
        (
            "[0.2, 0.5, 0.0]",
            "[inf, 0.5, 0.0]",
            &["flask[1].position", "inf"],
        ),
        (
            "name = \"b\"",
            "name = \"a\"",
            &["flask[1].name", "give another"],
        ),
        (
            "flask = \"a\"",
            "flask = \"c\"",
            &["liquid[0].flask", "no flask is named", "a, b"],
        ),
        (
            "volume_ml = 100.0",
            "volume_ml = 400.0",
            &["liquid", "fit below the rim"],
        ),
        (
            "volume_ml = 100.0",
            "volume_ml = 1e30",
            &["liquid", "fit below the rim"],
        ),
        (
            "volume_ml = 100.0",
            "",
            &["liquid[0].volume_ml", "exactly one"],
        ),
        (
            "acid_fraction = 0.0",
            "acid_fraction = 1.5",
            &["liquid[0].acid_fraction", "between 0 and 1"],
        ),
        (
            "[floor]",
            "[preset.quick]\n[floor]",
            &["unknown variant `quick`", "`fast`"],
        ),
        (
            "[floor]",
            "[preset.fast]\nspacing = 0.1\n[floor]",
            &["preset.fast.spacing", "narrower"],
        ),
    ];
    for (from, to, parts) in cases {
        let message = broken(from, to);
        assert!(message.starts_with("bad.toml: "), "{message}");
        for part in parts {
            assert!(
                message.contains(part),
                "{to:?}: {part:?} is not in: {message}"
            );
        }
    }
}

#[test]
fn missing_file_is_named_with_the_builtin_scenes() {
    let message = Scene::load("nowhere.toml").unwrap_err().to_string();
    assert!(
        message.contains("nowhere.toml") && message.contains("two-flasks"),
        "{message}"
    );
}

#[test]
fn nested_flasks_do_not_overlap() {
    let inside = GOOD
        .replace("[0.08, 0.03]", "[0.08, 0.015]")
        .replace("[0.0, 0.03]", "[0.0, 0.015]")
        .replace("[0.2, 0.5, 0.0]", "[0.0, 0.502, 0.0]")
        .replace("90.0]", "0.0]");
    Scene::parse(&inside, "nested.toml").unwrap();
    let through = inside.replace("[0.0, 0.502, 0.0]", "[0.0, 0.501, 0.0]");
    assert!(Scene::parse(&through, "through.toml").is_err());
}

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

#[test]
fn every_builtin_loads_and_states_its_scale() {
    for name in Scene::builtin_names() {
        let scene = Scene::load(name).unwrap();
        assert_eq!(scene.name, name);
        for preset in [Preset::Fast, Preset::Balanced, Preset::Reference] {
            assert!(scene.presets.contains_key(&preset), "{name} {preset:?}");
            let changed = scene.with_preset(preset);
            let count: usize = changed
                .liquids
                .iter()
                .map(|l| changed.particle_count(l))
                .sum();
            let start = changed.start(Some(1)).unwrap();
            assert_eq!(start.len(), count);
            assert!(name != "two-flasks" || count >= 8000, "{preset:?}: {count}");
            for particle in start {
                let flask = &changed.flasks[particle.flask];
                let local = flask.stage_from_flask.inverse();
                let p = local
                    .transform_point(particle.position.as_vec3())
                    .as_dvec3();
                assert!(flask.profile.is_inside(p.x.hypot(p.z), p.y), "{name}: {p}");
            }
        }
    }
}

/// Table 2: fluid particles within 1 %, solid ones within 10 %.
#[test]
fn paper_scenes_have_table_2s_particles() {
    for (name, fluid, solid) in [
        ("moving-flask", 10925, 51158),
        ("single-dilution", 13894, 48044),
        ("triple-dilution", 39888, 60632),
        ("tomato-soup", 14880, 2341),
    ] {
        let scene = Scene::load(name).unwrap();
        assert!((scene.scale.particle_mass() - 0.125).abs() < 1e-12);
        let own_fluid = scene.start(None).unwrap().len();
        let own_solid: usize = scene.boundary_particles().iter().map(Vec::len).sum();
        let off = |own: usize, paper: usize| (own as f64 / paper as f64 - 1.0).abs();
        assert!(off(own_fluid, fluid) < 0.01, "{name}: {own_fluid} fluid");
        assert!(off(own_solid, solid) < 0.10, "{name}: {own_solid} solid");
    }
}

/// Table 1, row by row.
#[test]
fn paper_scenes_have_table_1s_parameters() {
    for name in ["single-dilution", "triple-dilution", "vr-dilution"] {
        let scene = Scene::load(name).unwrap();
        let p = scene.paper.unwrap();
        let row = [p.T_a, p.T_B, p.k_d, p.k_v, p.D_T, p.D_c].map(Option::unwrap);
        assert_eq!(row, [20.0, 100.0, 0.017, 1.0, 0.01, 0.007]);
        assert_eq!(scene.solver.viscosity, 0.3);
    }
    let soup = Scene::load("tomato-soup").unwrap();
    let p = soup.paper.unwrap();
    assert_eq!((p.T_a, p.T_B, p.k_d), (Some(110.0), Some(100.0), None));
    assert_eq!(soup.solver.viscosity, 0.3);
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
    let scene = Scene::load("water-into-acid").unwrap();
    let (less, gone) = scene.without(Feature::Evaporation);
    assert_eq!(
        gone,
        [Feature::Evaporation, Feature::Steam, Feature::Boiling]
    );
    assert!(gone.iter().all(|&feature| !less.models(feature)));
    assert!(less.models(Feature::Density));
    assert!(scene.without(Feature::Dilution).0.model.is_empty());
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

/// Numbers as a file may have them; not such as ask for millions of particles.
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
