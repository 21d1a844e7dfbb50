//! Numbers at the ends of their ranges: just within they are accepted, just beyond they are refused with the range.

use super::{GOOD, assert_parts};
use crate::scene::Scene;

/// Where the number goes in the text of a case.
const NUMBER: &str = "@";

/// A text that is replaced, the one in its place, numbers within and beyond, and parts of the refusal.
type Case = (
    &'static str,
    &'static str,
    &'static [&'static str],
    &'static [&'static str],
    [&'static str; 2],
);

/// [`Case`]s by text and text in its place; numbers within, and beyond; and parts of the refusal.
macro_rules! cases {
    ($($from:literal => $to:literal: $($within:literal),+; not $($beyond:literal),+: $a:literal, $b:literal;)*) => {
        &[$(($from, $to, &[$($within),+], &[$($beyond),+], [$a, $b])),*]
    };
}

fn check(scene: &str, cases: &[Case]) {
    for (from, to, within, beyond, parts) in cases {
        assert!(scene.contains(from), "{from} is not in the scene");
        let read = |number: &str| {
            let text = scene.replacen(from, &to.replace(NUMBER, number), 1);
            Scene::parse(&text, "ends.toml")
        };
        for number in *within {
            if let Err(error) = read(number) {
                panic!("{to} {number}: {error}");
            }
        }
        for number in beyond.iter().chain(&["nan", "inf", "-1e300", "1e300"]) {
            let Err(error) = read(number) else {
                panic!("{to} {number} is accepted");
            };
            let message = error.to_string();
            for part in parts {
                assert!(message.contains(part), "{to} {number}: {message}");
            }
        }
    }
}

/// The good scene with substeps and speed for any gravity.
fn roomy() -> String {
    GOOD.replacen("substeps = 3", "substeps = 40", 1)
        .replacen("v_max = 10.0", "v_max = 1000.0", 1)
}

#[test]
fn of_any_scene() {
    check(
        &roomy(),
        cases! {
            "gravity = 9.81" => "gravity = @": "0.0", "300.0"; not "-0.1", "300.1": "scale.gravity", "from 0 to 300";
            "rest_density = 1000.0" => "rest_density = @": "1.0", "25000.0"; not "0.9", "25001.0":
                "scale.rest_density", "from 1 to 25000 (kg/m³)";
            "v_max = 1000.0" => "v_max = @": "1e9"; not "0.0", "1.1e9": "solver.v_max", "up to 1000000000 (m/s)";
            "model = []" => "model = []\norigin = [0.0, @, 0.0]": "-1e9", "1e9"; not "-1.1e9", "1.1e9":
                "origin", "up to 1000000000 either way";
            "height = 0.0" => "height = @": "-1e4", "1e4"; not "-10001.0", "10001.0": "floor.height", "within 10 km";
            "[0.0, 0.0, 90.0]" => "[0.0, 0.0, @]": "-360.0", "360.0"; not "-360.1", "360.1":
                "flask[1].rotation", "from −360 to 360 (degrees)";
            "wall = 0.002" => "wall = 0.002\ndensity = @": "1.0", "25000.0"; not "0.9", "25001.0":
                "flask[1].density", "from 1 to 25000 (kg/m³)";
            "[floor]" => "[table]\ntop = 0.4\ncentre = [0.0, 0.0]\nsize = [1.0, @]\n[floor]": "0.1", "1000.0"; not "0.0", "1000.1":
                "table.size", "up to 1000 (metres)";
            "[floor]" => "[[tool]]\nkind = \"rod\"\nposition = [0.0, 0.8, 0.0]\nyaw = @\n[floor]": "-360.0", "360.0"; not "-360.1", "360.1":
                "tool[0].yaw", "from −360 to 360 (degrees)";
        },
    );
    for (scale, refused) in [("0.0009", true), ("0.001", false), ("1001.0", true)] {
        let text = roomy().replacen("length_scale = 1.0", &format!("length_scale = {scale}"), 1);
        // Named glass of such a size has no room here.
        let error = Scene::parse(&text, "scale.toml").unwrap_err().to_string();
        let range = "scale.length_scale: ";
        assert_eq!(error.contains(range), refused, "{scale}: {error}");
    }
}

#[test]
fn of_forces() {
    let with = |feature: &str| roomy().replacen("model = []", &format!("model = [{feature:?}]"), 1);
    check(
        &with("vorticity"),
        cases! {
            "viscosity = 0.1" => "viscosity = 0.1\nvorticity = @": "0.0", "100.0"; not "-0.1", "100.1":
                "solver.vorticity", "up to 100 (m/s)";
        },
    );
    check(
        &with("tension"),
        cases! {
            "viscosity = 0.1" => "viscosity = 0.1\nsurface_tension = @": "0.0", "3.0"; not "-0.1", "3.1":
                "solver.surface_tension", "up to 3 (N/m)";
        },
    );
}

