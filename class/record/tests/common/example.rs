//! An attempt with one incident of each kind and each cause.

use std::collections::BTreeMap;

use vitriol_lesson::{
    Attempt, Cause, Content, Ending, Hottest, Incident, Pour, Skin, Surface, What,
};

/// Incidents of each kind, and of each cause.
pub fn incidents() -> Vec<Incident> {
    let [beaker, flask] = ["beaker", "flask"].map(String::from);
    let whats = [
        What::WaterIntoAcid {
            flask: beaker.clone(),
            met_acid: 0.96,
            volume_m3: 2.5e-5,
        },
        What::PouredTooFast {
            flask: beaker.clone(),
            rate_m3_s: 4e-5,
            limit_m3_s: 1e-5,
        },
        What::BoiledOver {
            flask: beaker.clone(),
            volume_m3: 3e-6,
            acid: 0.61,
        },
        What::Hot {
            flask: beaker.clone(),
            temperature_c: 131.0,
        },
        What::Spilt {
            surface: Surface::Bench,
            volume_m3: 1e-6,
            acid: 0.3,
        },
        What::OnSkin {
            skin: Skin::LeftHand,
            volume_m3: 5e-8,
            acid: 0.61,
            temperature_c: None,
            protected: true,
        },
        What::Dropped {
            flask: flask.clone(),
            speed_m_s: 2.25,
            broke: true,
        },
    ];
    let causes = [
        Cause::Pouring {
            from: flask.clone(),
        },
        Cause::Mixing {
            flask: beaker.clone(),
        },
        Cause::Boiling {
            flask: beaker.clone(),
        },
        Cause::Unknown,
        Cause::Splashing { flask: beaker },
        Cause::Breaking {
            flask: flask.clone(),
        },
        Cause::LettingGo { flask },
    ];
    let both = whats.into_iter().zip(causes).enumerate();
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
