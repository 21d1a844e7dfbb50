//! A session in a headset or a window: the frame loop that feeds the flasks from live hands.
//!
//! `session` is the loop, over the trait [`Headset`](vitriol_xr::Headset) that an OpenXR session, the stand-in and a
//! window implement. The other files hold its parts, which do not depend on it. `docs/headset.md` lists what happens in a
//! frame, in that order.

pub mod blame;
pub mod clock;
pub mod closing;
pub mod decision;
pub mod desk;
pub mod fade;
pub mod first_minute;
pub mod foveating;
mod frame_clock;
pub mod governor;
pub mod handle;
pub mod haptics;
pub mod hold;
pub mod info;
pub mod inputs;
pub mod ladder;
pub mod latch;
mod listing;
pub mod menu;
pub mod mirror;
mod painter;
pub mod panel;
pub mod picture;
pub mod placement;
mod projection;
pub mod rates;
mod reopening;
pub mod session;
pub mod sign;
pub mod stand_in;
pub mod tally;
mod view;
pub mod workbench;
