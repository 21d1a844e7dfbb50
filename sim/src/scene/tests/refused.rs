//! Scenes with a mistake, and the errors for them.

use super::{GOOD, assert_parts};
use crate::chemistry::Chemistry;
use crate::parameters::Parameters;
use crate::scene::Scene;
use crate::surface_tension::{GLASS, HYSTERESIS};

fn broken(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from} is not in the good scene");
    Scene::parse(GOOD, "good.toml").unwrap();
    refusal(&GOOD.replacen(from, to, 1))
}

/// The error for a scene's text.
fn refusal(text: &str) -> String {
    Scene::parse(text, "bad.toml").unwrap_err().to_string()
}

/// Cases of a text that is replaced, the one in its place, and parts of the error.
macro_rules! cases {
    ($($from:literal => $to:literal: $($part:literal),+;)*) => {
        [$(($from, $to, &[$($part),+][..])),*]
    };
}

/// It was told of a key that scenes do not have.
#[test]
fn a_lesson_and_a_track_are_told_from_a_scene() {
    for (text, parts) in [
        (
            include_str!("../../../../run/lesson/lessons/dilute.toml"),
            [
                "bad.toml: is a lesson and no scene",
                "`vitriol lesson FILE`",
            ],
        ),
        (
            include_str!("../../../../xr/tracks/two-flasks.toml"),
            ["bad.toml: is a track and no scene", "`vitriol replay FILE`"],
        ),
    ] {
        assert_parts(&refusal(text), &parts);
    }
}

#[test]
fn malformed_scenes_name_file_field_and_remedy() {
    let cases = cases! {
        "spacing = 0.005\n" => "spacing = 0.00005\n": "scale.spacing", "larger spacing";
        "spacing = 0.005\n" => "": "missing field `spacing`", "line 5";
        "gravity" => "gravitas": "unknown field `gravitas`", "`gravity`", "line 9";
        "0.005" => "nan": "scale.spacing", "NaN", "above zero";
        "0.005" => "-0.005": "scale.spacing", "-0.005", "above zero";
        "0.005" => "\"wide\"": "invalid type", "line 6";
        // Decimal commas make more numbers.
        "position = [0.0, 0.5, 0.0]" => "position = [0.0, 0,5, 0.0]": "has 4 numbers; write 3", "decimal point";
        "[0.08, 0.03]" => "[0,8, 0.03]": "has 3 numbers; write 2";
        "omega = 0.5" => "omega = 3.0": "solver.omega", "below 2";
        "substeps = 3" => "substeps = 1": "solver.substeps", "leap out", "take 2 or more";
        "viscosity = 0.1" => "viscosity = 1.5": "solver.viscosity", "between 0 and 1";
        "frame_time = 0.01" => "frame_time = 5.0": "scale.frame_time", "at most 0.1";
        "support_ratio = 2.0" => "support_ratio = 1.2": "scale.support_ratio", "between 1.5 and 3";
        "[0.2, 0.5, 0.0]" => "[10000.0, 0.5, 0.0]": "flask[1].position", "`origin`";
        "model = []" => "model = []\norigin = [0.0, inf, 0.0]": "origin", "inf";
        "temperature = 20.0\nacid_fraction = 0.0\n" => "temperature = 400.0\nacid_fraction = 0.0\n[physical]\n":
            "liquid[0].temperature", "boils at 100 °C", "take 140";
        "substeps = 3" => "substeps = 0": "solver.substeps", "between 1";
        "substeps = 3\niterations = 2" => "substeps = 800\niterations = 800": "solver.iterations", "at most 4096";
        "\"map\"" => "\"mop\"": "unknown variant `mop`", "`map`", "`particles`";
        "model = []" => "model = [\"boiling\"]": "paper", "missing", "boiling", "[physical]";
        "[floor]" => "[paper]\nT_a = 20.0\n[physical]\nambient = 20.0\n[floor]": "physical", "keep one chemistry";
        "[floor]" => "[physical]\nlewis = 0.7\n[floor]": "unknown field `lewis`", "`mixing`";
        "[floor]" => "[physical]\nambient = 5000.0\n[floor]": "physical.ambient", "from −90 to 60";
        "[floor]" => "[paper]\nT_B = 0.0\n[floor]": "paper.T_B", "above 0";
        "[floor]" => "[physical]\nambient = 20.0\n[floor]": "physical.ambient", "not used", "heat";
        "viscosity = 0.1" => "viscosity = 0.1\nvorticity = 1.0": "solver.vorticity", "model";
        "beaker-250" => "bucket": "flask[0].profile", "bucket", "beaker-250";
        "[0.08, 0.03]" => "[0.08, 0.001]": "flask[1].points", "narrower than a particle (0.005 m)";
        "[0.08, 0.03]" => "[0.0, 0.03]": "flask[1].points", "list the points from the floor up";
        "[0.08, 0.03]" => "[0.08, nan]": "flask[1].points", "NaN";
        "wall = 0.002" => "wall = -1.0": "flask[1].wall", "above zero";
        "wall = 0.002\n" => "": "flask[1].wall", "missing";
        "wall = 0.002" => "wall = 0.002\nvessel = \"jar\"": "unknown variant `jar`", "`bottle`";
        "name = \"a\"" => "name = \"a\"\nvessel = \"bottle\"": "flask[0].vessel", "has its own";
        "[0.2, 0.5, 0.0]" => "[0.06, 0.5, 0.0]": "flask[1].position", "overlaps", "move them apart";
        "[0.2, 0.5, 0.0]" => "[inf, 0.5, 0.0]": "flask[1].position", "inf";
        "name = \"b\"" => "name = \"a\"": "flask[1].name", "give another";
        "flask = \"a\"" => "flask = \"c\"": "liquid[0].flask", "no flask is named", "a, b";
        "volume_ml = 100.0" => "volume_ml = 400.0": "liquid", "400 mL are asked for", "mL fit below the rim", "use less";
        "volume_ml = 100.0" => "volume_ml = 1e30": "liquid", "fit below the rim";
        "volume_ml = 100.0" => "": "liquid[0].volume_ml", "exactly one";
        "acid_fraction = 0.0" => "acid_fraction = 1.5": "liquid[0].acid_fraction", "between 0 and 1";
        "[floor]" => "[preset.quick]\n[floor]": "unknown variant `quick`", "`fast`";
        "[floor]" => "[preset.fast]\nspacing = 0.1\n[floor]": "preset.fast.spacing", "narrower";
    };
    for (from, to, parts) in cases {
        let message = broken(from, to);
        assert!(message.starts_with("bad.toml: "), "{message}");
        assert_parts(&message, parts);
    }
}

