//! The mock's state: head, hands, origins of the spaces, and offered features. The script sets all of it.

use openxr::sys;

use crate::script::{Fov, Goal, HandState, Inset, Joint, Known, Pose, SpaceKind};

/// The extensions that Vitriol's client uses.
pub(crate) const ALL: [&str; 12] = [
    "XR_KHR_vulkan_enable2",
    "XR_KHR_composition_layer_depth",
    "XR_KHR_visibility_mask",
    "XR_EXT_local_floor",
    "XR_EXT_hand_tracking",
    "XR_EXT_user_presence",
    "XR_FB_display_refresh_rate",
    // Offered only where the script has it: with it there is no other hand tracking.
    "XR_EXT_hand_interaction",
    "XR_BD_controller_interaction",
    "XR_EXT_eye_gaze_interaction",
    "XR_VARJO_quad_views",
    "XR_VARJO_foveated_rendering",
];

/// VK_FORMAT_R8G8B8A8_SRGB and VK_FORMAT_D32_SFLOAT.
const FORMATS: [i64; 2] = [43, 126];

/// The display's first time is one period after it, ns. Not 0, so that a time is not taken for a span.
pub(crate) const EPOCH: i64 = 1_000_000_000_000;

/// The part of an eye's picture that no eye sees.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mask {
    pub vertices: Vec<[f32; 2]>,
    pub indices: Vec<u32>,
}

/// Origins of one space, each from its time on.
#[derive(Clone, Debug)]
pub(crate) struct Origins(Vec<(i64, Pose)>);

impl Origins {
    fn new(origin: Pose) -> Self {
        Self(vec![(i64::MIN, origin)])
    }

    /// The origin at that time.
    pub(crate) fn at(&self, time: i64) -> Pose {
        let held = self.0.iter().rfind(|(from, _)| *from <= time);
        held.map_or(Pose::IDENTITY, |(_, origin)| *origin)
    }

    /// Sets another origin from that time on.
    pub(crate) fn push(&mut self, from: i64, origin: Pose) {
        self.0.retain(|(earlier, _)| *earlier < from);
        self.0.push((from, origin));
    }
}

/// Everything that a script changes.
#[derive(Clone, Debug)]
pub(crate) struct World {
    pub head: (Pose, Known),
    pub hands: [Option<HandState>; 2],
    pub joints: [Option<Vec<Joint>>; 2],
    /// The gaze, along -Z; `None` where it is not tracked.
    pub gaze: Option<Pose>,
    pub inset: Inset,
    pub local: Origins,
    pub floor: Origins,
    pub stage: Origins,
    pub fov: [Fov; 2],
    pub ipd: f32,
    pub extensions: Vec<String>,
    pub spaces: Vec<SpaceKind>,
    pub formats: Vec<i64>,
    pub array_layers: u32,
    pub blends: Vec<i32>,
    pub extent: [u32; 2],
    pub rates: Vec<f32>,
    pub rate: f32,
    pub period: i64,
    pub masks: [Mask; 2],
    pub present: bool,
    pub connected: bool,
    pub goal: Goal,
}

impl Default for World {
    fn default() -> Self {
        let eye = Fov {
            left: -0.8,
            right: 0.7,
            up: 0.75,
            down: -0.85,
        };
        Self {
            head: (Pose::at(0.0, 1.6, 0.0), Known::TRACKED),
            hands: [0, 1].map(|side| Some(HandState::touch(side))),
            joints: [None, None],
            gaze: None,
            inset: Inset::default(),
            local: Origins::new(Pose::at(0.0, 1.6, 0.0)),
            floor: Origins::new(Pose::IDENTITY),
            stage: Origins::new(Pose::IDENTITY),
            fov: [
                eye,
                Fov {
                    left: -eye.right,
                    right: -eye.left,
                    ..eye
                },
            ],
            ipd: 0.063,
            extensions: ALL[..7].iter().map(|&name| name.to_owned()).collect(),
            spaces: vec![
                SpaceKind::View,
                SpaceKind::Local,
                SpaceKind::LocalFloor,
                SpaceKind::Stage,
                SpaceKind::Gaze,
            ],
            formats: FORMATS.to_vec(),
            array_layers: 64,
            blends: vec![sys::EnvironmentBlendMode::OPAQUE.into_raw()],
            extent: [64, 48],
            rates: vec![72.0, 80.0, 90.0, 120.0],
            rate: 90.0,
            period: period(90.0),
            masks: [Mask::default(), Mask::default()],
            present: true,
            connected: true,
            goal: Goal::Focused,
        }
    }
}

impl World {
    /// The origins of a space that can move.
    pub(crate) fn origins(&mut self, space: SpaceKind) -> Option<&mut Origins> {
        match space {
            SpaceKind::Local => Some(&mut self.local),
            SpaceKind::LocalFloor => Some(&mut self.floor),
            SpaceKind::Stage => Some(&mut self.stage),
            SpaceKind::View | SpaceKind::Gaze | SpaceKind::Action => None,
        }
    }

    /// Sets another display rate and its period.
    pub(crate) fn set_rate(&mut self, rate: f32) {
        self.rate = rate;
        self.period = period(rate);
    }
}

/// Period of a rate in Hz, ns.
fn period(rate: f32) -> i64 {
    (1e9 / f64::from(rate)).round() as i64
}

/// OpenXR's number of a space that can be offered.
pub(crate) fn raw_space(kind: SpaceKind) -> Option<sys::ReferenceSpaceType> {
    match kind {
        SpaceKind::View => Some(sys::ReferenceSpaceType::VIEW),
        SpaceKind::Local => Some(sys::ReferenceSpaceType::LOCAL),
        SpaceKind::LocalFloor => Some(sys::ReferenceSpaceType::LOCAL_FLOOR),
        SpaceKind::Stage => Some(sys::ReferenceSpaceType::STAGE),
        SpaceKind::Gaze => Some(sys::ReferenceSpaceType::COMBINED_EYE_VARJO),
        SpaceKind::Action => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_origin_holds_from_its_time_on() {
        let mut origins = Origins::new(Pose::IDENTITY);
        let [a, b] = [1.0, 2.0].map(|x| Pose::at(x, 0.0, 0.0));
        origins.push(100, a);
        origins.push(200, b);
        assert_eq!(origins.at(99), Pose::IDENTITY);
        assert_eq!(origins.at(100), a);
        assert_eq!(origins.at(199), a);
        assert_eq!(origins.at(200), b);
    }
}
