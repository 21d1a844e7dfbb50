//! The least that a program does with a headset.

use std::time::Instant;

use glam::{Quat, Vec3};
use vitriol_gpu::{Buffer, Image, ImageDesc, Options, QueueKind, vk};
use vitriol_tests::mock::{self, Change, Mock};
use vitriol_tests::program::own_name;
use vitriol_tests::wait::{PATIENCE, until};
use vitriol_xr::{
    Headset, HeadsetFrame, Inset, OpenXr, OpenXrOptions, Pose, SessionState, Shown, Targets, Turn,
    View,
};

const PANEL: [u32; 2] = [64, 32];

/// Whether the session had the input focus.
pub fn focused(frame: &HeadsetFrame) -> bool {
    frame.poses.info.session_state == SessionState::Focused
}

/// Width and height of a picture that is drawn smaller to save time.
pub fn hurried(extent: [u32; 2]) -> [u32; 2] {
    extent.map(|side| side * 7 / 10)
}

/// Options of a client without gaze and inset.
pub fn options() -> OpenXrOptions {
    OpenXrOptions {
        gpu: Options::default(),
        instance_extensions: Vec::new(),
        device_extensions: Vec::new(),
        gaze: false,
        inset: false,
        panel: PANEL,
    }
}

/// Runs this test with a mock runtime that begins with `changes`, as [`mock::enter`] does.
pub fn enter(changes: &[Change]) -> Option<Mock> {
    mock::enter(&own_name(), changes)
}

/// A client that has the focus, on a mock runtime that begins with `changes`.
pub fn on_mock(changes: &[Change]) -> Option<(Mock, Client)> {
    let mock = enter(changes)?;
    let mut client = Client::open();
    client.focus();
    Some((mock, client))
}

/// A headset, and pictures of its size.
pub struct Client {
    pub xr: OpenXr,
    pictures: Option<Pictures>,
}

/// Each picture with the buffer that it is copied from, and with the word that fills it.
struct Pictures {
    all: Vec<(Buffer, Image, u32)>,
}

/// Colour of the eyes' pictures, and of the inset's.
pub const EYES: [u8; 4] = [64, 128, 191, 255];
pub const INSET: [u8; 4] = [32, 191, 64, 255];

impl Client {
    pub fn open() -> Self {
        Self::open_with(false)
    }

    /// Opens the headset with the gaze and an inset, or without both; [`Client::open`] is without.
    pub fn open_with(gaze: bool) -> Self {
        let options = OpenXrOptions {
            gpu: Options {
                validation: true,
                ..Options::default()
            },
            gaze,
            inset: gaze,
            ..options()
        };
        let xr = OpenXr::open(options, |_| false).unwrap();
        Self { xr, pictures: None }
    }

    /// Turns up to and with the next frame; the other turns are returned in words.
    pub fn frame(&mut self) -> (HeadsetFrame, Vec<String>) {
        let begun = Instant::now();
        let mut others = Vec::new();
        while begun.elapsed() < PATIENCE {
            match self.xr.next().unwrap() {
                Turn::Frame(frame) => return (*frame, others),
                Turn::Renewed => {
                    self.pictures = None;
                    others.push("renewed".to_owned());
                }
                Turn::Paused { cause } => others.push(format!("paused: {cause:?}")),
                Turn::Lost { cause } => others.push(format!("lost: {cause}")),
                Turn::Ended => panic!("ended"),
            }
        }
        panic!("no frame came: {others:?}");
    }

    /// The next frame, drawn.
    pub fn drawn(&mut self) -> HeadsetFrame {
        let (frame, _) = self.frame();
        self.draw();
        frame
    }

    /// Frames until one has the focus.
    pub fn focus(&mut self) -> HeadsetFrame {
        let begun = Instant::now();
        while begun.elapsed() < PATIENCE {
            let frame = self.drawn();
            if focused(&frame) {
                return frame;
            }
        }
        panic!("no focus came");
    }

