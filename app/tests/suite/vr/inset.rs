//! A session whose headset has a second pair of pictures over a part of the first (quad views).

use vitriol_gpu::{Gpu, Image, ImageDesc, vk};
use vitriol_session::foveating::Foveating;
use vitriol_session::session::SessionOutcome;
use vitriol_tests::gpu;
use vitriol_xr::{Fov, Inset, InsetTargets, Pose, View, depth_extent};

use crate::vr::common::{Settled, Worn, hash, pour, run};
use crate::vr::seen::read;

const EXTENT: [u32; 2] = [320, 340];
/// What the inset of each eye sees, rad: none of it is as much to one side as to the other.
const SEES: [Fov; 2] = [
    Fov {
        left: -0.35,
        right: 0.15,
        up: 0.1,
        down: -0.4,
    },
    Fov {
        left: -0.3,
        right: 0.25,
        up: 0.05,
        down: -0.45,
    },
];

/// How much a smoothed edge may differ, levels of 255: a sampler takes places as shares of the image, which is larger where it takes
/// other pictures too, and rounds them to 1/256 of a pixel at best.
const SAMPLED: u8 = 2;

/// Colour and depth of both eyes.
struct Pictures {
    colour: Vec<[u8; 4]>,
    depth: Vec<f32>,
}

impl Pictures {
    fn of(gpu: &Gpu, colour: &Image, depth: &Image) -> Self {
        Self {
            colour: read(gpu, colour),
            depth: gpu::read_back(gpu, depth).get().unwrap(),
        }
    }

    /// Of the eyes.
    fn of_eyes<T>(gpu: &Gpu, headset: &Worn<T>) -> Self {
        let targets = &headset.inner.targets;
        Self::of(gpu, &targets.colour, targets.depth.as_ref().unwrap())
    }

    /// Fails where they are not the same but for what a sampler rounds; and where nothing is to be seen.
    fn assert_like(&self, other: &Self, what: &str) {
        assert!(self.depth == other.depth, "{what}: depths");
        assert_eq!(self.colour.len(), other.colour.len());
        let off = |(a, b): (&[u8; 4], &[u8; 4])| {
            let levels = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
            levels.max().unwrap_or(0)
        };
        let most = self.colour.iter().zip(&other.colour).map(off).max();
        assert!(most <= Some(SAMPLED), "{what}: {most:?}");
        let middle = self.depth[self.depth.len() / 4];
        let other = |depth: &&f32| (**depth - middle).abs() > 0.1 * middle;
        let others = self.depth.iter().filter(other).count();
        assert!(others > self.depth.len() / 20, "{what}: {others} depths");
    }
}

/// Of so many pixels, with images for them.
pub fn inset_of(gpu: &Gpu, extent: [u32; 2]) -> (Inset, InsetTargets) {
    let image = |label, extent, format| {
        let desc = ImageDesc {
            extent,
            layers: 2,
            format,
            usage: vk::ImageUsageFlags::SAMPLED,
        };
        Image::new(gpu, label, desc).unwrap()
    };
    let views = SEES.map(|fov| View {
        stage_from_eye: Pose::IDENTITY,
        fov,
    });
    let colour = image("inset", extent, vk::Format::R8G8B8A8_SRGB);
    let depth = image(
        "inset's depth",
        depth_extent(extent),
        vk::Format::D32_SFLOAT,
    );
    let targets = InsetTargets {
        colour,
        depth: Some(depth),
    };
    (Inset { extent, views }, targets)
}

/// A session with pictures of `extent`, in which `wear` changes the headset.
fn session(
    gpu: &Gpu,
    extent: [u32; 2],
    foveating: Foveating,
    wear: impl FnOnce(&mut Worn<Settled>),
) -> (Worn<Settled>, SessionOutcome) {
    let track = pour().sample_track();
    let mut headset = Worn::of_extent(gpu, track, extent, (90.0, 5), Settled(gpu.clone()));
    wear(&mut headset);
    let (outcome, _) = run(&mut headset, |it| it.foveating = Some(foveating));
    (headset, outcome)
}

