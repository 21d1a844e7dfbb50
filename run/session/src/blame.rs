//! Whose fault a headset's error is.

use vitriol_xr::HeadsetError;

use vitriol_run::Failure;

/// A missing runtime or headset is [`Failure::NoDevice`], everything else [`Failure::Other`].
pub fn blame(error: HeadsetError) -> Failure {
    match error {
        HeadsetError::NoRuntime { .. } | HeadsetError::Asleep { .. } => {
            Failure::NoDevice(error.into())
        }
        _ => Failure::Other(error.into()),
    }
}
