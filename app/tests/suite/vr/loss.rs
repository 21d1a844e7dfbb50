//! A runtime that goes away in mid-pour and comes back with another device.

use crate::vr::common::{
    StartsOver, Trouble, Worn, carried, hash, nobody, options, options_where, pour, pour_at_once,
    run, session_with, switched, when_heard,
};
use std::sync::mpsc::channel;
use vitriol_gpu::Gpu;
use vitriol_lesson::Event;
use vitriol_run::track::key;
use vitriol_run::{Action, Judging, Observer, Outcome, Progress, Setup, Span, on_device};
use vitriol_session::session::Session;
use vitriol_session::stand_in::StandIn;
use vitriol_session::workbench::TAKEN_UP;
use vitriol_sim::scene::Preset;
use vitriol_tests::gpu;
use vitriol_xr::track::{Track, TrackSource};
use vitriol_xr::{HeadsetFrame, Pause, Turn};

/// Hash of the state that a replay of `track` ends in; it finds what the session found.
pub fn replayed(gpu: &Gpu, track: Track) -> u64 {
    let (recorded, outcome) = replay_of(gpu, track, None);
    assert_eq!(
        recorded, outcome.events,
        "what was found in session and replay"
    );
    outcome.state_hash
}

/// The hash, and what an instructor did in the replay, with simulated times in ns.
pub fn instructed(gpu: &Gpu, track: Track) -> (u64, Vec<(i64, Action)>) {
    let (_, outcome) = replay_of(gpu, track, None);
    let instructions = outcome.instructions.into_iter();
    let instructions = instructions.map(|(t, it)| ((1e9 * t).round() as i64, it));
    (outcome.state_hash, instructions.collect())
}

/// What came of a replay that judges a lesson.
pub fn judged(gpu: &Gpu, track: Track, lesson: Judging) -> Outcome {
    replay_of(gpu, track, Some(lesson)).1
}

/// What the session found, and what came of the replay.
fn replay_of(gpu: &Gpu, track: Track, lesson: Option<Judging>) -> (Vec<Event>, Outcome) {
    let name = track.metadata.scene.clone();
    let scenes = carried(&track);
    let scene = scenes.get(&name).unwrap();
    let mut experiment = on_device(
        gpu,
        &Setup::without_pictures(
            &scene,
            (&name, &scenes),
            Preset::Balanced,
            track.metadata.seed,
        ),
    )
    .unwrap();
    if let Some(lesson) = lesson {
        experiment.judge(lesson);
    }
    let span = Span::covering(track.duration(), scene.scale.frame_time);
    let mut observer = Observer::new(span, Vec::new(), Progress::hidden());
    let recorded = track.events.iter();
    let recorded: Vec<Event> = recorded
        .map(|(_, json)| serde_json::from_str(json).unwrap())
        .collect();
    let mut source = TrackSource::new(track);
    vitriol_run::replay(&mut source, experiment.as_mut(), span, &mut observer).unwrap();
    let outcome = experiment.outcome().unwrap();
    assert!(!recorded.is_empty());
    (recorded, outcome)
}

/// Gone before some frame, for three turns.
struct Gone {
    before: u64,
    turns: u32,
    then: Gpu,
}

impl Trouble for Gone {
    fn turn(&mut self, headset: &mut StandIn, after: u64) -> Option<Turn> {
        if after != self.before || self.turns == 4 {
            return None;
        }
        self.turns += 1;
        if self.turns < 4 {
            return Some(Turn::Lost {
                cause: "the test took the runtime away".into(),
            });
        }
        headset.move_to(&self.then).unwrap();
        Some(Turn::Renewed)
    }
}

#[test]
fn a_loss_in_mid_pour_loses_no_particle() {
    let (first, second) = (gpu::device(), gpu::another_device(|_| {}));
    let folder = tempfile::tempdir().unwrap();
    let trouble = Gone {
        // 1.5 s: the stream runs.
        before: 45,
        turns: 0,
        then: Gpu::clone(&second),
    };
    let (keyframes, in_hand) = pour_at_once();
    let mut headset = Worn::new(&first, keyframes.sample_track(), 30.0, 75, trouble);
    let options = options_where(folder.path(), in_hand);
    let (outcome, track) = session_with(&mut headset, options, nobody());
    assert_eq!(outcome.renewals, 1);
    // No step in the first frame, none in the first one after the loss.
    assert_eq!(outcome.steps, 3 * 73);
    let state = outcome.world.snapshot().unwrap().solver;
    assert!((0..state.tags.len()).all(|slot| state.is_present(slot)));
    let measured = outcome.world.measure().unwrap();
    assert_eq!((measured.lost_particles, measured.nan_particles), (0, 0));
    // 150 g were in the first beaker; some have come to the second.
    assert!(
        measured.in_flasks[1] > 0.01,
        "it was not poured: {measured:?}"
    );
    // And it went on as if nothing had been: one device, never lost, comes to the same bits.
    let expected = hash(&outcome);
    assert_eq!(replayed(&first, track), expected);
}

