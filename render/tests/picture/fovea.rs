//! Foveated pictures against those of which every pixel is shaded.

use glam::{Affine3A, DVec3, Vec3};
use vitriol_gpu::{Buffer, QueueKind, vk};
use vitriol_render::{
    Bone, Finish, Fov, Foveation, FrameDesc, LiquidDesc, Panel, RenderDesc, RenderError, SceneDesc,
    SteamSource, VesselDesc, View,
};
use vitriol_shaders::layout::Puff;

use crate::liquid::{Liquid, frame, lattice, rig_of};
use crate::panel::image;
use crate::rig::{LEFT_QUARTER, Picture, Rig, cylinder, ray};

/// Of no whole number of tiles or blocks.
pub const EXTENT: [u32; 2] = [635, 467];
pub const TILE: u32 = 32;
/// Foot of the middle one of three beakers.
const FOOT: Vec3 = Vec3::new(0.0, 0.75, -0.4);

/// A bench with three beakers, of which one holds liquid, a hand and steam.
pub struct Bench {
    pub rig: Rig,
    vessels: Vec<Affine3A>,
    liquid: Liquid,
    hand: [Bone; 2],
    puffs: Buffer,
}

impl Bench {
    /// Its glass on its table, in a room with furniture or without.
    pub fn scene(furnished: bool) -> SceneDesc {
        let glass = VesselDesc {
            marks: vec![0.012, 0.022],
            ..cylinder([0.02, 0.022], 0.002, 0.05)
        };
        SceneDesc {
            furnished,
            ..SceneDesc::laboratory(vec![glass; 3], 0.75, 1.0)
        }
    }

    pub fn new() -> Self {
        let mut rig = rig_of(&RenderDesc {
            views: 2,
            liquid: Some(LiquidDesc::new(20_000)),
            foveated: true,
            ..RenderDesc::film(EXTENT)
        });
        rig.set_scene(&Self::scene(true));
        let places = lattice(7, 0.3, |x| x.length() < 6.0);
        let middle = FOOT + Vec3::new(0.0, 0.02, 0.0);
        let places: Vec<_> = places.iter().map(|place| middle + *place).collect();
        let liquid = Liquid::new(&rig, &places, |x| if x.y < middle.y { 0.9 } else { 0.0 });
        let at = |x: f32| Affine3A::from_translation(FOOT + Vec3::new(x, 0.0, -0.02 * x));
        let bone = |x: f32| {
            Bone::new(
                Finish::Glove,
                [
                    FOOT + Vec3::new(x, 0.03, 0.02),
                    FOOT + Vec3::new(x + 0.03, 0.09, 0.04),
                ],
                [0.009, 0.008],
            )
        };
        let puff = Puff {
            position: (FOOT + Vec3::new(0.08, 0.06, 0.0)).to_array(),
            radius: 0.03,
            depth: 1.0,
            ..Puff::default()
        };
        let puffs = rig.filled("puffs", &[puff]);
        Self {
            vessels: [-0.14, 0.0, 0.11].map(at).to_vec(),
            hand: [bone(0.04), bone(-0.11)],
            rig,
            liquid,
            puffs,
        }
    }

    pub fn frame<'a>(&'a self, views: &'a [View], foveation: Option<Foveation>) -> FrameDesc<'a> {
        FrameDesc {
            hands: [&self.hand, &[]],
            foveation,
            ..frame(views, &self.vessels, &self.liquid)
        }
    }

    pub fn steam(&self) -> Option<SteamSource<'_>> {
        Some(SteamSource {
            puffs: &self.puffs,
            count: 1,
            dew: None,
        })
    }

    /// The picture before edges are smoothed, a view beside the other.
    fn drawn(&self, frame: &FrameDesc<'_>) -> Vec<u8> {
        let mut rec = self.rig.gpu.recorder(QueueKind::Main).unwrap();
        self.rig.renderer.record(&mut rec, frame).unwrap();
        let passes = self.rig.renderer.read_back_passes(&mut rec, frame).unwrap();
        self.rig.gpu.submit(rec).unwrap().wait().unwrap();
        let pictures = passes.pictures().unwrap();
        let drawn = pictures.into_iter().find(|pass| pass.name == "picture");
        drawn.unwrap().pixels
    }
}

