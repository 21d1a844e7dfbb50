//! A keyframed track as Monado's head and hands, at the pace of the program that it drives.

use std::path::Path;
use std::time::Instant;

use vitriol_tests::monado::{Controller, Remote, Rig};
use vitriol_tests::wait::PATIENCE;
use vitriol_xr::track::Keyframes;
use vitriol_xr::{Hand, Pose, PoseFrame, Side};

use crate::headset::program::{Program, Seen};

/// Track time from one pose to the next, s. A frame simulates as much or little more, so that liquid
/// and hand go equally fast, however long a frame takes.
const TICK: f64 = 0.05;

/// The pour that is driven.
pub fn track() -> Keyframes {
    let text = include_str!("../../../../xr/tracks/two-flasks.toml");
    Keyframes::parse(text, Path::new("two-flasks.toml")).unwrap()
}

/// Sends a track's poses, each when a frame has shown the one before: on a busy machine all goes
/// slower, and nothing leaps.
pub struct Driver {
    track: Keyframes,
    remote: Remote,
    /// How many ticks the track has gone.
    tick: u32,
    /// What was sent; it holds until the next.
    pub sent: Vec<PoseFrame>,
}

impl Driver {
    /// At the track's start.
    pub fn start(rig: &Rig, track: Keyframes) -> Self {
        let mut driver = Self {
            track,
            remote: rig.remote(),
            tick: 0,
            sent: Vec::new(),
        };
        driver.send(true);
        driver
    }

    /// Track time, s.
    fn time(&self) -> f64 {
        (TICK * f64::from(self.tick)).min(self.track.duration)
    }

    fn send(&mut self, awake: bool) {
        let mut frame = self.track.sample(0, self.time());
        if !awake {
            frame.hands = [Hand::default(), Hand::default()];
        }
        send(&mut self.remote, &frame).unwrap();
        self.sent.push(frame);
    }

    /// Goes on until the track is there, s.
    pub fn reach(&mut self, program: &mut Program, time: f64) {
        while self.time() < time {
            self.tick += 1;
            self.send(true);
            self.arrive(program);
        }
    }

    /// Goes on until the track is through.
    pub fn finish(&mut self, program: &mut Program) {
        self.reach(program, self.track.duration);
    }

    /// Begins the track anew.
    pub fn restart(&mut self, program: &mut Program) {
        self.tick = 0;
        self.send(true);
        self.arrive(program);
    }

    /// Switches the controllers off, or on again.
    pub fn sleep(&mut self, program: &mut Program, asleep: bool) {
        self.send(!asleep);
        self.arrive(program);
    }

    /// Takes hold of a service that was started again, where the track is.
    pub fn connect(&mut self, rig: &Rig) {
        self.remote = rig.remote();
        self.send(true);
    }

    /// Waits for a frame that shows what was sent last.
    pub fn arrive(&self, program: &mut Program) {
        let begun = Instant::now();
        let last = &self.sent[self.sent.len() - 1];
        while !shows(program.frame(), last) {
            assert!(begun.elapsed() < PATIENCE, "{last:?} is not seen");
        }
    }
}

/// Whether a frame shows these poses, to the rounding of a quaternion's normalisation.
pub fn shows(seen: &Seen, sent: &PoseFrame) -> bool {
    let same = |a: &Pose, b: &Pose| {
        a.position.distance(b.position) < 1e-5
            && a.orientation.dot(b.orientation).abs() > 1.0 - 1e-5
    };
    let hand = sent.hand(Side::Right);
    let right = match &seen.right {
        Some((grip, squeeze)) => {
            hand.active && same(grip, &hand.stage_from_grip) && *squeeze == hand.squeeze
        }
        None => !hand.active,
    };
    right && same(&seen.head, &sent.stage_from_view)
}

fn send(remote: &mut Remote, frame: &PoseFrame) -> std::io::Result<()> {
    let head = &frame.stage_from_view;
    remote.head(head.position, head.orientation);
    for side in Side::BOTH {
        let hand = frame.hand(side);
        let grip = &hand.stage_from_grip;
        remote.controller(
            side as usize,
            &Controller {
                position: grip.position,
                orientation: grip.orientation,
                squeeze: hand.squeeze,
                trigger: hand.trigger,
                active: hand.active,
                ..Controller::default()
            },
        );
    }
    remote.send()
}
