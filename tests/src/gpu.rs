//! A device with the validation layer and its synchronisation validation, and a guard that fails the test if the layer has reported
//! anything.

use std::ops::Deref;
use std::sync::OnceLock;

use vitriol_gpu::{Gpu, Image, Options, PlainLoader, QueueKind, Readback};

/// A device that is watched: dropped at a test's end, it panics where the
/// validation layer has reported anything. Keep it to the end; declared
/// first, it is dropped last.
///
/// Messages are not taken away, so that tests which share a process, and with
/// it the device, all fail rather than one of them by chance.
#[derive(Clone)]
#[must_use = "the validation layer is asked when this is dropped"]
pub struct Watched(Gpu);

/// The process's device, opened at the first call; `VITRIOL_DEVICE` (index or
/// part of the name) chooses which.
///
/// Bind it: `&device()` as an argument is dropped, and the layer asked, before
/// the work that follows is done. Nothing waits for that work then, and a
/// process that exits while the software driver works at it may abort.
///
/// # Panics
/// Where there is no device or no validation layer, with the remedy.
pub fn device() -> Watched {
    static DEVICE: OnceLock<Gpu> = OnceLock::new();
    Watched(DEVICE.get_or_init(|| open(|_| {})).clone())
}

/// A device of its own, with other options than the process's.
///
/// # Panics
/// As [`device`].
pub fn another_device(change: impl FnOnce(&mut Options)) -> Watched {
    Watched(open(change))
}

/// An image as the device has it, with all layers.
///
/// # Panics
/// Where it cannot be read.
#[must_use]
pub fn read_back(gpu: &Gpu, image: &Image) -> Readback {
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let read = rec.read_back_image(image).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    read
}

fn open(change: impl FnOnce(&mut Options)) -> Gpu {
    let mut options = Options {
        device: std::env::var("VITRIOL_DEVICE").ok(),
        validation: true,
        ..Options::default()
    };
    change(&mut options);
    Gpu::open(&mut PlainLoader::default(), &options)
        .expect("a Vulkan device with the validation layer")
}

impl Deref for Watched {
    type Target = Gpu;

    fn deref(&self) -> &Gpu {
        &self.0
    }
}

impl Drop for Watched {
    fn drop(&mut self) {
        // Work in flight could be reported after the test. A device that a test has lost reports nothing more.
        let idle = if self.0.is_lost() {
            Ok(())
        } else {
            self.0.wait_idle()
        };
        let messages = self.0.validation_messages();
        if std::thread::panicking() {
            // A second panic would hide the first.
            eprintln!("the validation layer says: {messages:#?}");
            return;
        }
        idle.expect("the device is not lost");
        assert!(
            messages.is_empty(),
            "the validation layer says: {messages:#?}"
        );
    }
}
