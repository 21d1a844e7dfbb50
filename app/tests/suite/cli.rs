//! The binary from outside: exit codes, one message, pure JSON.

mod bounds;
mod editors;
mod own;
#[cfg(target_os = "linux")]
pub mod runtime;
mod shown;
#[cfg(unix)]
mod unseen;

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::VITRIOL;
use vitriol_lesson::Attempt;
use vitriol_record::{Keeping, Scored, Session, keep};

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

#[test]
fn help_names_every_subcommand_and_its_options() {
    let folder = tempfile::tempdir().unwrap();
    let help = |line: &str| {
        let output = VITRIOL.run(folder.path(), line);
        assert!(output.status.success(), "{line}");
        text(&output.stdout).to_owned()
    };
    let all = help("--help");
    for line in [
        "replay --scene --preset --seconds --seed --device --out --no-video --camera --colour",
        "vr --scene --preset --seed --posture --grip --record --frames --stand-in --size --rate",
        "desk --scene --lesson --preset --grip --record --no-hints --size --full-screen --fov --scale --device",
        "track --output --list",
        "scenes",
        "bench --scene --paper --frames --against --scaling --most --device",
        "fidelity --out --quick --preset --device",
        "fig5 --out --device",
        "dam-break --out --preset --device",
        "calorimeter --water-ml --acid-ml --acid-percent --water-c --acid-c --order --preset --seed --device",
        "grade --scene --preset --jobs --out --verify --device --class",
        "forget --class",
        "doctor",
    ] {
        let mut words = line.split(' ');
        let command = words.next().unwrap();
        assert!(all.contains(command), "{all}");
        let own = help(&format!("{command} --help"));
        for option in words.chain(["--json"]) {
            assert!(own.contains(option), "{command}: {own}");
        }
    }
}

#[test]
fn bad_arguments_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    VITRIOL.refuses(folder.path(), "", &["Usage"]);
    VITRIOL.refuses_each(
        folder.path(),
        "
pour => pour
replay => TRACK
replay x --preset best => best; balanced
replay x --seconds=0 => above 0
replay x --seconds=-1 => above 0
replay x --seconds=nan => above 0
replay x --seconds=inf => above 0
replay x --seed=-1 => --seed
replay two-flasks --colour acid => --colour acid; two-flasks models no heat
replay nowhere.mcap => nowhere.mcap; two-flasks
bench --frames 0 => --frames
bench --paper --scene x => --paper
calorimeter --water-ml 10 => --acid-ml
calorimeter --water-ml 0 --acid-ml 0 => 0 mL in all
calorimeter --water-ml -1 --acid-ml 10 => --water-ml -1
calorimeter --water-ml 10 --acid-ml nan => --acid-ml NaN
calorimeter --water-ml 1e30 --acid-ml 1 => 1000000000
calorimeter --water-ml 10 --acid-ml 10 --acid-percent 101 => --acid-percent 101
calorimeter --water-ml 10 --acid-ml 10 --water-c 101 => --water-c 101; 100 °C
calorimeter --water-ml 10 --acid-ml 10 --acid-c -1 => --acid-c -1; 333 °C
calorimeter --water-ml 10 --acid-ml 10 --order both => both; water-first
",
    );
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_calorimeter_of_one_liquid_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let told = VITRIOL.object(
        folder.path(),
        "calorimeter --preset fast --water-ml 0 --acid-ml 50 --acid-percent 30 --acid-c 60",
    );
    let number = |key: &str| told[key].as_f64().unwrap();
    // f32 of what went in.
    assert!((number("final_c") - 60.0).abs() < 1e-3, "{told}");
    assert!((number("mass_percent") - 30.0).abs() < 1e-4, "{told}");
    // 1.191 g/mL at 60 °C (the table of densities).
    assert!((number("mass_g") - 59.55).abs() < 0.01, "{told}");
    for key in [
        "evaporated_g",
        "time_to_even_s",
        "peak_superheat_k",
        "mass_drift",
        "acid_drift",
        "enthalpy_drift",
        "lost_particles",
    ] {
        assert_eq!(number(key), 0.0, "{key}: {told}");
    }
}

