//! What the renderer draws of a scene, in its own terms: room, vessels, liquid.

use glam::{Affine3A, Vec3};
use vitriol_render::{
    BoxDesc, BubbleSource, Label, LiquidDesc, LiquidSource, Neighbours, PlateDesc, RoomLight,
    SceneDesc, ShardDesc, SpraySource, SurfaceFilter, Tint, VesselDesc, VesselTables,
};
use vitriol_sim::bodies::{BASE_SHARE, Shard};
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::{Flask, PictureFilter, PictureRoom, PictureTint, Scene, TableTop};
use vitriol_sim::world::World;

/// The liquid in the solver's buffers.
pub fn liquid_of(world: &World) -> LiquidSource<'_> {
    let (solver, scene) = (world.solver(), world.scene());
    let (flasks, distances) = solver.flask_tables();
    LiquidSource {
        positions: solver.positions(),
        heat: solver.heat(),
        volumes: solver.volumes(),
        count: solver.count(),
        spacing: scene.scale.spacing as f32,
        neighbours: solver.neighbours().map(|(counts, list, fours)| Neighbours {
            counts,
            list,
            fours,
            support: solver.parameters().support_radius as f32,
        }),
        vessels: Some(VesselTables { flasks, distances }),
        bubbles: solver.bubbles().map(|(bubbles, count)| BubbleSource {
            bubbles,
            count,
            spray: solver.drops().map(|drops| SpraySource {
                drops,
                mass: solver.parameters().particle_mass() as f32,
            }),
        }),
        table: table(scene),
        floor: scene.floor.height as f32,
    }
}

/// What a renderer is made for that draws a world's liquid.
pub fn drawn_liquid(world: &World) -> LiquidDesc {
    let solver = world.solver();
    LiquidDesc {
        filter: filter(world.scene().picture.filter),
        tint: tint(world.scene().picture.tint),
        bubbles: solver.bubbles().map_or(0, |(_, count)| count),
        ..LiquidDesc::new(solver.count())
    }
}

/// The renderer's name for a scene's filter.
pub fn filter(filter: PictureFilter) -> SurfaceFilter {
    match filter {
        PictureFilter::NarrowRange => SurfaceFilter::NarrowRange,
        PictureFilter::CurvatureFlow => SurfaceFilter::CurvatureFlow,
    }
}

/// The renderer's name for a scene's tint.
pub fn tint(tint: PictureTint) -> Tint {
    match tint {
        PictureTint::Artificial => Tint::Artificial,
        PictureTint::None => Tint::None,
    }
}

/// The scene's table.
fn table(scene: &Scene) -> Option<BoxDesc> {
    scene.table.map(|table| {
        let half = [0.5 * table.size[0], 0.5 * table.size[1]];
        let under = table.top - TableTop::THICKNESS / scene.scale.length_scale;
        let corner = |side: f64, y: f64| {
            Vec3::new(
                (table.centre[0] + side * half[0]) as f32,
                y as f32,
                (table.centre[1] + side * half[1]) as f32,
            )
        };
        BoxDesc {
            min: corner(-1.0, under),
            max: corner(1.0, table.top),
        }
    })
}

/// Least distance between two marks, m: in a tray they would run into each other.
const LEAST_APART: f64 = 0.004;

/// Heights of a vessel's graduation marks: where whole multiples of a round
/// volume, as drawn, would stand; and those volumes, mL. A funnel, which hangs upside down, has none.
fn marks(flask: &Flask, length_scale: f64) -> (Vec<f64>, Vec<u32>) {
    let capacity = flask.profile.capacity() * length_scale.powi(3);
    let steps = [1, 2, 5, 10, 25, 50, 100, 250];
    let step = steps
        .into_iter()
        .find(|&step| capacity / millilitres(step) < 9.0);
    let Some(step) = step.filter(|_| is_upright(flask)) else {
        return Default::default();
    };
    // The uppermost tenth is left free.
    let marks: Vec<(f64, u32)> = (1..)
        .map(|n| n * step)
        .take_while(|volume| millilitres(*volume) < 0.9 * capacity)
        .filter_map(|volume| {
            let height = flask
                .profile
                .level_for_volume(millilitres(volume) / length_scale.powi(3));
            Some((height?, volume))
        })
        .collect();
    let close = |pair: &[(f64, u32)]| length_scale * (pair[1].0 - pair[0].0) < LEAST_APART;
    match marks.windows(2).any(close) {
        true => Default::default(),
        false => marks.into_iter().unzip(),
    }
}

