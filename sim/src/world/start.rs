//! A scene's start for a world: particles, ground and rigid bodies.

use crate::bodies::{BodiesSpec, BodySpec, Role, Table, ToolSpec, Worn};
use crate::chemistry::table::SolutionTable;
use crate::fill::FillError;
use crate::scene::{Feature, PANE, Scene, StartParticle, Tool, ToolKind, sash_heights};
use crate::solver::{Ground, Particle};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// The liquid of a scene at the start, under the pressure of its depth: from
/// none, the column would first be squeezed while its multipliers build up.
///
/// # Errors
/// [`FillError`] where a liquid does not fit.
pub fn particles(scene: &Scene, seed: u64) -> Result<Vec<Particle>, FillError> {
    let start = scene.start(Some(seed))?;
    let table = scene.models(Feature::Density).then(SolutionTable::new);
    let rest_density = scene.scale.rest_density;
    let density = |particle: &StartParticle| match &table {
        Some(table) => table
            .at(particle.acid_fraction)
            .density_at(particle.temperature),
        None => rest_density,
    };
    // Down each flask from its highest particle, ∫ ρ g dy.
    let mut order: Vec<usize> = (0..start.len()).collect();
    order.sort_by(|&a, &b| {
        let by_flask = start[a].flask.cmp(&start[b].flask);
        by_flask.then(start[b].position.y.total_cmp(&start[a].position.y))
    });
    let mut carried = vec![0.0; start.len()];
    for pair in order.windows(2) {
        let (above, below) = (&start[pair[0]], &start[pair[1]]);
        if above.flask == below.flask {
            let drop = above.position.y - below.position.y;
            let mean = 0.5 * (density(above) + density(below)) / rest_density;
            carried[pair[1]] = carried[pair[0]] - scene.scale.gravity * drop * mean;
        }
    }
    Ok(start
        .iter()
        .zip(carried)
        .map(|(particle, carried)| Particle {
            position: particle.position,
            velocity: DVec3::ZERO,
            flask: Some(particle.flask),
            temperature: particle.temperature,
            acid: particle.acid_fraction,
            carried,
        })
        .collect())
}

/// Table and floor of a scene, for the particles.
pub fn ground(scene: &Scene) -> Ground {
    Ground {
        floor: scene.floor.height,
        table: scene
            .table
            .map(|t| (t.top, DVec2::from(t.centre), DVec2::from(t.size))),
        scale: 1.0 / scene.scale.length_scale,
    }
}

/// The rigid bodies of a scene.
pub(super) fn bodies(scene: &Scene) -> BodiesSpec {
    let single = |pair: [f64; 2]| Vec2::new(pair[0] as f32, pair[1] as f32);
    BodiesSpec {
        gravity: Vec3::new(0.0, -scene.scale.gravity as f32, 0.0),
        step: scene.scale.frame_time as f32,
        length_scale: (1.0 / scene.scale.length_scale) as f32,
        table: scene.table.map(|table| Table {
            top: table.top as f32,
            centre: single(table.centre),
            size: single(table.size),
        }),
        floor: scene.floor.height as f32,
        flasks: scene
            .flasks
            .iter()
            .map(|flask| BodySpec {
                outline: flask
                    .profile
                    .outer_outline()
                    .iter()
                    .map(|&[r, y]| [r as f32, y as f32])
                    .collect(),
                glass_mass: flask.mass as f32,
                stage_from_flask: flask.stage_from_flask,
                fixed: flask.fixed,
            })
            .collect(),
        tools: scene
            .tools
            .iter()
            .map(|tool| of_tool(tool, scene))
            .collect(),
        worn: Worn {
            goggles: scene.tool(ToolKind::Goggles).map(|it| it.worn),
            gloves: scene.tool(ToolKind::Gloves).map(|it| [it.worn; 2]),
        },
    }
}

/// A tool as a body: a cylinder.
fn of_tool(tool: &Tool, scene: &Scene) -> ToolSpec {
    let length_scale = scene.scale.length_scale;
    // A scene with a sash has a table.
    let heights = (scene.table.as_ref()).map_or([0.0; 2], |it| sash_heights(it, &scene.scale));
    let [radius, height] = tool.kind.cylinder().map(|m| (m / length_scale) as f32);
    ToolSpec {
        body: BodySpec {
            outline: vec![[0.0, 0.0], [radius, 0.0], [radius, height]],
            // Its weight grows as the flasks' does, with the scene's volume.
            glass_mass: (tool.kind.mass() / length_scale.powi(3)) as f32,
            stage_from_flask: tool.stage_from_tool,
            fixed: tool.kind == ToolKind::Gloves,
        },
        role: match tool.kind {
            ToolKind::Goggles => Role::Goggles,
            ToolKind::Gloves => Role::Gloves,
            ToolKind::Sash => Role::Sash {
                heights: heights.map(|m| m as f32),
                pane: PANE.map(|m| (m / length_scale) as f32),
            },
            ToolKind::Cloth | ToolKind::Rod | ToolKind::Thermometer => Role::Tool,
        },
    }
}
