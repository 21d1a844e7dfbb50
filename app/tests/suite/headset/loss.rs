//! The runtime dies in mid-pour, and comes back.

use vitriol_tests::monado;
use vitriol_xr::Side;
use vitriol_xr::track::load;

use crate::headset::drive;
use crate::headset::pour::{begin, follows, keeps_time, replay, whole};

mod long {
    use super::*;

    #[test]
    fn a_pour_goes_on_when_the_runtime_is_killed() {
        let Some(mut rig) =
            monado::enter("headset::loss::long::a_pour_goes_on_when_the_runtime_is_killed")
        else {
            return;
        };
        let (mut driver, mut program, recording) = begin(&rig);
        // The flask is tilted, and pours.
        driver.reach(&mut program, 4.8);
        rig.kill();
        program.says("session lost");
        // It goes on seeking.
        for _ in 0..3 {
            program.says("no runtime yet");
        }
        rig.start();
        driver.connect(&rig);
        program.says("Focused");
        driver.arrive(&mut program);
        program.frames(10);
        driver.finish(&mut program);
        program.frames(20);
        let (report, seen) = program.end();
        assert_eq!(report["renewals"], 1);
        assert_eq!(report["lost_particles"], 0);
        assert_eq!(report["nan_particles"], 0);
        assert_eq!(report["recording"]["unwritten"], 0);

        let track = load(recording.to_str().unwrap()).unwrap();
        whole(&track, report["steps"].as_u64().unwrap());
        follows(&track, &drive::track());
        keeps_time(&track, &seen, &driver.sent);
        // The flask did not leave the hand: in the air it is nowhere else from one step to the next.
        let flasks: Vec<_> = track
            .stage_from_flasks
            .iter()
            .filter(|f| !f.is_empty())
            .collect();
        for (pair, frame) in flasks.windows(2).zip(&track.frames) {
            let leap = pair[0][0].position.distance(pair[1][0].position);
            let squeezed = frame.hand(Side::Right).squeeze > 0.9;
            assert!(leap < 0.05 || !squeezed, "step {}: {leap} m", frame.step);
        }
        let replayed = replay(&track);
        assert_eq!(report["state_hash"], replayed.hash.as_str());
        assert!(replayed.poured > 0.05, "{} kg poured", replayed.poured);
    }
}
