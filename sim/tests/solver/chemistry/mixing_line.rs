//! What a stirred glass mixes lies on the straight line between the two liquids, in c and h.

use super::setup::*;
use crate::common::*;
use vitriol_sim::chemistry::table::SolutionTable;
use vitriol_sim::chemistry::transport::Mixing;
use vitriol_sim::chemistry::{Chemistry, Physical};
use vitriol_tests::gpu;

/// Of water and 98 % acid at 20 °C, that line is at most 9.0 K above its boiling point and
/// 159.9 °C hot, by the tables and without a particle. Whichever is below, the hottest particle
/// comes to that and not above it.
#[test]
fn a_stirred_glass_reaches_the_mixing_line_and_does_not_pass_it() {
    let device = gpu::device();
    let table = SolutionTable::new();
    // With eddies as fast as pairs may exchange, and with the scenes'.
    for turbulence in [10.0, Mixing::default().turbulence] {
        let law = Physical {
            mixing: Mixing { turbulence },
            ..mixing_alone()
        };
        let p = with(Chemistry::Physical(law), parameters());
        for acid_below in [true, false] {
            let particles = glass_of(450, |height| {
                let acid = (height < 0.5) == acid_below;
                (20.0, if acid { 0.98 } else { 0.0 })
            });
            let solver = Setup::new(p.clone(), vec![narrow_glass()], particles).solver(&device);
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
            let [superheat, temperature] = most;
            let case = format!("{turbulence}, acid below: {acid_below}: {superheat} {temperature}");
            assert!((8.0..=10.0).contains(&superheat), "{case}");
            assert!((temperature - 159.9).abs() <= 0.5, "{case}");
        }
    }
}
