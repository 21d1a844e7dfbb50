//! The frame loop's interface to a headset, whether it is an OpenXR session or a stand-in of the same size.
//!
//! One frame, in this order: [`next`](Headset::next) (wait, begin, sync actions, locate),
//! the simulation's steps, [`acquire`](Headset::acquire), [`locate_views`](Headset::locate_views) as
//! late as can be, the picture's submission, [`end`](Headset::end). Each frame that `next` gives is
//! ended, drawn or not. Nothing between them waits for the GPU. Methods with a body are of what not all have.

use glam::Vec3;
use vitriol_gpu::{Gpu, GpuError, Image};

use crate::{Around, Fov, Line, Pointed, Pose, PoseFrame, Side};

/// A headset's frames, images and hands.
pub trait Headset {
    /// The device that simulation and picture use. Another one after [`Turn::Renewed`].
    fn gpu(&self) -> &Gpu;

    /// Pictures that it shows: two eyes, or one on a screen, whose two views are then the same.
    fn eyes(&self) -> u32 {
        2
    }

    /// Width and height of each eye's picture, pixels.
    fn extent(&self) -> [u32; 2];

    /// Width and height of the picture that is to be drawn next, pixels: at most [`Headset::extent`]. A window that is smaller than its
    /// screen needs less.
    fn wanted(&self) -> [u32; 2] {
        self.extent()
    }

    /// The second pair of pictures, where the headset has one.
    fn inset(&self) -> Option<Inset> {
        None
    }

    /// Corners of triangles that no eye sees, three each, for the left and the right eye: 0 to 1
    /// from the picture's upper left. Empty where the runtime gives none.
    fn hidden_area(&self) -> [Vec<[f32; 2]>; 2] {
        [Vec::new(), Vec::new()]
    }

    /// Runtime and device in a line, for people.
    fn name(&self) -> &str;

    /// Takes the runtime's events, waits for the next frame and begins it.
    ///
    /// # Errors
    /// [`HeadsetError`] for failures that another try does not mend; a lost runtime or session is a [`Turn`].
    fn next(&mut self) -> Result<Turn, HeadsetError>;

    /// The images to which the frame's pictures are to be copied, the panel's only if it is to change; `end` hands them over. `None` where
    /// the runtime gives no images, which it may do at any time: the frame is then ended without a picture.
    ///
    /// # Errors
    /// As for [`Headset::next`].
    fn acquire(&mut self, panel: bool) -> Result<Option<Targets>, HeadsetError>;

    /// Locates the eyes anew at the frame's display time, and with them those of [`Headset::inset`].
    ///
    /// # Errors
    /// As for [`Headset::next`].
    fn locate_views(&mut self) -> Result<[View; 2], HeadsetError>;

    /// The user's gaze at the time for which the eyes were located last: from between them along -Z, in the stage. `None` where it is not
    /// known, or not asked for.
    fn gaze(&self) -> Option<Pose> {
        None
    }

    /// Takes the bodies at the bench as they are before the next frame.
    fn around(&mut self, _around: Around) {}

    /// Lines that help a pointer, drawn with the picture of this frame.
    fn lines(&self) -> Vec<Line> {
        Vec::new()
    }

    /// What a pointer is at in this frame, while its hand is free; `None` of a headset, whose hands point by themselves.
    fn pointed(&self) -> Option<Pointed> {
        None
    }

    /// Ends the frame; without `shown` nothing is shown.
    ///
    /// # Errors
    /// As for [`Headset::next`]. [`HeadsetError::NoInset`] where `shown` lacks the inset that there is: the frame is then ended with
    /// nothing.
    fn end(&mut self, shown: Option<&Shown>) -> Result<(), HeadsetError>;

    /// Vibrates the hand's controller until the next call: 0 not at all, 1 the strongest. It must be called in each frame: after 200 ms
    /// the vibration ends by itself, so that a program that hangs does not go on shaking a hand.
    ///
    /// # Errors
    /// As for [`Headset::next`].
    fn vibrate(&mut self, _side: Side, _amplitude: f32) -> Result<(), HeadsetError> {
        Ok(())
    }

    /// Call it when the device is lost ([`Gpu::is_lost`]), and with it all images; a frame that is open is not ended. The next turns are
    /// [`Turn::Lost`], and [`Turn::Renewed`] once there is another device.
    fn lose_device(&mut self);

    /// Display rates that can be asked for, Hz; empty where there is no choice.
    fn rates(&self) -> &[f32] {
        &[]
    }

    /// Asks for one of them. The frames' periods show when it has come into effect.
    ///
    /// # Errors
    /// As for [`Headset::next`].
    fn request_rate(&mut self, _rate: f32) -> Result<(), HeadsetError> {
        Ok(())
    }

    /// Asks the runtime for the end; [`Turn::Ended`] follows some turns later.
    ///
    /// # Errors
    /// As for [`Headset::next`].
    fn request_exit(&mut self) -> Result<(), HeadsetError>;
}

/// The result of [`Headset::next`].
#[derive(Debug)]
pub enum Turn {
    /// A frame has begun.
    Frame(Box<HeadsetFrame>),
    /// No frame now. It has waited a little (100 ms at most).
    Paused {
        /// Why.
        cause: Pause,
    },
    /// The runtime or its session is gone, and the headset looks for it. It has waited a little.
    Lost {
        /// The loss, in words.
        cause: String,
    },
    /// The session is new, and so are device, images and sizes: resources of the old device move over.
    Renewed,
    /// The runtime or the student asked to end.
    Ended,
}

