//! What a look shows of the flasks, for the judge of a lesson.

use glam::Vec3;
use vitriol_sim::bodies;
use vitriol_sim::pose::Pose;

use super::{Bench, Finder, Seen};
use crate::procedure::{FlaskSight, Sight};

/// Tilt up to which a flask stands, as the cosine of its axis with the vertical: 5°, which rounding of the table's contact does not reach.
/// Our choice.
const UPRIGHT: f32 = 0.996;
/// How far above or below the bench's top its base may be, m at real size. Our choice.
const CONTACT: f64 = 0.005;

impl Bench {
    fn stands(&self, pose: &Pose) -> bool {
        let Some(table) = self.table else {
            return false;
        };
        let place = pose.position.as_dvec3();
        let over = |at: f64, axis: usize| (at - table.centre[axis]).abs() <= 0.5 * table.size[axis];
        let upright = (pose.orientation * Vec3::Y).y >= UPRIGHT;
        let near = self.scale * (place.y - table.top).abs() <= CONTACT;
        !bodies::is_nowhere(pose) && upright && near && over(place.x, 0) && over(place.z, 1)
    }
}

impl Finder {
    /// What a look shows, for [`Procedure::advance`](crate::Procedure::advance) with the events of the same look. Bodies that no scene has
    /// yet are `None`.
    pub fn sight(&self, seen: &Seen<'_>) -> Sight {
        let bench = &self.bench;
        let flasks = bench.names.iter().enumerate().map(|(flask, name)| {
            let held = seen.census.flasks.get(flask);
            let content = held.map(|it| bench.content(it)).unwrap_or_default();
            let is_held = seen.held.get(flask) == Some(&true);
            let pose = seen.poses.get(flask);
            FlaskSight {
                name: name.clone(),
                volume_m3: content.volume_m3,
                acid: content.acid,
                temperature_c: content.temperature_c,
                held: is_held,
                standing: !is_held && pose.is_some_and(|pose| bench.stands(pose)),
            }
        });
        Sight {
            t_s: seen.t,
            flasks: flasks.collect(),
            bench_m3: bench.volume(seen.census.table.volume),
            floor_m3: bench.volume(seen.census.floor.volume),
            ..Sight::default()
        }
    }
}
