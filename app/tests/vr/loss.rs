//! A runtime that goes away in mid-pour and comes back with another device.

use crate::common::{Trouble, Worn, carried, hash, nobody, pour, session};
use std::sync::Arc;
use vitriol::vr::stand_in::StandIn;
use vitriol_experiment::{Observer, Progress, Setup, Span, on_device};
use vitriol_gpu::Gpu;
use vitriol_shaders::Library;
use vitriol_sim::scene::Preset;
use vitriol_tests::gpu;
use vitriol_xr::track::{Track, TrackSource};
use vitriol_xr::{HeadsetFrame, Pause, Turn};

/// What `vitriol replay` makes of a track: the hash of its end.
pub fn replayed(gpu: &Gpu, track: Track) -> u64 {
    let name = track.metadata.scene.clone();
    let scenes = carried(&track);
    let scene = scenes.get(&name).unwrap();
    let mut experiment = on_device(
        gpu,
        &Setup {
            scene: &scene,
            scene_name: &name,
            scenes: &scenes,
            preset: Preset::Balanced,
            seed: track.metadata.seed,
            device: None,
            picture: None,
            colours: Vec::new(),
            eyes: 1,
            filter: None,
            head: None,
            shaders: Arc::new(Library::embedded()),
        },
    )
    .unwrap();
    let span = Span::covering(track.duration(), scene.scale.frame_time);
    let mut observer = Observer::new(span, Vec::new(), Progress::hidden());
    let mut source = TrackSource::new(track);
    vitriol_experiment::run(&mut source, experiment.as_mut(), span, &mut observer).unwrap();
    experiment.outcome().unwrap().state_hash
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
        // 4.7 s: the stream runs.
        before: 140,
        turns: 0,
        then: Gpu::clone(&second),
    };
    let mut headset = Worn::new(&first, pour().sample_track(), 30.0, 170, trouble);
    let (outcome, track) = session(&mut headset, folder.path(), nobody());
    assert_eq!(outcome.renewals, 1);
    // No step in the first frame, none in the first one after the loss.
    assert_eq!(outcome.steps, 3 * 168);
    let state = outcome.bench.world.snapshot().unwrap().solver;
    assert!((0..state.tags.len()).all(|slot| state.is_present(slot)));
    let measured = outcome.bench.world.measure().unwrap();
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
    let folder = tempfile::tempdir().unwrap();
    let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, 40, Off(0));
    let (outcome, _) = session(&mut headset, folder.path(), nobody());
    // 39 intervals less the one that was not seen.
    assert_eq!(outcome.steps, 38);
    assert_eq!(outcome.slowed, 0.0);
    // What nobody would have seen was not missed.
    assert_eq!(outcome.skipped, 0);
}