    /// The eyes, in an open frame, as soon as the runtime has taken in a packet that has the head at `head`, and so all other values in
    /// that packet.
    pub fn hear(&mut self, head: Vec3) -> [View; 2] {
        until("the runtime hears", || {
            let views = self.xr.locate_views().unwrap();
            let [left, right] = views.map(|view| view.stage_from_eye.position);
            (left.midpoint(right).distance(head) < 1e-4).then_some(views)
        })
    }

    /// The whole of each picture, with the eyes as they are located, and no panel.
    pub fn shown(&self, views: [View; 2]) -> Shown {
        Shown {
            views,
            extent: self.xr.extent(),
            inset: self.xr.inset(),
            near: 0.05,
            panel: None,
        }
    }

    /// Draws the frame and ends it; gives the colour target.
    pub fn draw(&mut self) -> Image {
        let targets = self.xr.acquire(true).unwrap().unwrap();
        self.submit(&targets);
        let views = self.xr.locate_views().unwrap();
        let panel = Pose::new(Vec3::new(0.0, 1.4, -0.7), Quat::IDENTITY);
        let shown = Shown {
            // A corner of the image, as a program in a hurry draws.
            extent: hurried(self.xr.extent()),
            inset: self.xr.inset().map(|inset| Inset {
                extent: hurried(inset.extent),
                ..inset
            }),
            panel: Some((panel, 0.3)),
            ..self.shown(views)
        };
        self.xr.end(Some(&shown)).unwrap();
        targets.colour
    }

    /// Fills pictures of our own and copies them to `targets`.
    pub fn submit(&mut self, targets: &Targets) {
        let gpu = self.xr.gpu().clone();
        let linear = vk::Format::R8G8B8A8_UNORM;
        let usage = |format| match format {
            vk::Format::D32_SFLOAT => vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT,
            _ => vk::ImageUsageFlags::COLOR_ATTACHMENT,
        };
        let far = 0.0_f32.to_bits();
        let [eyes, inset, red] = [EYES, INSET, [255, 0, 0, 255]].map(u32::from_le_bytes);
        let d32 = vk::Format::D32_SFLOAT;
        let of_inset = targets.inset.as_ref();
        let wanted = [
            (Some(&targets.colour), linear, eyes),
            (targets.depth.as_ref(), d32, far),
            (of_inset.map(|inset| &inset.colour), linear, inset),
            (of_inset.and_then(|inset| inset.depth.as_ref()), d32, far),
            (targets.panel.as_ref(), linear, red),
        ];
        let given = |all: &[_]| wanted.iter().filter(|it| it.0.is_some()).count() == all.len();
        self.pictures.take_if(|pictures| !given(&pictures.all));
        let wanted = wanted.into_iter();
        let wanted = wanted.filter_map(|(target, format, word)| Some((target?, format, word)));
        let wanted: Vec<_> = wanted.collect();
        let pictures = self.pictures.get_or_insert_with(|| {
            let made = wanted.iter().map(|&(target, format, word)| {
                let usage = usage(format);
                let desc = ImageDesc {
                    format,
                    usage,
                    ..*target.desc()
                };
                let [width, height] = desc.extent;
                let bytes = u64::from(4 * width * height * desc.layers);
                let texels = Buffer::storage(&gpu, target.label(), bytes).unwrap();
                (
                    texels,
                    Image::new(&gpu, target.label(), desc).unwrap(),
                    word,
                )
            });
            Pictures {
                all: made.collect(),
            }
        });
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        for ((texels, image, word), (target, ..)) in pictures.all.iter().zip(&wanted) {
            rec.fill(texels, *word).unwrap();
            rec.copy_to_image(texels, image).unwrap();
            rec.copy_image(image, target).unwrap();
        }
        gpu.submit(rec).unwrap();
    }

    /// Fails if Vulkan's validation layer has reported anything about the present device.
    pub fn assert_silent(&self) {
        self.xr.gpu().wait_idle().unwrap();
        let messages = self.xr.gpu().take_validation_messages();
        assert!(messages.is_empty(), "Vulkan's layer says: {messages:#?}");
    }
}
