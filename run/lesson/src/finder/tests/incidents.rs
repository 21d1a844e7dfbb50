//! Incidents.

use super::*;

const BROKEN: Break = Break {
    flask: 0,
    stage_from_flask: Pose::IDENTITY,
};

/// A spill has its volume, surface and place, and as its cause what was under way at the flask that it came from.
#[test]
fn a_spill_has_a_cause() {
    type Arrange = (f32, bool, bool, Cause);
    let flask = || "source".to_owned();
    let cases: [Arrange; 4] = [
        (80.0, true, false, Cause::Pouring { from: flask() }),
        (80.0, false, false, Cause::LettingGo { flask: flask() }),
        (5.0, true, true, Cause::Boiling { flask: flask() }),
        (5.0, true, false, Cause::Splashing { flask: flask() }),
    ];
    for (degrees, in_hand, bubbles, cause) in cases {
        let mut arranged = Arranged::new([0.98, 0.0]);
        arranged.tilt(0, degrees);
        arranged.hands[0] = in_hand;
        if bubbles {
            arranged.bubbles(0);
            arranged.held[0].hottest = Some(104.0);
        }
        arranged.looks(10, &|mut census| {
            census.floor.came.position = DVec3::new(0.1, 0.0, 0.2);
            let moved = moved(BIT, 0.9);
            census
                .with_moved(Place::Air, 0, moved)
                .with_moved(Place::Floor, 0, moved)
        });
        let (_, incidents) = arranged.end();
        let spill = incidents
            .iter()
            .find(|it| matches!(it.what, What::Spilt { .. }));
        let spill = spill.unwrap();
        let What::Spilt {
            surface,
            volume_m3,
            acid,
        } = spill.what
        else {
            panic!("{spill:?}");
        };
        assert_eq!((surface, &spill.cause), (Surface::Floor, &cause));
        assert!(near(volume_m3, 10.0 * BIT) && near(acid, 0.9), "{spill:?}");
        let origin = arranged.finder.bench.origin;
        let expected = (DVec3::new(0.1, 0.0, 0.2) + origin).to_array();
        assert!(
            spill.place_m.iter().zip(expected).all(|(a, b)| near(*a, b)),
            "{spill:?}"
        );
        let boiled = incidents
            .iter()
            .filter(|it| matches!(it.what, What::BoiledOver { .. }));
        assert_eq!(boiled.count(), usize::from(bubbles), "{incidents:?}");
    }
    // One drop is no spill, two are one.
    for (bits, said) in [(2.4, 0), (2.6, 1)] {
        let mut arranged = Arranged::new([0.98, 0.0]);
        arranged.pours(1, bits * BIT, 0.9, Place::Table);
        assert_eq!(arranged.end().1.len(), said);
    }
}

/// Drops of bubbles are not particles: what sprays out of a flask as it boils is thrown out, because of what was poured in.
#[test]
fn what_sprays_out_boils_over() {
    let mut arranged = Arranged::new([0.0, 0.98]);
    arranged.tilt(0, 80.0);
    arranged.pours(20, BIT, 0.0, Place::Flask(1));
    // Bubbles of air throw drops as well, which is no boiling over.
    arranged.bubbles(1);
    arranged.sprayed[1] += 1e-6;
    arranged.looks(20, &|census| census);
    arranged.held[1].hottest = Some(140.0);
    for _ in 0..10 {
        arranged.sprayed[1] += 0.01e-6;
        arranged.looks(20, &|census| census);
    }
    let (_, incidents) = arranged.end();
    let thrown = incidents.iter().find_map(|it| match &it.what {
        What::BoiledOver {
            flask, volume_m3, ..
        } => Some((flask.as_str(), *volume_m3, it)),
        _ => None,
    });
    let (flask, volume, incident) = thrown.unwrap();
    assert!(flask == "target" && near(volume, 0.1e-6), "{incident:?}");
    let flask = "target".into();
    assert_eq!(incident.cause, Cause::Mixing { flask });
    // The incident is at the rim.
    let rim = arranged.finder.bench.rim(&arranged.poses[1], 1) + arranged.finder.bench.origin;
    assert!(
        incident
            .place_m
            .iter()
            .zip(rim.to_array())
            .all(|(a, b)| (a - b).abs() < 1e-6)
    );
}

