//! Liquids beyond any that is poured.

use super::setup::*;
use crate::common::*;
use vitriol_sim::chemistry::paper::Boiling;
use vitriol_sim::chemistry::{Chemistry, PaperBoiling};
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::Counters;
use vitriol_tests::gpu;

/// Six frames of 300 particles in a glass; all must stay numbers.
fn run(chemistry: &Chemistry, of: impl Fn(usize) -> (f64, f64)) -> (Counters, Vec<[f32; 4]>) {
    let device = gpu::device();
    let mut particles = glass_of(300, |_| (20.0, 0.0));
    for (i, particle) in particles.iter_mut().enumerate() {
        (particle.temperature, particle.acid) = of(i);
    }
    let p = with(chemistry.clone(), parameters());
    let max_speed = p.max_speed;
    let solver = Setup::new(p, vec![narrow_glass()], particles).solver(&device);
    let total = |rows: &[[f32; 4]]| sum(rows, |row| row[0] * row[3]);
    let before = total(&solver.snapshot().unwrap().matter);
    frames(&device, &solver, &[Pose::IDENTITY], 6);
    let state = solver.snapshot().unwrap();
    let counters = solver.counters().unwrap();
    assert_eq!(counters.nan_particles, 0, "{chemistry:?}");
    for found in crate::common::particles(&state) {
        assert!(found.present && found.position.is_finite(), "{found:?}");
        // Line 27 comes after line 24: the default adds a third of each
        // relative velocity at most, over the lattice's largest eigenvalue.
        let literal = matches!(chemistry, Chemistry::Paper(p)
            if p.boiling.is_some_and(|b| b.law == Boiling::Literal));
        let most = if literal { f64::MAX } else { 2.0 * max_speed };
        assert!(found.velocity.length() < most, "{found:?}");
    }
    for &[temperature, acid, ..] in &state.heat {
        assert!(temperature.is_finite() && temperature >= -273.15);
        assert!((0.0..=1.0).contains(&acid), "{acid}");
    }
    for &[acid, enthalpy, vapour, mass] in &state.matter {
        assert!((0.0..=1.0).contains(&acid) && enthalpy.is_finite());
        assert!(
            (0.0..1.0).contains(&vapour) && mass > 0.0,
            "{vapour} {mass}"
        );
    }
    let after = total(&state.matter);
    // However violent: 72 substeps of rounding.
    assert!((after - before).abs() <= 1e-6 * before, "{before} {after}");
    (counters, state.heat)
}

fn papers(intensity: f64) -> [Chemistry; 2] {
    [Boiling::Power, Boiling::Literal].map(|law| {
        let boiling = PaperBoiling {
            intensity,
            ..anti_viscosity(law)
        };
        paper(Some(dilution()), Some(boiling))
    })
}

#[test]
fn a_million_degrees_and_any_intensity() {
    for intensity in [1.0, 100.0] {
        for chemistry in papers(intensity) {
            for temperature in [1e6, 150.0] {
                let (counters, _) = run(&chemistry, |_| (temperature, 0.0));
                // Exchanges that were cut are counted; at 150 °C and k_v = 1 nothing need be.
                let cut = counters.speed_limited + counters.list_limited;
                assert!(cut > 0 || temperature < 1e5, "{counters:?}");
            }
        }
    }
    let physical = Chemistry::Physical(everything());
    run(&physical, |_| (1e6, 0.5));
    run(&physical, |i| (if i % 2 == 0 { 1e6 } else { -50.0 }, 0.3));
    run(&physical, |_| (300.0, 0.0));
}

#[test]
fn all_water_and_all_acid_stay_as_they_are() {
    let [power, _] = papers(1.0);
    for acid in [0.0, 1.0] {
        for chemistry in [power.clone(), Chemistry::Physical(everything())] {
            let (_, heat) = run(&chemistry, |_| (20.0, acid));
            for row in heat {
                // To the bit: nothing differs, so nothing is exchanged.
                assert_eq!(f64::from(row[1]), acid);
                // T follows from h: its last bit is 0.004 J/kg, 1 µK; 20 in
                // f32 is 2e-6.
                assert!((row[0] - 20.0).abs() < 1e-4, "{row:?}");
            }
        }
    }
}

#[test]
fn one_particle_of_acid_in_water() {
    let [power, _] = papers(1.0);
    for chemistry in [power, Chemistry::Physical(everything())] {
        let (_, heat) = run(&chemistry, |i| (20.0, if i == 150 { 1.0 } else { 0.0 }));
        let most = heat.iter().fold(0.0f32, |a, row| a.max(row[1]));
        let some = heat.iter().filter(|row| row[1] > 0.0).count();
        assert!(most < 1.0 && some > 10, "{most} {some}");
        if matches!(chemistry, Chemistry::Paper(_)) {
            let total = sum(&heat, |row| row[1]);
            assert!((total - 1.0).abs() < 1e-6, "{total}");
        }
    }
}

/// A particle whose enthalpy is no number turns non-finite at a frame's end, after which the flow is filtered
/// around it. It is taken out in the next frame, and no other particle is.
#[test]
fn a_particle_that_is_no_number_spoils_no_other() {
    let device = gpu::device();
    let p = with(Chemistry::Physical(boiling()), single_substeps());
    let particles = glass_of(300, |height| (60.0, if height < 0.5 { 0.98 } else { 0.0 }));
    let solver = Setup::new(p, vec![narrow_glass()], particles).solver(&device);
    frames(&device, &solver, &[Pose::IDENTITY], 3);
    let mut state = solver.snapshot().unwrap();
    let bad = state.tags[150][1];
    state.matter[150][1] = f32::NAN;
    solver.restore(&state).unwrap();
    for _ in 0..4 {
        frames(&device, &solver, &[Pose::IDENTITY], 1);
        let state = solver.snapshot().unwrap();
        for slot in (0..state.tags.len()).filter(|&slot| state.tags[slot][1] != bad) {
            let rows = [state.heat[slot], state.matter[slot], state.velocities[slot]];
            // The third word of `heat` is two halves.
            let finite = rows
                .iter()
                .all(|row| [0, 1, 3].iter().all(|&k| row[k].is_finite()));
            assert!(
                finite && state.eddies[slot][0].is_finite(),
                "{slot}: {rows:?}"
            );
        }
    }
    assert_eq!(solver.counters().unwrap().nan_particles, 1);
}
