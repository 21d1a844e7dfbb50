//! The report on a session at its end, as a document and in words.

use std::path::Path;

use serde::Serialize;
use vitriol_lesson::Mode;
use vitriol_run::units::{count, three_digits};
use vitriol_run::{Blame, DeviceStatement, Failure, device};

use crate::command::keeping::Kept;
use vitriol_live::WatchReport;
use vitriol_run::Spread;
use vitriol_session::foveating::Foveating;
use vitriol_session::session::{FramesWith, GovernorReport, SessionOutcome, WARM_UP};
use vitriol_session::stand_in::{Ready, StandInSpec};
use vitriol_session::tally::{FramesReport, Holdings, WaitsReport};

/// What `vitriol vr` and `vitriol desk` print at the session's end.
#[derive(Serialize)]
pub struct SessionReport {
    /// The headset, or what was in its place.
    headset: String,
    device: DeviceStatement,
    scene: String,
    fluid_particles: u64,
    lost_particles: u64,
    nan_particles: u64,
    /// Frames that count.
    frames: u64,
    /// Display periods without a picture of their own.
    missed_frames: u64,
    /// The session's outcome, whose keys stand beside these.
    #[serde(flatten)]
    pub outcome: SessionOutcome,
    /// Processor time of a frame from begin to end, ms.
    #[serde(skip_serializing_if = "Option::is_none")]
    cpu_ms: Option<Spread>,
    /// Of these, frames with nothing beside them.
    #[serde(skip_serializing_if = "Option::is_none")]
    frames_alone: Option<FramesReport>,
    /// Frames while a bench or a picture was built on another thread.
    #[serde(skip_serializing_if = "Option::is_none")]
    frames_while_building: Option<FramesReport>,
    /// The solver's time on the device in a frame, ms.
    #[serde(skip_serializing_if = "Option::is_none")]
    gpu_solver_ms: Option<Spread>,
    /// The picture's, ms.
    #[serde(skip_serializing_if = "Option::is_none")]
    gpu_picture_ms: Option<Spread>,
    /// From a frame's begin to the end of all its work on the device, ms; of a stand-in.
    #[serde(skip_serializing_if = "Option::is_none")]
    ready_ms: Option<Spread>,
    /// Length of a display period, ms; of a stand-in.
    #[serde(skip_serializing_if = "Option::is_none")]
    period_ms: Option<f64>,
    /// From the eyes' location to the picture's submission, ms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pose_age_ms: Option<Spread>,
    /// From the hand's pose to the flask in the picture, simulation steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    input_to_flask_steps: Option<Spread>,
    /// From the hand's pose to the flask in the picture, displayed frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    input_to_flask_frames: Option<Spread>,
    /// What was kept under a pseudonym.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kept: Option<Kept>,
    /// What pages saw that looked meanwhile.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub watched: Option<WatchReport>,
    /// What the process held after warming up and at the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    holdings: Option<[Holdings; 2]>,
    state_hash: String,
}

/// The report of a session; `stand_in` is what timed its frames, if not a headset.
///
/// # Errors
/// An error of the device.
pub fn report(
    headset: String,
    outcome: SessionOutcome,
    stand_in: Option<(StandInSpec, Vec<Ready>)>,
) -> Result<SessionReport, Failure> {
    let world = &outcome.world;
    let measured = world.measure().other()?;
    let tally = &outcome.tally;
    let counted: Vec<f64> = stand_in.as_ref().map_or_else(Vec::new, |(_, ready)| {
        let counted = ready.iter().filter(|frame| frame.index >= WARM_UP);
        counted
            .map(|frame| 1e3 * frame.after.as_secs_f64())
            .collect()
    });
    let period = stand_in.as_ref().map(|(spec, _)| 1e3 / spec.rate_hz);
    let late = counted.iter().filter(|ready| Some(**ready) > period);
    Ok(SessionReport {
        headset,
        device: device::statement(world.gpu()),
        scene: outcome.bench.plan.scene.clone(),
        fluid_particles: world.solver().count().into(),
        lost_particles: measured.lost_particles,
        nan_particles: measured.nan_particles,
        frames: outcome.frames.saturating_sub(WARM_UP),
        missed_frames: outcome.skipped + late.count() as u64,
        cpu_ms: Spread::of(&tally.cpu_ms),
        frames_alone: tally.alone.report(),
        frames_while_building: tally.building.report(),
        gpu_solver_ms: Spread::of(&tally.solve_ms),
        gpu_picture_ms: Spread::of(&tally.picture_ms),
        ready_ms: Spread::of(&counted),
        period_ms: period,
        pose_age_ms: Spread::of(&tally.pose_age_ms),
        input_to_flask_steps: Spread::of(&tally.delay_steps),
        input_to_flask_frames: Spread::of(&tally.delay_frames),
        kept: None,
        watched: None,
        holdings: match outcome.holdings {
            [Some(before), Some(after)] => Some([before, after]),
            _ => None,
        },
        state_hash: format!("{:016x}", world.snapshot().other()?.solver.hash()),
        outcome,
    })
}