/// Liquid that scalds counts from a fifth of a drop on, other liquid by its acid: 0.13 mL of 10 % acid at 50 °C, which a correct pour
/// throws up, have less than a drop of battery acid, 0.05 mL of 37 %.
#[test]
fn drops_boil_over_where_they_harm() {
    for (acid, celsius, thrown, said) in [
        (0.10, 50.0, 0.13e-6, false),
        (0.18, 50.0, 0.13e-6, true),
        (0.9, 20.0, 0.019e-6, false),
        (0.9, 20.0, 0.022e-6, true),
        (0.0, 54.0, 1e-6, false),
        (0.0, 56.0, 0.009e-6, false),
        (0.0, 56.0, 0.011e-6, true),
        (0.9, 140.0, 0.011e-6, true),
    ] {
        let mut arranged = Arranged::new([0.0, acid]);
        arranged.held[1].temperature = Some(celsius);
        // One particle boils.
        arranged.held[1].hottest = Some(140.0);
        arranged.bubbles(1);
        arranged.looks(20, &|census| census);
        for _ in 0..10 {
            arranged.sprayed[1] += 0.1 * thrown;
            arranged.looks(20, &|census| census);
        }
        let (_, incidents) = arranged.end();
        let over = |it: &Incident| matches!(it.what, What::BoiledOver { .. });
        let found = incidents.iter().any(over);
        assert_eq!(found, said, "{acid} {celsius} {thrown}: {incidents:?}");
    }
}

/// Layers of acid and water that a hand moves until they boil over, or moved just before, were mixed by that; on the bench they mix all
/// the same. Where a scene has no layers and nothing was poured, the cause is not known.
#[test]
fn layers_boil_over_because_they_were_moved() {
    let flask = || "source".to_owned();
    let swirling = || Cause::Swirling { flask: flask() };
    for (scene, in_hand, cause) in [
        ("layer-and-swirl", [true, true], swirling()),
        ("layer-and-swirl", [true, false], swirling()),
        (
            "layer-and-swirl",
            [false, false],
            Cause::Mixing { flask: flask() },
        ),
        ("water-into-acid", [true, true], Cause::Unknown),
    ] {
        let mut arranged = Arranged::new([0.82, 0.0]);
        let file = Scene::builtin(scene).unwrap();
        arranged.finder = Finder::new(scene, &file, Limits::default());
        arranged.held[0].hottest = Some(140.0);
        arranged.bubbles(0);
        for held in in_hand {
            arranged.hands[0] = held;
            arranged.looks(20, &|census| census);
        }
        for _ in 0..10 {
            arranged.sprayed[0] += 0.1e-6;
            arranged.looks(20, &|census| census);
        }
        let (_, incidents) = arranged.end();
        let over = |it: &&Incident| matches!(it.what, What::BoiledOver { .. });
        let over = incidents.iter().find(over).unwrap();
        assert_eq!(over.cause, cause, "{scene} {in_hand:?}");
    }
}

/// Gloves and goggles protect as long as they are worn; after one bare touch the skin counts as touched.
#[test]
fn a_glove_protects_while_it_is_on() {
    let on = |goggles: Option<bool>, gloves: Option<[bool; 2]>| Worn { goggles, gloves };
    let never = Worn::default();
    let all = on(Some(true), Some([true; 2]));
    let bare = on(Some(false), Some([true, false]));
    for (first, then, protected) in [
        (never, never, [true, true, true]),
        (all, all, [true, true, true]),
        (bare, bare, [true, false, false]),
        (all, bare, [true, false, false]),
        (bare, all, [true, false, false]),
    ] {
        let mut arranged = Arranged::new([0.98, 0.0]);
        for worn in [first, then] {
            arranged.worn = worn;
            arranged.looks(5, &|mut census| {
                for touching in &mut census.skin {
                    touching.came = Came {
                        particles: 1,
                        volume: BIT,
                        acid: 0.98,
                        ..Came::default()
                    };
                }
                census
            });
        }
        let (_, incidents) = arranged.end();
        let found = [Skin::LeftHand, Skin::RightHand, Skin::Face].map(|part| {
            let mut found = incidents.iter().filter_map(|it| match it.what {
                What::OnSkin {
                    skin, protected, ..
                } if skin == part => Some(protected),
                _ => None,
            });
            found.next().unwrap()
        });
        assert_eq!(found, protected, "{first:?}, {then:?}");
    }
}

