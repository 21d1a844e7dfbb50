//! The settings that are tried.

use vitriol_sim::scene::{Preset, Scene};

use super::setting::{Knob, Setting};
use super::tank::VOLUME;

/// Rate (1/s) at which multipliers are carried on, where it is not a preset's own.
const CARRY_RATE: f64 = 2.25;

/// The finest setting, beyond all presets, with `particles` of them: it is compared with the f64 reference, and others' poured volumes are
/// compared with its.
pub fn finest(scene: &Scene, particles: f64) -> Setting {
    let fine = Setting {
        substeps: 24,
        ..Setting::of(scene, Preset::Reference)
    };
    fine.with_particles(particles, VOLUME)
}

/// Every setting once: the presets, one knob at a time from each of them, and the pairs that are known to matter. With `quick` those that
/// two cores run in some minutes.
pub fn sweep(scene: &Scene, quick: bool) -> Vec<(Preset, Knob, Setting)> {
    let mut all: Vec<(Preset, Knob, Setting)> = Vec::new();
    let mut add = |preset, knob, setting: Setting| {
        if !all.iter().any(|(_, _, known)| *known == setting) {
            all.push((preset, knob, setting));
        }
    };
    let presets = [Preset::Fast, Preset::Balanced, Preset::Reference];
    let of = |preset| {
        let own = Setting::of(scene, preset);
        if quick {
            own.with_particles(4_000.0, VOLUME)
        } else {
            own
        }
    };
    for preset in presets {
        add(preset, Knob::Preset, of(preset));
    }
    let turned = if quick { &presets[1..2] } else { &presets[..] };
    for &preset in turned {
        for (knob, setting) in one_at_a_time(of(preset), quick) {
            add(preset, knob, setting);
        }
    }
    if !quick {
        for (knob, setting) in pairs(of(Preset::Balanced)) {
            add(Preset::Balanced, knob, setting);
        }
    }
    all
}

fn one_at_a_time(own: Setting, quick: bool) -> Vec<(Knob, Setting)> {
    let mut all = Vec::new();
    let substeps: &[u32] = if quick {
        &[6, 16]
    } else {
        &[5, 6, 8, 10, 12, 16]
    };
    for &substeps in substeps {
        all.push((Knob::Substeps, Setting { substeps, ..own }));
    }
    let iterations: &[u32] = if quick {
        &[1, 2, 6]
    } else {
        &[1, 2, 3, 4, 6, 8]
    };
    for &iterations in iterations {
        all.push((Knob::Iterations, Setting { iterations, ..own }));
    }
    let cold = Setting {
        carry_rate: 0.0,
        ..own
    };
    let jacobi = Setting {
        chebyshev: false,
        omega: 0.35,
        ..cold
    };
    all.extend([jacobi, cold].map(|setting| (Knob::Acceleration, setting)));
    if quick {
        return all;
    }
    for particles in [4e3, 8e3, 14e3, 28e3, 56e3, 110e3, 200e3] {
        all.push((Knob::Particles, own.with_particles(particles, VOLUME)));
    }
    for rate in [45.0, 60.0, 120.0, 240.0] {
        let frame_time = 1.0 / rate;
        all.push((Knob::FrameTime, Setting { frame_time, ..own }));
    }
    let solids = Setting {
        boundary_particles: true,
        ..own
    };
    all.push((Knob::Boundary, solids));
    for support_ratio in [1.6, 1.8, 2.3, 2.6] {
        let setting = Setting {
            support_ratio,
            ..own
        };
        all.push((Knob::Support, setting));
    }
    for list_margin in [0.0, 0.1, 0.15, 0.25] {
        all.push((Knob::Margin, Setting { list_margin, ..own }));
    }
    all
}

/// Pairs of knobs, from the setting `own` in the middle.
fn pairs(own: Setting) -> Vec<(Knob, Setting)> {
    let mut all = Vec::new();
    for substeps in [6, 8, 10, 12] {
        for iterations in [1, 2, 4, 6, 8] {
            let setting = Setting {
                substeps,
                iterations,
                carry_rate: CARRY_RATE,
                ..own
            };
            all.push((Knob::SubstepsIterations, setting));
        }
    }
    for particles in [4e3, 28e3, 56e3] {
        for rate in [60.0, 120.0, 180.0] {
            let setting = Setting {
                frame_time: 1.0 / rate,
                ..own.with_particles(particles, VOLUME)
            };
            all.push((Knob::ParticlesFrameTime, setting));
        }
    }
    all
}
