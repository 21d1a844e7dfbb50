//! A run's report, made of the run's outcome.

use std::collections::BTreeMap;

use vitriol_lesson::{Attempt, Boiling, Language, layered};
use vitriol_run::{
    Action, Colour, FILM_FPS, FILM_SIZE, Failure, Observations, Outcome, Sample, boiling,
};
use vitriol_sim::scene::{Feature, Preset, Scene};

use super::film_name;
use crate::cli::{CameraName, ReplayArgs};
use crate::report::{
    AskedStatement, FilmStatement, InstructorStatement, LAYOUT, Report, SceneStatement,
    SolverStatement,
};
use vitriol_run::output::POSTERS;
use vitriol_run::texts::Texts;

/// The report, without its part on the recording and without its score.
///
/// # Errors
/// [`Failure::Other`] where a text is missing, which a test rules out.
pub(super) fn assemble(
    (args, track, chosen): (&ReplayArgs, &str, Option<[u32; 2]>),
    colours: &[Colour],
    preset: Preset,
    seed: u64,
    (name, scene): (&str, &Scene),
    outcome: Outcome,
    observations: Observations,
) -> Result<Report, Failure> {
    let samples = &observations.samples;
    // The filling is not the solver's work, so the start does not count.
    let solved = || samples.iter().skip(1);
    let count = solved().count().max(1) as f64;
    let [width, height] = FILM_SIZE;
    let film = |index: usize| {
        colours.get(index).map(|colour| FilmStatement {
            path: film_name(index).into(),
            width,
            height,
            fps: FILM_FPS,
            frames: observations.film_frames,
            colour: colour.name().into(),
            cuts: observations.cuts.clone(),
            poster: POSTERS.get(index).map(|name| (*name).into()),
        })
    };
    let attempts = Attempt::all(outcome.events);
    let contact = contact(samples, scene, &attempts);
    Ok(Report {
        layout: LAYOUT,
        program: concat!("vitriol ", env!("CARGO_PKG_VERSION")).into(),
        command: command_line((args, track), preset, seed, chosen),
        track: track.to_owned(),
        asked: Some(AskedStatement {
            scene: args.scene.clone(),
            solver: chosen,
            seconds: args.seconds,
            breakable: args.breakable,
            accept_truncated: args.accept_truncated,
        }),
        preset: preset.name().into(),
        seed,
        fluid_particles: outcome.fluid_particles,
        lost_particles: outcome.lost_particles,
        nan_particles: outcome.nan_particles,
        density_error_mean: solved().map(|s| s.density_error_mean).sum::<f64>() / count,
        density_error_p99: solved().map(|s| s.density_error_p99).fold(0.0, f64::max),
        frames: observations.time.steps(),
        simulated_s: observations.time.seconds(),
        wall_s: observations.wall.as_secs_f64(),
        state_hash: format!("{:016x}", outcome.state_hash),
        mass_kg: samples
            .last()
            .map(|s| s.mass_kg.clone())
            .unwrap_or_default(),
        boiling_particle_seconds: boiling_particles(samples),
        boiling: Boiling {
            nuclei_spacing_m: nuclei(scene, seed),
            ..boiling(samples, scene.models(Feature::Bubbles), contact)
        },
        film: film(0),
        film_temperature: film(1),
        device: outcome.device,
        scene: SceneStatement::of(name, scene),
        solver: SolverStatement::of(scene),
        counters: outcome.counters,
        recording: None,
        lesson: Vec::new(),
        scenes_before: observations.scenes_before,
        attempts,
        instructor: said(&outcome.instructions, args.language)?,
        score: Vec::new(),
        series: observations.samples,
    })
}

/// What an instructor did, in sentences.
fn said(
    instructions: &[(f64, Action)],
    language: Language,
) -> Result<Vec<InstructorStatement>, Failure> {
    let words = Texts::of(language)?.instructor;
    let of = |(t_s, instruction): &(f64, Action)| InstructorStatement {
        t_s: *t_s,
        text: words.instruction(instruction),
    };
    Ok(instructions.iter().map(of).collect())
}

/// When acid and water first came together in the scene of the samples, which is that of the last attempt, s, and in which flask.
pub(super) fn contact<'a>(
    samples: &[Sample],
    scene: &'a Scene,
    attempts: &'a [Attempt],
) -> Option<(f64, &'a str)> {
    let start = samples.first()?.t_s;
    let at_start = layered(scene).map(|flask| (start, flask));
    at_start.or_else(|| attempts.last()?.first_contact())
}

/// Nuclei of a run's liquid, where bubbles are modelled.
fn nuclei(scene: &Scene, seed: u64) -> Option<f64> {
    let drawn = scene.with_nuclei(seed);
    let physical = drawn.physical.filter(|_| drawn.models(Feature::Bubbles))?;
    physical.nuclei_spacing
}

/// Particles above their boiling point times the time since the sample before,
/// by flask.
fn boiling_particles(samples: &[Sample]) -> BTreeMap<String, f64> {
    let mut sums = BTreeMap::new();
    for pair in samples.windows(2) {
        let flasks = pair[1].heat.iter().flat_map(|heat| &heat.boiling_in_flasks);
        for (flask, &count) in flasks {
            *sums.entry(flask.clone()).or_insert(0.0) += count as f64 * (pair[1].t_s - pair[0].t_s);
        }
    }
    sums
}

/// The command line that makes the run again; without `--out`, since that
/// folder is taken now.
fn command_line(
    (args, track): (&ReplayArgs, &str),
    preset: Preset,
    seed: u64,
    solver: Option<[u32; 2]>,
) -> String {
    let camera = match args.camera {
        CameraName::Director => None,
        CameraName::Fixed => Some("fixed".to_owned()),
        CameraName::Head => Some("head".to_owned()),
    };
    let language = args.language;
    let language = (language != Language::default()).then(|| language.code().to_owned());
    let options = [
        ("scene", args.scene.as_deref().map(quoted)),
        ("preset", Some(preset.name().to_owned())),
        ("seed", Some(seed.to_string())),
        ("solver", solver.map(|[a, b]| format!("{a}x{b}"))),
        ("seconds", args.seconds.map(|seconds| seconds.to_string())),
        ("device", args.device.as_deref().map(quoted)),
        ("camera", camera),
        ("colour", args.colour.map(|it| it.name().to_owned())),
        ("filter", args.filter.map(|it| it.name().to_owned())),
        ("tint", args.drawn.tint.map(|it| it.name().to_owned())),
        ("room", args.drawn.room.map(|it| it.name().to_owned())),
        ("language", language),
        ("lesson", args.judge.lesson.as_deref().map(quoted)),
        ("mode", args.judge.mode.map(|it| it.name().to_owned())),
    ];
    let truncated = if args.accept_truncated {
        " --accept-truncated"
    } else {
        ""
    };
    let mut line = format!("vitriol replay {}", quoted(track));
    for (name, value) in options {
        line.extend(value.map(|value| format!(" --{name} {value}")));
    }
    line += truncated;
    if args.breakable {
        line += " --breakable";
    }
    if args.no_video {
        line += " --no-video";
    }
    line
}

/// An argument as a POSIX shell takes it.
fn quoted(argument: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=+,@%".contains(c);
    if !argument.is_empty() && argument.chars().all(plain) {
        argument.to_owned()
    } else {
        format!("'{}'", argument.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_survive_a_shell() {
        assert_eq!(quoted("two-flasks"), "two-flasks");
        assert_eq!(quoted("my tracks/a'b"), r"'my tracks/a'\''b'");
        assert_eq!(quoted(""), "''");
    }
}
