//! Reduces an observation to the [`Sight`] that the judge of a lesson takes in.

use glam::Vec3;
use vitriol_sim::bodies;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::ToolKind;

use super::{Bench, Finder, Seen};
use crate::procedure::{Dip, FlaskSight, Sight};

/// Tilt up to which a flask stands, as the cosine of its axis with the vertical: 5°, which rounding of the table's contact does not reach.
/// Our choice.
const UPRIGHT: f32 = 0.996;
/// How far above or below the bench's top the base of a standing flask may be, m at real size. Our choice.
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

impl Bench {
    /// Whether a place in the world is in the liquid of a flask that holds `volume` (m³ of the scene), as that would stand in the upright
    /// flask.
    fn is_in_liquid(&self, flask: usize, volume: f64, pose: &Pose, place: Vec3) -> bool {
        let Some(profile) = self.profiles.get(flask).filter(|_| volume > 0.0) else {
            return false;
        };
        let local = pose.inverse().transform_point(place).as_dvec3();
        let level = profile.level_for_volume(volume);
        let level = level.unwrap_or_else(|| profile.rim_height());
        local.y < level && profile.is_inside(local.x.hypot(local.z), local.y)
    }
}

impl Finder {
    /// The [`Sight`] of an observation that [`Finder::looked`] has taken in, for [`Procedure::advance`](crate::Procedure::advance) with
    /// the events of the same observation. Equipment that the scene does not have is `None`.
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
            goggles: seen.worn.goggles,
            gloves: seen.worn.gloves,
            sash_m: seen.sash_open,
            rod: self.dip(seen, ToolKind::Rod),
            thermometer: self.dip(seen, ToolKind::Thermometer),
            rinsed_m3: self.rinsing.then_some(self.rinsed),
        }
    }

    fn dip(&self, seen: &Seen<'_>, kind: ToolKind) -> Option<Dip> {
        let dipped = seen.dipped.iter().find(|it| it.kind == kind)?;
        let bench = &self.bench;
        let flasks = 0..bench.names.len();
        let in_flask = flasks.into_iter().find(|&flask| {
            let held = seen.census.flasks.get(flask);
            let volume = held.map_or(0.0, |held| held.volume);
            let pose = seen.poses.get(flask);
            pose.is_some_and(|pose| bench.is_in_liquid(flask, volume, pose, dipped.tip))
        });
        Some(Dip {
            flask: in_flask.map(|flask| bench.name(flask)),
            speed_m_s: bench.speed(dipped.speed.into()),
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use glam::Quat;
    use vitriol_sim::bodies::Worn;
    use vitriol_sim::scene::Scene;
    use vitriol_sim::solver::{Census, Held};

    use super::*;
    use crate::Limits;
    use crate::finder::Dipped;

    /// Sight of a scene at its start, after `change` of the first flask's pose.
    fn seen(scene: &str, held: bool, change: &dyn Fn(&mut Pose)) -> Sight {
        let scene = Scene::builtin(scene).unwrap();
        let finder = Finder::new("scene", &scene, Limits::default());
        let poses = scene.flasks.iter().map(|it| it.stage_from_flask);
        let mut poses: Vec<Pose> = poses.collect();
        change(&mut poses[0]);
        let full = Held {
            particles: 10,
            volume: 8.0,
            temperature: Some(30.0),
            acid: 0.5,
            ..Held::default()
        };
        let census = Census {
            flasks: vec![full, Held::default()],
            table: full,
            floor: Held {
                volume: 16.0,
                ..full
            },
            ..Census::default()
        };
        finder.sight(&Seen {
            t: 3.0,
            before: 2.9,
            elapsed: 0.1,
            census: &census,
            poses: &poses,
            held: &[held, false],
            strikes: &[],
            breaks: &[],
            worn: Worn::default(),
            sash_open: Some(0.3),
            dipped: &[],
        })
    }

    /// Volumes at real size, also in a scene whose metre is a twentieth of a real one: 8 m³ there are 1 L.
    #[test]
    fn a_sight_is_of_real_size() {
        for (scene, volume_m3) in [("acid-into-water", 8.0), ("vr-dilution", 1e-3)] {
            let sight = seen(scene, false, &|_| {});
            let flask = &sight.flasks[0];
            assert!(
                (flask.volume_m3 / volume_m3 - 1.0).abs() < 1e-9,
                "{flask:?}"
            );
            assert!((sight.bench_m3 / volume_m3 - 1.0).abs() < 1e-9);
            assert!((sight.floor_m3 / volume_m3 - 2.0).abs() < 1e-9);
            assert_eq!((flask.acid, flask.temperature_c), (0.5, Some(30.0)));
            assert_eq!((sight.t_s, sight.flasks.len()), (3.0, 2));
            assert_eq!(sight.flasks[1].temperature_c, None);
            // The first scene has gloves to take off, the second has none.
            let rinsed = (scene == "acid-into-water").then_some([0.0; 2]);
            assert_eq!((sight.goggles, sight.rinsed_m3), (None, rinsed));
            assert_eq!(sight.sash_m, Some(0.3));
        }
    }

    #[test]
    fn a_flask_stands_upright_on_the_bench_and_in_no_hand() {
        for (name, metre) in [("acid-into-water", 1.0), ("vr-dilution", 20.0)] {
            let stands = |held, change: &dyn Fn(&mut Pose)| {
                let sight = seen(name, held, change);
                (sight.flasks[0].standing, sight.flasks[0].held)
            };
            assert_eq!(stands(false, &|_| {}), (true, false));
            assert_eq!(stands(true, &|_| {}), (false, true));
            assert!(stands(false, &|it| it.position.y += 0.004 * metre).0);
            assert!(!stands(false, &|it| it.position.y += 0.006 * metre).0);
            assert!(!stands(false, &|it| it.position.y -= 0.75 * metre).0);
            assert!(!stands(false, &|it| it.position.x += 2.0 * metre).0);
            assert!(!stands(false, &|it| it.position.z += 2.0 * metre).0);
            let tilt = |degrees: f32| {
                let turn = Quat::from_rotation_x(degrees.to_radians());
                stands(false, &|it| it.orientation = turn).0
            };
            assert!(tilt(4.0) && !tilt(6.0) && !tilt(180.0));
        }
        // A broken flask stands nowhere, and no flask stands on a bench that the scene does not have.
        let scene = Scene::builtin("acid-into-water").unwrap();
        let mut finder = Finder::new("scene", &scene, Limits::default());
        let pose = scene.flasks[0].stage_from_flask;
        assert!(finder.bench.stands(&pose));
        finder.bench.table = None;
        assert!(!finder.bench.stands(&pose));
    }

    /// 160 mL in a beaker of 400 mL stand 35 mm high over its base of 2 mm: π · 38² mm² · 35.3 mm.
    #[test]
    fn what_is_dipped_is_in_the_liquid_of_a_flask() {
        let scene = Scene::builtin("acid-into-water").unwrap();
        let finder = Finder::new("scene", &scene, Limits::default());
        let poses: Vec<Pose> = scene.flasks.iter().map(|it| it.stage_from_flask).collect();
        let census = Census {
            flasks: vec![
                Held::default(),
                Held {
                    particles: 10,
                    volume: 160e-6,
                    ..Held::default()
                },
            ],
            ..Census::default()
        };
        let dip = |aside: f32, height: f32| {
            let tip = poses[1].position + Vec3::new(aside, height, 0.0);
            let dipped = [Dipped {
                kind: ToolKind::Rod,
                tip,
                speed: 0.2,
            }];
            let sight = finder.sight(&Seen {
                t: 3.0,
                before: 2.9,
                elapsed: 0.1,
                census: &census,
                poses: &poses,
                held: &[false; 2],
                strikes: &[],
                breaks: &[],
                worn: Worn {
                    goggles: Some(true),
                    gloves: Some([true, false]),
                },
                sash_open: None,
                dipped: &dipped,
            });
            assert_eq!(sight.thermometer, None);
            let worn = (sight.goggles, sight.gloves);
            assert_eq!(worn, (Some(true), Some([true, false])));
            let dip = sight.rod.unwrap();
            assert!((dip.speed_m_s - 0.2).abs() < 1e-6);
            dip.flask
        };
        assert_eq!(dip(0.0, 0.036).as_deref(), Some("target"));
        assert_eq!(dip(0.0, 0.039), None, "above it");
        assert_eq!(dip(0.037, 0.01).as_deref(), Some("target"));
        assert_eq!(dip(0.039, 0.01), None, "in the glass");
        assert_eq!(dip(0.0, 0.001), None, "in the base");
        assert_eq!(dip(-0.24, 0.01), None, "in an empty beaker");
    }
}