#[test]
fn missing_file_is_named_with_the_builtin_scenes() {
    let message = Scene::builtin("nowhere.toml").unwrap_err().to_string();
    assert_parts(&message, &["nowhere.toml", "two-flasks"]);
}

/// Water's own bound is not acid's: water of the films, at 112 °C, and hot acid are liquid, water of 250 °C is steam. Acid of 98 % boils at
/// 333 °C (Perry), and the tables end at 340 °C. It is so in a scene without heat as well.
#[test]
fn a_liquid_is_no_hotter_than_it_stays_liquid() {
    let of = |celsius: f64, acid: f64| {
        let hot = format!("temperature = {celsius:?}\nacid_fraction = {acid:?}\n");
        let [without, with] = ["", "[physical]\n"].map(|chemistry| {
            let hot = format!("{hot}{chemistry}");
            let text = GOOD.replacen("temperature = 20.0\nacid_fraction = 0.0\n", &hot, 1);
            let scene = Scene::parse(&text, "hot.toml");
            scene.map(|scene| scene.liquids[0].temperature)
        });
        assert_eq!(with, without);
        with
    };
    for (celsius, acid) in [(112.0, 0.0), (140.0, 0.0), (150.0, 0.98), (340.0, 0.98)] {
        assert_eq!(of(celsius, acid), Ok(celsius), "acid {acid}");
    }
    for (celsius, acid, parts) in [
        (250.0, 0.0, ["boils at 100 °C", "take 140"]),
        (250.0, 0.6, ["boils at 141 °C", "take 181"]),
        (341.0, 0.98, ["boils at 333 °C", "take 340"]),
    ] {
        let message = of(celsius, acid).unwrap_err().to_string();
        assert_parts(&message, &["liquid[0].temperature"]);
        assert_parts(&message, &parts);
    }
}

