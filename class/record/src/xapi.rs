//! Statements of the Experience API, 1.0.3 (IEEE 9274.1.1's predecessor, which every store accepts): a student's attempts, as other
//! programs for learning read them.

mod activity;
mod incident;
mod statement;
mod vocabulary;

pub use statement::{Statement, statements};
pub use vocabulary::{KEYS, Key, OURS};
