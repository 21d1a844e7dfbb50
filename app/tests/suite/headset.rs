//! `vitriol vr` in a headset from end to end: against Monado, which a track drives, and against the mock runtime, which does
//! what Monado does not.

mod drive;
mod hold;
mod inset;
mod loss;
mod manifest;
mod moved;
mod pour;
mod program;
