//! Two scenes side by side in one film, made by the program.

use std::fs;

use crate::VITRIOL;
use serde_json::Value;
use vitriol_tests::program::words;

/// What cannot be compared is refused before anything is made, with what to do instead.
#[test]
fn what_cannot_be_compared_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let refused = [
        ("two-flasks --compare beaker", "comma between them"),
        ("two-flasks --compare beaker,beaker", "scenes that differ"),
        ("two-flasks --compare beaker,nowhere", "no such file"),
        ("two-flasks dilute --compare beaker,dam-break", "one track"),
        (
            "two-flasks --compare beaker,dam-break --no-video",
            "--no-video",
        ),
    ];
    for (line, part) in refused {
        let line = format!("replay {line} --out out");
        let output = VITRIOL.run(here, &words(&line));
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}: {said}");
        assert!(said.contains(part), "{line}: {said}");
        assert!(!here.join("out").exists(), "{line}");
    }
}

mod long {
    use super::*;

    const ORDERS: [&str; 2] = ["acid-into-water", "water-into-acid"];
    /// A fifth of a second, six frames of a film, before anything is poured.
    const SHORT: &str = "--preset fast --seconds 0.2";

    /// Film, picture and numbers are there; both runs are what they are without the other.
    #[test]
    fn both_orders_are_side_by_side() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path();
        let compare = format!(
            "replay two-flasks --compare {} {SHORT} --out both",
            ORDERS.join(",")
        );
        let told: Value = serde_json::from_str(&VITRIOL.json(here, &words(&compare))).unwrap();
        let kept = fs::read(here.join("both/compare.json")).unwrap();
        let kept: Value = serde_json::from_slice(&kept).unwrap();
        assert_eq!(kept["scenes"], told["scenes"]);
        assert_eq!(told["film_frames"], 6);
        assert_eq!(
            told["cuts"],
            serde_json::json!([{ "film_s": 0.0, "t_s": 0.0 }])
        );
        assert!(fs::metadata(here.join("both/compare.mp4")).unwrap().len() > 1000);

        let picture = fs::read(here.join("both/compare.gif")).unwrap();
        let mut decoder = gif::DecodeOptions::new().read_info(&picture[..]).unwrap();
        let mut frames = 0;
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            assert_eq!((frame.width, frame.height, frame.delay), (480, 270, 10));
            frames += 1;
        }
        // Each third of the film's six.
        assert_eq!(frames, 2);

        let scenes = told["scenes"].as_array().unwrap();
        assert_eq!(scenes.len(), 2);
        for (order, both) in ORDERS.iter().zip(scenes) {
            assert_eq!(both["scene"], *order);
            assert_eq!(both["thrown_kg"], 0.0);
            assert!(both["hottest_c"].as_f64().unwrap() > 10.0, "{both}");
            let alone =
                format!("replay two-flasks --scene {order} {SHORT} --no-video --out {order}");
            let alone = VITRIOL.json(here, &words(&alone));
            let alone: Value = serde_json::from_str(&alone).unwrap();
            assert_eq!(both["state_hash"], alone["state_hash"], "{order}");
        }

        let again = VITRIOL.run(here, &words(&compare));
        assert_eq!(again.status.code(), Some(2));
        let said = String::from_utf8_lossy(&again.stderr);
        assert!(
            said.contains("compare.mp4") && said.contains("not overwritten"),
            "{said}"
        );
    }
}
