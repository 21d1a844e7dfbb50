//! Each number of a scene arrives where it belongs.

use super::super::bubbles::Bubbles;
use super::super::eddies::Mixing;
use super::super::paper::Boiling;
use super::super::transport::Losses;
use super::super::{Chemistry, Paper, PaperBoiling, PaperDilution, Physical};
use crate::scene::{Feature, Scene};

#[test]
fn table_1_arrives() {
    let of = |name: &str| Chemistry::from_scene(&Scene::builtin(name).unwrap());
    let boiling = PaperBoiling {
        boiling_point: 100.0,
        intensity: 1.0,
        law: Boiling::Power,
    };
    let dilution = PaperDilution {
        ambient: 20.0,
        heat_diffusivity: 0.01,
        acid_diffusivity: 0.007,
        heat_generation: 0.017,
    };
    let expected = Paper {
        dilution: Some(dilution),
        boiling: Some(boiling),
    };
    assert_eq!(of("single-dilution"), Some(Chemistry::Paper(expected)));
    let Some(Chemistry::Paper(soup)) = of("tomato-soup") else {
        panic!("has the paper's chemistry")
    };
    assert!(soup.dilution.is_none() && soup.boiling.is_some());
    assert_eq!(of("beaker"), None);
}

#[test]
fn the_physical_chemistrys_numbers_arrive() {
    let mut scene = Scene::builtin("water-into-acid").unwrap();
    let physical = scene.physical.as_mut().unwrap();
    // No two alike.
    physical.ambient = Some(1.0);
    physical.mixing = Some(2.0);
    physical.eddy_width = Some(0.004);
    physical.superheat_time = Some(4.0);
    physical.glass_loss = Some(7.0);
    physical.surface_loss = Some(8.0);
    physical.lamella = Some(9.0);
    physical.nuclei_spacing = Some(10.0);
    physical.foam_time = Some(11.0);
    physical.most_bubbles = Some(12);
    (
        scene.liquids[0].acid_fraction,
        scene.liquids[1].acid_fraction,
    ) = (0.5, 0.92);
    let bubbles = Bubbles {
        nuclei_spacing: 10.0,
        foam_time: Some(11.0),
        most: 12,
        spray: true,
        air: true,
    };
    let all = Physical {
        bubbles: Some(bubbles),
        mixing: Mixing {
            turbulence: 2.0,
            width: 0.004,
        },
        feed: 0.92,
        density: true,
        viscosity: true,
        superheat_time: Some(4.0),
        lamella: Some(9.0),
        losses: Some(Losses {
            ambient: 1.0,
            glass: 7.0,
            surface: 8.0,
        }),
    };
    let of = |scene: &Scene| match Chemistry::from_scene(scene) {
        Some(Chemistry::Physical(physical)) => physical,
        other => panic!("has the physical chemistry, not {other:?}"),
    };
    assert_eq!(of(&scene), all);
    // Features that a scene does not model are off, and nothing else.
    type Off = fn(&mut Physical);
    let features: [(Feature, Off); 8] = [
        (Feature::Segregation, |law| law.lamella = None),
        (Feature::Density, |law| law.density = false),
        (Feature::Viscosity, |law| law.viscosity = false),
        (Feature::Evaporation, |law| law.superheat_time = None),
        (Feature::Losses, |law| law.losses = None),
        (Feature::Bubbles, |law| law.bubbles = None),
        (Feature::Spray, |law| {
            law.bubbles.as_mut().unwrap().spray = false;
        }),
        (Feature::Air, |law| {
            law.bubbles.as_mut().unwrap().air = false;
        }),
    ];
    for (feature, off) in features {
        let mut without = scene.clone();
        without.model.retain(|modelled| *modelled != feature);
        let mut expected = all;
        off(&mut expected);
        assert_eq!(of(&without), expected, "{feature:?}");
    }
}

/// Lamellae have the acid of the scene's strongest liquid, in whatever order they are; water has some, as its share is divided by.
#[test]
fn the_strongest_liquid_feeds_the_lamellae() {
    let mut scene = Scene::builtin("water-into-acid").unwrap();
    for (acids, expected) in [
        ([0.5, 0.92], 0.92),
        ([0.98, 0.0], 0.98),
        ([0.0, 1.0], 1.0),
        ([0.0, 0.0], 0.05),
    ] {
        for (liquid, acid) in scene.liquids.iter_mut().zip(acids) {
            liquid.acid_fraction = acid;
        }
        let Some(Chemistry::Physical(physical)) = Chemistry::from_scene(&scene) else {
            panic!("has the physical chemistry")
        };
        assert_eq!(physical.feed, expected, "{acids:?}");
    }
}
