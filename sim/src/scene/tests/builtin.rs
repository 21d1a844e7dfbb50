//! The scenes that come with the program.

use crate::scene::{Preset, Scene};

#[test]
fn every_builtin_loads_and_states_its_scale() {
    for name in Scene::builtin_names() {
        let scene = Scene::builtin(name).unwrap();
        assert_eq!(scene.name, name);
        for preset in [Preset::Fast, Preset::Balanced, Preset::Reference] {
            assert!(scene.presets.contains_key(&preset), "{name} {preset:?}");
            let changed = scene.with_preset(preset);
            let count: usize = changed
                .liquids
                .iter()
                .map(|l| changed.particle_count(l))
                .sum();
            let start = changed.start(Some(1)).unwrap();
            assert_eq!(start.len(), count);
            assert!(name != "two-flasks" || count >= 8000, "{preset:?}: {count}");
            for particle in start {
                let flask = &changed.flasks[particle.flask];
                let local = flask.stage_from_flask.inverse();
                let p = local
                    .transform_point(particle.position.as_vec3())
                    .as_dvec3();
                assert!(flask.profile.is_inside(p.x.hypot(p.z), p.y), "{name}: {p}");
            }
        }
    }
}

/// Table 2: fluid particles within 1 %, solid ones within 10 %.
#[test]
fn paper_scenes_have_table_2s_particles() {
    for (name, fluid, solid) in [
        ("moving-flask", 10925, 51158),
        ("single-dilution", 13894, 48044),
        ("triple-dilution", 39888, 60632),
        ("tomato-soup", 14880, 2341),
    ] {
        let scene = Scene::builtin(name).unwrap();
        assert!((scene.scale.particle_mass() - 0.125).abs() < 1e-12);
        let own_fluid = scene.start(None).unwrap().len();
        let own_solid: usize = scene.boundary_particles().iter().map(Vec::len).sum();
        let off = |own: usize, paper: usize| (own as f64 / paper as f64 - 1.0).abs();
        assert!(off(own_fluid, fluid) < 0.01, "{name}: {own_fluid} fluid");
        assert!(off(own_solid, solid) < 0.10, "{name}: {own_solid} solid");
    }
}

/// Table 1, row by row.
#[test]
fn paper_scenes_have_table_1s_parameters() {
    for name in ["single-dilution", "triple-dilution", "vr-dilution"] {
        let scene = Scene::builtin(name).unwrap();
        let p = scene.paper.unwrap();
        let row = [p.T_a, p.T_B, p.k_d, p.k_v, p.D_T, p.D_c].map(Option::unwrap);
        assert_eq!(row, [20.0, 100.0, 0.017, 1.0, 0.01, 0.007]);
        assert_eq!(scene.solver.viscosity, 0.3);
    }
    let soup = Scene::builtin("tomato-soup").unwrap();
    let p = soup.paper.unwrap();
    assert_eq!((p.T_a, p.T_B, p.k_d), (Some(110.0), Some(100.0), None));
    assert_eq!(soup.solver.viscosity, 0.3);
}
