//! `vitriol extremes`: many cases, each with something extreme.

use std::time::Instant;

use vitriol_run::units::count;
use vitriol_run::{Blame, Failure, Format, device, emit, output};
use vitriol_shaders::Library;

use crate::cli::ExtremesArgs;
use crate::extremes::{Extremes, Finding, Verdict, cases, describe, judge, merge, summary};
use crate::merge::read;
use vitriol_run::several::at_a_time;

/// The numbers' name in the folder.
const NUMBERS: &str = "extremes.json";

/// Runs `vitriol extremes`.
///
/// # Errors
/// [`Failure::NoDevice`]; [`Failure::Input`] where the file exists already or there is no such case, or parts do not belong together;
/// [`Failure::Other`] where device or folder fails, or a case fails.
pub fn run(args: &ExtremesArgs, format: Format) -> Result<(), Failure> {
    let file = output::new_files(args.out.as_deref(), [NUMBERS])?;
    if !args.merge.is_empty() {
        let all = merge(read(&args.merge)?).input()?;
        if let Some([path]) = file {
            output::write_json(&path, &all)?;
        }
        emit(format, &all, describe)?;
        return whether_all_passed(&all);
    }
    let wanted = match args.only {
        Some(only) => cases(only + 1, args.seed).split_off(only),
        None => cases(args.cases.end, args.seed).split_off(args.cases.start),
    };
    let gpu = device::open(args.device.as_deref())?;
    let begin = Instant::now();
    let library = Library::embedded();
    // Several at a time: most of the time of a small case is the host's work.
    let found = at_a_time(args.jobs as usize, &wanted, |case| {
        let finding = judge(&gpu, &library, case);
        tracing::info!("{} {}", case.number, case.label());
        finding
    })?;
    let seconds = begin.elapsed().as_secs_f64();
    if let (Some(folder), Some([case])) =
        (&args.out, wanted.get(..1).filter(|_| args.only.is_some()))
    {
        let name = format!("case-{}.toml", case.number);
        output::write_new(&folder.join(name), case.recipe.text().as_bytes())?;
    }
    let all = summary(device::statement(&gpu), args.seed, &found, seconds);
    if let Some([path]) = file {
        output::write_json(&path, &all)?;
    }
    match (args.only, &found[..]) {
        (Some(_), [finding]) => emit(format, finding, describe_one)?,
        _ => emit(format, &all, describe)?,
    }
    whether_all_passed(&all)
}

fn whether_all_passed(all: &Extremes) -> Result<(), Failure> {
    if all.failed > 0 {
        return Err(format!(
            "{} of {} failed",
            all.failed,
            count(all.cases as u64, "case")
        ))
        .other();
    }
    Ok(())
}

fn describe_one(finding: &Finding) -> String {
    let verdict = match &finding.verdict {
        Verdict::Passed => "passed".to_owned(),
        Verdict::Refused { message } => format!("refused at load: {message}"),
        Verdict::Failed { reasons } => format!("FAILED: {}", reasons.join("; ")),
    };
    let limiters: Vec<String> = finding
        .limiters
        .iter()
        .map(|(name, times)| format!("{name}: {times}"))
        .collect();
    format!(
        "case {}: {}\n{verdict}\n{}, {}; speed {:.4} of v_max, energy {:.4} of \
         what was turned over, {:.4} m/s at the end\nacid {:.1e}, mass {:.1e}, enthalpy {:.1e}\n\
         limiters: {}",
        finding.case,
        finding.label,
        count(finding.particles as u64, "particle"),
        count(finding.steps, "step"),
        finding.speed_over_max,
        finding.energy_excess,
        finding.end_speed,
        finding.drifts[0],
        finding.drifts[1],
        finding.drifts[2],
        if limiters.is_empty() {
            "none acted".into()
        } else {
            limiters.join(", ")
        }
    )
}