/// Why nothing is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pause {
    /// The headset is off, or shows something else.
    Off,
    /// The runtime has not located the headset yet.
    Unseen,
}

/// A frame that has begun.
#[derive(Clone, Debug)]
pub struct HeadsetFrame {
    /// Number of the frame, counted from 0, over losses too.
    pub index: u64,
    /// Head and hands at the display time ([`FrameInfo::xr_time`](crate::FrameInfo)); `step` and
    /// `time_ns` are the simulation's, and zero here; `scenario` is empty. A hand that is not valid holds its last pose.
    pub poses: PoseFrame,
    /// Whether a picture would be shown.
    pub should_render: bool,
    /// The runtime moved the stage (the student recentred).
    pub recentred: bool,
    /// The head's position was known before and is not now: it is the last known one, while the orientation is current.
    pub lost: bool,
    /// Joints of the left and the right hand, if it is seen and holds no controller. They are in no recording: simulation steps consume
    /// only the [`Hand`](crate::Hand)s.
    pub joints: [Option<Joints>; 2],
}

/// Joints of a hand that is seen, in the order of OpenXR's XrHandJointEXT: position in the stage, m, and distance of the skin from it, m.
#[derive(Clone, Debug, PartialEq)]
pub struct Joints(pub [(Vec3, f32); 26]);

impl Joints {
    /// The tip of the thumb.
    pub const THUMB: usize = 5;
    /// The tips of the other fingers, from the index finger on.
    pub const FINGERS: [usize; 4] = [10, 15, 20, 25];
}

/// An eye at the display time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The eye in the stage (-Z is the line of sight).
    pub stage_from_eye: Pose,
    /// Its field of view.
    pub fov: Fov,
}

/// A second pair of pictures of the same eyes, of a smaller field of view and finer: the runtime shows it over the first pair where the
/// user looks, or ahead where it has no gaze (quad views).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inset {
    /// Width and height of each picture, pixels.
    pub extent: [u32; 2],
    /// The left and the right eye; their fields of view may change with each frame.
    pub views: [View; 2],
}

/// Width and height of the depth that goes with a picture of `extent` pixels: half of each, rounded up, over the same field of view.
/// A runtime moves pixels by it, for which that is fine enough, and its copy takes a quarter of the time.
pub fn depth_extent(extent: [u32; 2]) -> [u32; 2] {
    extent.map(|side| side.div_ceil(2))
}

/// The runtime's images for a frame. They take copies of pictures of the same extent.
#[derive(Clone)]
pub struct Targets {
    /// A layer for each of [`Headset::eyes`], 8 bits a channel, sRGB; where it is smaller than the picture, it takes its upper left
    /// corner. Alpha is 0 where the panel is to be seen in their place, and not multiplied with them.
    pub colour: Image,
    /// Two layers of reversed depth, where the runtime takes it, of [`depth_extent`].
    pub depth: Option<Image>,
    /// Images of the second pair, where there is one.
    pub inset: Option<InsetTargets>,
    /// The panel, one layer, 8 bits a channel, sRGB; `None` where it stays as it was shown last.
    pub panel: Option<Image>,
}

/// The runtime's images for [`Inset`], as [`Targets`] has them for the first pair.
#[derive(Clone)]
pub struct InsetTargets {
    /// Two layers.
    pub colour: Image,
    /// Two layers, where the runtime takes depth.
    pub depth: Option<Image>,
}

/// The content of a frame that is shown.
#[derive(Clone, Copy, Debug)]
pub struct Shown {
    /// The eyes with which the picture was drawn, as [`Headset::locate_views`] gave them.
    pub views: [View; 2],
    /// Width and height of each eye's picture, pixels: all of its image, or less, in the upper left
    /// corner. The runtime scales it to the same field of view.
    pub extent: [u32; 2],
    /// The second pair, with views and extent as they were drawn; required where the headset has one.
    pub inset: Option<Inset>,
    /// Distance of the near plane, m, at which depth is 1; it is 0 at infinity.
    pub near: f32,
    /// Pose of the panel (its middle; +Z is its face's normal), and its width, m; its height follows from its pixels. It is shown under
    /// the picture; `None` where the picture's own panel is to be seen.
    pub panel: Option<(Pose, f32)>,
}

/// Why a headset cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HeadsetError {
    /// There is no runtime to connect to.
    #[error("{remedy}")]
    NoRuntime {
        /// What is missing, and what to install or start.
        remedy: String,
    },
    /// There is a runtime, but its headset is switched off.
    #[error("{remedy}")]
    Asleep {
        /// What to do.
        remedy: String,
    },
    /// The runtime refused a call.
    #[error("the OpenXR runtime refused {call} ({cause}); restart it, or update it if that stays")]
    Refused {
        /// OpenXR's name of the call.
        call: &'static str,
        /// The runtime's answer.
        cause: String,
    },
    /// The program ended a frame without a picture for the inset that its session has.
    #[error("the frame has no picture for the inset of its session; nothing was shown")]
    NoInset,
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}
