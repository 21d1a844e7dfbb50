//! What a session records: its steps, what was switched before them, and simulated time.

use std::path::Path;

use vitriol_experiment::switches::{SWITCH_SCENE, SWITCH_START};
use vitriol_experiment::track::{
    DEVICE, DRIVER, LANGUAGE, LESSON, LESSON_HASH, MODE, PRESET, STATE_HASH,
};
use vitriol_experiment::{DeviceStatement, Failure, Instruction, SimulatedTime, Wish, track};
use vitriol_lesson::Event;
use vitriol_lesson::procedure::Progress;
use vitriol_xr::track::TrackMetadata;
use vitriol_xr::{Pose, PoseFrame, Switch};

use super::guide::Course;
use crate::choices::CHOICES;
use crate::vr::record::{Note, RecordingStatus, TrackRecording};
use crate::vr::workbench::Plan;

/// Numbers the steps, gives each what was switched before it, and records it where there is a recording.
#[derive(Default)]
pub(super) struct SessionTrack {
    /// `None` in a session that nobody records.
    recording: Option<TrackRecording>,
    /// Switches since the last step. They go with the next one, before which a replay does them.
    switches: Vec<Switch>,
    time: SimulatedTime,
    /// What was asked of the lesson before steps that were taken, each with simulated time before its step, s.
    asked: Vec<(f64, Wish)>,
    /// What was found so far.
    pub events: Vec<Event>,
}

impl SessionTrack {
    /// The track of a session that begins with `plan` on `device` and goes through `course`, recorded to a new `file` if one is named.
    pub fn new(
        file: Option<&Path>,
        (plan, course): (&Plan, Option<&Course>),
        device: &DeviceStatement,
    ) -> Result<Self, Failure> {
        let metadata = || metadata(plan, course, device);
        let recording = file.map(|file| TrackRecording::create(file, &metadata()));
        Ok(Self {
            recording: recording.transpose().map_err(track::blame)?,
            ..Self::default()
        })
    }

    /// Something was switched, which the next step is the first to be taken with.
    pub fn switch(&mut self, switch: Switch) {
        self.switches.push(switch);
    }

    /// Whether something was switched since the last step that a replay has to do as well: another bench, or what an
    /// instructor did, or what was asked of the lesson.
    pub fn awaits_step(&self) -> bool {
        let counts =
            |it: &Switch| brings_up(it) || Instruction::of(it).is_some() || Wish::of(it).is_some();
        self.switches.iter().any(counts)
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
        let mut asked = Vec::new();
        for switch in &step.scenario {
            if brings_up(switch) {
                // What was asked before that is of no step that was taken.
                asked.clear();
            } else if let Some(Ok(wish)) = Wish::of(switch) {
                asked.push((self.time.seconds(), wish));
            }
        }
        self.asked.append(&mut asked);
        self.time.advance(frame_time);
    }

    /// Simulated time at the end of the last step, s.
    pub fn seconds(&self) -> f64 {
        self.time.seconds()
    }

    /// Something was found, which goes into the recording where there is one.
    pub fn found(&mut self, events: Vec<Event>) {
        if let Some(recording) = &mut self.recording {
            for event in &events {
                // A struct of numbers and texts has a JSON; what is not finite becomes null.
                let json = serde_json::to_string(event).unwrap_or_default();
                recording.found(nanoseconds(&self.time), Note::Event(json));
            }
        }
        self.events.extend(events);
    }

    /// What was asked of the lesson before steps that were taken since the last call, each with simulated time before its step, s.
    pub fn asked(&mut self) -> Vec<(f64, Wish)> {
        std::mem::take(&mut self.asked)
    }

    /// Something was said of the lesson, which goes into the recording where there is one.
    pub fn progressed(&mut self, said: &[Progress]) {
        if let Some(recording) = &mut self.recording {
            for progress in said {
                let json = serde_json::to_string(progress).unwrap_or_default();
                recording.found(nanoseconds(&self.time), Note::Progress(json));
            }
        }
    }

    /// Seconds that were recorded, and how the recording stands; `None` without one.
    pub fn state(&self) -> Option<(f64, RecordingStatus)> {
        let recording = self.recording.as_ref()?;
        Some((self.time.seconds(), recording.state()))
    }

    /// Marks the recording's end in the state of `hash`, and waits for its file.
    ///
    /// # Errors
    /// What `hash` returns, which is asked for where there is a recording.
    pub fn finish(self, hash: impl FnOnce() -> Result<u64, Failure>) -> Result<Finished, Failure> {
        let (steps, end_ns) = (self.time.steps(), nanoseconds(&self.time));
        let Some(recording) = self.recording else {
            return Ok(Finished {
                time: self.time,
                events: self.events,
                recorded: None,
            });
        };
        let outcome = [(STATE_HASH.to_owned(), format!("{:016x}", hash()?))].into();
        let recorded = recording.finish(steps, end_ns, outcome);
        Ok(Finished {
            time: self.time,
            events: self.events,
            recorded: Some(recorded),
        })
    }
}

