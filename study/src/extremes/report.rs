//! The report of `vitriol extremes` over all cases.

use std::collections::BTreeMap;
use std::fmt::Write;
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

/// Summarises findings.
pub fn summary(device: DeviceStatement, seed: u64, found: &[Finding], seconds: f64) -> Extremes {
    let mut all = Extremes {
        device,
        seed,
        first: found.first().map_or(0, |finding| finding.case),
        cases: found.len(),
        seconds,
        ..Extremes::default()
    };
    for finding in found {
        for name in &finding.kinds {
            let kind = all.kinds.entry(name.to_string()).or_default();
            kind.cases += 1;
            match &finding.verdict {
                Verdict::Passed => {
                    kind.passed += 1;
                    kind.limited += usize::from(!finding.limiters.is_empty());
                }
                Verdict::Refused { .. } => kind.refused += 1,
                Verdict::Failed { .. } => kind.failed += 1,
            }
        }
        match &finding.verdict {
            Verdict::Passed => all.passed += 1,
            Verdict::Refused { message } => {
                all.refused += 1;
                *all.refusals.entry(field(message)).or_default() += 1;
            }
            Verdict::Failed { .. } => {
                all.failed += 1;
                all.failures.push(finding.clone());
            }
        }
        for (name, &times) in &finding.limiters {
            let acted = all.limiters.entry(name.to_string()).or_default();
            acted.cases += 1;
            acted.times += u64::from(times);
        }
        let worst = &mut all.worst;
        worst.speed_over_max = worst.speed_over_max.max(finding.speed_over_max);
        worst.energy_excess = worst.energy_excess.max(finding.energy_excess);
        worst.settling = worst.settling.max(finding.settling);
        for (worst, drift) in worst.drifts.iter_mut().zip(finding.drifts) {
            *worst = worst.max(drift);
        }
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
        all.cases += part.cases;
        all.passed += part.passed;
        all.refused += part.refused;
        all.failed += part.failed;
        all.seconds += part.seconds;
        all.failures.extend(part.failures);
        for (name, acted) in part.limiters {
            let sum = all.limiters.entry(name).or_default();
            sum.cases += acted.cases;
            sum.times += acted.times;
        }
        for (name, kind) in part.kinds {
            let sum = all.kinds.entry(name).or_default();
            sum.cases += kind.cases;
            sum.passed += kind.passed;
            sum.refused += kind.refused;
            sum.failed += kind.failed;
            sum.limited += kind.limited;
        }
        for (field, cases) in part.refusals {
            *all.refusals.entry(field).or_default() += cases;
        }
        let worst = &mut all.worst;
        worst.speed_over_max = worst.speed_over_max.max(part.worst.speed_over_max);
        worst.energy_excess = worst.energy_excess.max(part.worst.energy_excess);
        worst.settling = worst.settling.max(part.worst.settling);
        for (worst, drift) in worst.drifts.iter_mut().zip(part.worst.drifts) {
            *worst = worst.max(drift);
        }
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
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{name:<28} {:>6} {:>7} {:>8} {:>8} {:>7}",
            kind.cases, kind.passed, kind.limited, kind.refused, kind.failed
        );
    }
    let _ = writeln!(text, "\n{:<44} {:>6} {:>12}", "limiter", "cases", "times");
    for (name, acted) in &all.limiters {
        let _ = writeln!(text, "{name:<44} {:>6} {:>12}", acted.cases, acted.times);
    }
    let _ = writeln!(text, "\n{:<44} {:>6}", "refused at load", "cases");
    for (name, cases) in &all.refusals {
        let _ = writeln!(text, "{name:<44} {cases:>6}");
    }
    let _ = writeln!(
        text,
        "\nworst: speed {:.6} of v_max, energy {:.4} of what was turned over, acid {:.1e}, mass \
         {:.1e}, enthalpy {:.1e}",
        all.worst.speed_over_max,
        all.worst.energy_excess,
        all.worst.drifts[0],
        all.worst.drifts[1],
        all.worst.drifts[2]
    );
    for finding in &all.failures {
        if let Verdict::Failed { reasons } = &finding.verdict {
            let _ = writeln!(
                text,
                "\nFAILED {} (--seed {} --only {}): {}",
                finding.label,
                all.seed,
                finding.case,
                reasons.join("; ")
            );
        }
    }
    text
}
