//! How much a track may hold. A track may come from anyone, so each size has an end that no recording reaches.

/// Of a track's file, B: three hours of 90 Hz take a quarter of it (240 B a step).
pub const FILE: u64 = 1 << 30;
/// Of all its records unpacked, B, of which a writer's messages are half at most: a chunk may pack hundreds to one.
pub(super) const RECORDS: u64 = 4 << 30;
/// Of a keyframe file, B.
pub(super) const KEYFRAMES: u64 = 16 << 20;
/// Of a message, B. A frame of [`FLASKS`] takes 10 kB.
pub(super) const MESSAGE: usize = 64 << 10;
/// Frames: 2.8 hours at 100 Hz.
pub const FRAMES: usize = 1_000_000;
/// Time of the last frame, s.
pub const SECONDS: i64 = 3 * 3600;
/// Flasks of a frame.
pub const FLASKS: usize = 64;
/// Transforms of a frame, those of other programs among them.
pub(super) const TRANSFORMS: usize = 256;
/// Switches in all: each may bring up a scene.
pub const SWITCHES: usize = 10_000;
/// What was found in the session, and likewise what was said of its lesson: some dozen an attempt.
pub const EVENTS: usize = 100_000;
/// Scenes that it carries.
pub const SCENES: usize = 64;
/// Of a scene's text, B.
pub const SCENE: usize = 256 << 10;
/// Of a name, a parameter or a switch, B.
pub(super) const TEXT: usize = 4096;
/// Parameters, and what is said at the end.
pub(super) const PARAMETERS: usize = 256;
