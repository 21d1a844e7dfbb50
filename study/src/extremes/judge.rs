//! Whether a case passed.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use vitriol_experiment::{Blame, Failure};
use vitriol_gpu::Gpu;
use vitriol_shaders::Library;
use vitriol_sim::scene::Scene;

use super::case::Case;
use super::drive::{ENERGY, Run, drive};
use super::motion::Motion;
use super::recipe::{Base, Crowd, Recipe};
use crate::merge::{Name, number, numbers};

/// What a case came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The case's number.
    pub case: usize,
    /// What was extreme in it.
    pub label: String,
    /// Kinds of what was extreme.
    pub kinds: Vec<Name>,
    /// How it ended.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// Limiters that acted, with how often.
    pub limiters: BTreeMap<Name, u32>,
    /// Particles.
    pub particles: usize,
    /// Steps.
    pub steps: u64,
    /// Largest speed over v_max.
    #[serde(deserialize_with = "number")]
    pub speed_over_max: f64,
    /// Energy beyond what was there or declared, over what was turned over.
    #[serde(deserialize_with = "number")]
    pub energy_excess: f64,
    /// Energy that the filling set free as it settled, likewise.
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

/// How a case ended.
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
    /// Some criterion does not hold.
    Failed {
        /// Which, each with its figures.
        reasons: Vec<String>,
    },
}

/// Runs a case and judges it.
///
/// # Errors
/// What the device says; a case that fails is none.
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

/// v_max may be passed by rounding.
const SPEED_ROUNDING: f64 = 1e-5;
/// Relative changes of acid, mass and enthalpy that rounding of f32 explains.
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
        format!("{} numbers are not finite", run.not_finite),
    );
    let taken_out = run.counters.nan_particles;
    hold(
        taken_out == 0,
        format!("{taken_out} particles were taken out"),
    );
    hold(
        run.lost == 0,
        format!("{} particles are beyond a wall", run.lost),
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
        // Rounding of f32 beside the hottest there was.
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

/// Particles of which no mean speed is told: in tubes less than four of them wide,
/// single ones leap now and then.
const FEW: usize = 50;

/// The rms speed that counts as rest where physics says that the liquid has come
/// to rest; `None` where it says no such thing.
fn rest_limit(recipe: &Recipe, run: &Run) -> Option<f64> {
    let free = run.boiling > 0 || recipe.upside_down || recipe.gravity == 0.0;
    // What is pushed apart out of one place, or shaken, sloshes on.
    let sloshes = recipe.crowd != Crowd::Filled;
    // So is what its own filling throws up, where little weight brings it down.
    let mass = recipe.rest_density * recipe.spacing.powi(3) * run.particles as f64;
    let thrown = run.settling > 0.25 * mass * recipe.gravity * recipe.depth();
    if !run.rested || free || sloshes || thrown || run.members < FEW {
        return None;
    }
    // In energy 2 % of what its depth and its surface hold.
    let surface = recipe.surface().map_or(0.0, |[tension, _]| {
        tension / (recipe.rest_density * recipe.depth())
    });
    let jitter = 0.15 * (recipe.gravity * recipe.depth() + surface).sqrt();
    match recipe.motion {
        Motion::Still | Motion::NoPose(_) => Some(jitter),
        // Waves in a glass ring on, and what turns turns on.
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
        ("gas cut to what a neighbourhood holds", c.gas_limited),
        ("drops of a jet or film left out", c.spray_refused),
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

    /// Each criterion by a run that breaks it alone.
    #[test]
    fn every_criterion_tells() {
        let recipe = Recipe::of(Base::Physical);
        assert!(reasons(&recipe, &calm()).is_empty());
        let taken_out = Counters {
            nan_particles: 1,
            ..Counters::default()
        };
        let broken: [(&str, Run); 9] = [
            (
                "not finite",
                Run {
                    not_finite: 1,
                    ..calm()
                },
            ),
            (
                "taken out",
                Run {
                    counters: taken_out,
                    ..calm()
                },
            ),
            ("beyond a wall", Run { lost: 1, ..calm() }),
            (
                "more than v_max",
                Run {
                    speed: 10.01,
                    ..calm()
                },
            ),
            (
                "more than declared",
                Run {
                    excess: 1e-4,
                    ..calm()
                },
            ),
            (
                "enthalpy changed",
                Run {
                    drifts: [0.0, 0.0, 2e-4],
                    ..calm()
                },
            ),
            (
                "acid fractions",
                Run {
                    acids: [0.0, 1.1],
                    ..calm()
                },
            ),
            (
                "colder than",
                Run {
                    temperatures: [-40.0, 90.0],
                    ..calm()
                },
            ),
            (
                "is rest",
                Run {
                    end_speed: 0.2,
                    ..calm()
                },
            ),
        ];
        for (word, run) in broken {
            let found = reasons(&recipe, &run);
            assert!(
                found.len() == 1 && found[0].contains(word),
                "{word}: {found:?}"
            );
        }
        // What boils or was shaken need not rest.
        let boiling = Run {
            boiling: 3,
            end_speed: 0.2,
            ..calm()
        };
        assert!(reasons(&recipe, &boiling).is_empty());
    }
}