/// Frusta of two eyes that see more aside than towards the nose.
const FOVS: [Fov; 2] = [
    Fov {
        left: -0.94,
        right: 0.70,
        up: 0.60,
        down: -0.75,
    },
    Fov {
        left: -0.70,
        right: 0.94,
        up: 0.60,
        down: -0.75,
    },
];

/// From above, past the middle beaker: to that of the left hand and to the right.
pub fn views(turn: f32) -> [View; 2] {
    let look = |eye: usize, target: f32| {
        let from = FOOT + Vec3::new(0.03 + 0.06 * eye as f32, 0.12, 0.16);
        let target = FOOT + Vec3::new(target, 0.02, 0.0);
        let mut view = View::look_at(from, target, FOVS[eye]);
        view.stage_from_eye.matrix3 =
            glam::Mat3A::from_rotation_y(turn) * view.stage_from_eye.matrix3;
        view
    };
    [look(0, 0.0), look(1, 0.16)]
}

fn to(towards: [[f32; 2]; 2]) -> Foveation {
    Foveation {
        towards,
        ..Foveation::fixed()
    }
}

/// Angle of a pixel's middle from the fovea, degrees.
pub fn away(view: &View, towards: [f32; 2], x: u32, y: u32) -> f64 {
    let axes = view.stage_from_eye.matrix3.as_dmat3();
    let fovea = axes * DVec3::new(towards[0].into(), towards[1].into(), -1.0);
    ray(view, EXTENT, x, y).angle_between(fovea).to_degrees()
}

pub fn pixel(picture: &[u8], width: u32, x: u32, y: u32) -> [u8; 4] {
    let at = 4 * (y * width + x) as usize;
    picture[at..at + 4].try_into().unwrap()
}

fn pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..EXTENT[1]).flat_map(|y| (0..EXTENT[0]).map(move |x| (x, y)))
}

/// Greatest difference of two pixels' channels, levels.
fn apart(a: [u8; 4], b: [u8; 4]) -> u8 {
    let apart = a.iter().zip(b).map(|(a, b)| a.abs_diff(b));
    apart.max().unwrap()
}

/// Wherever the fovea is, in both eyes; and without one the renderer draws as a renderer without coarse passes does.
#[test]
fn within_the_fovea_every_pixel_is_the_same() {
    let bench = Bench::new();
    let views = views(0.0);
    let with = |foveation| FrameDesc {
        steam: bench.steam(),
        ..bench.frame(&views, foveation)
    };
    let full = bench.rig.draw(&with(None));
    for towards in [
        [[0.0; 2]; 2],
        [[-0.9, 0.3], [0.5, -0.6]],
        [[0.31, -0.17], [1.2, 0.6]],
    ] {
        let foveated = bench.rig.draw(&with(Some(to(towards))));
        let (mut within, mut changed) = (0, 0);
        for eye in 0..2 {
            for (x, y) in pixels() {
                let at = |picture: &Picture| {
                    let depth = picture.depth[eye][(y * EXTENT[0] + x) as usize];
                    (pixel(&picture.colour[eye], EXTENT[0], x, y), depth)
                };
                let same = at(&full) == at(&foveated);
                if away(&views[eye], towards[eye], x, y) <= 10.0 {
                    assert!(same, "{towards:?}, eye {eye}, ({x}, {y})");
                    within += 1;
                } else if !same {
                    changed += 1;
                }
            }
        }
        eprintln!("{towards:?}: {within} pixels within, {changed} changed beyond");
        assert!(within > 4000 && changed > 20_000, "{within} {changed}");
    }
}

/// Side of the blocks of a tile that was foveated to `towards`, by angles computed anew at each pixel around it. `None` where a tenth of a
/// degree decides.
fn side(
    view: &View,
    foveation: &Foveation,
    eye: usize,
    [column, row]: [u32; 2],
    plain: bool,
) -> Option<u32> {
    let mut least = f64::MAX;
    let grown = |tile: u32| (TILE * tile).saturating_sub(6)..=TILE * (tile + 1) + 6;
    for y in grown(row) {
        for x in grown(column) {
            least = least.min(away(view, foveation.towards[eye], x, y));
        }
    }
    let sharp = f64::from(foveation.sharp.to_degrees());
    let quarter = f64::from(foveation.quarter.to_degrees());
    // The grid of middles misses its corners by half a pixel, some 0.15°.
    if (least - sharp).abs() < 0.25 || (least - quarter).abs() < 0.25 {
        return None;
    }
    Some(match () {
        () if least < sharp => 1,
        () if least < quarter || !plain => 2,
        () => 4,
    })
}

