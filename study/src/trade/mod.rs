//! The trade of speed for accuracy: knobs, what each costs, and how far off what
//! comes of it is from what is known without it.

mod boil;
mod exact;
mod front;
mod order;
mod page;
mod plot;
pub mod report;
mod setting;
mod sweep;
mod tank;
mod vouch;

pub use boil::{Boiled, Quartiles, Seeds, boil, quartiles};
pub use exact::{centre_of_mass, retained};
pub use front::{front, observed_order};
pub use order::{Convergence, convergence};
pub use page::page;
pub use report::{Errors, Point, Trade, describe};
pub use setting::{Knob, Setting};
pub use sweep::{finest, sweep};
pub use tank::{Cost, Rested, Tipped, rest, tip};
pub use vouch::{Vouched, vouch};