#[test]
fn of_the_papers_chemistry() {
    check(
        Scene::builtin_text("single-dilution").unwrap(),
        cases! {
            "\ntemperature = 20.0" => "\ntemperature = @": "-273.1", "1e6"; not "-273.2", "1.1e6":
                "liquid[0].temperature", "up to 1000000 (°C)";
            "T_a = 20.0" => "T_a = @": "-273.1", "1e6"; not "-273.2", "1.1e6": "paper.T_a", "up to 1000000 (°C)";
            "T_B = 100.0" => "T_B = @": "0.1", "1e6"; not "0.0", "1.1e6": "paper.T_B", "up to 1000000 (°C";
            "\nk_d = 0.017" => "\nk_d = @": "0.0", "1000.0"; not "-0.1", "1001.0": "paper.k_d", "from 0 to 1000 (K/cal)";
            "k_v = 1.0" => "k_v = @": "0.0", "1000.0"; not "-0.1", "1001.0": "paper.k_v", "from 0 to 1000";
            "D_T = 0.01" => "D_T = @": "0.0", "1e6"; not "-0.1", "1.1e6": "paper.D_T", "from 0 to 1000000 (m²/s)";
            "D_c = 0.007" => "D_c = @": "0.0", "1e6"; not "-0.1", "1.1e6": "paper.D_c", "from 0 to 1000000 (m²/s)";
        },
    );
}

#[test]
fn of_the_physical_chemistry() {
    check(
        Scene::builtin_text("water-into-acid").unwrap(),
        cases! {
            "mixing = 0.041" => "mixing = @": "0.0", "1e5"; not "-0.1", "1.1e5": "physical.mixing", "from 0 to 100000";
            "eddy_width = 0.006" => "eddy_width = @": "1e-6", "10.0"; not "0.0", "0.9e-6", "10.1":
                "physical.eddy_width", "from 0.000001 to 10 (m)";
            "lamella = 0.0003" => "lamella = @": "1e-6", "10.0"; not "0.0", "0.9e-6", "10.1":
                "physical.lamella", "from 0.000001 to 10 (m)";
            "nuclei_spacing = 0.04" => "nuclei_spacing = @": "1e-6", "10.0"; not "0.0", "0.9e-6", "10.1":
                "physical.nuclei_spacing", "from 0.000001 to 10 (m)";
            "nuclei_spacing = 0.04" => "foam_time = @\nnuclei_spacing = 0.04": "0.001", "3600.0"; not "0.0", "3601.0":
                "physical.foam_time", "up to 3600 (seconds)";
            "glass_loss = 12.0" => "glass_loss = @": "0.0", "1e5"; not "-0.1", "1.1e5":
                "physical.glass_loss", "from 0 to 100000 (W/(m²·K))";
            "surface_loss = 12.0" => "surface_loss = @": "0.0", "1e5"; not "-0.1", "1.1e5":
                "physical.surface_loss", "from 0 to 100000 (W/(m²·K))";
        },
    );
}

/// Clean water freezes of itself at −38 °C (Koop et al., 2000), and battery acid, of 38 %, at −75 °C. Water of −20 °C is supercooled.
#[test]
fn a_liquid_is_no_colder_than_it_stays_liquid() {
    let of = |celsius: f64, acid: f64| {
        let cold = format!("temperature = {celsius:?}\nacid_fraction = {acid:?}\n[physical]\n");
        let text = GOOD.replacen("temperature = 20.0\nacid_fraction = 0.0\n", &cold, 1);
        Scene::parse(&text, "cold.toml").map(|scene| scene.liquids[0].temperature)
    };
    for (celsius, acid) in [(-20.0, 0.0), (-38.0, 0.0), (-75.0, 0.38), (-75.0, 0.98)] {
        assert_eq!(of(celsius, acid), Ok(celsius), "acid {acid}");
    }
    for (celsius, acid, remedy) in [
        (-38.5, 0.0, "take -38 or more"),
        (-57.0, 0.19, "take -56 or more"),
        (-75.5, 0.38, "take -75 or more"),
        (-200.0, 0.98, "take -75 or more"),
    ] {
        let message = of(celsius, acid).unwrap_err().to_string();
        assert_parts(&message, &["liquid[0].temperature", "is ice", remedy]);
    }
}
