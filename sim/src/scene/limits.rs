//! Limits beyond which a scene cannot be simulated; it is refused at loading.

use super::Scene;
use super::error::Problem;
use super::feature::Feature;
use crate::chemistry::table::SolutionTable;

/// Steps of single precision between 1 and 2.
const PRECISION: f64 = 8_388_608.0;

/// Δt_s over its limit 0.4 d/√(gH) beyond which a column no longer stands. Up to
/// the limit it is calm, between the two it is compressed but rests; from here on
/// it does not come to rest, and at twice the limit deep ones leave their vessel
/// (docs/solver.md, docs/accuracy.md).
const LONGEST_SUBSTEP: f64 = 1.4;

/// Most of a substep's multipliers that may be carried on.
const MOST_CARRY: f64 = 0.1;

impl Scene {
    /// Whether everything is near enough to the scene's origin that single precision
    /// resolves the margin before a wall, 0.001 h: beyond, liquid would be
    /// found in glass.
    pub(super) fn check_reach(&self) -> Result<(), Problem> {
        let reach = 0.5 * PRECISION * 0.001 * self.scale.support();
        let flasks = (0..).zip(&self.flasks).map(|(index, flask)| {
            let place = flask.stage_from_flask.position.abs().max_element();
            (format!("flask[{index}].position"), f64::from(place))
        });
        let table = self.table.map(|table| {
            let centre = table.centre[0].abs().max(table.centre[1].abs());
            ("table".to_owned(), centre.max(table.top.abs()))
        });
        for (field, place) in flasks.chain(table) {
            if place > reach {
                let problem = format!(
                    "{place:.0} m from the scene's origin, where particles of {} m are told from \
                     walls up to {reach:.0} m off; give places by a nearer one, and say in \
                     `origin` where that is",
                    self.scale.spacing
                );
                return Err(Problem::new(field, problem));
            }
        }
        Ok(())
    }

    /// Whether weight exceeds the capillary suction of a wetted wall, 2σ cos θ/R: under suction a liquid whose pressure can only push
    /// tears, and wanders about its glass.
    pub(super) fn check_suction(&self) -> Result<(), Problem> {
        let Some(surface) = self.surface_tension() else {
            return Ok(());
        };
        let scale = &self.scale;
        let volume: f64 = self.liquids.iter().map(|liquid| liquid.volume).sum();
        for (index, flask) in self.flasks.iter().enumerate() {
            let full = flask.profile.rim_height();
            let level = flask.profile.level_for_volume(volume).unwrap_or(full);
            let depth = (level - flask.profile.floor_height()).max(scale.spacing);
            let radius = flask.profile.inner_radius(level).max(scale.spacing);
            let suction = 2.0 * surface.tension * flask.contact_angle.cos() / radius;
            if volume > 0.0 && suction > scale.rest_density * scale.gravity * depth {
                let problem = format!(
                    "glass {radius:.4} m in radius that liquid wets so well sucks it up with {suction:.1} Pa, more than \
                     {depth:.4} m of it weigh, and particles bear no suction; take 90 or more, a wider flask, or more \
                     weight"
                );
                return Err(Problem::new(
                    format!("flask[{index}].contact_angle"),
                    problem,
                ));
            }
        }
        Ok(())
    }

    /// Whether the share of the multipliers that a substep carries on lets the liquid rest, at up to
    /// 0.15·√(gH). Acid under water, 400 particles of 2.5 mm, moves at 2 cm/s
    /// with 0.005, 3 with 0.1, up to 6 with 0.2 and more; water at 6.5 with 0.3
    /// where the substep is at its own limit.
    pub(super) fn check_carry(&self) -> Result<(), Problem> {
        let rate = self.solver.carry_rate;
        let most = MOST_CARRY * f64::from(self.solver.substeps) / self.scale.frame_time;
        if rate > most {
            let problem = format!(
                "{rate} 1/s carry on more than {MOST_CARRY} of a substep's multipliers, and leave the liquid no \
                 rest; take {most:.0} or less, or more substeps"
            );
            return Err(Problem::new("solver.carry_rate", problem));
        }
        Ok(())
    }

