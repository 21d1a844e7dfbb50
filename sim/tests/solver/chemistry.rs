//! Lines 26 and 27 of a liquid with a chemistry, the paper's and the physical one.

mod air;
mod boiling;
pub mod bubbles;
mod bubbly_liquid;
mod churned;
mod conserved;
mod dew;
mod dew_of_scenes;
mod displaced;
mod dormant;
mod extremes;
mod figures;
mod idle;
mod kettles;
mod layers;
mod losses;
mod mixing_line;
mod nuclei;
mod paper;
mod physical;
mod scenes;
pub mod setup;
pub mod spray;
mod steam;
mod swarms;
mod work;
