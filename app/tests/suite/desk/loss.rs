//! A device that is lost while a flask is in the hand.

use crate::desk::common::{By, Script, at_screen, points, puts_down, session_at, spec, takes};
use crate::desk::seen::SOURCE;
use crate::vr::common::hash;
use crate::vr::loss::replayed;
use vitriol_gpu::Gpu;
use vitriol_session::desk::Desk;
use vitriol_tests::{gpu, screen};

mod long {
    use super::*;

    /// The session goes on with another device: the flask is still in the hand, no water is missing, and it is put down as ever.
    #[test]
    fn a_lost_device_leaves_the_flask_in_the_hand() {
        let name = "desk::loss::long::a_lost_device_leaves_the_flask_in_the_hand";
        let Some(screen) = screen::enter(name) else {
            return;
        };
        let (first, second) = (gpu::another_device(|_| {}), gpu::another_device(|_| {}));
        let folder = tempfile::tempdir().unwrap();
        let lost = Gpu::clone(&first);
        let script =
            takes(points(Script::default())).then("loses the device", move |_, seen, frame| {
                if frame == 0 {
                    lost.lose();
                }
                // Hands, bodies and time go on.
                assert!(seen.holder(SOURCE).is_some());
                seen.lasts > 0.5
            });
        let then = Gpu::clone(&second);
        let sat = session_at(
            &first,
            (screen, By::Mouse),
            at_screen(folder.path()),
            puts_down(script),
            (spec(), move |desk: Desk| {
                desk.reopening(move || Ok(then.clone()))
            }),
        );
        assert_eq!(sat.ended_in, None);
        assert_eq!((sat.outcome.devices_lost, sat.outcome.renewals), (1, 1));
        let measured = sat.outcome.world.measure().unwrap();
        assert_eq!((measured.lost_particles, measured.nan_particles), (0, 0));
        // 150 g of water.
        assert!(measured.in_flasks[SOURCE] > 0.149, "{measured:?}");
        assert_eq!(sat.outcome.world.holder(SOURCE), None);
        assert_eq!(replayed(&second, sat.track), hash(&sat.outcome));
    }
}
