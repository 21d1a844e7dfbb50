//! Contribution of a wall to the density sum: V(x) = ∫_solid W(x − x′, h) dx′,
//! the fraction of the kernel's weight that lies in the solid.
//!
//! Density maps of Koschier & Bender 2017, and volume maps of Bender et al.
//! 2019, are tables in three dimensions; a vessel of revolution needs (r, y)
//! only. The integral is not sampled in the volume: on the circle of radius s
//! at height offset t around the particle, the part in the solid is an arc of
//! known angle, which leaves a smooth double integral over (s, t).

use super::profile::Profile;
use crate::kernel::Kernel;
use std::f64::consts::PI;

/// Nodes of the table per support radius.
const NODES_PER_SUPPORT: f64 = 6.0;

/// Which particles a [`VolumeMap`] is for. Glass is thinner than the support
/// radius, so no one map can serve both sides without letting the liquid
/// inside feel the air outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// For particles in the liquid space: solid is everything below the rim
    /// that is not liquid space, however far out.
    Inside,
    /// For all other particles: solid is the glass.
    Outside,
}

/// Value of a boundary map at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MapSample {
    /// Signed distance to the surface, metres: for [`Side::Inside`]
    /// [`Profile::signed_distance_inner`], for [`Side::Outside`]
    /// [`Profile::signed_distance_glass`].
    pub distance: f64,
    /// V: the solid's part of a full density, 0 to 1.
    pub volume: f64,
    /// ∂V/∂r, 1/m.
    pub volume_dr: f64,
    /// ∂V/∂y, 1/m.
    pub volume_dy: f64,
}

/// Nodes `spacing` apart (metres) in r and in y that reach h beyond the vessel.
fn nodes(profile: &Profile, support: f64, spacing: f64) -> [f64; 2] {
    let size = [
        profile.outer_radius() + support,
        profile.rim_height() + 2.0 * support,
    ];
    size.map(|length| (length / spacing).ceil() + 1.0)
}

/// Table of [`MapSample`]s over (r, y) in the flask's frame, from the axis
/// and h below the base to h outside of the vessel.
#[derive(Clone, Debug)]
pub struct VolumeMap {
    /// Distance between nodes in r and in y, metres.
    pub(crate) spacing: f64,
    /// Height of the first row in the flask's frame, metres; the first
    /// column is at r = 0.
    pub(crate) base: f64,
    /// Nodes in r and in y.
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// The table for the GPU: [distance (m), V, ∂V/∂r (1/m), ∂V/∂y (1/m)],
    /// r running fastest.
    pub(crate) nodes: Vec<[f32; 4]>,
}

impl VolumeMap {
    /// Map of `profile` for a kernel of support radius `support` (metres).
    pub fn new(profile: &Profile, side: Side, support: f64) -> Self {
        Self::refined(profile, side, support, 1)
    }

    /// Nodes in r and in y that a table for this support radius (metres) takes; infinite where
    /// the profile's size is.
    pub fn size(profile: &Profile, support: f64) -> [f64; 2] {
        nodes(profile, support, support / NODES_PER_SUPPORT)
    }

    /// Map of `profile` like that of [`VolumeMap::new`], with nodes `refinement` times as close in r and y: tests separate the
    /// error of the law from that of its interpolation by it.
    pub(crate) fn refined(profile: &Profile, side: Side, support: f64, refinement: u32) -> Self {
        let spacing = support / (NODES_PER_SUPPORT * f64::from(refinement));
        let [columns, rows] = nodes(profile, support, spacing).map(|count| count as usize);
        let base = -support;
        let integral = Integral::new(profile, side, support);
        let node = |index: usize| {
            let r = (index % columns) as f64 * spacing;
            let y = base + (index / columns) as f64 * spacing;
            let sample = integral.sample(r, y);
            [
                sample.distance as f32,
                sample.volume as f32,
                sample.volume_dr as f32,
                sample.volume_dy as f32,
            ]
        };
        Self {
            spacing,
            base,
            columns,
            rows,
            nodes: (0..columns * rows).map(node).collect(),
        }
    }

