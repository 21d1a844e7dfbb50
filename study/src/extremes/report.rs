//! The report of `vitriol extremes` over all cases.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use vitriol_run::DeviceStatement;
use vitriol_run::units::count;

use super::judge::{Finding, Verdict};
use crate::merge::{MergeError, alike, devices, in_order, largest, numbers};

/// Results of `vitriol extremes`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Extremes {
    /// The device.
    pub device: DeviceStatement,
    /// The seed of the random cases.
    pub seed: u64,
    /// Number of the first case.
    pub first: usize,
    /// Cases.
    pub cases: usize,
    /// Of these, those in which all criteria hold.
    pub passed: usize,
    /// Those that were refused at load.
    pub refused: usize,
    /// Those in which at least one criterion does not hold.
    pub failed: usize,
    /// By limiter: in how many cases it acted, and how often.
    pub limiters: BTreeMap<String, Acted>,
    /// Results by kind of extreme.
    pub kinds: BTreeMap<String, Kind>,
    /// Number of refused cases, by the beginning of the message.
    pub refusals: BTreeMap<String, usize>,
    /// Worst figures of the cases that ran.
    pub worst: Worst,
    /// Every case that failed; `--only` repeats it.
    pub failures: Vec<Finding>,
    /// Wall time, s.
    pub seconds: f64,
}

/// How often a limiter acted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Acted {
    /// Cases in which it acted.
    pub cases: usize,
    /// Number of times over all of these cases.
    pub times: u64,
}

/// Cases with one kind of extreme, alone or in a pair.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Kind {
    /// All of them.
    pub cases: usize,
    /// Passed.
    pub passed: usize,
    /// Refused at load.
    pub refused: usize,
    /// Failed.
    pub failed: usize,
    /// Passed, and some limiter acted.
    pub limited: usize,
}

/// Worst figures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    /// Speed over v_max.
    #[serde(deserialize_with = "largest")]
    pub speed_over_max: f64,
    /// Energy beyond the declared one, over the turnover.
    #[serde(deserialize_with = "largest")]
    pub energy_excess: f64,
    /// Energy that a filling set free as it settled, over the turnover.
    #[serde(deserialize_with = "largest")]
    pub settling: f64,
    /// Relative changes of acid, mass, enthalpy.
    #[serde(deserialize_with = "numbers")]
    pub drifts: [f64; 3],
}

impl Extremes {
    /// The report of one case.
    fn of(finding: &Finding) -> Self {
        let mut one = Self {
            cases: 1,
            worst: Worst {
                speed_over_max: finding.speed_over_max,
                energy_excess: finding.energy_excess,
                settling: finding.settling,
                drifts: finding.drifts,
            },
            ..Self::default()
        };
        let mut limited = 0;
        match &finding.verdict {
            Verdict::Passed => {
                one.passed = 1;
                limited = usize::from(!finding.limiters.is_empty());
            }
            Verdict::Refused { message } => {
                one.refused = 1;
                one.refusals.insert(field(message), 1);
            }
            Verdict::Failed { .. } => {
                one.failed = 1;
                one.failures.push(finding.clone());
            }
        }
        let kind = Kind {
            cases: 1,
            passed: one.passed,
            refused: one.refused,
            failed: one.failed,
            limited,
        };
        one.kinds = (finding.kinds.iter())
            .map(|name| (name.to_string(), kind))
            .collect();
        let limiters = finding.limiters.iter().map(|(name, &times)| {
            let times = times.into();
            (name.to_string(), Acted { cases: 1, times })
        });
        one.limiters = limiters.collect();
        one
    }

