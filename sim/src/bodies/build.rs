//! Builds rapier's world from a [`BodiesSpec`].

use glam::{Vec2, Vec3};
use rapier3d::na::Unit;
use rapier3d::prelude::{
    ColliderBuilder, Group, InteractionGroups, InteractionTestMode, PhysicsWorld, RigidBodyBuilder,
};

use crate::scene::TableTop;

use super::body::Body;
use super::spec::{BodiesError, BodiesSpec, BodySpec, Role, Table};
use super::units::{UNIT, Units};
use super::{shell, solid};

/// rapier steps in one simulation step. Each has four solver substeps of its
/// own; at 90 Hz that is 0.7 ms, in which a flask that falls off a table (4 m/s) moves 3 mm.
pub(super) const SUBSTEPS: u32 = 4;
/// Sliding friction between glass and what it meets: 0.4 for glass on glass (The Engineering
/// ToolBox, friction coefficients, kinetic). For wood on wood OpenStax (University
/// Physics 1, Table 6.1) has 0.3 kinetic and 0.5 static; we found no value for glass on
/// wood and take 0.4 there, too.
const FRICTION: f32 = 0.4;
/// Restitution. A solid glass ball on steel gives back 0.9 and more, a
/// thin-walled vessel on wood rings and loses most of it: our choice, not a measurement.
const RESTITUTION: f32 = 0.2;
/// Natural frequency (Hz) of contacts with table and floor. At rapier's 60 Hz a
/// full flask stands 0.1 mm deep in the table, at 200 Hz a tenth of that; the solver's
/// substeps (1440 Hz at 90 Hz of simulation) still resolve it.
const CONTACT_FREQUENCY: f32 = 200.0;
/// Thickness of the table top (m, at real size).
const TABLE_THICKNESS: f32 = TableTop::THICKNESS as f32;

/// Damping of a tool's spin, 1/s: our choice.
const TOOL_DAMPING: f32 = 3.0;

/// Collision group of a body's colliders; those of table, floor and shards are in all groups.
const FLASKS: Group = Group::GROUP_1;
const TOOLS: Group = Group::GROUP_2;
const SASH: Group = Group::GROUP_3;

/// rapier's world and the bodies in it, the flasks first, at rest where `spec` puts them.
pub(super) fn build(spec: &BodiesSpec) -> Result<(PhysicsWorld, Vec<Body>), BodiesError> {
    check_world(spec)?;
    let units = Units::new(spec.length_scale);
    let mut rapier = PhysicsWorld {
        gravity: units.vector(spec.gravity),
        ..PhysicsWorld::default()
    };
    let parameters = &mut rapier.integration_parameters;
    parameters.dt = spec.step / SUBSTEPS as f32;
    parameters.min_ccd_dt = parameters.dt / 100.0;
    parameters.static_contact_softness.natural_frequency = CONTACT_FREQUENCY;
    // Without friction in its first pass a flask that stands creeps by 0.01 mm a second.
    parameters.friction_in_bias_pass = true;
    // Contacts that are reused while a flask moves by millimetres save no time worth having.
    parameters.contact_recycling = false;

    let floor = ColliderBuilder::halfspace(Unit::new_unchecked(Vec3::Y));
    let height = Vec3::new(0.0, spec.floor, 0.0);
    rapier.insert_collider(surface(floor).translation(units.vector(height)), None);
    if let Some(table) = spec.table {
        rapier.insert_collider(table_top(table, units), None);
    }
    let mut flasks = Vec::with_capacity(spec.flasks.len());
    let tools = spec.tools.iter().map(|it| (&it.body, Some(it.role)));
    let all = spec.flasks.iter().map(|it| (it, None)).chain(tools);
    for (index, (body, role)) in all.enumerate() {
        flasks.push(insert(&mut rapier, index, (body, role), units)?);
    }
    Ok((rapier, flasks))
}

fn check_world(spec: &BodiesSpec) -> Result<(), BodiesError> {
    let check = |what, value: f32, fits: bool, must| {
        (value.is_finite() && fits)
            .then_some(())
            .ok_or(BodiesError::World { what, value, must })
    };
    let finite = |what, value| check(what, value, true, "a finite number");
    let positive = |what, value| {
        check(
            what,
            value,
            value > 0.0,
            "a finite number greater than zero",
        )
    };
    spec.gravity
        .to_array()
        .into_iter()
        .try_for_each(|component| finite("gravity", component))?;
    positive("the simulation step", spec.step)?;
    positive("the length scale", spec.length_scale)?;
    finite("the floor's height", spec.floor)?;
    if let Some(Table { top, centre, size }) = spec.table {
        finite("the table's height", top)?;
        finite("the table's centre", centre.x)?;
        finite("the table's centre", centre.y)?;
        positive("the table's size", size.x)?;
        positive("the table's size", size.y)?;
    }
    Ok(())
}

