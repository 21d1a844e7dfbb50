//! Fig. 5 with few particles.

use vitriol_sim::scene::Scene;
use vitriol_study::command::fig5::compare;
use vitriol_tests::gpu;

#[test]
fn only_the_constraint_keeps_liquid_in_a_jerked_flask() {
    let device = gpu::device();
    let mut scene = Scene::builtin("moving-flask").unwrap();
    scene.scale.spacing *= 2.0;
    let result = compare(&device, &scene, None).unwrap();
    // An eighth of 10,925.
    assert_eq!(result.fluid_particles, 1366);
    // The test needs a flask that outruns its liquid's support radius (2 d).
    assert!(result.spacings_per_frame > 1.5, "{result:?}");
    assert!(result.without.through_glass > 100, "{result:?}");
    assert_eq!(result.with.through_glass, 0, "{result:?}");
    for count in [&result.without, &result.with] {
        assert!(count.in_flask > 0, "{result:?}");
        assert!(count.in_flask <= 1366, "{result:?}");
    }
    // With the constraint, particles that are not in the flask went over the rim.
    let left = result.with.over_rim + result.with.in_flask;
    assert!(left >= 1366, "{result:?}");
}