#[test]
fn keyframes_become_a_track_and_are_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let keyframes = "name = \"wave\"\nscene = \"two-flasks\"\nduration = 1.0\n\
        [[head]]\nt = 0.0\nposition = [0.0, 1.2, 0.0]\n";
    fs::write(here.join("wave.toml"), keyframes).unwrap();
    let done = VITRIOL.object(here, "track wave.toml -o wave.mcap");
    let info = VITRIOL.object(here, "track wave.mcap");
    assert_eq!(info["frames"], done["frames"]);
    assert_eq!(info["scene"], "two-flasks");
    assert_eq!(info["recovered"], false);
    assert!(
        (info["duration_s"].as_f64().unwrap() - 1.0).abs() < 1.0 / 90.0,
        "{info}"
    );

    let before = fs::read(here.join("wave.mcap")).unwrap();
    VITRIOL.refuses_each(
        here,
        "track wave.toml -o wave.mcap => wave.mcap; exists; take that one away",
    );
    assert_eq!(fs::read(here.join("wave.mcap")).unwrap(), before);

    let typo = keyframes.replace("duration", "durration");
    fs::write(here.join("typo.toml"), typo).unwrap();
    fs::write(here.join("cut.mcap"), &before[..40]).unwrap();
    VITRIOL.refuses_each(
        here,
        "
track typo.toml -o typo.mcap => typo.toml; duration
track cut.mcap => cut.mcap
replay cut.mcap => cut.mcap
",
    );
    assert!(!here.join("typo.mcap").exists() && !here.join("out").exists());
}

#[test]
fn who_is_forgotten_is_in_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    // Windows has no such variable: what it would find there is not a test's.
    let forget = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_vitriol"));
        command
            .current_dir(here)
            .env("XDG_DATA_HOME", here.join("data"));
        command.arg("forget").args(arguments).output().unwrap()
    };
    let attempt = Attempt {
        scene: "water-into-acid".into(),
        ..Attempt::default()
    };
    let attempts = [attempt].map(|attempt| Scored {
        attempt,
        score: None,
    });
    let class = here.join("data/vitriol/class.sqlite");
    for name in ["Zebra-Quagga", "Otter"] {
        let pseudonym = name.parse().unwrap();
        let kept = keep(&Keeping {
            class: &class,
            pseudonym: &pseudonym,
            session: Session::now(),
            lesson: None,
            source: Some(Path::new("pour.mcap")),
            attempts: &attempts,
            out: Some(&here.join(name)),
            lrs: None,
        });
        assert_eq!(kept.unwrap().new, 1);
    }

    fs::write(here.join("text"), "no table").unwrap();
    VITRIOL.refuses_each(
        here,
        "
forget => PSEUDONYM
forget ada@example.org => e-mail; p07
forget Otter --class typo.sqlite => typo.sqlite; no such file
forget Otter --class text => text; not a class's file
",
    );

    #[cfg(unix)]
    {
        let output = forget(&["Zebra-Quagga", "--json"]);
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(told["attempts"], 1, "{told}");
        assert_eq!(told["files"].as_array().unwrap().len(), 1, "{told}");
        assert!(
            told["recordings"][0]
                .as_str()
                .unwrap()
                .ends_with("pour.mcap")
        );
        assert!(!here.join("Zebra-Quagga/statements.jsonl").exists());
        assert!(here.join("Otter/statements.jsonl").exists());
        let class = fs::read(&class).unwrap();
        let holds = |name: &str| {
            class
                .windows(name.len())
                .any(|part| part == name.as_bytes())
        };
        assert!(holds("Otter") && !holds("Zebra-Quagga"));
        let again = forget(&["Zebra-Quagga"]);
        assert!(text(&again.stdout).starts_with("Nothing is kept of Zebra-Quagga"));
        // Where nobody was ever kept, nothing is made.
        fs::remove_dir_all(here.join("data")).unwrap();
        assert!(forget(&["Otter"]).status.success());
        assert!(!here.join("data").exists());
    }
}

