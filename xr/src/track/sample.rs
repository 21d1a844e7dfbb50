//! From keyframes to frames at a fixed rate.

use std::collections::BTreeMap;

use super::keyframes::Keyframes;
use super::{Track, TrackMetadata};
use crate::{FrameInfo, Pose, PoseFrame};

impl Keyframes {
    /// Time of frame `step`, s, on a clock of [`rate_hz`](Self::rate_hz).
    fn time(&self, step: u64) -> f64 {
        step as f64 / self.rate_hz
    }

    /// The user at time `t`, s, as the frame of simulation step `step`. The frame's scenario
    /// is empty: a switch belongs to a span of time, not to a point.
    pub fn sample(&self, step: u64, t: f64) -> PoseFrame {
        let time_ns = (t * 1e9).round() as i64;
        // Checked when read: there is a head.
        let stage_from_view = self
            .head
            .at(t)
            .map_or(Pose::IDENTITY, |key| self.head.pose(&key));
        PoseFrame {
            step,
            time_ns,
            stage_from_view,
            hands: self.hands.each_ref().map(|path| path.hand(t)),
            scenario: Vec::new(),
            info: FrameInfo {
                xr_time: time_ns,
                period_ns: (1e9 / self.rate_hz).round() as i64,
                ..FrameInfo::default()
            },
        }
    }

    /// The track: frames at [`rate_hz`](Self::rate_hz) from 0 to the duration, a switch in
    /// the first frame at or after its time, or in the last one.
    pub fn sample_track(&self) -> Track {
        // A hair more than whole, so that 9 s at 90 Hz has its frame 810 in spite of rounding.
        let last = (self.duration * self.rate_hz + 1e-9).floor() as u64;
        let mut switches = self.scenario.iter().peekable();
        let frames: Vec<PoseFrame> = (0..=last)
            .map(|step| {
                let t = self.time(step);
                let mut frame = self.sample(step, t);
                while let Some((_, switch)) = switches.next_if(|(at, _)| *at <= t || step == last) {
                    frame.scenario.push(switch.clone());
                }
                frame
            })
            .collect();
        Track {
            events: Vec::new(),
            progress: Vec::new(),
            metadata: TrackMetadata {
                scene: self.scene.clone(),
                seed: self.seed,
                parameters: [("track".to_owned(), self.name.clone())].into(),
                program_version: env!("CARGO_PKG_VERSION").into(),
                scenes: BTreeMap::new(),
            },
            stage_from_flasks: vec![Vec::new(); frames.len()],
            frames,
            recovered: false,
            outcome: BTreeMap::new(),
        }
    }
}
