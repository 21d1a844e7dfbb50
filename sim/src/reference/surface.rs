//! Surface tension (line 28): the force of the surface's energy on nodes, as `surface_energy.wgsl` has it, in f64 and on
//! boxes of nodes about all liquid of each grid.

use super::neighbours::Neighbours;
use super::state::{Hold, Reference};
use super::surroundings::Contact;
use crate::surface_tension::{
    CORE_STEPS, CORE_STRIDE, FAINTEST, FEWEST, LEAST_SPACE, MOUTH_REACH, SurfaceTension, core_for,
    flat, relative, thickness_for,
};
use glam::{DVec2, DVec3, IVec3};

/// Nodes about the liquid that its colour, two filters and two differences reach, and one more.
const MARGIN: i32 = 6;

/// Energy of the surface and the force that it has on each particle.
#[derive(Clone, Debug, Default)]
pub struct SurfaceForces {
    /// J.
    pub energy: f64,
    /// N, by particle.
    pub forces: Vec<DVec3>,
    /// Force with which walls hold the surface's line, N, by particle.
    pub holds: Vec<DVec3>,
    /// Core by which the colour of each cell was divided, grid by grid.
    pub(super) cores: Vec<f64>,
}

/// A box of nodes, x running fastest.
#[derive(Clone, Debug)]
struct Nodes {
    first: IVec3,
    size: IVec3,
    /// Distance between nodes, m.
    spacing: f64,
}

impl Nodes {
    fn about(positions: &[DVec3], spacing: f64) -> Self {
        let low = |a: IVec3, x: &DVec3| a.min((*x / spacing).floor().as_ivec3());
        let high = |a: IVec3, x: &DVec3| a.max((*x / spacing).floor().as_ivec3());
        let first = positions.iter().fold(IVec3::MAX, low) - MARGIN;
        let last = positions.iter().fold(IVec3::MIN, high) + MARGIN + 1;
        Self {
            first,
            size: last - first + 1,
            spacing,
        }
    }

    fn count(&self) -> usize {
        (self.size.x * self.size.y * self.size.z) as usize
    }

    fn index(&self, at: IVec3) -> usize {
        ((at.z * self.size.y + at.y) * self.size.x + at.x) as usize
    }

    /// All, as offsets from the first.
    fn all(&self) -> impl Iterator<Item = IVec3> + use<> {
        let size = self.size;
        (0..size.z).flat_map(move |z| {
            (0..size.y).flat_map(move |y| (0..size.x).map(move |x| IVec3::new(x, y, z)))
        })
    }

    fn contains(&self, at: IVec3) -> bool {
        at.cmpge(IVec3::ZERO).all() && at.cmplt(self.size).all()
    }

    /// The 64 nodes that a particle at `x` is spread over, with each one's weight and the weight's slope (1/m).
    fn spread(&self, x: DVec3) -> Vec<(usize, f64, DVec3)> {
        let at = x / self.spacing;
        let below = at.floor();
        let mut all = Vec::with_capacity(64);
        for k in 0..64 {
            let offset = IVec3::new(k % 4, k / 4 % 4, k / 16) - 1;
            let away = (at - below - offset.as_dvec3()).to_array();
            let [w, s] = [away.map(|t| spline(t).0), away.map(|t| spline(t).1)];
            let slope = DVec3::new(s[0] * w[1] * w[2], w[0] * s[1] * w[2], w[0] * w[1] * s[2]);
            let node = self.index(below.as_ivec3() + offset - self.first);
            all.push((node, w[0] * w[1] * w[2], slope / self.spacing));
        }
        all
    }

    /// The binomial filter; it is its own transpose but for the box's outermost nodes, where all is 0.
    fn filter(&self, values: &[f64]) -> Vec<f64> {
        let mut found = vec![0.0; values.len()];
        for at in self.all() {
            for k in 0..27 {
                let offset = IVec3::new(k % 3, k / 3 % 3, k / 9) - 1;
                if self.contains(at + offset) {
                    let weights = (2 - offset.abs()).as_dvec3() / 4.0;
                    let weight = weights.x * weights.y * weights.z;
                    found[self.index(at)] += weight * values[self.index(at + offset)];
                }
            }
        }
        found
    }

