//! Glass, table and floor as the reference surface asks for them.

use glam::{DAffine3, DQuat, DVec3};
use vitriol_render::reference::Surroundings;
use vitriol_sim::flask::Profile;
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::visibility::leaves_through_mouth;
use vitriol_sim::scene::{Scene, TableTop};

/// What is solid in a scene at one moment, for its particles.
pub struct Glassware {
    flasks: Vec<(Profile, DAffine3)>,
    table: Option<TableTop>,
    /// Thickness of the table, scene's unit.
    slab: f64,
    floor: f64,
    positions: Vec<DVec3>,
    members: Vec<Option<usize>>,
}

impl Glassware {
    /// The scene's flasks at `poses`, around particles at `positions` (stage,
    /// scene's unit) that are in the flasks `members`.
    pub fn new(
        scene: &Scene,
        poses: &[Pose],
        positions: Vec<DVec3>,
        members: Vec<Option<usize>>,
    ) -> Self {
        let flasks = scene.flasks.iter().zip(poses).map(|(flask, pose)| {
            let orientation: DQuat = pose.orientation.as_dquat().normalize();
            let stage_from_flask =
                DAffine3::from_rotation_translation(orientation, pose.position.as_dvec3());
            (flask.profile.clone(), stage_from_flask.inverse())
        });
        Self {
            flasks: flasks.collect(),
            table: scene.table,
            slab: TableTop::THICKNESS / scene.scale.length_scale,
            floor: scene.floor.height,
            positions,
            members,
        }
    }

    /// Signed distance to the table, beside which there is none.
    fn table_distance(&self, at: DVec3) -> f64 {
        self.table.map_or(f64::INFINITY, |table| {
            let beyond = |k: usize, x: f64| (x - table.centre[k]).abs() - 0.5 * table.size[k];
            let above = (at.y - table.top).max(table.top - self.slab - at.y);
            above.max(beyond(0, at.x)).max(beyond(1, at.z))
        })
    }

    /// View depth at which a ray from `eye` meets the table or the floor;
    /// infinite where it does not. `ray` has the length 1 along the eye's axis.
    pub fn opaque(&self, eye: DVec3, ray: DVec3) -> f64 {
        let ahead = |t: f64| if t > 0.0 { t } else { f64::INFINITY };
        let floor = ahead((self.floor - eye.y) / ray.y);
        let Some(table) = self.table else {
            return floor;
        };
        let centre = DVec3::new(
            table.centre[0],
            table.top - 0.5 * self.slab,
            table.centre[1],
        );
        let half = 0.5 * DVec3::new(table.size[0], self.slab, table.size[1]);
        let (a, b) = ((centre - half - eye) / ray, (centre + half - eye) / ray);
        let (first, last) = (a.min(b).max_element(), a.max(b).min_element());
        if first < last {
            floor.min(ahead(first))
        } else {
            floor
        }
    }
}

impl Surroundings for Glassware {
    /// 0 outside, k + 1 in flask k.
    fn side(&self, particle: usize) -> usize {
        self.members[particle].map_or(0, |flask| flask + 1)
    }

    fn distance(&self, side: usize, at: DVec3) -> f64 {
        match side.checked_sub(1).and_then(|flask| self.flasks.get(flask)) {
            Some(flask) => {
                let (profile, r, y) = in_flask(flask, at);
                profile.signed_distance_inner(r, y)
            }
            None => self
                .flasks
                .iter()
                .map(|flask| in_flask(flask, at))
                .map(|(profile, r, y)| profile.signed_distance_glass(r, y))
                .fold((at.y - self.floor).min(self.table_distance(at)), f64::min),
        }
    }

    fn is_solid(&self, side: usize, at: DVec3) -> bool {
        match side.checked_sub(1).and_then(|flask| self.flasks.get(flask)) {
            Some(flask) => {
                let (profile, r, y) = in_flask(flask, at);
                y < profile.rim_height() && !profile.is_inside(r, y)
            }
            None => {
                at.y < self.floor
                    || self.table_distance(at) < 0.0
                    || self.flasks.iter().any(|flask| {
                        let (profile, r, y) = in_flask(flask, at);
                        let in_outer = (0.0..profile.rim_height()).contains(&y)
                            && r <= profile.outer_radius_at(y);
                        in_outer && !profile.is_inside(r, y)
                    })
            }
        }
    }

    fn apart(&self, a: usize, b: usize) -> bool {
        let leaves = |from: usize, to: usize| {
            self.members[from]
                .and_then(|flask| self.flasks.get(flask))
                .is_none_or(|(profile, flask_from_stage)| {
                    let [from, to] = [from, to]
                        .map(|one| flask_from_stage.transform_point3(self.positions[one]));
                    leaves_through_mouth(profile, from, to)
                })
        };
        self.members[a] != self.members[b] && !(leaves(a, b) && leaves(b, a))
    }
}

/// (r, y) of a place in a flask's frame.
fn in_flask((profile, flask_from_stage): &(Profile, DAffine3), at: DVec3) -> (&Profile, f64, f64) {
    let local = flask_from_stage.transform_point3(at);
    (profile, local.x.hypot(local.z), local.y)
}