    /// Bilinear interpolation at (r, y). Outside of the table V is 0 and the
    /// distance is that of the table's edge plus the way to it, a lower
    /// bound.
    pub fn sample(&self, r: f64, y: f64) -> MapSample {
        let column = r / self.spacing;
        let row = (y - self.base) / self.spacing;
        let edge_column = column.clamp(0.0, (self.columns - 1) as f64);
        let edge_row = row.clamp(0.0, (self.rows - 1) as f64);
        let i = (edge_column as usize).min(self.columns - 2);
        let j = (edge_row as usize).min(self.rows - 2);
        let (s, t) = (edge_column - i as f64, edge_row - j as f64);
        let at = |k: usize| {
            let value = |i: usize, j: usize| f64::from(self.nodes[j * self.columns + i][k]);
            (1.0 - t) * ((1.0 - s) * value(i, j) + s * value(i + 1, j))
                + t * ((1.0 - s) * value(i, j + 1) + s * value(i + 1, j + 1))
        };
        let away = (column - edge_column).hypot(row - edge_row) * self.spacing;
        if away > 0.0 {
            return MapSample {
                distance: at(0).abs().max(away),
                ..MapSample::default()
            };
        }
        MapSample {
            distance: at(0),
            volume: at(1),
            volume_dr: at(2),
            volume_dy: at(3),
        }
    }
}

/// Gauss–Legendre nodes and weights on [−1, 1], order 16 (Abramowitz &
/// Stegun, table 25.4); the other half by symmetry.
const GAUSS: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_5),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_7),
    (0.755_404_408_355_003, 0.124_628_971_255_533_9),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_8),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_9),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_1),
];

/// Calls `visit(x, weight)` at the nodes of ∫_a^b.
fn quadrature(a: f64, b: f64, mut visit: impl FnMut(f64, f64)) {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    for (node, weight) in GAUSS {
        visit(middle - half * node, half * weight);
        visit(middle + half * node, half * weight);
    }
}

/// The integral behind one map.
struct Integral<'a> {
    profile: &'a Profile,
    side: Side,
    kernel: Kernel,
}

/// V and its two derivatives, summed up.
#[derive(Default)]
struct Sums {
    volume: f64,
    dr: f64,
    dy: f64,
}

impl<'a> Integral<'a> {
    fn new(profile: &'a Profile, side: Side, support: f64) -> Self {
        Self {
            profile,
            side,
            kernel: Kernel::new(support),
        }
    }

    fn sample(&self, r: f64, y: f64) -> MapSample {
        let h = self.kernel.support();
        let distance = match self.side {
            Side::Inside => self.profile.signed_distance_inner(r, y),
            Side::Outside => self.profile.signed_distance_glass(r, y),
        };
        let mut sums = Sums::default();
        if distance < h {
            let floor = self.profile.floor_height();
            let rim = self.profile.rim_height();
            let breaks = [y - h, 0.0, floor, rim, y + h].map(|level| level.clamp(y - h, y + h));
            for pair in breaks.windows(2).filter(|pair| pair[1] > pair[0]) {
                quadrature(pair[0], pair[1], |level, weight| {
                    self.add_slice(r, level, level - y, weight, &mut sums);
                });
            }
        }
        MapSample {
            distance,
            volume: sums.volume,
            volume_dr: sums.dr,
            volume_dy: sums.dy,
        }
    }

    /// Adds the horizontal slice at `level`, `rise` above the particle.
    fn add_slice(&self, r: f64, level: f64, rise: f64, weight: f64, sums: &mut Sums) {
        let profile = self.profile;
        if level > profile.rim_height() {
            return;
        }
        let hole = profile.inner_radius(level);
        match self.side {
            Side::Inside => self.add_outside_of(r, hole, rise, weight, sums),
            Side::Outside if level >= 0.0 => {
                self.add_outside_of(r, hole, rise, weight, sums);
                let outer = profile.outer_radius_at(level);
                self.add_outside_of(r, outer, rise, -weight, sums);
            }
            Side::Outside => {}
        }
    }

