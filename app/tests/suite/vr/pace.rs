//! A session that keeps pace with a display that the machine cannot hold, and its replay.

use std::sync::mpsc::channel;

use crate::vr::common::{
    Trouble, Worn, hash, heard, in_scene, nobody, options, pour, scene, session_with,
};
use crate::vr::inset::inset_of;
use crate::vr::loss::replayed;
use crate::vr::seen::Seen;
use vitriol_gpu::{Gpu, Timestamps};
use vitriol_run::Action;
use vitriol_run::track::key;
use vitriol_session::decision::Decision;
use vitriol_session::foveating::Foveating;
use vitriol_session::session::WARM_UP;
use vitriol_session::stand_in::StandIn;
use vitriol_session::workbench::TAKEN_UP;
use vitriol_sim::scene::PictureFilter;
use vitriol_tests::gpu;
use vitriol_xr::track::Track;
use vitriol_xr::{HeadsetFrame, Turn};

/// Frames of a display of 2,000 Hz, which no driver holds, and then of one of 0.1 Hz, which every does on however
/// busy a machine; with a loss or a new start between the two.
struct Rates<T> {
    until: u64,
    between: T,
    /// After so many frames it awaits what is being made.
    awaits: Option<u64>,
}

impl<T: FnMut(&mut StandIn, u64) -> Option<Turn>> Trouble for Rates<T> {
    fn turn(&mut self, headset: &mut StandIn, after: u64) -> Option<Turn> {
        (self.between)(headset, after)
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        frame.poses.info.period_ns = match after < self.until {
            true => 500_000,
            false => 10_000_000_000,
        };
    }

    fn awaits(&self, after: u64) -> bool {
        self.awaits == Some(after) && heard(TAKEN_UP) == 0
    }
}

fn timed() -> impl std::ops::Deref<Target = Gpu> {
    gpu::another_device(|options| options.timestamps = Timestamps::Whole)
}

/// Switches of a track but where its bench stands, with the steps that they precede.
fn switches(track: &Track) -> Vec<(u64, String, String)> {
    let of = |frame: &vitriol_xr::PoseFrame| {
        let step = frame.step;
        let said = frame.scenario.clone().into_iter();
        said.map(move |switch| (step, switch.key, switch.value))
    };
    let all = track.frames.iter().flat_map(of);
    all.filter(|(_, key, _)| key != key::PLACEMENT).collect()
}

fn values<'a>(all: &'a [(u64, String, String)], key: &str) -> Vec<&'a str> {
    let of = all.iter().filter(|(_, of, _)| of == key);
    of.map(|(_, _, value)| value.as_str()).collect()
}

/// Down to the end of both ladders, up again, and each step of a replay is solved as it was.
#[test]
fn a_session_gives_way_and_its_replay_repeats_it() {
    let gpu = timed();
    let folder = tempfile::tempdir().unwrap();
    let trouble = Rates {
        until: 60,
        between: |_: &mut StandIn, _| None,
        awaits: None,
    };
    let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, 180, trouble);
    headset.inset = Some(inset_of(&gpu, [70, 50]));
    let mut options = options(folder.path());
    options.governed = true;
    options.plan.solver = Some([7, 6]);
    let (outcome, track) = session_with(&mut headset, options, nobody());
    let said = switches(&track);
    let solver = values(&said, key::SOLVER);
    // What was asked for is not the preset's; then down, and up to it again.
    assert_eq!((said[0].0, said[0].1.as_str()), (0, key::SOLVER));
    assert_eq!((solver[0], *solver.last().unwrap()), ("7x6", "7x6"));
    assert!(solver.len() > 3, "{solver:?}");
    let least = solver.iter().map(|value| {
        let (substeps, iterations) = value.split_once('x').unwrap();
        substeps.parse::<u32>().unwrap() * iterations.parse::<u32>().unwrap()
    });
    assert!(least.min().unwrap() < 21, "{solver:?}");
    let resolution = values(&said, key::RESOLUTION);
    assert!(resolution.contains(&"0.6"), "{resolution:?}");
    assert_eq!(resolution.last(), Some(&"1"));
    // What is shown is as large as was said.
    let sides: Vec<u32> = headset.shown.iter().map(|shown| shown.extent[0]).collect();
    assert_eq!((sides[0], sides.iter().min()), (96, Some(&58)));
    assert_eq!(sides.last(), Some(&96));
    // And so is a second pair of pictures.
    for shown in &headset.shown {
        let wide = f64::from(shown.inset.unwrap().extent[0]) / 70.0;
        let eyes = f64::from(shown.extent[0]) / 96.0;
        assert!((wide - eyes).abs() <= 0.5 / 70.0 + 0.5 / 96.0, "{shown:?}");
    }
    let counted: u64 = outcome
        .governor
        .settings
        .iter()
        .map(|with| with.frames)
        .sum();
    assert_eq!((outcome.governor.on, counted), (true, 180 - WARM_UP));
    assert_eq!(replayed(&gpu, track.clone()), hash(&outcome));
    // It is the changes that make it so.
    let mut other = track;
    for frame in &mut other.frames {
        frame.scenario.retain(|switch| switch.key != key::SOLVER);
    }
    assert_ne!(replayed(&gpu, other), hash(&outcome));
}

