//! An attempt with one incident of each kind and each cause.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;

use vitriol_lesson::{Attempt, Content, Ending, Hottest, Incident, Pour};

/// What went wrong, as in a recording.
const WHATS: &str = r#"
{"kind":"water-into-acid","flask":"beaker","met_acid":0.96,"volume_m3":2.5e-5}
{"kind":"poured-too-fast","flask":"beaker","rate_m3_s":4e-5,"limit_m3_s":1e-5}
{"kind":"boiled-over","flask":"beaker","volume_m3":3e-6,"acid":0.61}
{"kind":"hot","flask":"beaker","temperature_c":131.0}
{"kind":"spilt","surface":"bench","volume_m3":1e-6,"acid":0.3}
{"kind":"on-skin","skin":"left-hand","volume_m3":5e-8,"acid":0.61,"temperature_c":null,"protected":true}
{"kind":"dropped","flask":"flask","speed_m_s":2.25,"broke":true}
"#;

/// The cause of each.
const CAUSES: &str = r#"
{"cause":"pouring","from":"flask"}
{"cause":"mixing","flask":"beaker"}
{"cause":"boiling","flask":"beaker"}
{"cause":"unknown"}
{"cause":"splashing","flask":"beaker"}
{"cause":"breaking","flask":"flask"}
{"cause":"letting-go","flask":"flask"}
"#;

/// Incidents of each kind, and of each cause.
pub fn incidents() -> Vec<Incident> {
    let whats = WHATS.trim().lines();
    let whats = whats.map(|it| serde_json::from_str(it).unwrap());
    let causes = CAUSES.trim().lines();
    let causes = causes.map(|it| serde_json::from_str(it).unwrap());
    let both = whats.zip(causes).enumerate();
    both.map(|(i, (what, cause))| Incident {
        t_s: 3.0 + i as f64,
        until_s: 3.125 + 1.5 * i as f64,
        what,
        cause,
        place_m: [0.1, 0.9, -0.25],
    })
    .collect()
}

/// An attempt from 2 s to 14.5 s of its run.
pub fn attempt() -> Attempt {
    let acid = Content {
        volume_m3: 1e-4,
        acid: 0.96,
        temperature_c: Some(20.0),
    };
    let contents = BTreeMap::from([("beaker".to_owned(), acid)]);
    Attempt {
        begun_s: 2.0,
        scene: "water-into-acid".into(),
        contents: contents.clone(),
        glass: BTreeMap::new(),
        pours: vec![Pour {
            t_s: 3.0,
            until_s: 4.5,
            from: "flask".into(),
            into: Some("beaker".into()),
            volume_m3: 2.5e-5,
            fastest_m3_s: 4e-5,
            acid: 0.0,
            met: Some(acid),
            bare_face: false,
        }],
        incidents: incidents(),
        ending: Some(Ending {
            t_s: 14.5,
            contents,
            hottest: Some(Hottest {
                t_s: 6.5,
                flask: Some("beaker".into()),
                temperature_c: 131.0,
            }),
            bench_m3: 1e-6,
            floor_m3: 0.0,
        }),
    }
}