/// In m³.
fn millilitres(volume: u32) -> f64 {
    1e-6 * f64::from(volume)
}

fn is_upright(flask: &Flask) -> bool {
    (flask.stage_from_flask.orientation * Vec3::Y).y > 0.9
}

/// A label's letters over the vessel's radius, and the middle of the label, rad to the left of the marks.
const LETTERS: f64 = 0.155;
const ASIDE: f64 = -0.78;
/// Its upper edge over the vessel's height.
const LABEL_TOP: f64 = 0.90;
/// Height and radius of a vessel below which it has no label, m as drawn: a tray, or what is too narrow to be read.
const LEAST_LABELLED: [f64; 2] = [0.04, 0.018];

/// The label of a vessel that holds one liquid at the start: what it is.
fn label(scene: &Scene, index: usize, flask: &Flask) -> Option<Label> {
    let mut liquids = scene.liquids.iter().filter(|it| it.flask == index);
    let (Some(liquid), None) = (liquids.next(), liquids.next()) else {
        return None;
    };
    let outer = flask.profile.outer_outline();
    let radius = outer.iter().map(|point| point[0]).fold(0.0, f64::max);
    let top = outer.last()?[1];
    let scale = scene.scale.length_scale;
    if !is_upright(flask) || scale * top < LEAST_LABELLED[0] || scale * radius < LEAST_LABELLED[1] {
        return None;
    }
    let lines = match 100.0 * liquid.acid_fraction {
        acid if acid < 0.5 => vec!["H₂O".to_owned()],
        acid => vec!["H₂SO₄".to_owned(), format!("{acid:.0} %")],
    };
    let letters = LETTERS * radius;
    // Margins and lines as `common/picture/printed.wgsl` has them; five letters of six points and seven high.
    let height = letters * (0.7 + 1.4 * lines.len() as f64);
    let half = letters * (0.7 + 2.5 * 6.0 / 7.0);
    Some(Label {
        lines,
        bottom: LABEL_TOP * top - height,
        letters,
        angles: [ASIDE, half / radius],
    })
}

/// Least radius of a hot plate, and how much wider than its vessel it is at least, m: 135 mm across, as laboratories' round ones are.
const PLATE: f64 = 0.0675;
const PLATE_BESIDE: f64 = 0.025;
/// How far a flask's base may be from the bench to stand on it, m.
const STANDS: f64 = 0.005;

/// The hot plates of the flasks that stand on the table at the start.
fn plates(scene: &Scene) -> Vec<PlateDesc> {
    let Some(table) = scene.table else {
        return Vec::new();
    };
    let scale = scene.scale.length_scale;
    let stands = |flask: &&Flask| {
        let base = f64::from(flask.stage_from_flask.position.y);
        flask.plate && is_upright(flask) && scale * (base - table.top).abs() < STANDS
    };
    let plate = |flask: &Flask| {
        let middle = flask.stage_from_flask.position;
        let radius = flask.profile.outer_radius() + PLATE_BESIDE / scale;
        PlateDesc {
            middle: [middle.x, middle.z],
            radius: radius.max(PLATE / scale) as f32,
        }
    };
    scene.flasks.iter().filter(stands).map(plate).collect()
}

/// The scene's vessels on their table in the room.
pub fn laboratory(scene: &Scene) -> SceneDesc {
    let bare = scene.picture.room == PictureRoom::Bare;
    let vessels = scene.flasks.iter().enumerate().map(|(index, flask)| {
        let (marks, volumes) = match bare {
            true => Default::default(),
            false => marks(flask, scene.scale.length_scale),
        };
        VesselDesc {
            inner: flask.profile.inner_outline().to_vec(),
            outer: flask.profile.outer_outline().to_vec(),
            marks,
            volumes,
            label: label(scene, index, flask).filter(|_| !bare),
        }
    });
    let length_scale = scene.scale.length_scale;
    let top = scene.table.map_or(0.0, |table| table.top) * length_scale;
    let room = SceneDesc::laboratory(vessels.collect(), top as f32, length_scale as f32);
    SceneDesc {
        table: table(scene),
        plates: if bare { Vec::new() } else { plates(scene) },
        light: match scene.picture.room {
            PictureRoom::Day | PictureRoom::Bare => RoomLight::DAY,
            PictureRoom::Bright => RoomLight::BRIGHT,
            PictureRoom::Dark => RoomLight::DARK,
        },
        furnished: !bare,
        ..room
    }
}