/// Acid under water jitters at up to 6 cm/s with half of its multipliers carried on in a substep, and at 3 with a tenth:
/// of 900 substeps a second, 90 1/s.
#[test]
fn little_is_carried_on_in_a_substep() {
    let scene = include_str!("../../../scenes/water-into-acid.toml");
    let with = |rate: &str| scene.replacen("carry_rate = 2.25", &format!("carry_rate = {rate}"), 1);
    let message = refusal(&with("90.5"));
    assert_parts(&message, &["solver.carry_rate", "take 90 or less"]);
    // `fast` has 8 substeps in place of 10.
    let message = refusal(&with("80"));
    assert_parts(&message, &["preset.fast: solver.carry_rate"]);
    Scene::parse(&with("70"), "good.toml").unwrap();
    let older = scene.replacen("carry_rate = 2.25", "carry = 0.005", 1);
    let message = refusal(&older);
    assert_parts(&message, &["`carry`", "`carry_rate`"]);
}

#[test]
fn a_plate_heats_glass_that_is_modelled() {
    let scene = Scene::builtin_text("water-into-acid").unwrap();
    let on = |heater: &str| {
        scene.replacen(
            "fixed = false",
            &format!("fixed = false\nheater = {heater}"),
            1,
        )
    };
    let heated = Scene::parse(&on("150"), "p.toml").unwrap();
    assert_eq!(heated.flasks[0].heater, 150.0);
    assert_eq!(
        Parameters::from_scene(&heated).heaters,
        [150.0, 0.0],
        "by flask"
    );
    // A plate that is off is there all the same, and gives nothing.
    let plates = |scene: &Scene| -> Vec<(f64, bool)> {
        let flasks = scene.flasks.iter();
        flasks.map(|it| (it.heater, it.plate)).collect()
    };
    assert_eq!(plates(&heated), [(150.0, true), (0.0, false)]);
    let off = Scene::builtin("hot-acid").unwrap();
    assert_eq!(plates(&off), [(0.0, false), (0.0, true)]);
    for heater in ["-1", "6000", "nan"] {
        assert_parts(&refusal(&on(heater)), &["flask[0].heater"]);
    }
    let lines = on("150").replacen("\"air\", \"losses\"", "\"air\"", 1);
    let lines = lines.lines().filter(|line| !line.contains("_loss "));
    let unmodelled = lines.collect::<Vec<_>>().join("\n");
    let message = refusal(&unmodelled);
    assert_parts(&message, &["flask[0].heater", "losses"]);
}

#[test]
fn surface_tension_needs_maps_short_substeps_and_angles() {
    let scene = Scene::builtin_text("beaker").unwrap();
    let key = |tension: &str| format!("surface_tension = {tension}");
    let tense = |tension: &str| scene.replacen(&key("0.0728"), &key(tension), 1);
    let message = |text: String| refusal(&text);
    let good = Scene::parse(&tense("0.0728"), "t.toml").unwrap();
    let surface = good.surface_tension().unwrap();
    assert_eq!((surface.tension, surface.glass[0]), (0.0728, GLASS));
    // √(ρd³/(2πσ)) is 1.39 ms, a substep of `fast`, at 1.29 N/m.
    Scene::parse(&tense("1.2"), "t.toml").unwrap();
    let short = message(tense("2.5"));
    assert_parts(&short, &["solver.substeps", "surface tension of 2.5 N/m"]);
    let particles = message(tense("0.07").replacen("\"map\"", "\"particles\"", 1));
    assert_parts(&particles, &["solver.surface_tension", "boundary"]);
    let flat =
        message(tense("0.07").replacen("fixed = false", "fixed = false\ncontact_angle = 181", 1));
    assert_parts(&flat, &["contact_angle", "from 0 to 180"]);
    assert_eq!(surface.hysteresis, HYSTERESIS);
    let sticky = |degrees: &str| tense(&format!("0.0728\nhysteresis = {degrees}"));
    let rough = Scene::parse(&sticky("45"), "t.toml").unwrap();
    let rough = rough.surface_tension().unwrap().hysteresis;
    assert!((rough - 45.0f64.to_radians()).abs() < 1e-12, "{rough}");
    let far = message(sticky("91"));
    assert_parts(&far, &["solver.hysteresis", "from 0 to 90"]);
    let alone = Scene::builtin_text("single-dilution").unwrap();
    let alone = message(alone.replacen("[solver]", "[solver]\nhysteresis = 20", 1));
    assert_parts(&alone, &["solver.hysteresis", "leave it out"]);
    let negative = message(tense("-0.1"));
    assert_parts(&negative, &["solver.surface_tension"]);
    let nobody = message(tense("0.07").replacen("[\"tension\"]", "[]", 1));
    assert_parts(&nobody, &["surface_tension", "tension"]);
}

