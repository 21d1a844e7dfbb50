//! The stage: which reference space it is, and where its floor lies.

use glam::{Quat, Vec3};
use openxr as xr;

use super::convert::{Failure, failed, posef};
use crate::Pose;

/// Height of the eyes above the floor where a runtime knows no floor, m: LOCAL has its origin at
/// the eyes. Between the medians of standing women and men, 1.52 and 1.63 m (DIN 33402-2:2005).
const EYES: f32 = 1.6;

/// The space that all poses are in.
pub(super) struct Stage {
    pub space: xr::Space,
    pub kind: xr::ReferenceSpaceType,
}

impl Stage {
    /// STAGE, else LOCAL_FLOOR, else LOCAL, put down to the floor.
    pub(super) fn new(session: &xr::Session<xr::Vulkan>) -> Result<Self, Failure> {
        let offered = session
            .enumerate_reference_spaces()
            .map_err(failed("xrEnumerateReferenceSpaces"))?;
        let (kind, drop) = choose(&offered);
        let origin = Pose::new(Vec3::new(0.0, -drop, 0.0), Quat::IDENTITY);
        let space = session
            .create_reference_space(kind, posef(&origin))
            .map_err(failed("xrCreateReferenceSpace"))?;
        Ok(Self { space, kind })
    }
}

/// The best of the offered spaces, and how far its origin is above the floor, m.
fn choose(offered: &[xr::ReferenceSpaceType]) -> (xr::ReferenceSpaceType, f32) {
    let floors = [
        xr::ReferenceSpaceType::STAGE,
        xr::ReferenceSpaceType::LOCAL_FLOOR,
    ];
    let floor = floors.into_iter().find(|kind| offered.contains(kind));
    floor.map_or((xr::ReferenceSpaceType::LOCAL, EYES), |kind| (kind, 0.0))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn a_known_floor_is_preferred() {
        use xr::ReferenceSpaceType as T;
        assert_eq!(
            choose(&[T::VIEW, T::LOCAL, T::LOCAL_FLOOR, T::STAGE]),
            (T::STAGE, 0.0)
        );
        assert_eq!(
            choose(&[T::VIEW, T::LOCAL, T::LOCAL_FLOOR]),
            (T::LOCAL_FLOOR, 0.0)
        );
        assert_eq!(choose(&[T::VIEW, T::LOCAL]), (T::LOCAL, EYES));
    }
}
