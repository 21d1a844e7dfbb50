//! A track as a pose source.

use std::sync::Arc;

use super::Track;
use crate::{Pose, PoseFrame, PoseSource, SourceError};

/// Frames further apart than this have a gap between them, in which the last pose is held:
/// 100 ms is two frames of the slowest display (20 Hz), and a hand that was lost for longer
/// did not come back along a straight line.
const GAP_NS: i64 = 100_000_000;

/// A time this close to a frame's own counts as the frame's own. Step times computed in f64 and times stored in ns differ by at most 1 ns;
/// no display is near a rate of 1 MHz.
const SAME_NS: i64 = 1_000;

/// Plays a track back on the simulation's clock.
///
/// Asked for the steps and times that were recorded, it gives the recorded poses, bit for
/// bit; at times between two frames it interpolates poses and analogue values, and takes
/// the rest from the earlier frame. Before the first frame it gives the first frame's poses.
#[derive(Clone, Debug)]
pub struct TrackSource {
    track: Arc<Track>,
    /// Per frame, both hands' grip and aim as held: where a hand is not valid, its last valid
    /// poses (before any was valid, the recorded ones).
    held: Vec<[[Pose; 2]; 2]>,
    /// Number of frames whose switches have been returned.
    switched: usize,
}

impl TrackSource {
    /// A source at the track's start.
    pub fn new(track: impl Into<Arc<Track>>) -> Self {
        let track = track.into();
        let held = hold(&track.frames);
        Self {
            track,
            held,
            switched: 0,
        }
    }

    /// The track that is played.
    pub fn track(&self) -> &Track {
        &self.track
    }

    /// Frame `index` with its invalid poses held.
    fn frame(&self, index: usize) -> PoseFrame {
        let mut frame = self.track.frames[index].clone();
        for (hand, [grip, aim]) in frame.hands.iter_mut().zip(self.held[index]) {
            hand.stage_from_grip = grip;
            hand.stage_from_aim = aim;
        }
        frame
    }

    /// The poses at `time_ns`, which is not past the last frame.
    fn at(&self, time_ns: i64) -> PoseFrame {
        let frames = &self.track.frames;
        let later =
            frames.partition_point(|frame| frame.time_ns <= time_ns.saturating_add(SAME_NS));
        let Some(index) = later.checked_sub(1) else {
            return PoseFrame {
                time_ns,
                ..self.frame(0)
            };
        };
        let mut frame = self.frame(index);
        let since = time_ns - frame.time_ns;
        if since.abs() <= SAME_NS {
            return frame;
        }
        if let Some(next) = frames.get(later) {
            let apart = next.time_ns - frame.time_ns;
            if apart <= GAP_NS {
                let s = (since as f64 / apart as f64) as f32;
                frame = frame.between(&self.frame(later), s);
            }
        }
        frame.time_ns = time_ns;
        frame
    }
}

impl PoseSource for TrackSource {
    fn next(&mut self, step: u64, time: f64) -> Result<Option<PoseFrame>, SourceError> {
        if !time.is_finite() || time < 0.0 {
            return Err(SourceError::Time { step, time });
        }
        // Saturates for times that no track reaches.
        let time_ns = (time * 1e9).round() as i64;
        let Some(last) = self.track.frames.last() else {
            return Ok(None);
        };
        if time_ns.saturating_sub(SAME_NS) > last.time_ns {
            return Ok(None);
        }
        let mut frame = self.at(time_ns);
        frame.step = step;
        frame.scenario.clear();
        let due = self.track.frames[self.switched..]
            .iter()
            .take_while(|recorded| recorded.time_ns <= time_ns.saturating_add(SAME_NS));
        let mut passed = 0;
        for recorded in due {
            frame.scenario.extend_from_slice(&recorded.scenario);
            passed += 1;
        }
        self.switched += passed;
        Ok(Some(frame))
    }
}

fn hold(frames: &[PoseFrame]) -> Vec<[[Pose; 2]; 2]> {
    let mut last: [Option<[Pose; 2]>; 2] = [None; 2];
    frames
        .iter()
        .map(|frame| {
            let mut now = [[Pose::IDENTITY; 2]; 2];
            for ((hand, last), now) in frame.hands.iter().zip(&mut last).zip(&mut now) {
                let recorded = [hand.stage_from_grip, hand.stage_from_aim];
                if hand.valid {
                    *last = Some(recorded);
                }
                *now = last.unwrap_or(recorded);
            }
            now
        })
        .collect()
}
