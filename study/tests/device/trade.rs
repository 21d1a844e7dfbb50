//! The measurements of `vitriol trade`, against formulas.

use vitriol_sim::scene::{Preset, Scene};
use vitriol_study::trade::{Setting, convergence, rest};
use vitriol_tests::gpu;

/// Symplectic Euler is of first order in a fall; Eq. 5 on a lattice is of second, with its own share of D.
#[test]
fn errors_shrink_with_their_order() {
    let orders = convergence(&gpu::device(), true).unwrap();
    let of = |index: usize| orders[index].order;
    assert!((of(0) - 1.0).abs() < 0.05, "{orders:?}");
    assert!((1.7..2.6).contains(&of(2)), "{orders:?}");
}

/// Fewer iterations are worse, and the liquid at rest is where geometry has it.
#[test]
fn a_setting_is_judged_by_what_it_leaves() {
    let scene = Scene::builtin("beaker").unwrap();
    let coarse = Setting::of(&scene, Preset::Balanced).with_particles(1500.0, 217e-6);
    let cold = Setting {
        carry_rate: 0.0,
        iterations: 1,
        ..coarse
    };
    let device = gpu::device();
    let [good, bad] = [coarse, cold].map(|s| rest(&device, &scene, &s, 0.4).unwrap());
    assert!(good.density_p99 < 0.01, "{good:?}");
    assert!(bad.density_p99 > 3.0 * good.density_p99, "{bad:?}");
    // A particle's spacing of 5 mm in 63 mm.
    assert!(good.lost_volume.abs() < 0.05, "{good:?}");
    assert!(bad.lost_volume > good.lost_volume, "{bad:?}");
}