/// The plainer filter takes over while the session goes on.
#[test]
fn the_filter_gives_way() {
    let gpu = timed();
    let folder = tempfile::tempdir().unwrap();
    let file = scene(folder.path());
    let text = std::fs::read_to_string(&file).unwrap();
    let curved = format!("{text}filter = \"curvature-flow\"\n");
    let file = folder.path().join("curved.toml");
    std::fs::write(&file, curved).unwrap();
    let trouble = Rates {
        until: u64::MAX,
        between: |_: &mut StandIn, _| None,
        awaits: Some(30),
    };
    let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, 60, trouble);
    let mut options = in_scene(folder.path(), &file);
    options.governed = true;
    let (outcome, track) = session_with(&mut headset, options, nobody());
    assert_eq!(outcome.bench.filter(), PictureFilter::NarrowRange);
    assert_eq!(values(&switches(&track), key::FILTER), ["narrow-range"]);
    let filters: Vec<_> = outcome
        .governor
        .settings
        .iter()
        .map(|with| with.setting.filter)
        .collect();
    assert_eq!(filters[0], PictureFilter::CurvatureFlow);
    assert_eq!(filters.last(), Some(&PictureFilter::NarrowRange));
}

mod long {
    use super::*;

    /// A display that could be slower becomes so before anything else gives way, and fast again when there is room.
    #[test]
    fn the_displays_rate_gives_way_first() {
        let gpu = timed();
        let folder = tempfile::tempdir().unwrap();
        // The frames' periods are the stand-in's own.
        struct Own;
        impl Trouble for Own {}
        // Each 22nd frame of 2,000 Hz has a step, and a dozen of those are a load.
        let mut headset = Worn::new(&gpu, pour().sample_track(), 2000.0, 320, Own);
        headset.inner.rates = vec![0.1, 2000.0];
        let mut options = options(folder.path());
        options.governed = true;
        let (outcome, track) = session_with(&mut headset, options, nobody());
        // Of 10 s in which five steps are taken.
        let [rate] = outcome.governor.rates[..] else {
            panic!("{:?}", outcome.governor.rates)
        };
        // It came as 32 bits.
        assert!((rate - 0.1).abs() < 1e-6);
        assert_eq!(outcome.governor.changes, 0);
        let said = switches(&track);
        assert!(values(&said, key::SOLVER).is_empty(), "{said:?}");
        assert!(values(&said, key::RESOLUTION).is_empty(), "{said:?}");
    }

    /// A new start and a lost device leave the level where it was; a replay knows.
    #[test]
    fn a_start_and_a_loss_keep_the_level() {
        let (gpu, second) = (timed(), timed());
        let folder = tempfile::tempdir().unwrap();
        let (sender, decisions) = channel();
        let next = Gpu::clone(&second);
        let mut turns = 0;
        let trouble = Rates {
            until: u64::MAX,
            between: move |headset: &mut StandIn, after| match (after, turns) {
                (40, 0) => {
                    turns = 1;
                    sender.send(Decision::Act(Action::Start(None))).unwrap();
                    None
                }
                (60, 1) => {
                    turns = 2;
                    headset.move_to(&next).unwrap();
                    Some(Turn::Renewed)
                }
                _ => None,
            },
            awaits: Some(42),
        };
        let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, 80, trouble);
        let mut options = options(folder.path());
        options.governed = true;
        let (outcome, track) = session_with(&mut headset, options, decisions);
        assert_eq!(outcome.renewals, 1);
        let said = switches(&track);
        let at = |key: &str| said.iter().position(|(_, of, _)| of == key).unwrap();
        let start = at(key::START);
        // Said before it, and again with it: a replay brings up the preset's.
        let (last, after) = (&said[start - 1], &said[start + 1]);
        assert_eq!(after.1, key::SOLVER);
        assert_eq!(after.0, said[start].0);
        let solver = values(&said[..start], key::SOLVER);
        assert_eq!(solver.last(), Some(&after.2.as_str()), "{last:?}");
        assert_eq!(said.len(), start + 2, "{said:?}");
        assert_eq!(replayed(&gpu, track), hash(&outcome));

