//! The passes of each built-in scene, and what a scene without chemistry does
//! not have.

use super::setup::*;
use crate::common::*;
use crate::passes::{PASSES, bindings, passes};
use vitriol_sim::chemistry::Chemistry;
use vitriol_sim::chemistry::bubbles::Bubbles;
use vitriol_sim::chemistry::paper::Boiling;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::Particle;
use vitriol_sim::surface_tension::SurfaceTension;
use vitriol_sim::world::ground;
use vitriol_tests::gpu;

/// A scene as a world has it, with a few of its particles.
fn setup(scene: &Scene) -> Setup {
    let start = scene.start(Some(1)).unwrap();
    let particles = start.iter().step_by(start.len() / 60).map(|p| Particle {
        position: p.position,
        velocity: glam::DVec3::ZERO,
        flask: Some(p.flask),
        temperature: p.temperature,
        acid: p.acid_fraction,
        carried: 0.0,
    });
    let profiles = scene.flasks.iter().map(|f| f.profile.clone()).collect();
    Setup {
        ground: ground(scene),
        loads: scene.flasks.iter().any(|flask| !flask.fixed),
        ..Setup::new(Parameters::from_scene(scene), profiles, particles.collect())
    }
}

/// Labels of a frame's passes, in their order; `line_26` is the chemistry's.
fn expected(p: &Parameters, loads: bool, line_26: &[&'static str]) -> Vec<String> {
    let sleeps = p.sleep && p.heaters.iter().all(|&watts| watts == 0.0);
    let mut all = Vec::from_iter(sleeps.then_some("sleep"));
    all.push("predict");
    let bubbles = match &p.chemistry {
        Some(Chemistry::Physical(physical)) => physical.bubbles,
        _ => None,
    };
    let of_surface =
        |s: &SurfaceTension| s.impulses(p.particle_mass(), p.substeps, p.substep_time());
    let impulses = p.surface.as_ref().map(of_surface).unwrap_or_default();
    for n in 0..p.substeps {
        all.extend(["cell_count", "cell_scan", "reorder", "list"]);
        all.extend(bubbles.map(|_| "cavity"));
        // Carried multipliers displace first.
        all.extend((p.carry_rate > 0.0).then_some("displacement"));
        all.extend(["multiplier", "displacement"].repeat(p.iterations as usize));
        if impulses.iter().any(|&(first, _)| first == n) {
            // Its table is cleared.
            all.extend(["fill", "upload", "colour", "colour_rim", "colour_walls"]);
            all.extend(["smooth_colour", "interface", "unfiltered_curvature"]);
            all.extend(["curvature", "tension"]);
        }
        all.extend(line_26);
        all.extend((p.vorticity > 0.0).then_some("vorticity"));
        all.push("forces");
        if let Some(bubbles) = bubbles
            && Bubbles::step_after(n, p.substeps).is_some()
        {
            all.extend(["live", "bubbles"]);
            all.extend(bubbles.spray.then_some("spray"));
        }
    }
    if let Some(Chemistry::Physical(physical)) = &p.chemistry {
        let (smoothing, _) = physical.mixing.smoothing(p.support_radius);
        all.extend(["smooth"].repeat(smoothing as usize));
        all.push("strain");
    }
    all.extend(sleeps.then_some("calm"));
    if let Some(Chemistry::Physical(physical)) = &p.chemistry {
        all.extend(physical.losses.map(|_| "glass"));
        all.extend(physical.losses.and(bubbles).map(|_| "dew"));
        all.extend(bubbles.iter().flat_map(|_| ["rise", "vent"]));
    }
    all.extend(loads.then_some("load"));
    let passes = all.iter().map(|&name| match name {
        "fill" | "upload" => name.to_owned(),
        pass => format!("sim/{pass}:main"),
    });
    // The poses go first; the loads, and what sleeps and where, come back; and a frame has its sum.
    let mut all = vec!["upload".to_owned()];
    all.extend(passes);
    let copies = usize::from(loads) + 2 * usize::from(sleeps);
    all.extend(vec!["copy".to_owned(); copies]);
    all.push("total".to_owned());
    all
}

#[test]
fn each_scene_has_its_passes_and_no_other() {
    let of_scenes = [
        ("beaker", &[][..]),
        ("two-flasks", &[]),
        ("moving-flask", &[]),
        ("three-flasks", &[]),
        ("single-dilution", &["diffusion"]),
        ("triple-dilution", &["diffusion"]),
        ("vr-dilution", &["diffusion"]),
        // Boils, and has no acid: what boils is found in the same pass.
        ("tomato-soup", &["diffusion"]),
        ("water-into-acid", &["turnover", "exchange"]),
        ("acid-into-water", &["turnover", "exchange"]),
        ("hot-acid", &["turnover", "exchange"]),
        ("hot-acid-85", &["turnover", "exchange"]),
        ("layer-and-swirl", &["turnover", "exchange"]),
        ("layer-and-swirl-right", &["turnover", "exchange"]),
        ("rinse-the-bottle", &["turnover", "exchange"]),
        ("boiling-water", &["turnover", "exchange"]),
        ("fume-hood", &["turnover", "exchange"]),
        ("acid-on-glove", &["turnover", "exchange"]),
    ];
    let mut names = of_scenes.map(|(name, _)| name);
    let mut known = Scene::builtin_names();
    names.sort_unstable();
    known.sort_unstable();
    assert_eq!(known, names);
    for (name, line_26) in of_scenes {
        let scene = Scene::builtin(name).unwrap();
        let setup = setup(&scene);
        let poses: Vec<_> = scene.flasks.iter().map(|f| f.stage_from_flask).collect();
        let own = passes(&setup, &poses);
        let expected = expected(&setup.parameters, setup.loads, line_26);
        assert_eq!(own, expected, "{name}");
    }
}

/// Water and water: with the chemistry off there is no heat anywhere.
#[test]
fn water_and_water_have_no_heat() {
    let device = gpu::device();
    let mut scene = Scene::builtin("water-into-acid").unwrap();
    scene.model.clear();
    scene.physical = None;
    for liquid in &mut scene.liquids {
        liquid.acid_fraction = 0.0;
    }
    let bare = setup(&scene);
    let poses: Vec<_> = scene.flasks.iter().map(|f| f.stage_from_flask).collect();
    let own = passes(&bare, &poses);
    assert_eq!(own, expected(&bare.parameters, bare.loads, &[]));
    let solver = bare.solver(&device);
    assert!(solver.heat().is_none());
    let state = solver.snapshot().unwrap();
    assert!(state.heat.is_empty() && state.matter.is_empty() && state.ledger.is_empty());
}

/// No pass binds buffers of features that its scene does not have.
#[test]
fn passes_bind_the_chemistry_of_their_scene() {
    let of_any = ["heat", "sorted_heat", "mixing"];
    let of_paper = ["diffused"];
    let of_physical = ["matter", "sorted_matter", "bulk", "sorted_bulk", "solution"];
    let all = [&of_any[..], &of_paper, &of_physical].concat();
    let mut seen: Vec<String> = Vec::new();
    for shader in PASSES {
        let last = [("COMMIT", 1.0), ("LOADS", 1.0), ("FLASKS", 1.0)];
        let mut bound = |own: &[(&str, f64)]| {
            let bound = bindings(shader, &[&last[..], own].concat());
            let bound: Vec<_> = bound.into_iter().filter(|n| all.contains(&&**n)).collect();
            seen.extend(bound.clone());
            bound
        };
        let none = bound(&[]);
        assert!(none.is_empty(), "{shader}: {none:?}");
        let heat = bound(&[("HEAT", 1.0), ("DILUTION", 1.0), ("BOILING", 1.0)]);
        let others = heat.iter().find(|name| of_physical.contains(&&***name));
        assert_eq!(others, None, "{shader}");
        let physical = bound(&[("HEAT", 1.0), ("PHYSICAL", 1.0), ("DENSITY", 1.0)]);
        let others = physical.iter().find(|name| of_paper.contains(&&***name));
        assert_eq!(others, None, "{shader}");
    }
    // Names that are in none would have proved nothing.
    for name in all {
        assert!(seen.iter().any(|n| n == name), "{name}");
    }
}

/// Bytes a particle: the buffers of each chemistry, and none of the other's.
#[test]
fn chemistry_costs_memory_where_it_is_asked_for() {
    let device = gpu::device();
    // Whole blocks of the list, of 32 particles.
    let particles = glass_of(416, |_| (20.0, 0.0));
    let bytes = |chemistry: Option<Chemistry>| {
        let p = with(chemistry, parameters());
        let setup = Setup::new(p, vec![narrow_glass()], particles.clone());
        setup.solver(&device).bytes_per_particle() as i64
    };
    let none = bytes(None);
    let boils = anti_viscosity(Boiling::Power);
    // Heat, its sorted copy and line 26's results of four floats; T and c
    // after diffusion.
    let own = bytes(Some(paper(Some(dilution()), Some(boils))));
    assert_eq!(own - none, 3 * 16 + 8);
    // In their place matter, bulk and eddies with copies, ledger, and what a particle may keep of its exchange.
    let own = bytes(Some(Chemistry::Physical(mixing_alone())));
    assert_eq!(own - none, 3 * 16 + 5 * 16 + 2 * 8 + 4);
    // Room for 16 more neighbours where the liquid contracts.
    let dense = bytes(Some(Chemistry::Physical(boiling())));
    assert_eq!(dense - own, 16 * 4);
}