    /// Adds the area outside of the disc of radius `disc` about the axis in
    /// the slice `rise` above the particle, which is at radius `r`.
    fn add_outside_of(&self, r: f64, disc: f64, rise: f64, weight: f64, sums: &mut Sums) {
        let reach2 = self.kernel.support().powi(2) - rise * rise;
        if reach2 <= 0.0 {
            return;
        }
        let reach = reach2.sqrt();
        // Circles of radius s: wholly in or out of the disc up to |disc − r|,
        // wholly around it from disc + r.
        let first = (disc - r).abs().min(reach);
        let last = (disc + r).clamp(first, reach);
        if r > disc {
            self.add_circles(0.0, first, |_| PI, rise, weight, sums);
        }
        let cut = |s: f64| {
            let cosine = (disc * disc - r * r - s * s) / (2.0 * r * s);
            cosine.clamp(-1.0, 1.0).acos()
        };
        self.add_circles(first, last, cut, rise, weight, sums);
        self.add_circles(last, reach, |_| PI, rise, weight, sums);
    }

    /// Adds arcs of half angle `half_angle(s)` about the outward direction,
    /// for s from `a` to `b`.
    fn add_circles(
        &self,
        a: f64,
        b: f64,
        half_angle: impl Fn(f64) -> f64,
        rise: f64,
        weight: f64,
        sums: &mut Sums,
    ) {
        if b <= a {
            return;
        }
        quadrature(0.0, 1.0, |u, du| {
            // The angle opens like a square root at either end; this
            // substitution makes the integrand smooth there.
            let s = a + (b - a) * u * u * (3.0 - 2.0 * u);
            let ds = (b - a) * 6.0 * u * (1.0 - u) * du * weight;
            let angle = half_angle(s);
            let distance = s.hypot(rise);
            let arc = 2.0 * s * angle * ds;
            sums.volume += self.kernel.w(distance) * arc;
            if distance > 0.0 {
                // ∇W(x − x′) points from the solid to the particle times a
                // negative slope.
                let slope = -self.kernel.dw(distance) / distance;
                sums.dy += slope * rise * arc;
                sums.dr += slope * 2.0 * s * s * angle.sin() * ds;
            }
        });
    }
}

/// V of a half space (table top, floor) in closed form, as a function of the
/// distance to its plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneMap {
    support: f64,
}

impl PlaneMap {
    /// Half space for a kernel of support radius `support` (metres).
    pub fn new(support: f64) -> Self {
        Self { support }
    }

    /// V at `distance` metres in front of the plane (negative: in the solid).
    pub fn volume(&self, distance: f64) -> f64 {
        let q = distance / self.support;
        if q < 0.0 {
            1.0 - volume_beyond(-q)
        } else {
            volume_beyond(q)
        }
    }

    /// dV/d(distance), 1/m.
    pub fn slope(&self, distance: f64) -> f64 {
        -16.0 * area((distance / self.support).abs()) / self.support
    }

    /// `count` uniform samples [V, dV/d(distance)] at distances from 0 to h,
    /// both included, for the GPU.
    pub fn table(&self, count: usize) -> Vec<[f32; 2]> {
        let step = self.support / (count.max(2) - 1) as f64;
        (0..count)
            .map(|i| i as f64 * step)
            .map(|distance| [self.volume(distance) as f32, self.slope(distance) as f32])
            .collect()
    }
}

/// ∫_q^1 t·w(t) dt for the cubic spline's shape w: the plane's cut through
/// the kernel, up to the factor 2πσh².
fn area(q: f64) -> f64 {
    let outer = |u: f64| u.powi(4) * (0.5 - 0.4 * u);
    let inner = |t: f64| t * t * (0.5 + t * t * (1.2 * t - 1.5));
    if q >= 1.0 {
        0.0
    } else if q >= 0.5 {
        outer(1.0 - q)
    } else {
        outer(0.5) + inner(0.5) - inner(q)
    }
}

/// 16·∫_q^1 area(t) dt, for q ≥ 0.
fn volume_beyond(q: f64) -> f64 {
    let outer = |u: f64| u.powi(5) * (0.1 - u / 15.0);
    let inner = |t: f64| t.powi(3) * (1.0 / 6.0 + t * t * (0.2 * t - 0.3));
    if q >= 1.0 {
        0.0
    } else if q >= 0.5 {
        16.0 * outer(1.0 - q)
    } else {
        let at_half = area(0.5) + 0.5 * 0.5 * (0.5 + 0.25 * (0.6 - 1.5));
        16.0 * (outer(0.5) + at_half * (0.5 - q) - (inner(0.5) - inner(q)))
    }
}

#[cfg(test)]
#[path = "map_tests.rs"]
mod tests;
