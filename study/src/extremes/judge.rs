//! The verdict on a case.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use vitriol_gpu::Gpu;
use vitriol_run::units::count;
use vitriol_run::{Blame, Failure};
use vitriol_shaders::Library;
use vitriol_sim::scene::Scene;

use super::case::Case;
use super::drive::{ENERGY, Run, drive};
use super::motion::Motion;
use super::recipe::{Base, Crowd, Recipe};
use crate::merge::{Name, number, numbers};

/// Result of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The case's number.
    pub case: usize,
    /// Its extremes in words.
    pub label: String,
    /// Kinds of its extremes.
    pub kinds: Vec<Name>,
    /// Its verdict.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// Number of times that each limiter acted.
    pub limiters: BTreeMap<Name, u32>,
    /// Particles.
    pub particles: usize,
    /// Steps.
    pub steps: u64,
    /// Largest speed over v_max.
    #[serde(deserialize_with = "number")]
    pub speed_over_max: f64,
    /// Energy beyond the initial and the declared one, over the turnover.
    #[serde(deserialize_with = "number")]
    pub energy_excess: f64,
    /// Energy that the filling set free as it settled, over the turnover.
    #[serde(deserialize_with = "number")]
    pub settling: f64,
    /// Largest relative changes of acid, mass and enthalpy.
    #[serde(deserialize_with = "numbers")]
    pub drifts: [f64; 3],
    /// Root mean square of the speeds in the flask over the last quarter of a second,
    /// m/s.
    #[serde(deserialize_with = "number")]
    pub end_speed: f64,
}

/// The verdict on a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "verdict", rename_all = "lowercase")]
pub enum Verdict {
    /// All criteria hold.
    Passed,
    /// The scene was refused at load.
    Refused {
        /// The message.
        message: String,
    },
    /// At least one criterion does not hold.
    Failed {
        /// These criteria, each with its figures.
        reasons: Vec<String>,
    },
}

/// Runs a case and judges it.
///
/// # Errors
/// The device's error; a case that fails is no error.
pub fn judge(gpu: &Gpu, library: &Library, case: &Case) -> Result<Finding, Failure> {
    let recipe = &case.recipe;
    let finding = |verdict, run: Option<&Run>| Finding {
        case: case.number,
        label: case.label(),
        kinds: case.extremes.iter().map(|it| it.kind().into()).collect(),
        verdict,
        limiters: run.map(limiters).unwrap_or_default(),
        particles: run.map_or(0, |run| run.particles),
        steps: run.map_or(0, |run| run.steps),
        speed_over_max: run.map_or(0.0, |run| run.speed / recipe.v_max),
        energy_excess: run.map_or(0.0, |run| run.excess / run.turnover),
        settling: run.map_or(0.0, |run| run.settling / run.turnover),
        drifts: run.map_or([0.0; 3], |run| run.drifts),
        end_speed: run.map_or(0.0, |run| run.end_speed),
    };
    let scene = match Scene::parse(&recipe.text(), "case.toml") {
        Ok(scene) => scene,
        Err(error) => {
            let message = error.to_string();
            return Ok(finding(Verdict::Refused { message }, None));
        }
    };
    let run = drive(gpu, library, &scene, case)?;
    let mut reasons = reasons(recipe, &run);
    if recipe.origin != [0.0; 3] {
        let mut here = case.clone();
        here.recipe.origin = [0.0; 3];
        let scene = Scene::parse(&here.recipe.text(), "case.toml").other()?;
        let hash = drive(gpu, library, &scene, &here)?.hash;
        if hash != run.hash {
            reasons.push("other bits than at the origin".into());
        }
    }
    let verdict = if reasons.is_empty() {
        Verdict::Passed
    } else {
        Verdict::Failed { reasons }
    };
    Ok(finding(verdict, Some(&run)))
}

/// Relative excess over v_max by rounding.
const SPEED_ROUNDING: f64 = 1e-5;
/// Relative changes of acid, mass and enthalpy by rounding of f32.
const KEPT: [f64; 3] = [1e-5, 1e-5, 1e-4];

/// Every criterion that does not hold.
fn reasons(recipe: &Recipe, run: &Run) -> Vec<String> {
    let mut reasons = Vec::new();
    let mut hold = |holds: bool, otherwise: String| {
        if !holds {
            reasons.push(otherwise);
        }
    };
    hold(
        run.not_finite == 0,
        format!("not finite: {}", count(run.not_finite, "number")),
    );
    let taken_out = run.counters.nan_particles;
    hold(
        taken_out == 0,
        format!("taken out: {}", count(taken_out.into(), "particle")),
    );
    hold(
        run.lost == 0,
        format!("beyond a wall: {}", count(run.lost, "particle")),
    );
    let v_max = recipe.v_max;
    hold(
        run.speed <= v_max * (1.0 + SPEED_ROUNDING),
        format!("{:.4} m/s are more than v_max, {v_max}", run.speed),
    );
    hold(
        run.excess <= ENERGY * run.turnover,
        format!(
            "{:.3e} J more than declared, where {:.3e} J were turned over",
            run.excess, run.turnover
        ),
    );
    for ((what, drift), most) in ["acid", "mass", "enthalpy"]
        .iter()
        .zip(run.drifts)
        .zip(KEPT)
    {
        hold(drift <= most, format!("{what} changed by {drift:.2e}"));
    }
    if recipe.base != Base::Water && run.particles > 0 {
        let [least, most] = run.acids;
        hold(
            least >= -1e-5 && most <= 1.0 + 1e-5,
            format!("acid fractions from {least} to {most}"),
        );
        let coldest = recipe.temperatures[0].min(recipe.temperatures[1]).min(20.0);
        // Rounding of f32 against the highest initial temperature.
        let hottest = recipe.temperatures[0].max(recipe.temperatures[1]);
        hold(
            run.temperatures[0] >= coldest - 0.01 - 1e-4 * hottest.abs(),
            format!("{:.2} °C is colder than all there was", run.temperatures[0]),
        );
    }
    if let Some(limit) = rest_limit(recipe, run) {
        hold(
            run.end_speed <= limit,
            format!(
                "{:.4} m/s a second after its end, where {limit:.4} m/s is rest",
                run.end_speed
            ),
        );
    }
    reasons
}

