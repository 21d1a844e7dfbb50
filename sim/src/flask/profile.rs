//! The shape of an axisymmetric vessel.

use super::outline;
use crate::pose::Pose;
use glam::Vec3;
use thiserror::Error;

/// Intervals of the radius lookup table over the inner height.
const INTERVALS: usize = 256;

/// Rows of the outer outline that follow the rounded edge of the base.
const BASE_ROWS: usize = 8;

/// Trial offsets per outer row when the inner region is dilated.
const DILATION_TRIALS: usize = 128;

/// Height or radius over the wall, at most: surfaces are walked in steps of half a
/// wall.
const THINNEST: f64 = 1000.0;

/// Why a list of points is not the profile of a vessel.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ProfileError {
    /// Fewer than two points.
    #[error("a profile has {0} point(s); give at least two, from the inner floor up to the rim")]
    TooFewPoints(usize),
    /// A coordinate or the wall is NaN or infinite.
    #[error("{0} is not a finite number; give metres")]
    NotFinite(String),
    /// A radius below zero.
    #[error("point {index}: radius {radius} m is negative; give a radius of zero or more")]
    NegativeRadius {
        /// Index into the list.
        index: usize,
        /// The radius, metres.
        radius: f64,
    },
    /// The first point is not on the inner floor.
    #[error("point 0: height {0} m; the first point is the inner floor, at height 0")]
    FloorNotZero(f64),
    /// Heights do not rise.
    #[error(
        "point {index}: height {height} m is not above the one before ({before} m); \
         list the points from the floor up, each higher than the last"
    )]
    NotAscending {
        /// Index into the list.
        index: usize,
        /// Its height, metres.
        height: f64,
        /// The height of the point before, metres.
        before: f64,
    },
    /// The wall has no thickness.
    #[error("wall {0} m; give a thickness above zero (laboratory glass: about 0.002)")]
    WallNotPositive(f64),
    /// The rim or the whole vessel is closed.
    #[error("the mouth has radius {0} m; a vessel is open at its rim, so give a radius above zero")]
    ClosedMouth(f64),
    /// A wall too thin for its vessel.
    #[error(
        "a wall of {wall} m around {size} m; give at least a thousandth of the vessel's size \
         (laboratory glass: a fiftieth)"
    )]
    WallTooThin {
        /// The wall, metres.
        wall: f64,
        /// Height or radius, metres.
        size: f64,
    },
    /// Too narrow for a particle.
    #[error(
        "{diameter} m wide at height {height} m, narrower than a particle ({spacing} m); \
         widen the vessel to at least {spacing} m there or use a smaller particle spacing"
    )]
    NarrowerThanParticle {
        /// Inner diameter, metres.
        diameter: f64,
        /// Height above the inner floor, metres.
        height: f64,
        /// Particle spacing d, metres.
        spacing: f64,
    },
}

/// An open vessel of revolution: its inner surface as a table of radii at
/// uniform heights (the paper's r_i(h), section 5), and the glass around it,
/// which is everything within one wall thickness of the liquid space and
/// below the rim.
///
/// The table is the only source: outlines, distances and volumes all follow
/// from its linear interpolation, so that features of the given points finer
/// than 1/256 of the height are rounded off everywhere alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    wall: f64,
    step: f64,
    radii: Vec<f64>,
    volumes: Vec<f64>,
    inner: Vec<[f64; 2]>,
    outer: Vec<[f64; 2]>,
}

impl Profile {
    /// Vessel from `points` (height above the inner floor, inner radius),
    /// from the floor (height 0) up to the rim, and the `wall` thickness, all
    /// in metres.
    ///
    /// A flat floor closes the first point's radius; a round bottom begins at
    /// radius 0 and approximates the arc.
    ///
    /// # Errors
    /// Any [`ProfileError`] but `NarrowerThanParticle`, which needs the
    /// particle: see [`Profile::check_particle`].
    pub fn new(points: &[[f64; 2]], wall: f64) -> Result<Self, ProfileError> {
        validate(points, wall)?;
        let height = points[points.len() - 1][0];
        let step = height / INTERVALS as f64;
        let radii: Vec<f64> = (0..=INTERVALS)
            .map(|i| interpolate(points, i as f64 * step))
            .collect();
        let mut volumes = vec![0.0];
        for pair in radii.windows(2) {
            let below = volumes[volumes.len() - 1];
            volumes.push(below + outline::frustum(step, pair[0], pair[1]));
        }
        let mut profile = Self {
            wall,
            step,
            radii,
            volumes,
            inner: Vec::new(),
            outer: Vec::new(),
        };
        profile.inner = profile.build_inner();
        profile.outer = profile.build_outer();
        Ok(profile)
    }