    /// The fullest of a colour up its `gradient` (1/m) from the cell at `at`, whose own is `mean`: of the nodes nearest to some
    /// places there, as far as the blocks of four nodes around the cell's have them.
    fn fullest(&self, colour: &[f64], at: IVec3, mean: f64, gradient: DVec3) -> f64 {
        let inward = gradient / gradient.length().max(1e-6 / self.spacing);
        let in_block = (self.first + at) & 3;
        let fullest = |found: f64, k: u32| {
            let to = in_block.as_dvec3() + 1.0 + inward * (CORE_STRIDE * f64::from(k));
            let node = to.clamp(DVec3::splat(-4.0), DVec3::splat(7.5)).floor();
            let node = at + node.as_ivec3() - in_block;
            if self.contains(node) {
                found.max(colour[self.index(node)])
            } else {
                found
            }
        };
        (1..=CORE_STEPS).fold(mean, fullest)
    }

    /// The eight corners of the cell whose first node is `at`, with the weights of its gradient (1/m).
    fn corners(&self, at: IVec3) -> [(usize, DVec3); 8] {
        std::array::from_fn(|k| {
            let k = k as i32;
            let far = IVec3::new(k & 1, k >> 1 & 1, k >> 2);
            let weight = (far.as_dvec3() * 2.0 - 1.0) / (4.0 * self.spacing);
            (self.index(at + far), weight)
        })
    }
}

/// The cubic B-spline and its slope.
fn spline(t: f64) -> (f64, f64) {
    let (a, far) = (t.abs(), (2.0 - t.abs()).max(0.0));
    if a < 1.0 {
        (
            2.0 / 3.0 - a * a + 0.5 * a.powi(3),
            t.signum() * (1.5 * a * a - 2.0 * a),
        )
    } else {
        (far.powi(3) / 6.0, -0.5 * t.signum() * far * far)
    }
}

impl Reference {
    /// The impulse of surface tension over `time` seconds.
    pub(super) fn hold_together(&mut self, neighbours: &Neighbours, time: f64) {
        let (_, lightness) = self.bulk();
        let SurfaceForces { forces, holds, .. } = self.surface_forces(neighbours);
        let mass = self.parameters.particle_mass();
        self.held.clear();
        for (i, (force, hold)) in forces.into_iter().zip(holds).enumerate() {
            let relative = match &self.chemistry {
                None => 1.0,
                Some(chemistry) => {
                    let (temperature, acid) = chemistry.state(i);
                    relative(acid, temperature)
                }
            };
            let per_force = relative * lightness[i] / mass;
            self.velocities[i] += force * (time * per_force);
            let flask = self.holder_of(i);
            let acceleration = hold * per_force;
            self.held.push(Hold {
                acceleration,
                flask,
            });
        }
    }

    /// The flask with the largest contact volume with particle `i`; its own, where it is in one.
    fn holder_of(&self, i: usize) -> Option<usize> {
        if self.membership[i].is_some() {
            return self.membership[i];
        }
        let (mut holder, mut most, mut ground) = (None, 0.0, 0.0);
        self.surroundings
            .contacts(self.positions[i], None, &self.motion, |contact| {
                if contact.flask.is_none() {
                    ground += contact.volume;
                } else if contact.volume > most {
                    (holder, most) = (contact.flask, contact.volume);
                }
            });
        holder.filter(|_| most > ground)
    }

    /// The surface's energy, and each particle's force over its volume's share of V₀.
    pub fn surface_forces(&self, neighbours: &Neighbours) -> SurfaceForces {
        self.surface_forces_of(Some(neighbours), None)
    }

    /// The surface's energy of all particles, those without neighbours included, J: comparable before and after a drop falls apart.
    pub fn surface_energy(&self) -> f64 {
        self.surface_forces_of(None, None).energy
    }

