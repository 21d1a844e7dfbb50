//! Limits of a track. A track may come from anyone, so each size has a limit that no recording reaches.

/// Bytes of a track's file: three hours of 90 Hz take a quarter of it (240 B a step).
pub const FILE: u64 = 1 << 30;
/// Bytes of all its records unpacked, of which a writer's messages are half at most: a chunk may pack hundreds to one.
pub(super) const RECORDS: u64 = 4 << 30;
/// Bytes of a keyframe file.
pub(super) const KEYFRAMES: u64 = 16 << 20;
/// Bytes of a message. A frame of [`FLASKS`] takes 10 kB.
pub(super) const MESSAGE: usize = 64 << 10;
/// Frames: 2.8 hours at 100 Hz.
pub const FRAMES: usize = 1_000_000;
/// Time of the last frame, s.
pub const SECONDS: i64 = 3 * 3600;
/// Flasks of a frame.
pub const FLASKS: usize = 64;
/// Transforms of a frame, those of other programs among them.
pub(super) const TRANSFORMS: usize = 256;
/// Switches in all: each may start a scene.
pub const SWITCHES: usize = 10_000;
/// Events of the session, and as many changes in its lesson: some dozen an attempt.
pub const EVENTS: usize = 100_000;
/// Scenes that it carries.
pub const SCENES: usize = 64;
/// Bytes of a scene's text.
pub const SCENE: usize = 256 << 10;
/// Bytes of a name, a parameter or a switch.
pub(super) const TEXT: usize = 4096;
/// Parameters, and entries of the outcome.
pub(super) const PARAMETERS: usize = 256;
