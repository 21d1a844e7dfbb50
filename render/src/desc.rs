//! Description from which a renderer is made.

use crate::RenderError;
use crate::tints::Tint;

/// Size and views of the picture, and its liquid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RenderDesc {
    /// Width and height of each view's image, pixels.
    pub extent: [u32; 2],
    /// 1 (a film) or 2 (a headset's eyes).
    pub views: u32,
    /// The liquid surface that frames may ask for; `None` for none.
    pub liquid: Option<LiquidDesc>,
    /// How many invocations share a particle.
    pub lanes: Lanes,
    /// Whether frames may be foveated, which takes pipelines of its own.
    pub foveated: bool,
}

/// How many invocations share a particle; `None` as many as suit the device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lanes {
    /// Its neighbours, whose sums go from lane to lane: a power of two, up to 32 and to the
    /// device's smallest subgroup. Other lanes are another order of sums, so other rounding.
    pub neighbours: Option<u32>,
    /// Its pixels: a power of two from 8 to 1,024, on any device. The picture has the same bits
    /// with each.
    pub pixels: Option<u32>,
}

impl Lanes {
    /// Numbers of lanes that suit the device.
    pub const CHOSEN: Self = Self {
        neighbours: None,
        pixels: None,
    };
}

impl RenderDesc {
    /// One view of `extent` in 8-bit sRGB, without a liquid surface: a film.
    pub const fn film(extent: [u32; 2]) -> Self {
        Self {
            extent,
            views: 1,
            liquid: None,
            lanes: Lanes::CHOSEN,
            foveated: false,
        }
    }

    /// Checks that a buffer of `limit` bytes has a number for each pixel of each view, as several of the passes need.
    pub(crate) fn check(&self, limit: u64) -> Result<(), RenderError> {
        let [width, height] = self.extent.map(u64::from);
        let most = limit / size_of::<f32>() as u64 / u64::from(self.views.max(1));
        if width * height <= most {
            return Ok(());
        }
        let share = (most as f64 / (width * height) as f64).sqrt();
        Err(RenderError::TooManyPixels {
            extent: self.extent,
            limit,
            largest: self.extent.map(|side| (f64::from(side) * share) as u32),
        })
    }
}

/// How the depth of the splatted ellipsoids becomes a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SurfaceFilter {
    /// Truong and Yuksel's narrow-range filter of 2018.
    #[default]
    NarrowRange,
    /// Van der Laan's screen-space curvature flow of 2009, which the paper uses.
    CurvatureFlow,
    /// No filter: the ellipsoids as they are, for comparison.
    None,
}

/// The liquid surface that a renderer is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LiquidDesc {
    /// Particles at most.
    pub particles: u32,
    /// Places of bubbles at most, and of drops.
    pub bubbles: u32,
    /// Filter of the depth.
    pub filter: SurfaceFilter,
    /// Whether particles are ellipsoids by their neighbours' places; else spheres.
    pub anisotropic: bool,
    /// Its absorption.
    pub tint: Tint,
}

impl LiquidDesc {
    /// A liquid of `particles` at most, without bubbles, with the program's own filter and tint.
    pub const fn new(particles: u32) -> Self {
        Self {
            particles,
            bubbles: 0,
            filter: SurfaceFilter::NarrowRange,
            anisotropic: true,
            tint: Tint::Artificial,
        }
    }
}
