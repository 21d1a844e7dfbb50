//! A beaker that slips out of the hand: it breaks where that is wanted, and a replay breaks it again.

use std::path::Path;

use crate::vr::common::{Trouble, Worn, hash, heard, run, switched};
use crate::vr::loss::replayed;
use vitriol_gpu::Gpu;
use vitriol_lesson::{Cause, What};
use vitriol_run::track::key;
use vitriol_session::session::SessionOutcome;
use vitriol_session::workbench::TAKEN_UP;
use vitriol_tests::gpu;
use vitriol_xr::HeadsetFrame;
use vitriol_xr::track::{Keyframes, Track};

/// The wearer repeats the track. In the first round she holds B for a second; in the second the bench stands anew.
const ROUND: u64 = 117;
const HOLDS: u64 = 2;
const LETS_GO: u64 = HOLDS + 50;
const ENDS: u64 = 2 * ROUND - 8;

struct StartsOver;

impl Trouble for StartsOver {
    fn awaits(&self, after: u64) -> bool {
        after == LETS_GO + 1 && heard(TAKEN_UP) < 1
    }
    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        frame.poses.hands[0].button_b = (HOLDS..LETS_GO).contains(&after);
        frame.poses.hands[0].active = true;
    }
}

fn dropped(gpu: &Gpu, breakable: bool, frames: u64) -> (SessionOutcome, Track) {
    let text = vitriol_xr::track::builtin::text("dropped").unwrap();
    let track = Keyframes::parse(text, Path::new("dropped.toml")).unwrap();
    let mut headset = Worn::new(gpu, track.sample_track(), 45.0, frames, StartsOver);
    run(&mut headset, |options| options.plan.breakable = breakable)
}

mod long {
    use super::*;

    #[test]
    fn it_holds_where_nothing_else_is_asked_for() {
        let gpu = gpu::device();
        let (outcome, track) = dropped(&gpu, false, ROUND - 8);
        assert_eq!(outcome.broken, 0);
        assert!(!outcome.world.is_broken(0));
        assert_eq!(switched(&track, key::GLASS), 0);
    }

    /// It breaks on a bench that began anew as well; so does what was recorded.
    #[test]
    fn a_beaker_that_is_dropped_breaks_and_replays() {
        let gpu = gpu::device();
        let (outcome, track) = dropped(&gpu, true, ENDS);
        assert_eq!(outcome.broken, 1);
        let world = &outcome.world;
        assert!(world.is_broken(0) && !world.is_broken(1));
        assert_eq!(world.holder(0), None);
        let spilt = outcome.spilt.bench + outcome.spilt.floor;
        assert!(spilt > 50.0, "{:?}", outcome.spilt);
        let switches: Vec<_> = track
            .frames
            .iter()
            .flat_map(|frame| &frame.scenario)
            .collect();
        let glass = switches.iter().filter(|it| it.key == key::GLASS);
        assert_eq!(glass.map(|it| &*it.value).collect::<Vec<_>>(), ["breaks"]);
        assert!(switches.iter().any(|it| it.key == key::START));
        // It began anew, and was dropped then: one fall, with its break. Let go of half a metre above the floor and more, at √(2 g h).
        let [before, after] = &outcome.attempts[..] else {
            panic!("{:?}", outcome.attempts);
        };
        assert!(
            before.ending.is_some() && before.incidents.is_empty(),
            "{before:?}"
        );
        let falls: Vec<_> = after
            .incidents
            .iter()
            .filter_map(|it| match &it.what {
                What::Dropped {
                    flask,
                    speed_m_s,
                    broke,
                } => Some((flask.as_str(), *speed_m_s, *broke, &it.cause)),
                _ => None,
            })
            .collect();
        let [(flask, speed, broke, cause)] = falls[..] else {
            panic!("{falls:?}");
        };
        assert!(broke && speed > 3.1 && speed < 5.0, "{speed}");
        assert_eq!(
            *cause,
            Cause::LettingGo {
                flask: flask.into()
            }
        );
        // What was in it lies there because of that.
        let broken = Cause::Breaking {
            flask: flask.into(),
        };
        let spills = after
            .incidents
            .iter()
            .filter(|it| matches!(it.what, What::Spilt { .. }));
        assert!(
            spills.clone().count() > 0 && spills.clone().all(|it| it.cause == broken),
            "{after:?}"
        );
        assert_eq!(replayed(&gpu, track), hash(&outcome));
    }
}