/// What the governor did, a line for each setting.
fn governed(governor: &GovernorReport) -> String {
    if !governor.on {
        let cause = governor.cause.as_deref().unwrap_or("as was asked for");
        return format!("settings fixed: {cause}\n");
    }
    let mut text = format!(
        "settings changed {} to keep pace\n",
        count(governor.changes, "time")
    );
    for FramesWith { setting, frames } in &governor.settings {
        let [substeps, iterations] = setting.solver;
        let picture = 100.0 * setting.resolution;
        let aside = match setting.foveated {
            true => ", fewer pixels aside",
            false => "",
        };
        text += &format!(
            "  solver {substeps} × {iterations}, picture {picture:.0} %{aside}, filter {}: {}\n",
            setting.filter.name(),
            count(*frames, "frame")
        );
    }
    text
}

/// "3 times, 0.12 ms in all, 0.08 ms at most".
fn waited(waits: &WaitsReport) -> String {
    if waits.waits == 0 {
        return "never".into();
    }
    format!(
        "{}, {:.3} ms in all, {:.3} ms at most",
        count(waits.waits, "time"),
        waits.total_ms,
        waits.longest_ms
    )
}

/// It in words, as the terminal shows it.
pub fn describe(session: &SessionReport) -> String {
    let outcome = &session.outcome;
    let mut text = format!(
        "{}\n{}, {}; {}, {} s simulated, {} s of slow motion; lost {}, not finite {}\n\
         {} shown, {} a new picture came too late\n",
        session.headset,
        session.scene,
        count(session.fluid_particles, "particle"),
        count(outcome.steps, "step"),
        three_digits(outcome.simulated),
        three_digits(outcome.slowed),
        session.lost_particles,
        session.nan_particles,
        count(session.frames, "picture"),
        count(session.missed_frames, "time"),
    );
    text += &governed(&outcome.governor);
    if let Some([width, height]) = outcome.inset {
        text += &format!("the runtime's quad views, with insets of {width} × {height} pixels\n");
    }
    text += match outcome.foveating.filter(|_| outcome.inset.is_none()) {
        Some(Foveating::Off) => "every pixel shaded\n",
        Some(Foveating::Eye) => {
            "every pixel shaded about where the user looks, if known, fewer beyond\n"
        }
        Some(Foveating::Fixed) => "every pixel shaded about the lenses' axes, fewer beyond\n",
        // The settings show it.
        None => "",
    };
    let rows = [
        ("processor, a frame, ms", session.cpu_ms),
        (
            "  while one builds, ms",
            session.frames_while_building.map(|frames| frames.cpu_ms),
        ),
        ("device, solver, ms", session.gpu_solver_ms),
        ("device, picture, ms", session.gpu_picture_ms),
        ("from begin to done, ms", session.ready_ms),
        ("age of the eyes' pose, ms", session.pose_age_ms),
        ("hand to flask, steps", session.input_to_flask_steps),
        ("hand to flask, frames", session.input_to_flask_frames),
        (
            "from a page's order to done, ms",
            session.watched.as_ref().and_then(|it| it.switch_ms),
        ),
    ];
    text += "                                median      95 %      99 %    99.9 %      most\n";
    for (name, spread) in rows {
        if let Some(it) = spread {
            text += &format!(
                "{name:<28} {:>9.3} {:>9.3} {:>9.3} {:>9.3} {:>9.3}\n",
                it.p50, it.p95, it.p99, it.p999, it.max
            );
        }
    }
    for (kind, frames) in [
        ("alone", session.frames_alone),
        ("while one builds", session.frames_while_building),
    ] {
        if let Some(it) = frames {
            text += &format!(
                "{} {kind}: waited for the queue {}, for memory {}\n",
                count(it.frames, "frame"),
                waited(&it.queue_lock),
                waited(&it.memory_lock)
            );
        }
    }
    if let (Some(period), Some(ready)) = (session.period_ms, session.ready_ms) {
        text += &format!(
            "left of {period:.2} ms: {:.2} ms in the 99th percentile\n",
            period - ready.p99
        );
    }
    let sound = &outcome.sound;
    text += &match (&sound.buffered_ms, &sound.cause) {
        (Some(held), None) => format!(
            "sound: {held:.1} ms buffered, ran dry {}\n",
            count(sound.underflows, "time")
        ),
        (_, Some(cause)) => format!("no sound: {cause}\n"),
        (None, None) => String::new(),
    };
    if let Some([before, after]) = session.holdings {
        text += &format!(
            "memory {} to {} MB, {} to {} handles\n",
            before.memory / 1_000_000,
            after.memory / 1_000_000,
            before.handles,
            after.handles
        );
    }
    if let Some(recording) = &outcome.recorded {
        let steps = count(recording.steps, "step");
        let cause = recording.cause.as_ref();
        let cause = cause.map_or_else(String::new, |cause| format!(": {cause}"));
        text += &match recording.unwritten {
            0 => format!("recorded whole, {steps}{cause}\n"),
            lost => format!("recorded {steps}; {lost} could not be written{cause}\n"),
        };
    }
    if let Some(verdict) = &outcome.verdict {
        text += &format!(
            "lesson {}: {} of {}\n",
            verdict.lesson,
            verdict.points,
            count(verdict.of.into(), "point")
        );
    }
    text += &format!("state {}", session.state_hash);
    text
}

