//! Incidents in words, in points and as a table.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod caps;
mod said;
mod scored;
mod table;
