//! The headset of a session: OpenXR's, where the build has it.

use vitriol_gpu::Timestamps;
use vitriol_run::device;
use vitriol_xr::{OpenXr, OpenXrOptions, probe};

use vitriol_session::blame::blame;
use vitriol_session::foveating::Foveating;
use vitriol_session::panel::PANEL;

/// Whether a runtime is chosen that could open it.
///
/// # Errors
/// [`vitriol_run::Failure::NoDevice`] where none is, with the remedy.
pub(super) fn check() -> Result<(), vitriol_run::Failure> {
    probe::check().map_err(blame)
}

/// Opens it, and waits for one that is not there yet.
///
/// # Errors
/// [`vitriol_run::Failure::NoDevice`] without runtime or device.
pub(super) fn open(
    foveation: Option<Foveating>,
    timestamps: Timestamps,
) -> Result<OpenXr, vitriol_run::Failure> {
    let opened = OpenXrOptions {
        gpu: vitriol_gpu::Options {
            timestamps,
            pipelines: device::pipelines(),
            ..vitriol_gpu::Options::default()
        },
        instance_extensions: Vec::new(),
        device_extensions: Vec::new(),
        gaze: foveation == Some(Foveating::Eye),
        inset: foveation == Some(Foveating::Eye),
        panel: PANEL,
    };
    let mut told = false;
    let waits = |remedy: &str| {
        if !std::mem::replace(&mut told, true) {
            eprintln!("{remedy} Waiting for it; Ctrl-C ends.");
        }
        true
    };
    OpenXr::open(opened, waits).map_err(blame)
}