#[test]
fn a_replay_watches_the_shaders_that_it_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let shaders = folder.path().join("wgsl/render");
    fs::create_dir_all(&shaders).unwrap();
    fs::write(shaders.join("picture.wgsl"), "fn nonsense(").unwrap();
    for line in [
        "replay two-flasks --camera head --out new",
        "replay two-flasks --compare beaker,two-flasks --out both",
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_vitriol"))
            .args(line.split(' '))
            .args(["--seconds", "0.001", "--preset", "fast"])
            .current_dir(folder.path())
            .env("VITRIOL_SHADERS", folder.path().join("wgsl"))
            .output()
            .unwrap();
        let message = text(&output.stderr);
        assert!(output.status.success(), "{message}");
        for part in [
            "the built-in render/picture.wgsl is used",
            "picture.wgsl:1:",
        ] {
            assert!(message.contains(part), "{line}: {message}");
        }
    }
    let report = fs::read_to_string(folder.path().join("new/report.json")).unwrap();
    assert!(report.contains("--camera head"), "{report}");
}

/// A fault of each kind, by the file that a user would have; `sim/src/scene/tests/refused.rs` and `xr/tests/suite/track/keyframes.rs` have
/// the message of each fault.
#[test]
fn bad_input_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let scene = fs::read_to_string(repository.join("sim/scenes/two-flasks.toml")).unwrap();
    for (from, to, part) in [
        ("gravity = 9.81", "", "missing field `gravity`"),
        ("gravity = 9.81", "gravity = nan", "scale.gravity"),
        ("volume_ml = 150.0", "volume_ml = 1500.0", "mL fit"),
    ] {
        assert!(scene.contains(from), "{from}");
        fs::write(here.join("bad.toml"), scene.replacen(from, to, 1)).unwrap();
        let line = "replay two-flasks --scene bad.toml --out new";
        VITRIOL.refuses(here, line, &["bad.toml: ", part]);
        assert!(!here.join("new").exists(), "{to}");
    }

    let keyframes = fs::read_to_string(repository.join("xr/tracks/two-flasks.toml")).unwrap();
    for (from, to, part) in [
        ("{ pitch = -40 }", "[0.0, 0.0, 0.0, 1.5]", "line 34"),
        ("t = 2.5", "t = 9.0", "order of time"),
    ] {
        assert!(keyframes.contains(from), "{from}");
        fs::write(here.join("bad.toml"), keyframes.replacen(from, to, 1)).unwrap();
        VITRIOL.refuses(here, "track bad.toml -o new.mcap", &["bad.toml:", part]);
        VITRIOL.refuses(here, "replay bad.toml --out new", &[part]);
        let left = ["new", "new.mcap"].map(|name| here.join(name).exists());
        assert_eq!(left, [false; 2], "{to}");
    }

    VITRIOL.object(here, "track two-flasks -o whole.mcap");
    let whole = fs::read(here.join("whole.mcap")).unwrap();
    let mut flipped = whole.clone();
    flipped[whole.len() / 3] ^= 0x10;
    fs::write(here.join("flipped.mcap"), flipped).unwrap();
    fs::write(here.join("cut.mcap"), &whole[..whole.len() / 2]).unwrap();
    VITRIOL.refuses_each(
        here,
        "
replay flipped.mcap --out new => flipped.mcap; intact
replay cut.mcap --out new => cut.mcap: breaks off after 4.; --accept-truncated
replay . --out new => .: is a folder
",
    );
    assert!(!here.join("new").exists());
    // Saved again it can be looked at, and still says that it is not whole.
    let saved = VITRIOL.object(here, "track cut.mcap -o saved.mcap");
    let info = VITRIOL.object(here, "track saved.mcap");
    assert_eq!(info["recovered"], false);
    assert_eq!(info["frames"], saved["frames"]);
    assert_eq!(info["outcome"]["broken_off"], "its file had no end");
}
