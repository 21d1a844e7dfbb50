//! Loops over what is around a bubble, which Mesa 22.3's software driver ends after 65,535 turns of an invocation together: counted here,
//! on no device, as `docs/measurements/solver.md` describes. What a driver did cut is counted as it happens (`Counters::bubbles_cut`).

use glam::{DVec3, IVec3};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::scene::{Feature, Preset, Scene};

/// Turns that all loops of an invocation may take.
const MOST: f64 = 65_535.0;

/// What the count repeats of the shaders: were one of these changed, the count would be of other loops.
const REPEATED: [(&str, &str); 5] = [
    (
        include_str!("../../../shaders/wgsl/common/chemistry/touching.wgsl"),
        "const WIDEST_BUBBLE: f32 = 0.5;",
    ),
    (
        include_str!("../../../shaders/wgsl/common/chemistry/touching.wgsl"),
        "const MOST_RADIUS: f32 = 7.0;",
    ),
    (
        include_str!("../../../shaders/wgsl/common/chemistry/bubble_surroundings.wgsl"),
        "const CONTACT: f32 = 3.5e-3;\nconst LEAST_CONTACT: f32 = 1.2;",
    ),
    (
        include_str!("../../../shaders/wgsl/common/chemistry/cavity.wgsl"),
        "const CAVITY_CELLS: i32 = 9;",
    ),
    (
        include_str!("../../../shaders/wgsl/common/liquid/cells_around.wgsl"),
        "const STRAYED: f32 = 2.0;",
    ),
];

/// Points along each edge of a cell at which the liquid in it is asked for: with twice as many a count differs by less than 1 %.
const POINTS: i32 = 4;

/// Turns of a walk around a bubble of that radius (m) at `place` in the first cell, in liquid at rest density on all sides; `hollow` where
/// the bubble holds none itself.
fn walk(p: &Parameters, radius: f64, place: DVec3, hollow: bool) -> f64 {
    let h = p.support_radius;
    let edge = h * (1.0 + p.list_margin);
    let reach = radius + h.max(3.5e-3).max(1.2 * p.spacing);
    let cells = ((reach / edge).ceil() as i32).clamp(1, 9);
    let reach = reach.min(f64::from(cells) * h) + 2.0 * p.list_reach * h;
    let of_cell = edge.powi(3) / p.particle_volume();
    let points = cube(0, POINTS).map(|it| (it.as_dvec3() + 0.5) / f64::from(POINTS));
    let points: Vec<DVec3> = points.collect();
    let turns = cube(-cells, cells + 1).map(|cell| {
        let low = edge * cell.as_dvec3();
        let gap = (low - place).max(place - low - edge).max(DVec3::ZERO);
        if gap.length() > reach {
            return 1.0;
        }
        let wet = |it: &&DVec3| !hollow || (low + edge * **it).distance(place) > radius;
        let wet = points.iter().filter(wet).count() as f64 / points.len() as f64;
        1.0 + wet * of_cell
    });
    turns.sum()
}

/// All from `first` to before `end` along each axis.
fn cube(first: i32, end: i32) -> impl Iterator<Item = IVec3> {
    let side = end - first;
    let place = move |n| IVec3::new(n % side, n / side % side, n / (side * side));
    (0..side.pow(3)).map(move |n| place(n) + first)
}

/// A bubble that bursts looks around itself four times, and once behind it, where there is liquid. It lies at a cell's corner or middle.
fn burst(p: &Parameters, radius: f64) -> f64 {
    let middle = DVec3::splat(0.5 * p.support_radius * (1.0 + p.list_margin));
    let at = |place| 4.0 * walk(p, radius, place, true) + walk(p, radius, place, false);
    f64::max(at(DVec3::ZERO), at(middle))
}

#[test]
fn no_loop_around_a_built_in_scenes_cavity_is_cut() {
    for (shader, text) in REPEATED {
        assert!(shader.contains(text), "count anew without {text:?}");
    }
    let mut most = 0.0;
    for name in Scene::builtin_names() {
        let scene = Scene::builtin(name).unwrap();
        if !scene.models(Feature::Bubbles) {
            continue;
        }
        let outlines = scene
            .flasks
            .iter()
            .flat_map(|it| it.profile.inner_outline());
        let widest = outlines.map(|[r, _]| *r).fold(0.0, f64::max);
        for preset in Preset::ALL {
            let p = Parameters::from_scene(&scene.with_preset(preset));
            let greatest = (0.5 * widest).min(7.0 * p.support_radius);
            // Turns do not only rise with the radius, since whole cells are asked.
            for radius in (8..=16).map(|part| greatest * f64::from(part) / 16.0) {
                let turns = burst(&p, radius);
                assert!(turns < MOST, "{name} at {}: {turns}", preset.name());
                most = f64::max(most, turns);
            }
        }
    }
    // Twice as many would be cut: the count is not of nothing.
    assert!(most > 0.5 * MOST, "{most}");
}
