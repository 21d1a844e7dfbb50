//! Mixtures in a stirred glass lie on the straight line between the two liquids, in c and h.

use super::setup::*;
use crate::common::*;
use vitriol_sim::chemistry::eddies::Mixing;
use vitriol_sim::chemistry::table::SolutionTable;
use vitriol_sim::chemistry::{Chemistry, Physical};
use vitriol_tests::gpu;

/// Largest superheat (K) and temperature (°C) of any particle of a glass of water at `water` °C
/// and 98 % acid at `acid` °C, whichever is below, stirred for 25 frames.
fn stirred(turbulence: f64, water: f64, acid: f64, acid_below: bool) -> [f64; 2] {
    let device = gpu::device();
    let table = SolutionTable::new();
    let law = Physical {
        mixing: Mixing {
            turbulence,
            ..Mixing::default()
        },
        ..mixing_alone()
    };
    let p = with(Chemistry::Physical(law), parameters());
    let particles = glass_of(450, |height| {
        if (height < 0.5) == acid_below {
            (acid, 0.98)
        } else {
            (water, 0.0)
        }
    });
    let solver = Setup::new(p, vec![narrow_glass()], particles).solver(&device);
    let mut random = Random(11);
    let mut most = [f64::NEG_INFINITY; 2];
    for _ in 0..25 {
        stir(&device, &solver, &mut random, 0.3);
        for &[temperature, acid, ..] in &solver.snapshot().unwrap().heat {
            let temperature = f64::from(temperature);
            let boiling_point = table.at(acid.into()).boiling_point;
            most[0] = most[0].max(temperature - boiling_point);
            most[1] = most[1].max(temperature);
        }
    }
    most
}

/// Of water and 98 % acid at 20 °C, that line is at most 9.0 K above its boiling point and
/// 159.9 °C hot, by the tables and without a particle. Whichever is below, the hottest particle
/// comes to that and not above it. Of warm feeds, whose enthalpies differ more, it is 38 and 23 K above.
#[test]
fn a_stirred_glass_reaches_the_mixing_line_and_does_not_pass_it() {
    // With eddies as fast as pairs may exchange, and with the scenes'.
    for turbulence in [10.0, Mixing::default().turbulence] {
        for acid_below in [true, false] {
            let [superheat, temperature] = stirred(turbulence, 20.0, 20.0, acid_below);
            let case = format!("{turbulence}, acid below: {acid_below}: {superheat} {temperature}");
            assert!((8.0..=10.0).contains(&superheat), "{case}");
            assert!((temperature - 159.9).abs() <= 0.5, "{case}");
        }
    }
    for (water, acid, line) in [(60.0, 20.0, 38.0), (20.0, 60.0, 23.0)] {
        let [superheat, _] = stirred(10.0, water, acid, true);
        assert!(
            (superheat - line).abs() <= 1.0,
            "{water} {acid}: {superheat}"
        );
    }
}
