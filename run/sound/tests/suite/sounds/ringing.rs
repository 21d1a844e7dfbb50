//! Frequencies of rings, against formulas and tables.

use vitriol_sound::{Body, Bubble, Glass, Sound, Strike};

use crate::sounds::measure::{ahead, amplitude, mono, pitch, render};

fn bubble(radius: f32, density: f32, depth: f32) -> f64 {
    let sound = Sound::Bubble(Bubble {
        radius,
        depth,
        density,
    });
    // A large one has some 12 periods to the ear's end.
    let periods = if radius > 2e-3 { 12 } else { 20 };
    pitch(&mono(&render(&[ahead(0.0, sound)], 0.1)), periods)
}

/// Minnaert's frequencies as they are published for diameters of 5, 2, 1 and 0.5 mm.
#[test]
fn bubbles_ring_at_minnaerts_frequency() {
    for (diameter, frequency) in [(5e-3, 1.3e3), (2e-3, 3.3e3), (1e-3, 6.6e3), (0.5e-3, 13e3)] {
        let found = bubble(0.5 * diameter, 998.0, 0.03);
        assert!(
            (found / frequency - 1.0).abs() < 0.02,
            "{diameter}: {found}"
        );
        let radius = f64::from(0.5 * diameter);
        // Without surface tension, which raises the smallest by 0.2 %.
        let pressure: f64 = 101_325.0 + 998.0 * 9.81 * 0.03;
        let minnaert = (4.2 * pressure / 998.0).sqrt() / (std::f64::consts::TAU * radius);
        assert!(
            (found / minnaert - 1.0).abs() < 4e-3,
            "{diameter}: {found} {minnaert}"
        );
    }
}

/// √(998/1830) = 0.7385; at 10 m of water p is 1.966 times the air's.
#[test]
fn acid_lowers_a_bubbles_pitch_and_depth_raises_it() {
    let water = bubble(1e-3, 998.0, 0.03);
    let acid = bubble(1e-3, 1830.0, 0.03);
    assert!((acid / water - 0.7385).abs() < 2e-3, "{}", acid / water);
    let deep = bubble(1e-3, 998.0, 10.0);
    let expected = (1.0 + 998.0 * 9.80665 * 9.97 / 101_618.0_f64).sqrt();
    assert!(
        (deep / water / expected - 1.0).abs() < 5e-3,
        "{}",
        deep / water
    );
}

/// A bubble at the surface ends higher than it began: ξ = 0.1 a time of damping (van den Doel 2005).
#[test]
fn a_bubble_at_the_surface_rises() {
    let begins = bubble(2.5e-3, 998.0, 0.03);
    let rises = bubble(2.5e-3, 998.0, 0.0);
    // Over 12 periods, 9.1 ms, with d = 109.6 1/s: the mean rise is 0.1·109.6·4.6 ms = 5 %.
    assert!((rises / begins - 1.05).abs() < 0.01, "{}", rises / begins);
}

fn beaker(filled: f32) -> Glass {
    Glass {
        radius: 0.035,
        wall: 1.4e-3,
        height: 0.095,
        filled,
        density: 998.0,
        held: false,
    }
}

fn clink(filled: f32) -> Vec<f64> {
    let blow = Strike {
        impulse: 0.005,
        bodies: [Body::Glass(beaker(filled)); 2],
    };
    mono(&render(&[ahead(0.0, Sound::Strike(blow))], 0.2))
}

/// The strongest frequency between two, in steps of 1 Hz.
fn strongest(samples: &[f64], from: u32, to: u32) -> f64 {
    let all = (from..to).map(f64::from);
    all.max_by(|a, b| amplitude(samples, *a).total_cmp(&amplitude(samples, *b)))
        .unwrap()
}

/// French 1983 by hand (`run/sound/src/modes.rs`): 764, 2138 and 4095 Hz; a full one is lower by √3.797.
#[test]
fn a_beaker_rings_at_frenchs_modes() {
    let empty = clink(0.0);
    for (from, to, mode) in [
        (500, 1200, 764.0),
        (1500, 2800, 2138.5),
        (3300, 4800, 4095.3),
    ] {
        let found = strongest(&empty, from, to);
        assert!((found / mode - 1.0).abs() < 5e-3, "{found} {mode}");
    }
    let full = strongest(&clink(1.0), 200, 900);
    assert!(
        (full / (764.0 / 3.797_f64.sqrt()) - 1.0).abs() < 0.01,
        "{full}"
    );
}
