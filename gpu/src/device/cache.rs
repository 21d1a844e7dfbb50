//! Compiled pipelines, kept from one run to the next.

use std::io::Write;
use std::path::{Path, PathBuf};

use ash::vk;
use xxhash_rust::xxh3::xxh3_64;

/// First bytes of a file; the checksum of the rest comes next.
const MAGIC: [u8; 8] = *b"vitriol1";
/// Largest file that is read, bytes: scenes have some MB.
const MOST: u64 = 1 << 28;

/// The file in which a device's pipelines are kept.
pub(super) struct Kept {
    path: PathBuf,
    /// Checksum of the data that were read.
    sum: u64,
}

impl Kept {
    /// The file of a device under `folder`, and the data that an earlier run stored there. A damaged file counts as none, since some
    /// drivers do not check their data.
    pub(super) fn read(folder: &Path, device: &vk::PhysicalDeviceProperties) -> (Self, Vec<u8>) {
        let id = [device.vendor_id, device.device_id, device.driver_version];
        let id = id.map(|part| format!("{part:08x}")).join("-");
        let uuid = device.pipeline_cache_uuid.map(|byte| format!("{byte:02x}"));
        let path = folder.join(format!("{id}-{}.pipelines", uuid.concat()));
        let data = read(&path).unwrap_or_default();
        let sum = xxh3_64(&data);
        (Self { path, sum }, data)
    }

    /// Stores `data`, unless they are those that were read. A failure does no harm: pipelines are compiled anew.
    pub(super) fn write(&self, data: &[u8]) {
        let sum = xxh3_64(data);
        if sum == self.sum || data.is_empty() {
            return;
        }
        if let Err(error) = write(&self.path, sum, data) {
            tracing::debug!(path = %self.path.display(), %error, "pipelines are not kept");
        }
    }
}

fn read(path: &Path) -> Option<Vec<u8>> {
    if std::fs::metadata(path).ok()?.len() > MOST {
        return None;
    }
    let file = std::fs::read(path).ok()?;
    let (magic, rest) = file.split_first_chunk::<8>()?;
    let (sum, data) = rest.split_first_chunk::<8>()?;
    (*magic == MAGIC && u64::from_le_bytes(*sum) == xxh3_64(data)).then(|| data.to_vec())
}

/// Written beside the file first: two programs may end at once.
fn write(path: &Path, sum: u64, data: &[u8]) -> std::io::Result<()> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let beside = path.with_extension(format!("{}.part", std::process::id()));
    let mut file = std::fs::File::create(&beside)?;
    let written = file
        .write_all(&MAGIC)
        .and_then(|()| file.write_all(&sum.to_le_bytes()))
        .and_then(|()| file.write_all(data));
    let moved = written.and_then(|()| std::fs::rename(&beside, path));
    if moved.is_err() {
        let _ = std::fs::remove_file(&beside);
    }
    moved
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    fn device(driver: u32) -> vk::PhysicalDeviceProperties {
        vk::PhysicalDeviceProperties {
            driver_version: driver,
            pipeline_cache_uuid: [7; 16],
            ..vk::PhysicalDeviceProperties::default()
        }
    }

    #[test]
    fn what_is_kept_is_read_and_what_is_damaged_is_not() {
        let folder = std::env::temp_dir().join(format!("vitriol-kept-{}", std::process::id()));
        let read = |driver| Kept::read(&folder, &device(driver));
        let (kept, data) = read(1);
        assert!(data.is_empty());
        let pipelines: Vec<u8> = (0..200).collect();
        kept.write(&pipelines);
        let (kept, data) = read(1);
        assert_eq!(data, pipelines);
        // Another driver has a file of its own.
        assert!(read(2).1.is_empty());
        // Data that were read are not written again.
        std::fs::remove_file(&kept.path).unwrap();
        kept.write(&pipelines);
        assert!(!kept.path.exists());
        kept.write(&pipelines[1..]);
        let whole = std::fs::read(&kept.path).unwrap();
        // One bit changed, the end cut off, another beginning, an empty file.
        let mut bit = whole.clone();
        bit[40] ^= 1;
        let other = [b"vitriol0", &whole[8..]].concat();
        for damaged in [&bit[..], &whole[..whole.len() - 1], &other, &[]] {
            std::fs::write(&kept.path, damaged).unwrap();
            assert!(read(1).1.is_empty());
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
