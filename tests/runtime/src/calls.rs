//! The runtime's log of calls: lines of JSON in the file `calls`, each a [`Call`].

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::number::{one, two};
use crate::script::{Fov, Pose, SpaceKind};

/// A call that was made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Call {
    /// Number of the xrWaitFrame that began last, counted from 0 over all sessions of the process.
    pub frame: Option<u64>,
    /// OpenXR's name of it.
    pub call: String,
    /// Its arguments; floats that are not finite are the strings `inf`, `-inf` and `NaN`.
    pub with: Value,
    /// The XrResult.
    pub answer: i32,
}

impl Call {
    /// The arguments of an xrEndFrame; `None` for other calls.
    #[must_use]
    pub fn ended(&self) -> Option<Ended> {
        (self.call == "xrEndFrame")
            .then(|| serde_json::from_value(self.with.clone()).ok())
            .flatten()
    }
}

/// A frame's end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ended {
    /// XrTime.
    pub time: i64,
    /// XrEnvironmentBlendMode.
    pub blend: i32,
    /// From the back to the front.
    pub layers: Vec<Layer>,
}

/// A composition layer. `space` is `None` for an invalid handle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Layer {
    /// XrCompositionLayerProjection
    Projection {
        /// The space of its views.
        space: Option<SpaceKind>,
        /// XrCompositionLayerFlags
        flags: u64,
        /// Left and right, and the insets of both where the session has them.
        views: Vec<ProjectionView>,
    },
    /// XrCompositionLayerQuad
    Quad {
        /// The space of its pose.
        space: Option<SpaceKind>,
        /// XrCompositionLayerFlags
        flags: u64,
        /// XrEyeVisibility
        eyes: i32,
        /// Its picture.
        image: Part,
        /// Its middle.
        pose: Pose,
        /// Width and height, m.
        #[serde(with = "two")]
        size: [f32; 2],
    },
    /// Some other layer, which the runtime does not support.
    Other {
        /// XrStructureType
        kind: i32,
    },
}

/// XrCompositionLayerProjectionView
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProjectionView {
    /// The eye.
    pub pose: Pose,
    /// Its field of view.
    pub fov: Fov,
    /// Its picture.
    pub image: Part,
    /// XrCompositionLayerDepthInfoKHR, where it is chained.
    pub depth: Option<Depth>,
}

/// XrSwapchainSubImage
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Part {
    /// Its handle, as xrCreateSwapchain returned it.
    pub swapchain: u64,
    /// x, y, width, height, pixels.
    pub rect: [i32; 4],
    /// Index of the image's layer.
    pub layer: u32,
}

/// XrCompositionLayerDepthInfoKHR
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Depth {
    /// The depths.
    pub image: Part,
    /// `minDepth`
    #[serde(with = "one")]
    pub min: f32,
    /// `maxDepth`
    #[serde(with = "one")]
    pub max: f32,
    /// `nearZ`
    #[serde(with = "one")]
    pub near: f32,
    /// `farZ`
    #[serde(with = "one")]
    pub far: f32,
}