/// Number of particles below which no mean speed is judged: in tubes less than four of them wide, single ones leap now and then.
const FEW: usize = 50;

/// Greatest rms speed at rest, where the liquid must have come to rest by physics; `None` where it need not.
fn rest_limit(recipe: &Recipe, run: &Run) -> Option<f64> {
    let free = run.boiling > 0 || recipe.upside_down || recipe.gravity == 0.0;
    // Particles that are pushed apart out of one place, or shaken, slosh on.
    let sloshes = recipe.crowd != Crowd::Filled;
    // So does liquid that its own filling throws up, where little weight brings it down.
    let mass = recipe.rest_density * recipe.spacing.powi(3) * run.particles as f64;
    let thrown = run.settling > 0.25 * mass * recipe.gravity * recipe.depth();
    if !run.rested || free || sloshes || thrown || run.members < FEW {
        return None;
    }
    // 2 % of the energy in its depth and its surface.
    let surface = recipe.surface().map_or(0.0, |[tension, _]| {
        tension / (recipe.rest_density * recipe.depth())
    });
    let jitter = 0.15 * (recipe.gravity * recipe.depth() + surface).sqrt();
    match recipe.motion {
        Motion::Still | Motion::NoPose(_) => Some(jitter),
        // Waves in a glass go on, and so does a rotation.
        _ => None,
    }
}

/// Limiters that acted in a run.
fn limiters(run: &Run) -> BTreeMap<Name, u32> {
    let c = &run.counters;
    [
        ("more neighbours than places", c.list_overflows),
        ("correction cut to the list's reach", c.list_limited),
        ("speed cut to v_max", c.speed_limited),
        ("diffusion cut to what there is", c.diffusion_limited),
        (
            "boiling cut to 30 % of a relative velocity",
            c.growth_limited,
        ),
        ("density taken at the end of its table", c.table_ends),
        ("surface tension left out", c.tension_skipped),
        ("bubble without a place", c.bubbles_refused),
        ("drops of a jet or film left out", c.spray_refused),
        ("bubble whose surroundings the driver cut", c.bubbles_cut),
    ]
    .into_iter()
    .filter(|&(_, times)| times > 0)
    .map(|(name, times)| (name.into(), times))
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use vitriol_sim::solver::Counters;

    fn calm() -> Run {
        Run {
            particles: 400,
            steps: 117,
            rested: true,
            not_finite: 0,
            lost: 0,
            speed: 1.0,
            excess: 0.0,
            turnover: 1e-3,
            settling: 0.0,
            end_speed: 0.001,
            members: 400,
            boiling: 0,
            drifts: [0.0; 3],
            temperatures: [20.0, 90.0],
            acids: [0.0, 0.98],
            counters: Counters::default(),
            hash: 0,
        }
    }

    /// Each criterion, by a run that breaks it alone.
    #[test]
    fn every_criterion_tells() {
        let recipe = Recipe::of(Base::Physical);
        assert!(reasons(&recipe, &calm()).is_empty());
        type Breaks = fn(&mut Run);
        let broken: [(&str, Breaks); 9] = [
            ("not finite", |run| run.not_finite = 1),
            ("taken out", |run| run.counters.nan_particles = 1),
            ("beyond a wall", |run| run.lost = 1),
            ("more than v_max", |run| run.speed = 10.01),
            ("more than declared", |run| run.excess = 1e-4),
            ("enthalpy changed", |run| run.drifts = [0.0, 0.0, 2e-4]),
            ("acid fractions", |run| run.acids = [0.0, 1.1]),
            ("colder than", |run| run.temperatures = [-40.0, 90.0]),
            ("is rest", |run| run.end_speed = 0.2),
        ];
        for (word, breaks) in broken {
            let mut run = calm();
            breaks(&mut run);
            let found = reasons(&recipe, &run);
            assert!(
                found.len() == 1 && found[0].contains(word),
                "{word}: {found:?}"
            );
        }
        // Liquid that boils or was shaken need not rest.
        let boiling = Run {
            boiling: 3,
            end_speed: 0.2,
            ..calm()
        };
        assert!(reasons(&recipe, &boiling).is_empty());
    }
}