    /// Adds the cases of another report.
    fn add(&mut self, part: Self) {
        self.cases += part.cases;
        self.passed += part.passed;
        self.refused += part.refused;
        self.failed += part.failed;
        self.seconds += part.seconds;
        self.failures.extend(part.failures);
        for (name, acted) in part.limiters {
            let sum = self.limiters.entry(name).or_default();
            sum.cases += acted.cases;
            sum.times += acted.times;
        }
        for (name, kind) in part.kinds {
            let sum = self.kinds.entry(name).or_default();
            sum.cases += kind.cases;
            sum.passed += kind.passed;
            sum.refused += kind.refused;
            sum.failed += kind.failed;
            sum.limited += kind.limited;
        }
        for (field, cases) in part.refusals {
            *self.refusals.entry(field).or_default() += cases;
        }
        let worst = &mut self.worst;
        worst.speed_over_max = worst.speed_over_max.max(part.worst.speed_over_max);
        worst.energy_excess = worst.energy_excess.max(part.worst.energy_excess);
        worst.settling = worst.settling.max(part.worst.settling);
        for (worst, drift) in worst.drifts.iter_mut().zip(part.worst.drifts) {
            *worst = worst.max(drift);
        }
    }
}

/// Summarises findings.
pub fn summary(device: DeviceStatement, seed: u64, found: &[Finding], seconds: f64) -> Extremes {
    let mut all = Extremes {
        device,
        seed,
        first: found.first().map_or(0, |finding| finding.case),
        seconds,
        ..Extremes::default()
    };
    for finding in found {
        all.add(Extremes::of(finding));
    }
    all
}

/// Merges the reports of parts.
///
/// # Errors
/// [`MergeError`] where they are of several seeds, or cases are missing or in two of them.
pub fn merge(mut parts: Vec<(PathBuf, Extremes)>) -> Result<Extremes, MergeError> {
    alike(&parts, "seed", |part| part.seed.to_string())?;
    let range = |part: &Extremes| part.first..part.first + part.cases;
    in_order(&mut parts, range, None..None)?;
    let mut parts = parts.into_iter().map(|(_, part)| part).collect::<Vec<_>>();
    // A part without cases has no first one either.
    parts.sort_by_key(|part| part.cases == 0);
    let mut all = Extremes {
        device: devices(parts.iter().map(|part| &part.device)),
        seed: parts.first().map_or(0, |part| part.seed),
        first: parts.first().map_or(0, |part| part.first),
        ..Extremes::default()
    };
    for part in parts {
        all.add(part);
    }
    Ok(all)
}

/// The field that a scene's message names.
fn field(message: &str) -> String {
    let parts: Vec<&str> = message.splitn(3, ": ").collect();
    parts.get(1).copied().unwrap_or(message).to_owned()
}

/// The table as text for people.
pub fn describe(all: &Extremes) -> String {
    let mut text = format!(
        "{}, {}\n{} of seed {}: {} passed, {} refused at load, {} failed, in {:.0} s\n\n\
         extreme                       cases  passed  limited  refused  failed\n",
        all.device.name,
        all.device.driver,
        count(all.cases as u64, "case"),
        all.seed,
        all.passed,
        all.refused,
        all.failed,
        all.seconds
    );
    for (name, kind) in &all.kinds {
        text += &format!(
            "{name:<28} {:>6} {:>7} {:>8} {:>8} {:>7}\n",
            kind.cases, kind.passed, kind.limited, kind.refused, kind.failed
        );
    }
    text += &format!("\n{:<44} {:>6} {:>12}\n", "limiter", "cases", "times");
    for (name, acted) in &all.limiters {
        text += &format!("{name:<44} {:>6} {:>12}\n", acted.cases, acted.times);
    }
    text += &format!("\n{:<44} {:>6}\n", "refused at load", "cases");
    for (name, cases) in &all.refusals {
        text += &format!("{name:<44} {cases:>6}\n");
    }
    text += &format!(
        "\nworst: speed {:.6} of v_max, energy {:.4} of what was turned over, acid {:.1e}, mass \
         {:.1e}, enthalpy {:.1e}\n",
        all.worst.speed_over_max,
        all.worst.energy_excess,
        all.worst.drifts[0],
        all.worst.drifts[1],
        all.worst.drifts[2]
    );
    for finding in &all.failures {
        if let Verdict::Failed { reasons } = &finding.verdict {
            text += &format!(
                "\nFAILED {} (--seed {} --only {}): {}\n",
                finding.label,
                all.seed,
                finding.case,
                reasons.join("; ")
            );
        }
    }
    text
}