    /// Refuses a vessel in which a particle of spacing `d` (metres) gets
    /// stuck: from where it first is `d` wide up to the rim it must stay so,
    /// and it must be so by half its height.
    ///
    /// # Errors
    /// [`ProfileError::NarrowerThanParticle`] with the place.
    pub fn check_particle(&self, d: f64) -> Result<(), ProfileError> {
        let first = self.radii.iter().position(|r| 2.0 * r >= d);
        let from = first.unwrap_or(INTERVALS).min(INTERVALS / 2);
        match (from..=INTERVALS).find(|&i| 2.0 * self.radii[i] < d) {
            None => Ok(()),
            Some(i) => Err(ProfileError::NarrowerThanParticle {
                diameter: 2.0 * self.radii[i],
                height: i as f64 * self.step,
                spacing: d,
            }),
        }
    }

    /// Wall thickness, metres.
    pub fn wall(&self) -> f64 {
        self.wall
    }

    /// Height of the inner floor in the flask's frame, metres.
    pub fn floor_height(&self) -> f64 {
        self.wall
    }

    /// Height of the rim in the flask's frame, metres.
    pub fn rim_height(&self) -> f64 {
        self.wall + self.inner_height()
    }

    /// Furthest that any of its glass goes, at most, as it moves from `before` to `after` (stage_from_flask), m.
    pub fn furthest(&self, before: Pose, after: Pose) -> f64 {
        let half = 0.5 * self.rim_height();
        let middle = Vec3::Y * half as f32;
        let moved = after.transform_point(middle) - before.transform_point(middle);
        let turned = before.orientation.angle_between(after.orientation);
        f64::from(moved.length()) + f64::from(turned) * half.hypot(self.outer_radius())
    }

    /// Inner radius at the rim, metres.
    pub fn mouth_radius(&self) -> f64 {
        self.radii[INTERVALS]
    }

    /// Largest radius of the outer surface, metres.
    pub fn outer_radius(&self) -> f64 {
        self.outer.iter().map(|p| p[0]).fold(0.0, f64::max)
    }

    /// Inner radius at height `y` of the flask's frame, from the lookup
    /// table; zero below the inner floor, the mouth's above the rim. Metres.
    pub fn inner_radius(&self, y: f64) -> f64 {
        let position = (y - self.wall) / self.step;
        if position < 0.0 {
            return 0.0;
        }
        let i = (position as usize).min(INTERVALS - 1);
        let t = (position - i as f64).min(1.0);
        self.radii[i] + t * (self.radii[i + 1] - self.radii[i])
    }

    /// Least inner radius between two heights of the flask's frame, metres; zero
    /// where they reach below the inner floor.
    pub fn narrowest(&self, from: f64, to: f64) -> f64 {
        let first = ((from - self.wall) / self.step).max(0.0) as usize;
        let last = ((to - self.wall) / self.step).max(0.0) as usize + 1;
        let rows = &self.radii[first.min(INTERVALS)..=last.min(INTERVALS)];
        let least = rows.iter().copied().fold(f64::INFINITY, f64::min);
        if from < self.floor_height() {
            0.0
        } else {
            least
        }
    }

    /// Outer radius at height `y` of the flask's frame; zero outside of
    /// base and rim. Metres.
    pub fn outer_radius_at(&self, y: f64) -> f64 {
        if y < 0.0 || y > self.rim_height() {
            return 0.0;
        }
        // The outline begins on the axis with the base's disc at y = 0.
        let above = self.outer.partition_point(|p| p[1] < y).max(1);
        let Some(&b) = self.outer.get(above) else {
            return self.outer[self.outer.len() - 1][0];
        };
        let a = self.outer[above - 1];
        if b[1] <= a[1] {
            return a[0].max(b[0]);
        }
        a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    }