        // The picture is drawn as small as it is said to be: what the lenses hide, a tenth of each side at the corner,
        // goes 5 pixels far and not 9, and 3 in the second row and not 7. Of two by two pixels all are hidden then.
        assert_eq!(headset.shown.last().unwrap().extent, [58, 38]);
        let depth = headset.inner.targets.depth.as_ref().unwrap();
        let depth: Vec<f32> = gpu::read_back(&second, depth).get().unwrap();
        assert_eq!(depth[0], 1.0);
        assert!(depth[2] < 1.0);
    }

    /// Pixels aside of the lenses' axes give way before any that are looked at, and come back last: for who has not said whether they
    /// may. A replay knows nothing of it.
    #[test]
    fn pixels_aside_give_way_first() {
        let gpu = timed();
        let run = |foveating, until, frames| {
            let folder = tempfile::tempdir().unwrap();
            let trouble = Rates {
                until,
                between: |_: &mut StandIn, _| None,
                awaits: None,
            };
            let track = pour().sample_track();
            let mut headset = Worn::of_extent(&gpu, track, [320, 340], (90.0, frames), trouble);
            let mut options = options(folder.path());
            options.governed = true;
            options.foveating = foveating;
            let (outcome, track) = session_with(&mut headset, options, nobody());
            let extent = headset.shown.last().unwrap().extent;
            let seen = Seen::last(&gpu, "gives-way", &headset);
            ((seen, extent), outcome, track)
        };
        let (_, outcome, track) = run(None, 45, 150);
        let said = switches(&track);
        assert_eq!(values(&said, key::FOVEATION), ["fixed", "off"]);
        let at = |key: &str| -> Vec<u64> {
            let of = said.iter().filter(|(_, of, _)| of == key);
            of.map(|(step, _, _)| *step).collect()
        };
        let [on, off] = at(key::FOVEATION)[..] else {
            panic!("{said:?}")
        };
        let smaller = at(key::RESOLUTION);
        assert!(smaller.len() > 1, "{said:?}");
        assert!(
            smaller.iter().all(|step| (on..=off).contains(step)),
            "{said:?}"
        );
        let settings = outcome.governor.settings.iter().map(|with| with.setting);
        for setting in settings {
            assert!(setting.foveated || setting.resolution == 1.0, "{setting:?}");
        }
        assert_eq!(outcome.foveating, None);
        assert_eq!(replayed(&gpu, track), hash(&outcome));

        // Pictures that end as small are nearly the same, unless one is drawn in blocks: 2 to 185 pixels differed, and 14,223 in blocks.
        let off = Some(Foveating::Off);
        let pictures = [None, off, off].map(|asked| run(asked, u64::MAX, 60));
        for ((_, small), outcome, track) in &pictures {
            assert_eq!(small, &[192, 204]);
            let settings = &outcome.governor.settings;
            let foveated = settings.iter().any(|with| with.setting.foveated);
            assert_eq!(foveated, outcome.foveating.is_none());
            let said = switches(track);
            assert_eq!(values(&said, key::FOVEATION).is_empty(), !foveated);
        }
        let [blocks, sharp, again] = pictures.each_ref().map(|((seen, _), _, _)| &seen.pixels);
        // Beyond what was drawn last the images hold what was drawn before.
        let drawn = |index: usize| index % 320 < 192 && index / 320 < 204;
        let differ = |a: &[[u8; 4]], b: &[[u8; 4]]| {
            let pairs = a.iter().zip(b).enumerate();
            let apart = pairs.filter(|(index, (a, b))| drawn(*index) && a != b);
            apart.count()
        };
        let (in_blocks, else_) = (differ(blocks, sharp), differ(again, sharp));
        eprintln!(
            "of {} pixels {in_blocks} differ, and {else_} in as sharp a picture",
            192 * 204
        );
        assert!(in_blocks > 5_000 && else_ < 1_000, "{in_blocks} {else_}");
    }
}