fn check_flask(flask: usize, spec: &BodySpec) -> Result<(), BodiesError> {
    let check = |met: bool, what, must| {
        met.then_some(())
            .ok_or(BodiesError::Flask { flask, what, must })
    };
    let outline = &spec.outline;
    check(
        outline.len() >= 3 && outline[0] == [0.0, 0.0],
        "the outline",
        "three or more points that begin at [0, 0], the centre of the base",
    )?;
    check(
        outline
            .iter()
            .all(|&[radius, height]| radius.is_finite() && height.is_finite() && radius >= 0.0),
        "the outline",
        "of finite numbers with radii of zero or more",
    )?;
    check(
        outline.windows(2).all(|pair| pair[0][1] <= pair[1][1]),
        "the outline",
        "ordered from base to rim, with heights that never decrease",
    )?;
    check(
        spec.glass_mass.is_finite() && spec.glass_mass > 0.0,
        "the glass's mass",
        "a finite number of kilograms greater than zero",
    )?;
    check(
        spec.stage_from_flask.is_valid(),
        "the pose",
        "finite, with an orientation of unit length",
    )
}

fn insert(
    rapier: &mut PhysicsWorld,
    index: usize,
    (spec, role): (&BodySpec, Option<Role>),
    units: Units,
) -> Result<Body, BodiesError> {
    check_flask(index, spec)?;
    let outline: Vec<Vec2> = spec
        .outline
        .iter()
        .map(|point| Vec2::from(point.map(|metres| units.length(metres))))
        .collect();
    let pieces = match role {
        None => solid::pieces(&outline),
        Some(Role::Sash { pane, .. }) => {
            let [height, thickness] = pane.map(|metres| units.length(metres));
            let orientation = spec.stage_from_flask.orientation;
            solid::sash(&outline, [height, thickness], orientation)
        }
        Some(_) => solid::block(&outline),
    };
    let pieces = pieces.ok_or(BodiesError::Flask {
        flask: index,
        what: "the outline",
        must: "the surface of a solid, not of a disc or a line",
    })?;
    let glass = shell::mass_properties(&spec.outline, spec.glass_mass);
    let builder = if spec.fixed {
        RigidBodyBuilder::fixed()
    } else if matches!(role, Some(Role::Sash { .. })) {
        // A sash: its counterweights bear it.
        RigidBodyBuilder::kinematic_position_based()
    } else {
        // Without sleep: liquid that is poured into a sleeping flask would have to wake it.
        let builder = RigidBodyBuilder::dynamic().ccd_enabled(true);
        match role {
            None => builder.can_sleep(false),
            // A tool bears no liquid. Asleep it does not creep, and damped it does not roll off the bench.
            Some(_) => builder.angular_damping(TOOL_DAMPING),
        }
    };
    let body = rapier.insert_body(
        builder
            .pose(units.pose(spec.stage_from_flask))
            .additional_mass_properties(units.mass_properties(glass)),
    );
    for (shape, flask_from_piece) in pieces {
        let collider = ColliderBuilder::new(shape)
            .position(flask_from_piece)
            .density(0.0);
        let collider = surface(collider).collision_groups(groups(role));
        rapier.insert_collider(collider, Some(body));
    }
    Ok(Body {
        body,
        outline: spec.outline.clone(),
        glass,
        radius: outline
            .iter()
            .fold(0.0, |widest, point| point.x.max(widest)),
        fixed: spec.fixed,
        role,
    })
}

/// Flasks and tools do not meet; a sash meets all of them.
fn groups(role: Option<Role>) -> InteractionGroups {
    let (own, other) = match role {
        None => (FLASKS, TOOLS),
        Some(Role::Sash { .. }) => (SASH, Group::NONE),
        Some(_) => (TOOLS, FLASKS | TOOLS),
    };
    InteractionGroups::new(own, !other, InteractionTestMode::And)
}

fn table_top(table: Table, units: Units) -> ColliderBuilder {
    let half = Vec2::new(
        units.length(0.5 * table.size.x),
        units.length(0.5 * table.size.y),
    );
    let half_thickness = 0.5 * TABLE_THICKNESS / UNIT;
    let surface_centre = units.vector(Vec3::new(table.centre.x, table.top, table.centre.y));
    surface(ColliderBuilder::cuboid(half.x, half_thickness, half.y))
        .translation(surface_centre - Vec3::Y * half_thickness)
}

pub(super) fn surface(collider: ColliderBuilder) -> ColliderBuilder {
    collider.friction(FRICTION).restitution(RESTITUTION)
}
