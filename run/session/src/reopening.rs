//! Another device where a headset without a runtime of its own has lost its device.

use vitriol_gpu::{Gpu, GpuError};
use vitriol_xr::HeadsetError;

/// Opens a device.
type Opens = Box<dyn FnMut() -> Result<Gpu, GpuError>>;

/// Whether the device is lost, and what opens another one.
#[derive(Default)]
pub(crate) struct Reopening {
    opens: Option<Opens>,
    lost: bool,
}

impl Reopening {
    /// By `opens`.
    pub fn by(opens: impl FnMut() -> Result<Gpu, GpuError> + 'static) -> Self {
        Self {
            opens: Some(Box::new(opens)),
            lost: false,
        }
    }

    /// The device is lost.
    pub fn lose(&mut self) {
        self.lost = true;
    }

    /// Another device, once after each loss.
    ///
    /// # Errors
    /// [`GpuError::DeviceLost`] where nothing opens another one; the error of what does.
    pub fn next(&mut self) -> Result<Option<Gpu>, HeadsetError> {
        if !std::mem::take(&mut self.lost) {
            return Ok(None);
        }
        let lost = GpuError::DeviceLost { last_pass: None };
        Ok(Some(self.opens.as_mut().ok_or(lost)?()?))
    }
}
