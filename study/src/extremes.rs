//! Cases at the extremes of scene, parameter and motion, and the criteria that each of them has to meet.
//!
//! A case is a scene as text, since a scene that cannot be simulated has to be refused when it is loaded; a script for one hand; and where
//! a scene cannot express it, a changed state at the start. All of it follows from the case's number and the seed.

mod case;
mod drive;
mod extreme;
mod judge;
mod motion;
mod recipe;
mod report;
mod surface;

pub use case::{Case, cases};
pub use judge::{Finding, Verdict, judge};
pub use report::{Extremes, describe, merge, summary};
