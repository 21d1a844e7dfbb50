//! A system on which nothing can be played.

use std::sync::mpsc::Sender;

use super::player::Player;
use super::{DeviceName, OutputError, Shared};

/// A thread handle that stops nothing.
#[derive(Debug)]
pub(super) struct Stop;

pub(super) fn play(
    _: Option<&str>,
    _: Player,
    _: &std::sync::Arc<Shared>,
    ready: &Sender<Result<Stop, OutputError>>,
) {
    let _ = ready.send(Err(OutputError::Unsupported));
}

pub(super) fn devices() -> Result<Vec<DeviceName>, OutputError> {
    Err(OutputError::Unsupported)
}