/// What can be done next with the recording `file` of a session with that lesson in that mode, or in a scene of the user's own: a command
/// in each line.
pub fn next(
    file: &Path,
    (lesson, mode): (Option<&str>, Option<Mode>),
    own_scene: Option<&str>,
) -> String {
    let quoted = |text: &str| match text.contains(char::is_whitespace) {
        true => format!("\"{text}\""),
        false => text.to_owned(),
    };
    let file = quoted(&file.display().to_string());
    let lesson = lesson.map_or_else(String::new, |it| format!(" --lesson {}", quoted(it)));
    let mode = mode.map_or_else(String::new, |it| format!(" --mode {it}"));
    let own = own_scene.map_or_else(String::new, |it| format!(" --scene {}", quoted(it)));
    format!(
        "\nnext: vitriol replay {file}{lesson}{mode}\n      vitriol grade {file}{lesson}{mode}{own} --out grades"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_next_can_be_typed() {
        let lesson = (Some("dilute"), Some(Mode::Free));
        let text = next(Path::new("ada.mcap"), lesson, None);
        let lines: Vec<&str> = text.trim_start().lines().collect();
        assert_eq!(
            lines,
            [
                "next: vitriol replay ada.mcap --lesson dilute --mode free",
                "      vitriol grade ada.mcap --lesson dilute --mode free --out grades"
            ]
        );
        let text = next(Path::new("of ada.mcap"), (None, None), Some("my.toml"));
        assert!(text.contains("vitriol replay \"of ada.mcap\"\n"), "{text}");
        assert!(
            text.contains("\"of ada.mcap\" --scene my.toml --out"),
            "{text}"
        );
    }
}