/// Whether a tile's depths are one in each block of so many pixels along its sides.
fn has_blocks(depth: &[f32], [column, row]: [u32; 2], side: u32) -> bool {
    let at = |x: u32, y: u32| depth[(y * EXTENT[0] + x) as usize];
    let rows = TILE * row..TILE * (row + 1);
    let mut pixels = rows.flat_map(|y| (TILE * column..TILE * (column + 1)).map(move |x| (x, y)));
    pixels.all(|(x, y)| at(x, y) == at(x - x % side, y - y % side))
}

impl Bench {
    fn without_glass(mut self) -> Self {
        self.vessels.clear();
        self.rig
            .set_scene(&SceneDesc::laboratory(Vec::new(), 0.75, 1.0));
        self
    }
}

/// Beyond the fovea a tile has every second pixel of the full picture in each direction, or every fourth where only the room is seen, and
/// interpolated colours between them.
#[test]
fn beyond_it_pixels_lie_between_those_that_are_shaded() {
    let mut bench = Bench::new();
    // On a GPU a block's four rays to the glass are spread over its pixels, each of which has four in the full picture.
    if bench.rig.gpu.info().kind != vk::PhysicalDeviceType::CPU {
        bench = bench.without_glass();
    }
    let views = views(0.0);
    let drawn = bench.drawn(&bench.frame(&views, None));
    let towards = [[0.1, 0.05], [-0.4, -0.2]];
    let foveation = to(towards);
    let foveated = bench.rig.draw(&bench.frame(&views, Some(foveation)));
    let mut of_side = [0; 5];
    for eye in 0..2_u32 {
        let full = |x: i32, y: i32| {
            let x = x.clamp(0, EXTENT[0] as i32 - 1) as u32;
            let y = y.clamp(0, EXTENT[1] as i32 - 1) as u32;
            pixel(&drawn, 2 * EXTENT[0], eye * EXTENT[0] + x, y)
        };
        let expected = |x: u32, y: u32, side: u32| {
            let (half, side_) = (side as i32 / 2, side as i32);
            let first = |at: u32| (at as i32 - half).div_euclid(side_);
            let share = |at: u32| f64::from((at as i32 - half).rem_euclid(side_)) / f64::from(side);
            let sample = |dx: i32, dy: i32, channel: usize| {
                let x = (first(x) + dx) * side_ + half;
                f64::from(full(x, (first(y) + dy) * side_ + half)[channel])
            };
            [0, 1, 2].map(|channel| {
                let row = |dy| {
                    let (a, b) = (sample(0, dy, channel), sample(1, dy, channel));
                    a + (b - a) * share(x)
                };
                row(0) + (row(1) - row(0)) * share(y)
            })
        };
        for row in 1..EXTENT[1] / TILE - 1 {
            for column in 1..EXTENT[0] / TILE - 1 {
                let view = &views[eye as usize];
                let inner = |tile: u32| TILE * tile + 4..TILE * (tile + 1) - 4;
                let is = |side: u32| {
                    inner(row).all(|y| {
                        inner(column).all(|x| {
                            let found = pixel(&foveated.colour[eye as usize], EXTENT[0], x, y);
                            let wanted = expected(x, y, side);
                            // Rounded once more.
                            let off =
                                |(found, wanted): (&u8, f64)| (f64::from(*found) - wanted).abs();
                            found.iter().zip(wanted).map(off).all(|off| off <= 1.0)
                        })
                    })
                };
                let tile = [column, row];
                let depth = &foveated.depth[eye as usize];
                let found = if has_blocks(depth, tile, 4) {
                    4
                } else if has_blocks(depth, tile, 2) {
                    2
                } else {
                    1
                };
                let allowed =
                    [true, false].map(|plain| side(view, &foveation, eye as usize, tile, plain));
                let [Some(plain), Some(marked)] = allowed else {
                    continue;
                };
                // The renderer marks what is in the tile.
                assert!([plain, marked].contains(&found), "eye {eye}, {tile:?}");
                // Edges are smoothed where all is sharp.
                assert!(found == 1 || is(found), "eye {eye}, {tile:?}: {found}");
                of_side[found as usize] += 1;
            }
        }
    }
    eprintln!("tiles by the side of their blocks: {of_side:?}");
    assert!(
        of_side[1] > 8 && of_side[2] > 60 && of_side[4] > 40,
        "{of_side:?}"
    );
}