    /// This scene with these substeps a frame and iterations a substep, valid or not:
    /// see [`Scene::problem_of_solver`].
    pub fn with_effort(&self, [substeps, iterations]: [u32; 2]) -> Self {
        let mut scene = self.clone();
        scene.solver.substeps = substeps;
        scene.solver.iterations = iterations;
        scene
    }

    /// Why the solver's settings are invalid, or [`Scene::problem_of_substep`]; `None` where neither is a problem.
    pub fn problem_of_solver(&self) -> Option<String> {
        let checked = self.solver.check().and_then(|()| self.check_substep());
        checked.err().map(|problem| problem.problem)
    }

    /// Why the liquid of some flask would not stand up under the scene's substep;
    /// `None` where all do. For callers that change substeps or frame time after loading.
    pub fn problem_of_substep(&self) -> Option<String> {
        self.check_substep().err().map(|problem| problem.problem)
    }

    /// Mean density of all liquids over the lightest one's: a column of it bears so many times its own pressure when what is
    /// heavier is poured onto it. 1 where densities are not modelled.
    fn heaviness(&self) -> f64 {
        if !self.models(Feature::Density) {
            return 1.0;
        }
        let table = SolutionTable::new();
        let (mut mass, mut volume, mut lightest) = (0.0, 0.0, f64::INFINITY);
        for liquid in &self.liquids {
            let density = table
                .at(liquid.acid_fraction)
                .density_at(liquid.temperature);
            mass += liquid.volume * density;
            volume += liquid.volume;
            lightest = lightest.min(density);
        }
        mass / (volume * lightest)
    }

    /// Whether all of the scene's liquid stands up under its substep, in whichever flask it is.
    pub(super) fn check_substep(&self) -> Result<(), Problem> {
        let (scale, solver) = (&self.scale, &self.solver);
        let substep = scale.frame_time / f64::from(solver.substeps);
        if self.models(Feature::Bubbles) && solver.substeps < 2 {
            let problem = "bubbles act twice a frame or more, after a substep each; take 2 or more";
            return Err(Problem::new("solver.substeps", problem.to_owned()));
        }
        if let Some(surface) = self.surface_tension() {
            let longest = surface.longest_interval(scale.particle_mass());
            if substep > longest {
                let needed = (scale.frame_time / longest).ceil();
                let problem = format!(
                    "{} in {} s are too long for a surface tension of {} N/m at this spacing, whose short waves would \
                     grow; take {needed} or more, or a larger spacing",
                    solver.substeps, scale.frame_time, surface.tension
                );
                return Err(Problem::new("solver.substeps", problem));
            }
        }
        let volume: f64 = self.liquids.iter().map(|liquid| liquid.volume).sum();
        if volume <= 0.0 || scale.gravity <= 0.0 {
            return Ok(());
        }
        let heaviness = self.heaviness();
        for flask in &self.flasks {
            // Any flask may be poured into, up to its rim.
            let full = flask.profile.rim_height();
            let level = flask.profile.level_for_volume(volume).unwrap_or(full);
            let depth = (level - flask.profile.floor_height()).max(scale.spacing) * heaviness;
            let limit = LONGEST_SUBSTEP * 0.4 * scale.spacing / (scale.gravity * depth).sqrt();
            if substep > limit {
                let needed = (scale.frame_time / limit).ceil();
                let problem = format!(
                    "{} in {} s are too long for the {depth:.3} m of liquid that {:?} may hold, which would \
                     leap out; take {needed} or more, a shorter frame_time, or a larger spacing",
                    solver.substeps, scale.frame_time, flask.name
                );
                return Err(Problem::new("solver.substeps", problem));
            }
        }
        Ok(())
    }
}
