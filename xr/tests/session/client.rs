//! The least that a program does with a headset.

use std::time::Instant;

use glam::{Quat, Vec3};
use vitriol_gpu::{Buffer, Image, ImageDesc, Options, QueueKind, vk};
use vitriol_tests::wait::{PATIENCE, until};
use vitriol_xr::{
    Headset, HeadsetFrame, OpenXr, OpenXrOptions, Pose, SessionState, Shown, Targets, Turn, View,
};

const PANEL: [u32; 2] = [64, 32];

/// Whether the session had the input focus.
pub fn focused(frame: &HeadsetFrame) -> bool {
    frame.poses.info.session_state == SessionState::Focused
}

/// A headset and pictures of its size.
pub struct Client {
    pub xr: OpenXr,
    pictures: Option<Pictures>,
}

struct Pictures {
    colour: (Buffer, Image),
    depth: (Buffer, Image),
    panel: (Buffer, Image),
}

impl Client {
    pub fn open() -> Self {
        Self::open_with(false)
    }

    /// The same that asks for the gaze or not.
    pub fn open_with(gaze: bool) -> Self {
        let options = OpenXrOptions {
            gpu: Options {
                validation: true,
                ..Options::default()
            },
            instance_extensions: Vec::new(),
            device_extensions: Vec::new(),
            gaze,
            panel: PANEL,
        };
        let xr = OpenXr::open(options, |_| false).unwrap();
        Self { xr, pictures: None }
    }

    /// Turns up to and with the next frame; what was no frame, in words.
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

    /// Frames until one has the focus.
    pub fn focus(&mut self) -> HeadsetFrame {
        let begun = Instant::now();
        while begun.elapsed() < PATIENCE {
            let (frame, _) = self.frame();
            self.draw();
            if focused(&frame) {
                return frame;
            }
        }
        panic!("no focus came");
    }

    /// The eyes, in an open frame, as soon as the runtime has taken in a packet that has the head at
    /// `head`, and so all else in that packet.
    pub fn hear(&mut self, head: Vec3) -> [View; 2] {
        until("the runtime hears", || {
            let views = self.xr.locate_views().unwrap();
            let [left, right] = views.map(|view| view.stage_from_eye.position);
            (left.midpoint(right).distance(head) < 1e-4).then_some(views)
        })
    }

    /// Draws the frame and ends it; gives the colour target.
    pub fn draw(&mut self) -> Image {
        let targets = self.xr.acquire(true).unwrap().unwrap();
        self.submit(&targets);
        let views = self.xr.locate_views().unwrap();
        let panel = Pose::new(Vec3::new(0.0, 1.4, -0.7), Quat::IDENTITY);
        let shown = Shown {
            views,
            // A corner of the image, as a program that must hurry draws.
            extent: self.xr.extent().map(|side| side * 7 / 10),
            near: 0.05,
            panel: Some((panel, 0.3)),
        };
        self.xr.end(Some(&shown)).unwrap();
        targets.colour
    }

    /// Fills pictures of our own and copies them to `targets`.
    pub fn submit(&mut self, targets: &Targets) {
        let gpu = self.xr.gpu().clone();
        let pictures = self.pictures.get_or_insert_with(|| {
            let image = |label: &str, extent, layers, format, usage| {
                let desc = ImageDesc {
                    extent,
                    layers,
                    format,
                    usage,
                };
                let [width, height] = desc.extent;
                let bytes = u64::from(4 * width * height * desc.layers);
                let texels = Buffer::storage(&gpu, label, bytes).unwrap();
                (texels, Image::new(&gpu, label, desc).unwrap())
            };
            let eyes = targets.colour.desc().extent;
            let depths = targets.depth.as_ref().map_or(eyes, |it| it.desc().extent);
            let linear = vk::Format::R8G8B8A8_UNORM;
            let colour = vk::ImageUsageFlags::COLOR_ATTACHMENT;
            let depth = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
            Pictures {
                colour: image("eyes", eyes, 2, linear, colour),
                depth: image("depth", depths, 2, vk::Format::D32_SFLOAT, depth),
                panel: image("panel", PANEL, 1, linear, colour),
            }
        });
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        for ((texels, image), word) in [
            (&pictures.colour, u32::from_le_bytes([64, 128, 191, 255])),
            (&pictures.depth, 0.0_f32.to_bits()),
            (&pictures.panel, u32::from_le_bytes([255, 0, 0, 255])),
        ] {
            rec.fill(texels, word).unwrap();
            rec.copy_to_image(texels, image).unwrap();
        }
        rec.copy_image(&pictures.colour.1, &targets.colour).unwrap();
        if let Some(panel) = &targets.panel {
            rec.copy_image(&pictures.panel.1, panel).unwrap();
        }
        if let Some(depth) = &targets.depth {
            rec.copy_image(&pictures.depth.1, depth).unwrap();
        }
        gpu.submit(rec).unwrap();
    }

    /// Fails where Vulkan's validation layer has said anything about the present device.
    pub fn assert_silent(&self) {
        self.xr.gpu().wait_idle().unwrap();
        let messages = self.xr.gpu().take_validation_messages();
        assert!(messages.is_empty(), "Vulkan's layer says: {messages:#?}");
    }
}