/// The device is lost in some frames: before their steps, before their picture, and behind their end. A bench is placed anew in others.
struct Breaks {
    devices: Vec<Gpu>,
    before_steps: u64,
    before_picture: u64,
    behind_end: u64,
    recentres: [u64; 2],
}

impl Breaks {
    /// The device in use, of those that are left.
    fn lose(&mut self) {
        self.devices.remove(0).lose();
    }
}

impl Trouble for Breaks {
    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        frame.recentred = self.recentres.contains(&after);
        if after == self.before_steps {
            self.lose();
        }
    }
    fn acquires(&mut self, after: u64) {
        if after == self.before_picture {
            self.lose();
        }
    }
    fn ends(&mut self, after: u64) {
        if after == self.behind_end {
            self.lose();
        }
    }
}

/// The device goes with the runtime, while a full flask is in the hand, and is back with the hand 10 cm further on.
struct Both {
    device: Gpu,
    then: Gpu,
    turns: u32,
    /// Whether the device is lost by itself, in a frame that still has its steps to take.
    in_a_frame: bool,
}

/// At 30 Hz the flask is upright in the hand from 1.4 to 2 s.
const GONE: u64 = 48;

impl Trouble for Both {
    fn turn(&mut self, headset: &mut StandIn, after: u64) -> Option<Turn> {
        if self.in_a_frame || after != GONE || self.turns == 3 {
            return None;
        }
        self.turns += 1;
        self.device.lose();
        if self.turns < 3 {
            let cause = "the test took runtime and device away".into();
            return Some(Turn::Lost { cause });
        }
        headset.move_to(&self.then).unwrap();
        Some(Turn::Renewed)
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        if self.in_a_frame && after == GONE {
            self.device.lose();
        }
        if after > GONE || (after == GONE && !self.in_a_frame) {
            for hand in &mut frame.poses.hands {
                hand.stage_from_grip.position.x += 0.10;
            }
        }
    }
}

/// A device that each step loses anew is no accident: the session ends, and says so.
#[test]
fn a_device_that_is_lost_again_and_again_ends_the_session() {
    struct Always(Vec<Gpu>);
    impl Trouble for Always {
        fn frame(&mut self, _: &mut HeadsetFrame, after: u64) {
            if after >= 3 && !self.0.is_empty() {
                self.0.remove(0).lose();
            }
        }
    }
    let devices: Vec<_> = (0..4).map(|_| gpu::another_device(|_| {})).collect();
    let all: Vec<_> = devices.iter().map(|device| Gpu::clone(device)).collect();
    let mut others = all[1..].to_vec();
    let folder = tempfile::tempdir().unwrap();
    let mut headset = Worn::new(&devices[0], pour().sample_track(), 30.0, 20, Always(all));
    headset.inner = headset.inner.reopening(move || Ok(others.remove(0)));
    let session = Session::new(&headset, options(folder.path()), nobody()).unwrap();
    let failure = session.run(&mut headset).err().unwrap();
    assert!(failure.to_string().contains("device was lost"), "{failure}");
}

/// The device is lost when the new bench is ready. Where observations of the old one are still under way then, as on a software driver,
/// the attempt ends on the next device and the bench is built again there; where none is, the new bench is brought back.
#[test]
fn a_device_lost_at_a_scene_change_loses_neither_scene() {
    let (first, second) = (gpu::another_device(|_| {}), gpu::another_device(|_| {}));
    let folder = tempfile::tempdir().unwrap();
    let (sender, decisions) = channel();
    let trouble = StartsOver {
        asks: 5,
        decisions: sender,
    };
    let mut headset = Worn::new(&first, pour().sample_track(), 90.0, 16, trouble);
    let then = Gpu::clone(&second);
    headset.inner = headset.inner.reopening(move || Ok(then.clone()));
    let lost = Gpu::clone(&first);
    when_heard(TAKEN_UP, move || lost.lose());
    let (outcome, track) = session_with(&mut headset, options(folder.path()), decisions);
    assert_eq!((outcome.devices_lost, outcome.renewals), (1, 1));
    assert_eq!(outcome.attempts.len(), 2);
    assert_eq!(switched(&track, key::START), 1);
    assert_eq!(replayed(&second, track), hash(&outcome));
}

