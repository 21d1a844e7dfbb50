//! The trade of speed for accuracy: the solver's knobs, the cost of each, and the error of its result against results that do not depend
//! on the solver.

mod boil;
pub mod constants;
mod exact;
mod front;
mod order;
mod page;
pub(crate) mod plot;
pub mod report;
mod setting;
mod shader_constants;
mod sweep;
mod tank;
mod vouch;

pub use boil::{Boiled, Seeds, boil};
pub use order::convergence;
pub use page::page;
pub use report::{Errors, Point, Trade, describe, merge};
pub use setting::{Knob, Setting};
pub use sweep::{finest, sweep};
pub use tank::{Tipped, rest, tip};
pub use vouch::vouch;