    /// The surface's energy (J) and forces (N over the particle's share of V₀) as in [`Self::surface_forces`], over all particles where
    /// `neighbours` is `None`. `cores` fixes the cells' cores to those of a nearby state: the forces are the slope of that energy.
    pub(super) fn surface_forces_of(
        &self,
        neighbours: Option<&Neighbours>,
        cores: Option<&[f64]>,
    ) -> SurfaceForces {
        let mut found = SurfaceForces {
            energy: 0.0,
            forces: vec![DVec3::ZERO; self.positions.len()],
            holds: vec![DVec3::ZERO; self.positions.len()],
            cores: Vec::new(),
        };
        if let Some(surface) = &self.parameters.surface {
            let grids = self.surroundings.vessels.len();
            for grid in std::iter::once(None).chain((0..grids).map(Some)) {
                let has_company =
                    |i: usize| neighbours.is_none_or(|all| all.of(i).count() >= FEWEST);
                let part = |&i: &usize| self.is_part_of(grid, i) && has_company(i);
                let part: Vec<_> = (0..self.positions.len()).filter(part).collect();
                if !part.is_empty() {
                    self.grid_forces(surface, grid, part, cores, &mut found);
                }
            }
        }
        found
    }

    /// Whether particle `i`'s volume is part of a grid: of its own, and through a mouth of the next.
    fn is_part_of(&self, grid: Option<usize>, i: usize) -> bool {
        let own = self.membership[i];
        let (Some(flask), true) = (own.or(grid), own.is_none() != grid.is_none()) else {
            return own == grid;
        };
        let local = self.motion[flask].after.to_flask(self.positions[i]);
        let profile = &self.surroundings.vessels[flask].profile;
        let beyond = (local.x.hypot(local.z) - profile.mouth_radius()).max(0.0);
        beyond.hypot(local.y - profile.rim_height())
            < MOUTH_REACH * 0.5 * self.parameters.support_radius
    }

    /// S, and S·cos θ.
    fn solid_at(&self, surface: &SurfaceTension, grid: Option<usize>, x: DVec3) -> DVec2 {
        let mut sum = DVec2::ZERO;
        self.surroundings
            .contacts(x, grid, &self.motion, |contact| {
                let angle = contact
                    .flask
                    .map_or(surface.ground, |k| surface.of_glass(k));
                sum += contact.volume * DVec2::new(1.0, angle.cos());
            });
        sum / sum.x.max(1.0)
    }