/// Acid on a hand and hot water in the face: which part, how much, how hot, and from which flask; however little it is.
#[test]
fn what_comes_to_somebody() {
    let mut arranged = Arranged::new([0.98, 0.0]);
    arranged.tilt(0, 80.0);
    arranged.looks(10, &|mut census| {
        let came = |acid: f64, temperature: f64, volume: f64| Touching {
            particles: 1,
            came: Came {
                particles: 1,
                volume,
                speed: 1.0,
                position: DVec3::new(0.0, 0.8, 0.1),
                acid,
                temperature: Some(temperature),
            },
            rinsed: 0.0,
        };
        census.skin[0] = came(0.98, 30.0, BIT);
        census.skin[2] = came(0.0, 90.0, 0.01 * BIT);
        let moved = moved(BIT, 0.98);
        census
            .with_moved(Place::Air, 0, moved)
            .with_moved(Place::Skin(Part::Left), 0, moved)
    });
    let (_, incidents) = arranged.end();
    let touched = incidents.iter().filter_map(|it| match &it.what {
        What::OnSkin {
            skin,
            volume_m3,
            acid,
            temperature_c,
            ..
        } => Some((
            *skin,
            *volume_m3,
            *acid,
            temperature_c.unwrap(),
            it.cause.clone(),
        )),
        _ => None,
    });
    let touched: Vec<_> = touched.collect();
    let [
        (hand, volume, acid, warm, from),
        (face, little, _, hot, unknown),
    ] = &touched[..]
    else {
        panic!("{touched:?}");
    };
    assert_eq!((*hand, *face), (Skin::LeftHand, Skin::Face));
    assert!(
        near(*volume, 10.0 * BIT) && near(*little, 0.1 * BIT),
        "{touched:?}"
    );
    assert!(
        near(*acid, 0.98) && near(*warm, 30.0) && near(*hot, 90.0),
        "{touched:?}"
    );
    let source = "source".into();
    assert_eq!(*from, Cause::Pouring { from: source });
    assert_eq!(*unknown, Cause::Unknown);
}

/// An incident begins at the limit and ends only where the liquid has cooled well below; the hottest particle of all, and when.
#[test]
fn heat_is_one_incident_until_it_has_cooled() {
    let mut arranged = Arranged::new([0.98, 0.0]);
    for (temperature, looks) in [
        (59.0, 10),
        (65.0, 10),
        (59.0, 10),
        (75.0, 10),
        (45.0, 10),
        (61.0, 5),
    ] {
        arranged.held[1].temperature = Some(temperature);
        arranged.held[1].hottest = Some(temperature + 5.0);
        arranged.looks(looks, &|census| census);
    }
    let (_, incidents) = arranged.end();
    let hot = incidents.iter().map(|it| match it.what {
        What::Hot { temperature_c, .. } => (it.t_s, temperature_c),
        _ => panic!("{it:?}"),
    });
    let hot: Vec<_> = hot.collect();
    let [(first, most), (second, later)] = hot[..] else {
        panic!("{hot:?}");
    };
    // The first observation is at 0.01 s.
    assert!(near(first, 0.12) && near(most, 75.0), "{hot:?}");
    assert!(near(second, 0.52) && near(later, 61.0), "{hot:?}");
    let Some(Event::Ended(ending)) = arranged.said.last() else {
        panic!("{:?}", arranged.said);
    };
    let hottest = ending.hottest.as_ref().unwrap();
    assert_eq!(
        (hottest.flask.as_deref(), hottest.temperature_c),
        (Some("target"), 80.0)
    );
    assert!(near(hottest.t_s, 0.32), "{hottest:?}");
}

