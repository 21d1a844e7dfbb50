//! Two scenes side by side in one film, made by the program.

use std::fs;

use crate::VITRIOL;
use serde_json::Value;

/// What cannot be compared is refused before anything is made, with what to do instead.
#[test]
fn what_cannot_be_compared_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    VITRIOL.refuses_each(
        here,
        "
replay two-flasks --compare beaker --out out => comma between them
replay two-flasks --compare beaker,beaker --out out => scenes that differ
replay two-flasks --compare beaker,nowhere --out out => no such file
replay two-flasks dilute --compare beaker,dam-break --out out => one track
replay two-flasks --compare beaker,dam-break --no-video --out out => --no-video
",
    );
    assert!(!here.join("out").exists());
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
        let told = VITRIOL.object(here, &compare);
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
            let alone = VITRIOL.object(here, &alone);
            assert_eq!(both["state_hash"], alone["state_hash"], "{order}");
        }

        VITRIOL.refuses(here, &compare, &["compare.mp4", "not overwritten"]);
    }
}
