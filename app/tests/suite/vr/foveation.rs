//! A session whose pictures are sharp about the lenses' axes, beside one whose are everywhere.

use glam::{Quat, Vec3};
use vitriol_gpu::Gpu;
use vitriol_session::foveating::Foveating;
use vitriol_tests::gpu;
use vitriol_xr::Pose;

use crate::vr::common::{Settled, Worn, pour, run};
use crate::vr::seen::Seen;

const EXTENT: [u32; 2] = [640, 680];

fn look(gpu: &Gpu, foveating: Foveating) -> (Seen, String) {
    let track = pour().sample_track();
    let mut headset = Worn::of_extent(gpu, track, EXTENT, (90.0, 6), Settled(gpu.clone()));
    let (outcome, _) = run(&mut headset, |it| it.foveating = Some(foveating));
    assert_eq!(outcome.foveating, Some(foveating));
    let hash = outcome.world.snapshot().unwrap().solver.hash();
    let name = format!("foveating-{foveating:?}").to_lowercase();
    (Seen::last(gpu, &name, &headset), format!("{hash:016x}"))
}

/// In a headset that tells where its wearer looks, it is sharp there.
#[test]
fn pictures_are_sharp_where_the_user_looks() {
    let gpu = gpu::device();
    let (sharp, _) = look(&gpu, Foveating::Off);
    let track = pour().sample_track();
    let mut headset = Worn::of_extent(&gpu, track, EXTENT, (90.0, 6), Settled(Gpu::clone(&gpu)));
    // To the left and down of where the head is, half a metre off.
    let head = sharp.eye();
    let turn = head.orientation * Quat::from_rotation_y(0.45) * Quat::from_rotation_x(-0.3);
    let gaze = Pose::new(head.transform_point(0.0315 * Vec3::X), turn);
    headset.inner.gaze = Some(gaze);
    run(&mut headset, |it| it.foveating = Some(Foveating::Eye));
    let foveated = Seen::last(&gpu, "foveating-eye", &headset);
    let place = gaze.transform_point(0.5 * Vec3::NEG_Z);
    let looked_at = head.inverse().transform_point(place);
    let [mut within, mut others] = [0, 0];
    for (index, (a, b)) in sharp.pixels.iter().zip(&foveated.pixels).enumerate() {
        let [x, y] = [index as u32 % EXTENT[0], index as u32 / EXTENT[0]];
        if sharp.along(x, y).angle_between(looked_at).to_degrees() <= 10.0 {
            assert_eq!(a, b, "({x}, {y})");
            within += 1;
        } else {
            others += u32::from(a != b);
        }
    }
    assert!(within > 8000, "{within}");
    assert!(others > 100_000, "{others}");
}

mod long {
    use super::*;

    /// Within 10° of the lens's axis the picture is the same to the bit, as is the panel wherever it is; beyond, it is less sharp. What
    /// is simulated knows nothing of it.
    #[test]
    fn pictures_are_sharp_about_the_axis() {
        let gpu = gpu::device();
        let (sharp, of_sharp) = look(&gpu, Foveating::Off);
        let (foveated, of_foveated) = look(&gpu, Foveating::Fixed);
        assert_eq!(of_sharp, of_foveated);
        let [mut within, mut of_panel, mut others] = [0, 0, 0];
        for (index, (a, b)) in sharp.pixels.iter().zip(&foveated.pixels).enumerate() {
            let [x, y] = [index as u32 % EXTENT[0], index as u32 / EXTENT[0]];
            let ahead = sharp.along(x, y).angle_between(Vec3::NEG_Z).to_degrees();
            if ahead <= 10.0 {
                assert_eq!(a, b, "({x}, {y})");
                within += 1;
            } else if a[3] == 0 {
                assert_eq!(a, b, "({x}, {y}), the panel");
                of_panel += 1;
            } else {
                others += u32::from(a != b);
            }
        }
        // Of a field of 94° by 97°.
        assert!(within > 8000, "{within}");
        assert!(of_panel > 4000, "{of_panel}");
        assert!(others > 100_000, "{others}");
    }
}
