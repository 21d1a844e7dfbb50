//! The surfaces at which light bends, apart from each other: air to liquid, glass to liquid, air to glass.
//!
//! The liquid's is the level set that the picture is judged by (Yu & Turk 2013, `vitriol_render::reference`). Its kernels
//! reach into the glass. So it is meshed on both sides of the glass for itself, as if there were none, and then cut along
//! the glass, and the glass along it: no gap of half a particle is left between liquid and wall, and none shines through.

use glam::{DAffine3, DQuat, DVec3};
use vitriol_render::reference::{Anisotropy, Field, Nothing, SURFACE, Shape, Surroundings};
use vitriol_run::glassware::Glassware;
use vitriol_run::{Liquid, stage};
use vitriol_sim::bodies::is_nowhere;
use vitriol_sim::flask::Profile;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::SolverState;

use crate::glass_mesh::{inner, outer};
use crate::mesh::Mesh;
use crate::nets::{self, Level};

/// Edge of the grid's cells, particle spacings: the level set's sharpest bends are those of a drop of one particle, 1.2
/// spacings across.
const CELL: f64 = 0.5;

/// Half-widths after which a kernel is 0.
const REACH: f64 = 2.0;

/// The three surfaces at one moment, in the stage, m.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Surfaces {
    /// Air to liquid; normals point into the air. It goes on, unseen, into table and floor, which are opaque.
    pub air_liquid: Mesh,
    /// Glass to liquid; normals point into the liquid.
    pub glass_liquid: Mesh,
    /// Air to glass; normals point into the air.
    pub air_glass: Mesh,
}

impl Surfaces {
    /// Those of a state of a scene whose flasks are at `poses`.
    pub fn of(scene: &Scene, poses: &[Pose], state: &SolverState) -> Self {
        Self::around(scene, poses, Liquid::of(scene, state)).into_stage(scene)
    }

    /// The surfaces of a liquid, in the scene's frame and unit.
    pub fn around(scene: &Scene, poses: &[Pose], liquid: Liquid) -> Self {
        let Liquid {
            positions,
            volumes,
            members,
        } = liquid;
        let scale = &scene.scale;
        let (spacing, cell) = (scale.spacing, CELL * scale.spacing);
        let vessels: Vec<Vessel> = scene
            .flasks
            .iter()
            .zip(poses)
            .map(|(flask, pose)| Vessel::new(&flask.profile, pose))
            .collect();
        let glassware = Glassware::new(scene, poses, positions.clone(), members.clone());
        let shapes = Anisotropy::new(spacing, scale.support()).shapes(&positions, &glassware);
        let kernels: Vec<Kernel> = shapes
            .into_iter()
            .zip(volumes)
            .zip(members)
            .map(|((shape, volume), member)| Kernel {
                reach: REACH * shape.lengths.max_element() * (volume / spacing.powi(3)).cbrt(),
                shape,
                volume,
                member,
            })
            .collect();

        // Shards are no solids of revolution, and are left out with the glass that they are of.
        let is_whole = |index: usize| !is_nowhere(&poses[index]);
        let mut surfaces = Self::default();
        let outside = Side::outside(&kernels, (&vessels, &glassware), spacing);
        outside.add(&vessels, cell, &mut surfaces, |surfaces, field| {
            let whole = vessels.iter().enumerate().filter(|it| is_whole(it.0));
            for (_, vessel) in whole {
                surfaces.wet(&vessel.place(outer(&vessel.profile, cell)), field);
            }
        });
        for (index, vessel) in vessels.iter().enumerate().filter(|it| is_whole(it.0)) {
            let within = Side::inside(&kernels, index, vessel, spacing);
            within.add(&vessels, cell, &mut surfaces, |surfaces, field| {
                surfaces.wet(&vessel.place(inner(&vessel.profile, cell)), field);
            });
        }
        surfaces
    }

    /// Adds glass, as far as it is wet to where it is wet.
    fn wet(&mut self, glass: &Mesh, field: &Outlined<'_>) {
        let wet = glass.where_positive(|at| field.value(at));
        let dry = glass.where_positive(|at| -field.value(at));
        self.glass_liquid.append(&wet);
        self.air_glass.append(&dry);
    }

    fn into_stage(self, scene: &Scene) -> Self {
        let place =
            |mesh: Mesh| mesh.moved(|at| stage::stage_from_scene(scene, at), |normal| normal);
        Self {
            air_liquid: place(self.air_liquid),
            glass_liquid: place(self.glass_liquid),
            air_glass: place(self.air_glass),
        }
    }
}

/// A flask in its place.
struct Vessel {
    profile: Profile,
    stage_from_flask: DAffine3,
    flask_from_stage: DAffine3,
}

impl Vessel {
    fn new(profile: &Profile, pose: &Pose) -> Self {
        let orientation: DQuat = pose.orientation.as_dquat().normalize();
        let stage_from_flask =
            DAffine3::from_rotation_translation(orientation, pose.position.as_dvec3());
        Self {
            profile: profile.clone(),
            stage_from_flask,
            flask_from_stage: stage_from_flask.inverse(),
        }
    }

    fn place(&self, mesh: Mesh) -> Mesh {
        mesh.moved(
            |at| self.stage_from_flask.transform_point3(at),
            |normal| self.stage_from_flask.transform_vector3(normal),
        )
    }

    /// (r, y) in its frame.
    fn cylindrical(&self, at: DVec3) -> (f64, f64) {
        let local = self.flask_from_stage.transform_point3(at);
        (local.x.hypot(local.z), local.y)
    }

