//! What a session records: its steps, what was switched before them, and simulated time.

use std::path::Path;

use vitriol_experiment::{Failure, SimulatedTime, track};
use vitriol_xr::track::TrackMetadata;
use vitriol_xr::{Pose, PoseFrame, Switch};

use crate::vr::record::{RecordingStatus, TrackRecording};
use crate::vr::workbench::Plan;

/// Numbers the steps, gives each what was switched before it, and records it where there is a recording.
#[derive(Default)]
pub(super) struct SessionTrack {
    /// `None` in a session that nobody records.
    recording: Option<TrackRecording>,
    /// Switches since the last step. They go with the next one, before which a replay does them.
    switches: Vec<Switch>,
    time: SimulatedTime,
}

impl SessionTrack {
    /// The track of a session that begins with `plan`, recorded to a new `file` if one is named.
    pub fn new(file: Option<&Path>, plan: &Plan) -> Result<Self, Failure> {
        let recording = file.map(|file| TrackRecording::create(file, &metadata(plan)));
        Ok(Self {
            recording: recording.transpose().map_err(track::blame)?,
            ..Self::default()
        })
    }

    /// Something was switched, which the next step is the first to be taken with.
    pub fn switch(&mut self, switch: Switch) {
        self.switches.push(switch);
    }

    /// A step of `frame_time` (s) was taken, which consumed `poses`; `flasks` are those after it.
    pub fn step(&mut self, poses: PoseFrame, frame_time: f64, flasks: impl FnOnce() -> Vec<Pose>) {
        let step = PoseFrame {
            step: self.time.steps(),
            time_ns: nanoseconds(&self.time),
            scenario: std::mem::take(&mut self.switches),
            ..poses
        };
        if let Some(recording) = &mut self.recording {
            recording.push(&step, flasks());
        }
        self.time.advance(frame_time);
    }

    /// Seconds that were recorded, and how the recording stands; `None` without one.
    pub fn state(&self) -> Option<(f64, RecordingStatus)> {
        let recording = self.recording.as_ref()?;
        Some((self.time.seconds(), recording.state()))
    }

    /// Marks the recording's end and waits for its file; the time at the end, and what became of the recording.
    pub fn finish(self) -> (SimulatedTime, Option<RecordingStatus>) {
        let (steps, end_ns) = (self.time.steps(), nanoseconds(&self.time));
        let recorded = self.recording.map(|it| it.finish(steps, end_ns));
        (self.time, recorded)
    }
}

fn metadata(plan: &Plan) -> TrackMetadata {
    TrackMetadata {
        scene: plan.scene.clone(),
        seed: plan.seed,
        parameters: [("preset".to_owned(), plan.preset.name().to_owned())].into(),
        program_version: env!("CARGO_PKG_VERSION").into(),
    }
}

fn nanoseconds(time: &SimulatedTime) -> i64 {
    (1e9 * time.seconds()).round() as i64
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_sim::scene::Preset;
    use vitriol_xr::track::Track;
    use vitriol_xr::{FrameInfo, Hand};

    fn plan() -> Plan {
        Plan {
            scene: "two-flasks".into(),
            preset: Preset::Fast,
            solver: None,
            filter: None,
            seed: 7,
        }
    }

    /// What a step consumed; its number, time and switches are the track's to say.
    fn poses() -> PoseFrame {
        PoseFrame {
            step: 99,
            time_ns: 99,
            stage_from_view: Pose::IDENTITY,
            hands: [Hand::default(), Hand::default()],
            scenario: Vec::new(),
            info: FrameInfo::default(),
        }
    }

    fn switch(value: &str) -> Switch {
        Switch {
            key: "scene".into(),
            value: value.into(),
        }
    }

    #[test]
    fn steps_are_numbered_and_carry_what_was_switched_before_them() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("x.mcap");
        let mut track = SessionTrack::new(Some(&file), &plan()).unwrap();
        track.switch(switch("a"));
        track.step(poses(), 0.01, Vec::new);
        track.step(poses(), 0.01, Vec::new);
        track.switch(switch("b"));
        track.switch(switch("c"));
        // A scene with another step.
        track.step(poses(), 0.02, Vec::new);
        let (time, recorded) = track.finish();
        assert_eq!((time.steps(), recorded.unwrap().steps), (3, 3));
        assert!((time.seconds() - 0.04).abs() < 1e-12);

        let track = Track::open(&file).unwrap();
        assert_eq!(track.metadata.scene, "two-flasks");
        assert_eq!(track.metadata.parameters["preset"], "fast");
        let frames = track.frames.iter();
        let said: Vec<_> = frames
            .map(|frame| {
                let values = frame.scenario.iter().map(|it| it.value.as_str());
                (frame.step, frame.time_ns, values.collect::<Vec<_>>())
            })
            .collect();
        // The last marks the end.
        let expected = [
            (0, 0, vec!["a"]),
            (1, 10_000_000, vec![]),
            (2, 20_000_000, vec!["b", "c"]),
            (3, 40_000_000, vec![]),
        ];
        assert_eq!(said, expected);
    }

    #[test]
    fn a_recording_that_is_there_is_not_overwritten() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("x.mcap");
        std::fs::write(&file, "mine").unwrap();
        let made = SessionTrack::new(Some(&file), &plan());
        assert!(matches!(made.err(), Some(Failure::Input(_))));
        assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    }
}