/// A session's track at its end.
pub(super) struct Finished {
    pub time: SimulatedTime,
    /// What was found.
    pub events: Vec<Event>,
    /// What became of the recording, if there was one.
    pub recorded: Option<RecordingStatus>,
}

/// Whether it brings up a scene from its start.
fn brings_up(switch: &Switch) -> bool {
    [SWITCH_SCENE, SWITCH_START].contains(&&*switch.key)
}

/// With all scenes that the session may bring up: a crash leaves no time to add the one that it did.
fn metadata(plan: &Plan, course: Option<&Course>, device: &DeviceStatement) -> TrackMetadata {
    let choices = CHOICES.iter().map(|choice| choice.scene);
    let scenes = choices
        .chain(plan.scenes.own())
        .chain([plan.scene.as_str()]);
    let scenes = scenes.filter_map(|name| {
        let text = plan.scenes.text(name)?;
        Some((name.to_owned(), text.to_owned()))
    });
    let parameters = [
        (PRESET, plan.preset.name()),
        (DEVICE, &device.name),
        (DRIVER, &device.driver),
    ];
    let of_course = course.map(|it| {
        [
            (LESSON, it.lesson.name.as_str()),
            (LESSON_HASH, it.lesson.hash()),
            (MODE, it.mode.name()),
            (LANGUAGE, it.language.code()),
        ]
    });
    let parameters = parameters
        .into_iter()
        .chain(of_course.into_iter().flatten());
    TrackMetadata {
        scene: plan.scene.clone(),
        seed: plan.seed,
        parameters: parameters
            .map(|(name, value)| (name.to_owned(), value.to_owned()))
            .collect(),
        program_version: env!("CARGO_PKG_VERSION").into(),
        scenes: scenes.collect(),
    }
}

fn nanoseconds(time: &SimulatedTime) -> i64 {
    (1e9 * time.seconds()).round() as i64
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_experiment::Scenes;
    use vitriol_sim::scene::{Preset, Scene};
    use vitriol_xr::track::Track;
    use vitriol_xr::{FrameInfo, Hand};

    fn plan() -> Plan {
        Plan {
            scene: "two-flasks".into(),
            scenes: Scenes::default(),
            preset: Preset::Fast,
            solver: None,
            filter: None,
            tint: None,
            room: None,
            breakable: false,
            seed: 7,
        }
    }

    fn device() -> DeviceStatement {
        DeviceStatement {
            name: "a device".into(),
            driver: "a driver 1.2".into(),
            api: "1.3".into(),
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
        let mut track = SessionTrack::new(Some(&file), (&plan(), None), &device()).unwrap();
        track.switch(switch("a"));
        track.step(poses(), 0.01, Vec::new);
        track.step(poses(), 0.01, Vec::new);
        track.switch(switch("b"));
        track.switch(switch("c"));
        // A scene with another step.
        track.step(poses(), 0.02, Vec::new);
        let Finished { time, recorded, .. } = track.finish(|| Ok(0xabc)).unwrap();
        assert_eq!((time.steps(), recorded.unwrap().steps), (3, 3));
        assert!((time.seconds() - 0.04).abs() < 1e-12);

        let track = Track::open(&file).unwrap();
        assert_eq!(track.metadata.scene, "two-flasks");
        assert_eq!(track.metadata.parameters["preset"], "fast");
        assert_eq!(track.metadata.parameters["device"], "a device");
        assert_eq!(track.metadata.parameters["driver"], "a driver 1.2");
        assert_eq!(track.outcome["state_hash"], "0000000000000abc");
        // Its own, and those that the user may choose.
        for name in ["two-flasks", "acid-into-water", "vr-dilution"] {
            let text = &track.metadata.scenes[name];
            assert_eq!(text, Scene::builtin_text(name).unwrap());
        }
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

    /// What was asked of the lesson counts from the step on that it comes with, and not for a scene that is brought up meanwhile.
    #[test]
    fn what_is_asked_of_a_lesson_waits_for_a_step() {
        let mut track = SessionTrack::new(None, (&plan(), None), &device()).unwrap();
        track.step(poses(), 0.01, Vec::new);
        track.switch(Wish::Finish.switch());
        assert!(track.awaits_step() && track.asked().is_empty());
        track.switch(switch("two-flasks"));
        let hint = Wish::Hint("lift".into());
        track.switch(hint.switch());
        track.step(poses(), 0.01, Vec::new);
        track.step(poses(), 0.01, Vec::new);
        assert_eq!(track.asked(), [(0.01, hint)]);
        assert!(!track.awaits_step() && track.asked().is_empty());
    }

    #[test]
    fn a_recording_that_is_there_is_not_overwritten() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("x.mcap");
        std::fs::write(&file, "mine").unwrap();
        let made = SessionTrack::new(Some(&file), (&plan(), None), &device());
        assert!(matches!(made.err(), Some(Failure::Input(_))));
        assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    }
}
