//! The stage: its reference space.

use openxr as xr;

use super::convert::{CallFailure, failed};

/// The space that all poses are in.
pub(super) struct Stage {
    pub space: xr::Space,
    pub kind: xr::ReferenceSpaceType,
}

impl Stage {
    /// LOCAL_FLOOR, else STAGE, else LOCAL. The first is where the user has recentred to; STAGE is the play area's, which may lie metres
    /// away; the origin of LOCAL is the eyes' first place: its floor is not known, and the bench is placed by the head.
    pub(super) fn new(session: &xr::Session<xr::Vulkan>) -> Result<Self, CallFailure> {
        let offered = session
            .enumerate_reference_spaces()
            .map_err(failed("xrEnumerateReferenceSpaces"))?;
        let kind = choose(&offered);
        let space = session
            .create_reference_space(kind, xr::Posef::IDENTITY)
            .map_err(failed("xrCreateReferenceSpace"))?;
        Ok(Self { space, kind })
    }
}

/// Whether a move of that space is the user's recentring. The specification ties that to LOCAL and LOCAL_FLOOR, and runtimes
/// differ in which of the three they name.
pub(super) fn tells_of_recentring(kind: xr::ReferenceSpaceType) -> bool {
    [
        xr::ReferenceSpaceType::LOCAL,
        xr::ReferenceSpaceType::LOCAL_FLOOR,
        xr::ReferenceSpaceType::STAGE,
    ]
    .contains(&kind)
}

/// The best of the offered spaces.
fn choose(offered: &[xr::ReferenceSpaceType]) -> xr::ReferenceSpaceType {
    let floors = [
        xr::ReferenceSpaceType::LOCAL_FLOOR,
        xr::ReferenceSpaceType::STAGE,
    ];
    let floor = floors.into_iter().find(|kind| offered.contains(kind));
    floor.unwrap_or(xr::ReferenceSpaceType::LOCAL)
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
            T::LOCAL_FLOOR
        );
        assert_eq!(choose(&[T::VIEW, T::LOCAL, T::STAGE]), T::STAGE);
        assert_eq!(choose(&[T::VIEW, T::LOCAL]), T::LOCAL);
    }
}