    /// The radius lookup table: radii in metres at uniform steps from the
    /// inner floor up to the rim, both included, for the GPU.
    pub fn radius_table(&self) -> Vec<f32> {
        self.radii.iter().map(|&r| r as f32).collect()
    }

    /// Volume of the liquid space below the rim, m³.
    pub fn capacity(&self) -> f64 {
        self.volumes[INTERVALS]
    }

    /// Volume of the liquid space below height `y` of the flask's frame, m³.
    pub fn volume_below(&self, y: f64) -> f64 {
        let position = (y - self.wall) / self.step;
        if position <= 0.0 {
            return 0.0;
        }
        let i = (position as usize).min(INTERVALS - 1);
        let part = (position - i as f64).min(1.0) * self.step;
        self.volumes[i] + outline::frustum(part, self.radii[i], self.inner_radius(y))
    }

    /// Height (flask's frame, metres) of the surface of `volume` m³ of liquid
    /// at rest; `None` where it does not fit.
    pub fn level_for_volume(&self, volume: f64) -> Option<f64> {
        if !(0.0..=self.capacity()).contains(&volume) {
            return None;
        }
        let (mut low, mut high) = (self.floor_height(), self.rim_height());
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.volume_below(middle) < volume {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(high)
    }

    /// Area of the level surface of `volume` m³ of liquid at rest, m²: the mouth's where it does not fit, 0 without liquid.
    pub fn surface_for_volume(&self, volume: f64) -> f64 {
        if volume <= 0.0 {
            return 0.0;
        }
        let level = self.level_for_volume(volume);
        let radius = level.map_or(self.mouth_radius(), |level| self.inner_radius(level));
        std::f64::consts::PI * radius * radius
    }

    /// Volume of the glass, m³; infinite where its sizes' cubes are no numbers.
    pub fn glass_volume(&self) -> f64 {
        let volume = outline::volume(&self.outer) - self.capacity();
        if volume.is_nan() {
            f64::INFINITY
        } else {
            volume
        }
    }

    /// Inner surface as points (r, y), from the axis on the inner floor to
    /// the rim.
    pub fn inner_outline(&self) -> &[[f64; 2]] {
        &self.inner
    }

    /// Outer surface as points (r, y), from the axis on the base to the rim.
    pub fn outer_outline(&self) -> &[[f64; 2]] {
        &self.outer
    }

    /// Distance to the inner surface: positive in the liquid space and above
    /// the rim (where the nearest glass is mostly the rim's ring), negative
    /// elsewhere. Metres.
    pub fn signed_distance_inner(&self, r: f64, y: f64) -> f64 {
        let distance = outline::distance(&self.inner, r, y);
        if y >= self.rim_height() || self.is_inside(r, y) {
            distance
        } else {
            -distance
        }
    }

    /// Distance to the glass: positive in free space on either side,
    /// negative in the glass. Metres.
    pub fn signed_distance_glass(&self, r: f64, y: f64) -> f64 {
        let distance = self.distance_to_glass_surface(r, y);
        // The plane of the rim is free: in the mouth there is no glass, and
        // a map's row that lies on it would close the vessel.
        let in_outer = (0.0..self.rim_height()).contains(&y) && r <= self.outer_radius_at(y);
        if in_outer && !self.is_inside(r, y) {
            -distance
        } else {
            distance
        }
    }

    /// Whether (r, y) is in the liquid space, Ω_in of Eq. 21.
    pub fn is_inside(&self, r: f64, y: f64) -> bool {
        y > self.floor_height() && y < self.rim_height() && r < self.inner_radius(y)
    }

    /// Nearest point (r, y) of the outer surface, the rim's top included.
    pub(super) fn nearest_outside(&self, r: f64, y: f64) -> [f64; 2] {
        let on_outer = outline::nearest(&self.outer, r, y);
        let on_rim = outline::nearest(&self.rim_top(), r, y);
        let squared = |p: [f64; 2]| (p[0] - r).powi(2) + (p[1] - y).powi(2);
        if squared(on_rim) < squared(on_outer) {
            on_rim
        } else {
            on_outer
        }
    }

    fn distance_to_glass_surface(&self, r: f64, y: f64) -> f64 {
        outline::distance(&self.inner, r, y)
            .min(outline::distance(&self.outer, r, y))
            .min(outline::distance(&self.rim_top(), r, y))
    }

    fn rim_top(&self) -> [[f64; 2]; 2] {
        [
            self.inner[self.inner.len() - 1],
            self.outer[self.outer.len() - 1],
        ]
    }

    fn inner_height(&self) -> f64 {
        self.step * INTERVALS as f64
    }

    fn build_inner(&self) -> Vec<[f64; 2]> {
        let mut points = Vec::with_capacity(INTERVALS + 2);
        if self.radii[0] > 0.0 {
            points.push([0.0, self.wall]);
        }
        points.extend(
            self.radii
                .iter()
                .enumerate()
                .map(|(i, &r)| [r, self.wall + i as f64 * self.step]),
        );
        outline::without_collinear(points)
    }

    /// The liquid space dilated by a disc of the wall's radius. Moving each
    /// point along its normal instead would fold over itself wherever the
    /// profile bends more tightly than the wall is thick; the dilation of a
    /// region r < r_i(y) is again of that form.
    fn build_outer(&self) -> Vec<[f64; 2]> {
        let mut heights: Vec<f64> = (0..BASE_ROWS)
            .map(|i| i as f64 / BASE_ROWS as f64 * std::f64::consts::FRAC_PI_2)
            .map(|angle| self.wall * (1.0 - angle.cos()))
            .collect();
        heights.extend((0..=INTERVALS).map(|i| self.wall + i as f64 * self.step));
        let mut points = Vec::with_capacity(heights.len() + 1);
        if self.radii[0] > 0.0 {
            points.push([0.0, 0.0]);
        }
        points.extend(heights.into_iter().map(|y| [self.dilated(y), y]));
        outline::without_collinear(points)
    }

    fn dilated(&self, y: f64) -> f64 {
        let low = (y - self.wall).max(self.floor_height());
        let high = (y + self.wall).min(self.rim_height());
        let reach = |at: f64| {
            let up = (self.wall * self.wall - (y - at).powi(2)).max(0.0);
            self.inner_radius(at) + up.sqrt()
        };
        (0..=DILATION_TRIALS)
            .map(|i| low + (high - low) * i as f64 / DILATION_TRIALS as f64)
            .chain([y.clamp(low, high)])
            .map(reach)
            .fold(0.0, f64::max)
    }
}

fn validate(points: &[[f64; 2]], wall: f64) -> Result<(), ProfileError> {
    if points.len() < 2 {
        return Err(ProfileError::TooFewPoints(points.len()));
    }
    if !wall.is_finite() {
        return Err(ProfileError::NotFinite(format!("wall {wall}")));
    }
    if wall <= 0.0 {
        return Err(ProfileError::WallNotPositive(wall));
    }
    for (index, &[height, radius]) in points.iter().enumerate() {
        if !height.is_finite() || !radius.is_finite() {
            return Err(ProfileError::NotFinite(format!(
                "point {index} ([{height}, {radius}])"
            )));
        }
        if radius < 0.0 {
            return Err(ProfileError::NegativeRadius { index, radius });
        }
        if index == 0 {
            if height != 0.0 {
                return Err(ProfileError::FloorNotZero(height));
            }
            continue;
        }
        let before = points[index - 1][0];
        if height <= before {
            return Err(ProfileError::NotAscending {
                index,
                height,
                before,
            });
        }
    }
    let size = points.iter().flatten().copied().fold(0.0, f64::max);
    if size > THINNEST * wall {
        return Err(ProfileError::WallTooThin { wall, size });
    }
    let mouth = points[points.len() - 1][1];
    if mouth <= 0.0 {
        return Err(ProfileError::ClosedMouth(mouth));
    }
    Ok(())
}

fn interpolate(points: &[[f64; 2]], height: f64) -> f64 {
    let above = points
        .partition_point(|p| p[0] < height)
        .clamp(1, points.len() - 1);
    let [h0, r0] = points[above - 1];
    let [h1, r1] = points[above];
    r0 + ((height - h0) / (h1 - h0)).clamp(0.0, 1.0) * (r1 - r0)
}

#[cfg(test)]
#[path = "profile_tests.rs"]
mod tests;