fn with_inset(gpu: &Gpu, extent: [u32; 2]) -> (Worn<Settled>, SessionOutcome) {
    session(gpu, EXTENT, Foveating::Eye, |headset| {
        headset.inset = Some(inset_of(gpu, extent));
        // Nothing is made of it: the runtime's foveation is.
        headset.inner.gaze = Some(Pose::IDENTITY);
    })
}

/// Pictures of the inset.
fn of_inset(gpu: &Gpu, headset: &Worn<Settled>) -> Pictures {
    let (_, targets) = headset.inset.as_ref().unwrap();
    Pictures::of(gpu, &targets.colour, targets.depth.as_ref().unwrap())
}

/// What the inset sees, drawn as the eyes' pictures of a headset of that size, of which nothing is hidden.
fn alone(gpu: &Gpu, extent: [u32; 2]) -> Pictures {
    let (headset, _) = session(gpu, extent, Foveating::Off, |headset| {
        headset.sees = Some(SEES);
        headset.hidden.clear();
    });
    Pictures::of_eyes(gpu, &headset)
}

/// With an inset that is smaller than the eyes' pictures these are the same to the last bit, every pixel of them shaded, and so is
/// what is simulated.
#[test]
fn it_leaves_the_eyes_pictures_as_they_are() {
    let gpu = gpu::device();
    let (plain, of_plain) = session(&gpu, EXTENT, Foveating::Off, |_| {});
    let (headset, outcome) = with_inset(&gpu, [212, 160]);
    assert_eq!(outcome.inset, Some([212, 160]));
    assert_eq!(
        (of_plain.inset, outcome.foveating),
        (None, Some(Foveating::Eye))
    );
    assert_eq!(hash(&outcome), hash(&of_plain));
    let (plain, eyes) = (
        Pictures::of_eyes(&gpu, &plain),
        Pictures::of_eyes(&gpu, &headset),
    );
    assert!(plain.colour == eyes.colour, "colours");
    assert!(plain.depth == eyes.depth, "depths");
    // What mirror and console show is the eyes' picture too.
    assert!(read(&gpu, outcome.bench.picture.image()) == eyes.colour);
}

mod long {
    use super::*;

    /// In it is what is there: as in pictures of that field of view and size alone, without what the lenses hide of the eyes' pictures.
    #[test]
    fn it_shows_what_the_eyes_see_there() {
        let gpu = gpu::device();
        // Smaller on both sides; wider and less high.
        for extent in [[212, 160], [351, 233]] {
            let (headset, _) = with_inset(&gpu, extent);
            of_inset(&gpu, &headset).assert_like(&alone(&gpu, extent), &format!("{extent:?}"));
            // Each frame is shown with what it was drawn with.
            assert_eq!(headset.shown.len(), 5);
            for shown in &headset.shown {
                let inset = shown.inset.unwrap();
                assert_eq!((shown.extent, inset.extent), (EXTENT, extent));
                assert_eq!(inset.views.map(|view| view.fov), SEES);
                let eyes = shown.views.map(|view| view.stage_from_eye);
                assert_eq!(inset.views.map(|view| view.stage_from_eye), eyes);
            }
        }
    }

    /// The eyes' pictures lie in larger images beside a larger inset, and are the same but for what a sampler rounds.
    #[test]
    fn a_larger_one_leaves_the_eyes_pictures_as_they_are() {
        let gpu = gpu::device();
        let (plain, _) = session(&gpu, EXTENT, Foveating::Off, |headset| {
            headset.hidden.clear()
        });
        let (headset, _) = session(&gpu, EXTENT, Foveating::Eye, |headset| {
            headset.hidden.clear();
            headset.inset = Some(inset_of(&gpu, [401, 397]));
        });
        let eyes = Pictures::of_eyes(&gpu, &headset);
        eyes.assert_like(&Pictures::of_eyes(&gpu, &plain), "eyes");
        of_inset(&gpu, &headset).assert_like(&alone(&gpu, [401, 397]), "inset");
    }
}
