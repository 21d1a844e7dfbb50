//! Incidents in words and as a table.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod caps;
mod said;
mod table;
