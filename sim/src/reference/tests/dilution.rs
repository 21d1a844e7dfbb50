//! Line 26 of the paper's chemistry.

use super::contact::{Bar, LATTICE_SHARE, erf};
use super::{Random, glass_of_water};
use crate::chemistry::paper::{Diffusion, Dilution};
use crate::parameters::Parameters;
use crate::pose::Pose;
use crate::reference::Reference;
use crate::reference::chemistry::{DilutionLaw, ReferenceChemistry, ReferencePaper};
use crate::reference::dilution::{Weight, diffuse};
use crate::scene::Scene;
use glam::DVec3;

/// Table 1 in the paper's world.
fn world() -> Parameters {
    Parameters::from_scene(&Scene::builtin("single-dilution").unwrap())
}

fn law(scheme: Diffusion, parameters: &Parameters) -> DilutionLaw {
    DilutionLaw {
        heat: Dilution::new(0.017, parameters.particle_mass()),
        temperature_diffusivity: 0.01,
        acid_diffusivity: 0.007,
        ambient: 20.0,
        scheme,
    }
}

/// A glass that fits the world's spacing, at the scale of `glass_of_water`,
/// and what it is filled with by `(temperature, acid)` of a position.
fn glass(parameters: Parameters, law: DilutionLaw, of: impl Fn(DVec3) -> (f64, f64)) -> Reference {
    let mut reference = glass_of_water(parameters, 300, Pose::IDENTITY);
    let particles: Vec<_> = reference.positions.iter().map(|&at| of(at)).collect();
    let paper = ReferencePaper::new(Some(law), None, &particles).unwrap();
    reference.chemistry = Some(ReferenceChemistry::Paper(paper));
    reference
}

fn paper(reference: &Reference) -> &ReferencePaper {
    match &reference.chemistry {
        Some(ReferenceChemistry::Paper(paper)) => paper,
        _ => panic!("has the paper's chemistry"),
    }
}

fn sum(values: &[f64]) -> f64 {
    values.iter().sum()
}

/// Largest error of a step in c after D·t = 0.01 m², `layers` a metre, against
/// ½ erfc(x/√(4D't)), where D' = `share`·D.
fn step_error(layers: usize, share: f64) -> f64 {
    let bar = Bar::new(layers);
    let initial = |at: &DVec3| if at.x < 0.0 { 1.0 } else { 0.0 };
    let mut acid: Vec<f64> = bar.positions.iter().map(initial).collect();
    for _ in 0..bar.steps {
        let next = diffuse(&bar.pairs(), &Weight::Conservative(1.0), &acid);
        for (slab, next) in acid.chunks_mut(25).zip(next.chunks(25)) {
            slab.fill(next[12]);
        }
    }
    let exact = |x: f64| 0.5 * (1.0 - erf(x / (4.0 * share * 0.01).sqrt()));
    let near = bar.middles().filter(|(x, _)| x.abs() < 0.6);
    near.map(|(x, i)| (acid[i] - exact(x)).abs())
        .fold(0.0, f64::max)
}

#[test]
fn a_step_diffuses_as_erf() {
    let resolutions = [10, 20, 40];
    // To the lattice's own D' = 0.992 D the order is two: 0.0111, 0.0030,
    // 0.00073.
    let own = resolutions.map(|layers| step_error(layers, LATTICE_SHARE));
    for pair in own.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.7..2.6).contains(&order), "{own:?}: {order}");
    }
    // To D the error ends at what is left of D at h/d = 2 for good, 0.85 % of
    // x·∂c/∂x: 0.0021.
    let errors = resolutions.map(|layers| step_error(layers, 1.0));
    assert!(errors[2] < 0.0025 && errors[0] < 0.02, "{errors:?}");
}

#[test]
fn conservative_diffusion_does_not_drift_where_the_literal_does() {
    let drift = |scheme| {
        let parameters = Parameters {
            support_radius: world().support_radius,
            ..world()
        };
        let mut random = Random(3);
        let count = 600;
        let positions = random.points(count, 0.05 * 600f64.cbrt());
        let mut reference = super::in_the_open(parameters.clone(), positions);
        let particles: Vec<_> = (0..count)
            .map(|i| (20.0, if i % 2 == 0 { 0.98 } else { 0.0 }))
            .collect();
        let start = ReferencePaper::new(Some(law(scheme, &parameters)), None, &particles).unwrap();
        let before = sum(&start.acid);
        reference.chemistry = Some(ReferenceChemistry::Paper(start));
        let neighbours = reference.neighbours(&reference.positions);
        for _ in 0..200 {
            reference.dilute(&neighbours);
        }
        let after = &paper(&reference).acid;
        assert!(after.iter().all(|acid| (0.0..=0.98 + 1e-12).contains(acid)));
        (sum(after) - before).abs() / before
    };
    let (symmetric, printed) = (drift(Diffusion::Conservative), drift(Diffusion::Literal));
    assert!(symmetric < 1e-12, "{symmetric}");
    assert!(printed > 1e-4, "{printed}");
}

#[test]
fn walls_take_the_liquid_to_ambient_without_overshoot() {
    for (diffusivity, end) in [(1e-5, 125.0), (1e300, 20.001)] {
        let parameters = super::parameters();
        let law = DilutionLaw {
            temperature_diffusivity: diffusivity,
            ..law(Diffusion::Conservative, &parameters)
        };
        let mut reference = glass(parameters, law, |_| (150.0, 0.3));
        let neighbours = reference.neighbours(&reference.positions);
        let mut before = sum(&paper(&reference).temperatures);
        for _ in 0..400 {
            reference.dilute(&neighbours);
            let now = sum(&paper(&reference).temperatures);
            assert!(now <= before, "{now} {before}");
            before = now;
        }
        let temperatures = &paper(&reference).temperatures;
        let mean = before / temperatures.len() as f64;
        assert!(
            temperatures
                .iter()
                .all(|t| (20.0 - 1e-9..=150.0).contains(t))
        );
        assert!(mean < end, "{mean}");
    }
}

#[test]
fn a_wall_of_the_map_cools_like_one_of_particles() {
    // Eq. 5 over a lattice of solid particles that fills the half space y < 0.
    let parameters = world();
    let (d, h) = (parameters.spacing, parameters.support_radius);
    let exchange = parameters.exchange(parameters.list_capacity());
    let map = crate::flask::PlaneMap::new(h);
    for (height, tolerance) in [(0.5, 0.2), (0.7, 0.25)] {
        let mut by_particles = 0.0;
        for x in -3i32..=3 {
            for z in -3i32..=3 {
                for y in 0..4 {
                    let down = height + 0.5 + f64::from(y);
                    let distance = d * f64::from(x * x + z * z).sqrt().hypot(down);
                    by_particles += exchange.unlimited(1e-6, distance);
                }
            }
        }
        let by_map = exchange.wall_share(1e-6, map.volume(height * d));
        // A continuum has 1.3 times the Σk of the lattice (22.2 for 17.1),
        // which is the liquid's own, too.
        assert!(
            (by_map / by_particles - 1.15).abs() < tolerance,
            "{height} {by_map} {by_particles}"
        );
    }
}