    fn grid_forces(
        &self,
        surface: &SurfaceTension,
        grid: Option<usize>,
        part: Vec<usize>,
        cores: Option<&[f64]>,
        found: &mut SurfaceForces,
    ) {
        let places: Vec<_> = part.iter().map(|&i| self.positions[i]).collect();
        let nodes = Nodes::about(&places, 0.5 * self.parameters.support_radius);
        let (volumes, _) = self.bulk();
        let mut colour = vec![0.0; nodes.count()];
        for &i in &part {
            for (node, weight, _) in nodes.spread(self.positions[i]) {
                colour[node] += weight * volumes[i] / nodes.spacing.powi(3);
            }
        }
        let solid: Vec<DVec2> = nodes
            .all()
            .map(|at| {
                let x = (nodes.first + at).as_dvec3() * nodes.spacing;
                self.solid_at(surface, grid, x)
            })
            .collect();
        let [share, wetted] =
            [0, 1].map(|k| nodes.filter(&solid.iter().map(|s| s[k]).collect::<Vec<_>>()));
        let space = |node: usize| {
            let space = 1.0 - share[node];
            if space > LEAST_SPACE {
                1.0 / space
            } else {
                0.0
            }
        };
        let mut colour = nodes.filter(&colour);
        for (node, value) in colour.iter_mut().enumerate() {
            *value *= space(node);
        }
        // ∂E/∂c by node, in σ·m².
        let mut derivative = vec![0.0; nodes.count()];
        // By cell, the force per volume of liquid with which a wall holds it, in σ/m².
        let mut line = vec![DVec3::ZERO; nodes.count()];
        let width = surface.stickiness();
        let cell = nodes.spacing.powi(3);
        let strength = surface.tension / flat();
        for at in nodes.all().filter(|&at| nodes.contains(at + 1)) {
            let corners = nodes.corners(at);
            if corners.iter().any(|&(k, _)| 1.0 - share[k] <= LEAST_SPACE) {
                continue;
            }
            let mean = |of: &[f64]| corners.iter().map(|&(k, _)| of[k]).sum::<f64>() / 8.0;
            let slope = |of: &[f64]| corners.iter().map(|&(k, w)| w * of[k]).sum::<DVec3>();
            let (c, s, gradient, wall) =
                (mean(&colour), mean(&share), slope(&colour), slope(&share));
            let faint = FAINTEST / nodes.spacing;
            let core = match cores {
                Some(cores) => cores[found.cores.len()],
                None => core_for(nodes.fullest(&colour, at, c, gradient)),
            };
            found.cores.push(core);
            let (c, gradient) = (c / core, gradient / core);
            let size = gradient.length().hypot(faint);
            let full = c.clamp(0.0, 1.0);
            let thickness = thickness_for(core);
            let by_thickness = |thin: f64, thick: f64| thin + thickness * (thick - thin);
            let outermost = by_thickness(2.0 * (1.0 - full), 1.5 * (1.0 - full * full));
            let outermost_slope = by_thickness(-2.0, -3.0 * full);
            let outermost_slope = if c < 1.0 { outermost_slope } else { 0.0 };
            let wetted_share =
                by_thickness(2.0 * full - full * full, 1.5 * full - 0.5 * full.powi(3));
            let mut by_colour = (1.0 - s) * outermost_slope * (size - faint);
            let mut density = (1.0 - s) * outermost * (size - faint);
            if wall.length() > 0.0 {
                let wetting = mean(&wetted) / s * flat();
                let (within, wetted_share) = if wetting > 0.0 {
                    (6.0 * full * (1.0 - full), full * full * (3.0 - 2.0 * full))
                } else {
                    (outermost, wetted_share)
                };
                if c < 1.0 {
                    let normal = wall.normalize();
                    let along = gradient - normal * gradient.dot(normal);
                    let angle = wetting / flat();
                    let length =
                        2.0 * width * (1.0 - angle * angle).max(0.0).sqrt() * wall.length();
                    line[nodes.index(at)] = along * (length / (core * (1.0 - s)));
                }
                by_colour -= wetting * within * wall.length();
                density -= wetting * wetted_share * wall.length();
            }
            found.energy += strength * density * cell;
            for (k, weight) in corners {
                let by_gradient = (1.0 - s) * outermost * gradient.dot(weight) / size;
                derivative[k] += (by_gradient + by_colour / 8.0) / core;
            }
        }
        for (node, value) in derivative.iter_mut().enumerate() {
            *value *= space(node);
        }
        let curvature = nodes.filter(&derivative);
        let volume = self.parameters.particle_volume();
        for i in part {
            if self.membership[i] == grid {
                let spread = nodes.spread(self.positions[i]);
                let slope: DVec3 = spread.iter().map(|&(k, _, s)| curvature[k] * s).sum();
                found.forces[i] -= slope * (strength * volume);
                if width == 0.0 {
                    continue;
                }
                let mut touched = 0.0;
                let touch = |contact: Contact| touched += contact.volume;
                self.surroundings
                    .contacts(self.positions[i], grid, &self.motion, touch);
                if touched <= 0.0 {
                    continue;
                }
                let half = DVec3::splat(0.5 * nodes.spacing);
                let cells = nodes.spread(self.positions[i] - half);
                let hold: DVec3 = cells.iter().map(|&(k, w, _)| line[k] * w).sum();
                found.holds[i] = hold * (surface.tension * volume);
            }
        }
    }
}