/// A flask that falls out of a hand is one incident with its bounces and its break; a knock by a hand, or of glass on glass, is none.
#[test]
fn glass_that_is_dropped() {
    let blow = |speed: f32, other: Option<usize>| Strike {
        flask: 0,
        other,
        impulse: 0.1,
        speed,
        position: Vec3::new(0.0, 0.0, 0.3),
    };
    let mut arranged = Arranged::new([0.98, 0.0]);
    let none = |census: Census| census;
    arranged.looks_with(5, (&[blow(2.0, None)], &[]), &none);
    arranged.hands[0] = false;
    arranged.looks_with(40, (&[blow(2.0, Some(1))], &[]), &none);
    arranged.looks_with(1, (&[blow(3.5, None)], &[]), &none);
    arranged.looks_with(20, (&[blow(1.5, None)], &[BROKEN]), &none);
    arranged.looks_with(1, (&[blow(0.5, None)], &[]), &none);
    let (_, incidents) = arranged.end();
    let [incident] = &incidents[..] else {
        panic!("{incidents:?}");
    };
    let What::Dropped {
        flask,
        speed_m_s,
        broke,
    } = &incident.what
    else {
        panic!("{incident:?}");
    };
    assert_eq!((flask.as_str(), *speed_m_s, *broke), ("source", 3.5, true));
    let flask = "source".into();
    assert_eq!(incident.cause, Cause::LettingGo { flask });
    assert!(near(incident.t_s, 0.47), "{incident:?}");
}

/// A flask that falls from the bench strikes twice and is one incident, with the hardest impact; one that is knocked in a hand and breaks
/// was not let go of.
#[test]
fn a_fall_is_one_and_a_knock_is_none() {
    let blow = |speed: f32| Strike {
        flask: 0,
        other: None,
        impulse: 0.1,
        speed,
        position: Vec3::ZERO,
    };
    let none = |census: Census| census;
    let what = |incidents: &[Incident]| match &incidents[0].what {
        What::Dropped {
            speed_m_s, broke, ..
        } => (*speed_m_s, *broke, incidents[0].cause.clone()),
        other => panic!("{other:?}"),
    };
    let mut arranged = Arranged::new([0.98, 0.0]);
    arranged.hands[0] = false;
    arranged.looks_with(40, (&[blow(1.5)], &[]), &none);
    arranged.looks_with(1, (&[blow(4.0)], &[]), &none);
    arranged.looks_with(1, (&[], &[BROKEN]), &none);
    let (_, incidents) = arranged.end();
    assert_eq!(incidents.len(), 1, "{incidents:?}");
    let flask = "source".to_owned();
    assert_eq!(what(&incidents), (4.0, true, Cause::LettingGo { flask }));

    let mut arranged = Arranged::new([0.98, 0.0]);
    arranged.looks_with(1, (&[blow(3.5)], &[]), &none);
    arranged.hands[0] = false;
    arranged.looks_with(1, (&[], &[BROKEN]), &none);
    let (_, incidents) = arranged.end();
    assert_eq!(incidents.len(), 1, "{incidents:?}");
    assert_eq!(what(&incidents), (3.5, true, Cause::Unknown));
}

/// Drops that fall a pause apart are one spill, and the liquid that a scene begins with is nobody's spill.
#[test]
fn a_drip_is_a_spill_and_a_hot_start_is_nobodys() {
    let mut arranged = Arranged::new([0.98, 0.0]);
    arranged.held[1].temperature = Some(100.0);
    arranged.finder = Finder::new(
        "hot",
        &Scene::builtin("water-into-acid").unwrap(),
        Limits::default(),
    );
    for _ in 0..3 {
        arranged.pours(1, BIT, 0.9, Place::Table);
        arranged.looks(150, &|census| census);
    }
    let (_, incidents) = arranged.end();
    let [spill] = &incidents[..] else {
        panic!("{incidents:?}");
    };
    let What::Spilt { volume_m3, .. } = spill.what else {
        panic!("{spill:?}");
    };
    assert!(near(volume_m3, 3.0 * BIT), "{spill:?}");
}

/// A scene at a twentieth of the real size gives the events of a real one.
#[test]
fn sizes_are_real() {
    let mut scene = Scene::builtin("water-into-acid").unwrap();
    scene.scale.length_scale = 0.05;
    scene.origin = DVec3::new(1.0, 2.0, 3.0);
    let bench = Bench::of(&scene, Limits::default());
    assert!(near(bench.volume(8000e-6), 1e-6));
    // A fall of 15 m of the scene is one of 0.75 m: √(2 g h) of each.
    let [scene_m, real] = [15.0, 0.75].map(|height: f64| (2.0 * 9.81 * height).sqrt());
    scene.scale.gravity = 9.81;
    assert!(near(
        Bench::of(&scene, Limits::default()).speed(scene_m),
        real
    ));
    let expected = (0.05 * (DVec3::ONE + scene.origin)).to_array();
    assert!(
        bench
            .place(DVec3::ONE)
            .iter()
            .zip(expected)
            .all(|(a, b)| near(*a, b))
    );
}