/// Pixels that the lens hides stay black, and do not darken pixels beside them.
#[test]
fn hidden_pixels_are_black_and_darken_no_other() {
    let mut bench = Bench::new();
    let views = views(0.0);
    let foveation = Some(Foveation::fixed());
    let open = bench.rig.draw(&bench.frame(&views, foveation));
    let corner = [[1.0, 0.0], [1.0, 0.7], [0.55, 0.0]];
    let masks: [&[[f32; 2]]; 2] = [&LEFT_QUARTER, &corner];
    bench.rig.renderer.set_visibility_mask(&masks).unwrap();
    let full = bench.rig.draw(&bench.frame(&views, None));
    let masked = bench.rig.draw(&bench.frame(&views, foveation));
    // A frame of other views is not masked.
    let other = bench.rig.draw(&FrameDesc {
        part_of: Some(&views),
        ..bench.frame(&views, foveation)
    });
    assert!(other.colour == open.colour && other.depth == open.depth);
    for eye in 0..2 {
        let mut hidden = 0;
        for (x, y) in pixels() {
            let at = |picture: &Picture| pixel(&picture.colour[eye], EXTENT[0], x, y);
            let depth = |picture: &Picture| picture.depth[eye][(y * EXTENT[0] + x) as usize];
            if depth(&full) == 1.0 {
                assert_eq!(
                    (at(&masked), depth(&masked)),
                    ([0, 0, 0, 255], 1.0),
                    "({x}, {y})"
                );
                hidden += 1;
            } else {
                // Next to the mask the block's own pixel stands for those that no eye sees.
                let apart = apart(at(&open), at(&masked));
                assert!(apart <= 60, "eye {eye}, ({x}, {y}): {apart}");
                assert!(depth(&masked) < 1.0);
            }
        }
        assert!(hidden > 30_000, "{hidden}");
    }
}

/// Text can be read wherever it is: panel and sign have every pixel, also beside the fovea.
#[test]
fn a_panel_is_sharp_beside_the_fovea() {
    let bench = Bench::new();
    let views = views(0.0);
    let image = image(&bench.rig);
    let at = |x: f32| {
        let place = views[0]
            .stage_from_eye
            .transform_point3(Vec3::new(x, 0.25, -0.7));
        let (axes, eye) = (
            views[0].stage_from_eye.matrix3,
            views[0].stage_from_eye.translation,
        );
        let facing = (Vec3::from(eye) - place).normalize();
        let right = Vec3::from(axes.y_axis).cross(facing).normalize();
        let turned = glam::Mat3::from_cols(right, facing.cross(right), facing);
        Panel {
            image: &image,
            stage_from_panel: Affine3A::from_mat3_translation(turned, place),
            size: [0.18, 0.14],
        }
    };
    let with = |foveation| FrameDesc {
        panel: Some(at(-0.55)),
        sign: Some(at(0.35)),
        ..bench.frame(&views, foveation)
    };
    let full = bench.rig.draw(&with(None));
    let without = bench.rig.draw(&bench.frame(&views, None));
    let foveated = bench.rig.draw(&with(Some(Foveation::fixed())));
    let mut beyond = 0;
    for (x, y) in pixels() {
        let at = |picture: &Picture| pixel(&picture.colour[0], EXTENT[0], x, y);
        let index = (y * EXTENT[0] + x) as usize;
        // Where there is another depth than without them, one of the two is seen.
        if full.depth[0][index] != without.depth[0][index] {
            assert_eq!(at(&full), at(&foveated), "({x}, {y})");
            beyond += u32::from(away(&views[0], [0.0; 2], x, y) > 12.0);
        }
    }
    eprintln!("{beyond} pixels of panel and sign beyond the fovea");
    assert!(beyond > 4000, "{beyond}");
}

#[test]
fn a_renderer_without_coarse_passes_refuses_a_foveated_frame() {
    let rig = Rig::new(EXTENT, 2);
    let views = views(0.0);
    let frame = FrameDesc {
        foveation: Some(Foveation::fixed()),
        ..FrameDesc::empty(&views)
    };
    let error = rig.refusal(&frame);
    assert!(matches!(error, RenderError::NotFoveated), "{error}");
}
