//! Permission to see and direct: one code a browser, then a cookie; one key for the students' programs.

mod code;
mod gate;
mod lockout;
mod site;

pub use code::NoRandomness;
pub(crate) use code::{Secret, hexadecimal};
pub(crate) use gate::{Gate, Refusal, SessionId};
pub(crate) use site::Site;