    /// How far a place is within the space for liquid below the rim; negative outside of it.
    fn depth_in_cavity(&self, at: DVec3) -> f64 {
        let (r, y) = self.cylindrical(at);
        let below = self.profile.rim_height() - y;
        self.profile.signed_distance_inner(r, y).min(below)
    }

    /// How far a place is out of glass and cavity together.
    fn distance_outside(&self, at: DVec3) -> f64 {
        let (r, y) = self.cylindrical(at);
        let above = y - self.profile.rim_height();
        if above >= 0.0 {
            return above;
        }
        if self.profile.is_inside(r, y) {
            return above.max(-self.profile.wall());
        }
        self.profile.signed_distance_glass(r, y)
    }
}

/// A particle's kernel.
struct Kernel {
    shape: Shape,
    volume: f64,
    member: Option<usize>,
    reach: f64,
}

/// The kernels that count on one side of the glass, as if there were no glass.
struct Side<'a> {
    shapes: Vec<Shape>,
    volumes: Vec<f64>,
    boxes: Vec<[DVec3; 2]>,
    /// The vessel that it is in; `None` of the outside.
    vessel: Option<usize>,
    solids: Box<dyn Surroundings + 'a>,
    spacing: f64,
}

impl<'a> Side<'a> {
    /// Outside: what is in no vessel, and what of a vessel's liquid reaches over its rim.
    fn outside(
        kernels: &[Kernel],
        (vessels, glassware): (&[Vessel], &'a Glassware),
        spacing: f64,
    ) -> Self {
        let counts = |kernel: &&Kernel| {
            let over = |flask: usize| {
                vessels.get(flask).is_none_or(|vessel| {
                    let (_, y) = vessel.cylindrical(kernel.shape.centre);
                    y + kernel.reach > vessel.profile.rim_height()
                })
            };
            kernel.member.is_none_or(over)
        };
        let counting: Vec<&Kernel> = kernels.iter().filter(counts).collect();
        let solids = OverTheRim {
            glassware,
            members: counting.iter().map(|kernel| kernel.member).collect(),
        };
        Self::of(&counting, None, Box::new(solids), spacing)
    }

    /// In a vessel: its own liquid, and what falls in from above its rim.
    fn inside(kernels: &[Kernel], index: usize, vessel: &Vessel, spacing: f64) -> Self {
        let counts = |kernel: &&Kernel| {
            if kernel.member == Some(index) {
                return true;
            }
            let (r, y) = vessel.cylindrical(kernel.shape.centre);
            let rim = vessel.profile.rim_height();
            (rim..rim + kernel.reach).contains(&y)
                && r < vessel.profile.mouth_radius() + kernel.reach
        };
        let counting: Vec<&Kernel> = kernels.iter().filter(counts).collect();
        Self::of(&counting, Some(index), Box::new(Nothing), spacing)
    }

    fn of(
        kernels: &[&Kernel],
        vessel: Option<usize>,
        solids: Box<dyn Surroundings + 'a>,
        spacing: f64,
    ) -> Self {
        let around = |kernel: &&Kernel| {
            let (centre, half) = (kernel.shape.centre, DVec3::splat(kernel.reach));
            [centre - half, centre + half]
        };
        Self {
            shapes: kernels.iter().map(|kernel| kernel.shape).collect(),
            volumes: kernels.iter().map(|kernel| kernel.volume).collect(),
            boxes: kernels.iter().map(around).collect(),
            vessel,
            solids,
            spacing,
        }
    }

    /// Adds this side's surface of the liquid, and of the glass what `glass` adds.
    fn add(
        &self,
        vessels: &[Vessel],
        cell: f64,
        surfaces: &mut Surfaces,
        glass: impl FnOnce(&mut Surfaces, &Outlined<'_>),
    ) {
        let field = Field::new(&self.shapes, &self.volumes, self.spacing, &*self.solids);
        let field = Outlined(field);
        let whole = nets::surface(&field, &self.boxes, cell);
        let own = match self.vessel {
            Some(index) => whole.where_positive(|at| vessels[index].depth_in_cavity(at)),
            None => whole.where_positive(|at| {
                let distances = vessels.iter().map(|vessel| vessel.distance_outside(at));
                distances.fold(f64::INFINITY, f64::min)
            }),
        };
        surfaces.air_liquid.append(&own);
        glass(surfaces, &field);
    }
}

/// φ less its level on the surface.
struct Outlined<'a>(Field<'a>);

impl Level for Outlined<'_> {
    fn value(&self, at: DVec3) -> f64 {
        self.0.value(at) - SURFACE
    }

    fn gradient(&self, at: DVec3) -> DVec3 {
        self.0.gradient(at)
    }
}

/// What is solid for the outside: nothing for what is there, and for a vessel's liquid what always is, all below its rim that
/// is not in the vessel.
struct OverTheRim<'a> {
    glassware: &'a Glassware,
    members: Vec<Option<usize>>,
}

impl Surroundings for OverTheRim<'_> {
    fn side(&self, particle: usize) -> usize {
        self.members[particle].map_or(0, |flask| flask + 1)
    }

    fn distance(&self, side: usize, at: DVec3) -> f64 {
        match side {
            0 => f64::INFINITY,
            vessel => self.glassware.distance(vessel, at),
        }
    }

    fn is_solid(&self, side: usize, at: DVec3) -> bool {
        side > 0 && self.glassware.is_solid(side, at)
    }

    /// The shapes are there already.
    fn apart(&self, _a: usize, _b: usize) -> bool {
        false
    }
}

#[cfg(test)]
#[path = "tests/surfaces.rs"]
mod tests;
