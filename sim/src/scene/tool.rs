//! Tools on the bench beside the flasks: goggles and gloves to wear, rod and thermometer to dip, a cloth to wipe with, and a sash.
//!
//! Each is a cylinder to the rigid bodies. Sizes are of real size; a scene that is drawn larger has them larger.

use super::error::Problem;
use super::fields::{TURN, TURN_IN_WORDS, exactly, require, within};
use super::settings::{Scale, TableTop};
use crate::pose::Pose;
use glam::{DQuat, DVec3, EulerRot, Vec3};
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_2;

/// How far a tool, and the floor, may be from the scene's origin along an axis, m: single precision resolves a millimetre there.
pub(super) const FARTHEST: f64 = 1e4;

/// Kind of a tool. A scene has one of each at most.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToolKind {
    /// Safety goggles: worn by letting go of them before the eyes.
    Goggles,
    /// A box of gloves: a hand that closes on it has one on. The other hand pulls it off.
    Gloves,
    /// A cloth that takes up the liquid that it lies on.
    Cloth,
    /// A stirring rod.
    Rod,
    /// A thermometer.
    Thermometer,
    /// The sash of a fume hood: a pane over a bar, by which it is slid up and down. It stays where it is let go of.
    Sash,
}

/// Height of a sash's pane over its bar, and its thickness, m at real size. Our choice; safety glass is sold so thick.
pub const PANE: [f64; 2] = [0.70, 0.006];
/// How far a sash goes up from the bench, m at real size: a hood's opening (EN 14175 tests it at 0.4 to 0.5 m).
pub const SASH_TRAVEL: f64 = 0.55;

impl ToolKind {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Goggles,
        Self::Gloves,
        Self::Cloth,
        Self::Rod,
        Self::Thermometer,
        Self::Sash,
    ];

    /// Radius and height of its cylinder at real size, m. Goggles are as broad as a face (0.15 m: NASA-STD-3000); a rod is 7 mm by 250 mm
    /// and a thermometer 6 mm by 260 mm, as they are sold; box, cloth, folded to a pad, and the bar of a sash are our choice.
    pub fn cylinder(self) -> [f64; 2] {
        match self {
            Self::Goggles => [0.075, 0.06],
            Self::Gloves => [0.08, 0.09],
            Self::Cloth => [0.07, 0.02],
            Self::Rod => [0.0035, 0.25],
            Self::Thermometer => [0.003, 0.26],
            Self::Sash => [0.012, 1.1],
        }
    }

    /// Its mass at real size, kg: of rod and thermometer that of the glass, of the others our choice.
    pub fn mass(self) -> f64 {
        match self {
            Self::Goggles => 0.09,
            Self::Gloves => 0.5,
            Self::Cloth => 0.04,
            Self::Rod => 0.021,
            Self::Thermometer => 0.016,
            Self::Sash => 6.0,
        }
    }

    /// Whether it is dipped: by its lower end, which is its origin.
    pub fn is_dipped(self) -> bool {
        matches!(self, Self::Rod | Self::Thermometer)
    }

    /// Whether its cylinder is long and thin, and lies on its side at the start.
    fn lies(self) -> bool {
        self.is_dipped() || self == Self::Sash
    }

    /// Whether it can be worn.
    pub fn is_worn(self) -> bool {
        matches!(self, Self::Goggles | Self::Gloves)
    }
}

/// A tool of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Its kind.
    pub kind: ToolKind,
    /// Where it is at the start: +y is its cylinder's axis, the origin the middle of its base.
    pub stage_from_tool: Pose,
    /// Whether it is worn at the start: gloves on both hands.
    pub worn: bool,
}