/// Whether there is any acid, which is drawn in another tint than water.
pub fn has_acid(scene: &Scene) -> bool {
    let mut liquids = scene.liquids.iter();
    liquids.any(|liquid| liquid.acid_fraction > 0.0)
}

/// What is left of broken glass.
pub fn shards(world: &World) -> Vec<ShardDesc> {
    let flasks = &world.scene().flasks;
    let shard = |shard: Shard| {
        let outline = flasks.get(shard.flask)?.profile.outer_outline();
        let top = outline.last().map_or(0.0, |[_, height]| *height as f32);
        Some(ShardDesc {
            vessel: shard.flask,
            piece: shard.piece,
            base: BASE_SHARE * top,
            stage_from_vessel: affine(&shard.stage_from_flask),
        })
    };
    world.shards().into_iter().filter_map(shard).collect()
}

/// A pose as the renderer takes it.
pub fn affine(pose: &Pose) -> Affine3A {
    Affine3A::from_rotation_translation(pose.orientation, pose.position)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// The volume that a number names is below its mark: the outline's integral, by frustums, of all vessels of all scenes.
    #[test]
    fn a_mark_stands_where_its_volume_does() {
        let mut numbers = 0;
        for name in Scene::builtin_names() {
            let scene = Scene::builtin(name).unwrap();
            let scale = scene.scale.length_scale;
            for vessel in laboratory(&scene).vessels {
                assert_eq!(vessel.marks.len(), vessel.volumes.len());
                for (&height, &number) in vessel.marks.iter().zip(&vessel.volumes) {
                    let below: f64 = (vessel.inner.windows(2))
                        .map(|pair| {
                            let [[r0, y0], [r1, y1]] = [pair[0], pair[1]];
                            let share = ((height - y0) / (y1 - y0).max(1e-12)).clamp(0.0, 1.0);
                            let r = r0 + share * (r1 - r0);
                            PI / 3.0 * share * (y1 - y0) * (r0 * r0 + r0 * r + r * r)
                        })
                        .sum();
                    let off = below * scale.powi(3) * 1e6 / f64::from(number) - 1.0;
                    assert!(off.abs() < 0.005, "{name}: {number} mL is off by {off}");
                    numbers += 1;
                }
            }
        }
        assert!(numbers > 50, "{numbers}");
    }

    /// A plate that heats, and one that left the acid hot, are about the middle of their beaker and wider than it. What hangs over the bench
    /// stands on none.
    #[test]
    fn a_hot_plate_is_under_its_beaker() {
        for (name, stands) in [("hot-acid", 1), ("hot-acid-85", 1), ("boiling-water", 0)] {
            let mut scene = Scene::builtin(name).unwrap();
            let plates = laboratory(&scene).plates;
            assert_eq!(plates.len(), 1, "{name}");
            let flask = &mut scene.flasks[stands];
            let at = flask.stage_from_flask.position;
            assert_eq!(plates[0].middle, [at.x, at.z], "{name}");
            let beside = f64::from(plates[0].radius) - flask.profile.outer_radius();
            assert!(beside > 0.02, "{name}: {beside}");
            flask.stage_from_flask.position.y += 0.05;
            assert_eq!(laboratory(&scene).plates, [], "{name}");
        }
        let cold = Scene::builtin("water-into-acid").unwrap();
        assert_eq!(laboratory(&cold).plates, []);
    }

    /// A vessel that holds liquid at the start is labelled with it; a funnel and an empty beaker have no label.
    #[test]
    fn labels_say_what_is_in_it() {
        let lines = |scene: &str| -> Vec<Option<Vec<String>>> {
            let scene = Scene::builtin(scene).unwrap();
            let vessels = laboratory(&scene).vessels.into_iter();
            vessels
                .map(|it| it.label.map(|label| label.lines))
                .collect()
        };
        let of = |lines: &[&str]| Some(lines.iter().map(|it| (*it).to_owned()).collect());
        let (water, acid) = (of(&["H₂O"]), of(&["H₂SO₄", "98 %"]));
        assert_eq!(lines("water-into-acid"), [water.clone(), acid]);
        assert_eq!(lines("two-flasks"), [water, None]);
        assert_eq!(lines("triple-dilution")[1], None);
    }
}