/// Taken off for a while.
struct Off(u32);

impl Trouble for Off {
    fn turn(&mut self, _: &mut StandIn, _: u64) -> Option<Turn> {
        let off = (20..30).contains(&self.0);
        self.0 += 1;
        off.then_some(Turn::Paused { cause: Pause::Off })
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, _: u64) {
        // A second passes meanwhile.
        if self.0 > 30 {
            frame.poses.info.xr_time += 1_000_000_000;
        }
    }
}

#[test]
fn nothing_happens_while_the_headset_is_off() {
    let gpu = gpu::device();
    let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, 40, Off(0));
    let (outcome, _) = run(&mut headset, |_| ());
    // 39 intervals less the one that was not seen.
    assert_eq!(outcome.steps, 38);
    assert_eq!(outcome.slowed, 0.0);
    // What nobody would have seen was not missed.
    assert_eq!(outcome.skipped, 0);
}

mod long {
    use super::*;

    /// Three times in a pour the device is lost, each time with all that lived on it, once just after a recentring with the full
    /// flask in the hand. The states that were read back and the steps since bring it back to the bit.
    #[test]
    fn lost_devices_in_mid_pour_lose_nothing() {
        let devices: Vec<_> = (0..4).map(|_| gpu::another_device(|_| {})).collect();
        let breaks = Breaks {
            devices: devices.iter().map(|device| Gpu::clone(device)).collect(),
            before_steps: 70,
            before_picture: 105,
            behind_end: 140,
            // 20 steps at most are between a state and the next.
            recentres: [60, 103],
        };
        let mut headset = Worn::new(&devices[0], pour().sample_track(), 30.0, 170, breaks);
        let mut others: Vec<_> = devices[1..]
            .iter()
            .map(|device| Gpu::clone(device))
            .collect();
        headset.inner = headset.inner.reopening(move || Ok(others.remove(0)));
        let (outcome, track) = run(&mut headset, |_| ());
        assert_eq!((outcome.devices_lost, outcome.renewals), (3, 3));
        // No step in the first frame, none in those that recentre, and none in the first after each loss.
        assert_eq!(outcome.steps, 3 * (170 - 1 - 2 - 3));
        let measured = outcome.world.measure().unwrap();
        assert_eq!((measured.lost_particles, measured.nan_particles), (0, 0));
        // It was poured out, over the bench, which recentrings moved away from under it.
        assert!(measured.in_flasks[0] < 0.1, "{measured:?}");
        // One device, never lost, comes to the same bits.
        let (recorded, replay) = replay_of(&devices[3], track, None);
        let found = replay.events;
        assert_eq!(replay.state_hash, hash(&outcome));
        // And so do the looks that were under way, which are made again.
        assert_eq!(recorded, found);
    }

    #[test]
    fn a_device_lost_with_its_runtime_spills_nothing() {
        for in_a_frame in [false, true] {
            let (first, second) = (gpu::another_device(|_| {}), gpu::another_device(|_| {}));
            let both = Both {
                device: Gpu::clone(&first),
                then: Gpu::clone(&second),
                turns: 0,
                in_a_frame,
            };
            let mut headset = Worn::new(&first, pour().sample_track(), 30.0, GONE + 10, both);
            let then = Gpu::clone(&second);
            headset.inner = headset.inner.reopening(move || Ok(then.clone()));
            let (outcome, track) = run(&mut headset, |_| ());
            assert_eq!((outcome.devices_lost, outcome.renewals), (1, 1));
            let measured = outcome.world.measure().unwrap();
            assert!(measured.in_flasks[0] > 0.1499, "{in_a_frame}: {measured:?}");
            assert_eq!(outcome.world.holder(0), Some(1));
            assert_eq!(replayed(&second, track), hash(&outcome));
        }
    }
}
