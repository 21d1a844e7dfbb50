//! What a scene states of itself, in the report's terms.

use vitriol_sim::scene::{Boundary, Preset, RelaxationKind, Scene};

use crate::cli::PresetName;
use crate::report::{SceneStatement, SolverStatement};

impl From<PresetName> for Preset {
    fn from(name: PresetName) -> Self {
        match name {
            PresetName::Fast => Self::Fast,
            PresetName::Balanced => Self::Balanced,
            PresetName::Reference => Self::Reference,
        }
    }
}

/// The scale of a scene and what it models; `name` is how it was asked for.
pub fn of_scene(name: &str, scene: &Scene) -> SceneStatement {
    SceneStatement {
        name: name.to_owned(),
        d_m: scene.scale.spacing,
        h_over_d: scene.scale.support_ratio,
        frame_time_s: scene.scale.frame_time,
        gravity_m_s2: scene.scale.gravity,
        length_scale: scene.scale.length_scale,
        models: scene.model.iter().map(|feature| feature.name()).collect(),
    }
}

/// The solver's settings in a scene, as its preset left them.
pub fn of_solver(scene: &Scene) -> SolverStatement {
    SolverStatement {
        substeps: scene.solver.substeps,
        iterations: scene.solver.iterations,
        relaxation: match scene.solver.relaxation {
            RelaxationKind::Jacobi => "jacobi",
            RelaxationKind::Chebyshev => "chebyshev",
        }
        .into(),
        omega: scene.solver.omega,
        carry: scene.solver.carry,
        v_max: scene.solver.v_max,
        boundary: match scene.solver.boundary {
            Boundary::Map => "map",
            Boundary::Particles => "particles",
        }
        .into(),
    }
}