/// What boils by another law, and numbers that only it has.
#[test]
fn tables_boil_by_bubbles_alone() {
    let good = Scene::builtin_text("water-into-acid").unwrap();
    let parsed = Scene::parse(good, "b.toml").unwrap();
    let Some(Chemistry::Physical(law)) = Chemistry::from_scene(&parsed) else {
        panic!("has no physical chemistry");
    };
    assert_eq!(law.bubbles.unwrap().slots(), 16_384);
    assert!(law.evaporates() && law.superheat_time.is_none());
    let message = |text: String| refusal(&text);
    let both = message(good.replacen("\"bubbles\"", "\"bubbles\", \"boiling\"", 1));
    assert_parts(&both, &["the paper's"]);
    let idle = message(good.replacen("lamella", "superheat_time = 0.03\nlamella", 1));
    assert_parts(&idle, &["physical.superheat_time"]);
    let lines = good
        .lines()
        .filter(|line| !line.starts_with("most_bubbles"));
    let without = message(lines.collect::<Vec<_>>().join("\n"));
    assert_parts(&without, &["physical.most_bubbles"]);
    // Bubbles have their number of nuclei by lot and their time at the surface by a law; what is said must fit.
    let keys = ["nuclei_spacing", "foam_time"];
    let lines = good.lines().filter(|line| !line.starts_with(keys[0]));
    let without = lines.collect::<Vec<_>>().join("\n");
    Scene::parse(&without, "b.toml").unwrap();
    for key in keys {
        let zero = format!("{key} = 0.0\nmost_bubbles");
        let zero = message(without.replacen("most_bubbles", &zero, 1));
        assert_parts(&zero, &[key, "above zero"]);
        let idle = without.replacen("\"bubbles\", \"spray\", \"air\", ", "", 1);
        let idle = message(idle.replacen("most_bubbles = 16384", &format!("{key} = 0.1"), 1));
        assert!(idle.contains(key), "{idle}");
    }
    let none = message(good.replacen("most_bubbles = 16384", "most_bubbles = 0", 1));
    assert_parts(&none, &["most_bubbles", "from 1 to 65,536"]);
    let level = message(good.replacen("\"density\", ", "", 1));
    assert_parts(&level, &["needs \"density\""]);
}

/// 2σ cos 30°/R of the beaker's 33 mm is 3.8 Pa, the weight of 57 mm of water at 0.0068 m/s².
#[test]
fn liquid_that_glass_sucks_up_is_refused() {
    let scene = Scene::builtin_text("beaker").unwrap();
    let at = |gravity: &str| {
        let text = scene.replacen("gravity = 9.81", &format!("gravity = {gravity}"), 1);
        assert_ne!(text, scene);
        text
    };
    Scene::parse(&at("0.1"), "t.toml").unwrap();
    let little = refusal(&at("0.001"));
    assert_parts(&little, &["flask[0].contact_angle", "sucks"]);
    let dry = at("0.001").replacen("fixed = false", "fixed = false\ncontact_angle = 90", 1);
    Scene::parse(&dry, "t.toml").unwrap();
}

#[test]
fn a_wall_step_is_some_of_a_spacing() {
    let scene = Scene::builtin_text("beaker").unwrap();
    let at = |step: &str| scene.replacen("wall_step = 0.4", &format!("wall_step = {step}"), 1);
    let found = Scene::parse(&at("0.5"), "t.toml").unwrap();
    assert_eq!(found.solver.wall_step, Some(0.5));
    for step in ["0", "-1", "inf", "nan", "11"] {
        assert_parts(&refusal(&at(step)), &["solver.wall_step"]);
    }
}