/// Least and greatest height of the axis of a sash's bar, m of the scene.
pub fn sash_heights(table: &TableTop, scale: &Scale) -> [f64; 2] {
    let [radius, _] = ToolKind::Sash.cylinder();
    [radius, radius + SASH_TRAVEL].map(|over| table.top + over / scale.length_scale)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ToolEntry {
    kind: ToolKind,
    /// Middle of the area that it lies on, metres of the scene.
    #[serde(deserialize_with = "exactly")]
    position: [f64; 3],
    /// Rotation about the vertical, degrees; at 0 a tool that lies on its side has its lower end to the right.
    #[serde(default)]
    yaw: f64,
    #[serde(default)]
    worn: bool,
}

impl ToolEntry {
    pub fn build(self, index: usize, scale: &Scale) -> Result<Tool, Problem> {
        let field = |name: &str| format!("tool[{index}].{name}");
        for value in self.position {
            let (fits, must) = (
                value.abs() <= FARTHEST,
                "within 10 km of the origin (metres)",
            );
            require(&field("position"), value, fits, must)?;
        }
        within(&field("yaw"), self.yaw, TURN, TURN_IN_WORDS)?;
        if self.worn && !self.kind.is_worn() {
            let problem = "can only be worn by goggles and gloves; leave it out";
            return Err(Problem::new(field("worn"), problem));
        }
        let [radius, height] = self.kind.cylinder().map(|m| m / scale.length_scale);
        let turned = DQuat::from_rotation_y(self.yaw.to_radians());
        let middle = DVec3::from_array(self.position);
        let (place, orientation) = if self.kind.lies() {
            let lying = turned * DQuat::from_euler(EulerRot::XYZ, 0.0, 0.0, FRAC_PI_2);
            let base = middle + radius * DVec3::Y - 0.5 * height * (lying * DVec3::Y);
            (base, lying)
        } else {
            (middle, turned)
        };
        Ok(Tool {
            kind: self.kind,
            stage_from_tool: Pose::new(place.as_vec3(), orientation.as_quat()),
            worn: self.worn,
        })
    }
}

/// One of each kind at most: lessons and pictures name tools by their kind. They lie on the bench, where there is one, so that hands reach
/// them; a sash slides over it.
pub(super) fn check_tools(
    tools: &[Tool],
    table: Option<&TableTop>,
    scale: &Scale,
) -> Result<(), Problem> {
    for (index, tool) in tools.iter().enumerate() {
        let field = |name: &str| format!("tool[{index}].{name}");
        if tools[..index].iter().any(|it| it.kind == tool.kind) {
            let problem = "is there already; a scene has one of each";
            return Err(Problem::new(field("kind"), problem));
        }
        let Some(table) = table else {
            if tool.kind == ToolKind::Sash {
                let problem =
                    "is a sash, which slides over a bench; add a [table], or leave it out";
                return Err(Problem::new(field("kind"), problem));
            }
            continue;
        };
        let Pose {
            position,
            orientation,
        } = tool.stage_from_tool;
        let half = 0.5 * tool.kind.cylinder()[1] / scale.length_scale;
        let middle = position.as_dvec3() + half * (orientation * Vec3::Y).as_dvec3();
        // Positions are in single precision: a hundredth of a millimetre is far below what is seen, and above its rounding.
        let slack = 1e-5 / scale.length_scale;
        for (axis, at) in [(0, middle.x), (2, middle.z)] {
            let side = axis / 2;
            let fits = (at - table.centre[side]).abs() <= 0.5 * table.size[side] + slack;
            let must = "over the table, whose extent is [table] centre and size (metres)";
            require(&field(&format!("position[{axis}]")), at, fits, must)?;
        }
        let [lowest, highest] = sash_heights(table, scale);
        let height = f64::from(position.y);
        let (fits, must) = match tool.kind {
            ToolKind::Sash => (
                (lowest - slack..=highest + slack).contains(&height),
                "from the table's top to 0.55 m over it at real size, which is how far a sash slides (metres)",
            ),
            _ => (
                height >= table.top - slack,
                "the table's top or above it (metres)",
            ),
        };
        require(&field("position[1]"), height, fits, must)?;
    }
    Ok(())
}
