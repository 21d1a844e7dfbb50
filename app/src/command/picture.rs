//! `vitriol picture`: one moment of a replay as a PNG file.

use std::path::PathBuf;
use std::sync::Arc;

use serde::Serialize;
use vitriol_run::output::{self, ColorType, OutDir};
use vitriol_run::progress::Runs;
use vitriol_run::{Blame, Colour, Experiment, Failure, Format, Observer, Setup, Span, emit};
use vitriol_shaders::Library;
use vitriol_sim::scene::Feature;
use vitriol_xr::track::TrackSource;

use crate::cli::{CameraName, PictureArgs};
use crate::command::plan::{Ask, ReplayPlan};
use crate::command::recorded::head;

/// What `vitriol picture` prints.
#[derive(Debug, Serialize)]
struct Pictured {
    /// The file.
    picture: PathBuf,
    /// The folder of what each pass leaves behind, where it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    passes: Option<PathBuf>,
    /// Width and height of the file, pixels.
    size: [u32; 2],
    /// Simulated time, s.
    t_s: f64,
}

/// Runs `vitriol picture`; `prepare` makes the experiment.
///
/// # Errors
/// [`Failure::Input`] for bad track, scene, size, a time after the track's end, or where the file exists;
/// [`Failure::NoDevice`]; [`Failure::Other`].
pub fn run(
    args: &PictureArgs,
    format: Format,
    prepare: impl FnOnce(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure>,
) -> Result<(), Failure> {
    let (dir, file) = (args.output.parent(), args.output.file_name());
    let (Some(dir), Some(file)) = (dir, file.and_then(|file| file.to_str())) else {
        return Err(format!("{} is no file name", args.output.display())).input();
    };
    let path = output::new_file(dir, file)?;
    if let Some(dir) = &args.passes {
        if args.colour != Colour::Liquid {
            return Err("--passes: shows how liquid is drawn; leave --colour out").input();
        }
        output::new_dir(dir)?;
    }
    let plan = ReplayPlan::new(&Ask {
        track: &args.track,
        scene: args.scene.as_deref(),
        preset: args.preset,
        device: args.device.as_deref(),
        accept_truncated: args.accept_truncated,
        ..Ask::default()
    })?;
    plan.reaches(args.at, plan.track.duration())?;
    if args.colour.is_of_heat() && !plan.scene.models(Feature::Heat) {
        let colour = args.colour.name();
        let name = &plan.name;
        return Err(format!(
            "--colour {colour}: the scene {name} models no heat"
        ))
        .input();
    }
    let eyes = if args.stereo { 2 } else { 1 };
    let mut experiment = prepare(&Setup {
        picture: Some(args.size),
        eyes,
        colours: vec![args.colour],
        filter: args.filter,
        tint: args.drawn.tint,
        room: args.drawn.room,
        head: head(args.camera, &args.track, &plan.track)?,
        directed: args.camera == CameraName::Director && args.eye.is_none(),
        look: args.look(),
        shaders: Arc::new(Library::watching()),
        ..plan.setup(args.device.as_deref())
    })?;
    let span = Span::covering(args.at, plan.scene.scale.frame_time);
    let mut observer = Observer::new(span, Vec::new(), Runs::new(format).of(&args.track, span));
    vitriol_run::replay(
        &mut TrackSource::new(plan.track),
        experiment.as_mut(),
        span,
        &mut observer,
    )?;
    observer.finish()?;
    let picture = experiment.picture(0)?;
    let size = [eyes * args.size[0], args.size[1]];
    let file = output::png(picture, size, ColorType::Rgba)?;
    output::write_new(&path, &file)?;
    if let Some(dir) = &args.passes {
        let mut dir = OutDir::take(Some(dir), "passes")?;
        for (number, pass) in (1..).zip(experiment.passes()?) {
            let name = format!("{number}-{}.png", pass.name.replace(' ', "-"));
            let file = output::png(&pass.pixels, pass.extent, ColorType::Rgba)?;
            dir.write(&name, &file)?;
        }
        dir.complete();
    }
    let pictured = Pictured {
        picture: path,
        passes: args.passes.clone(),
        size,
        t_s: span.seconds(),
    };
    emit(format, &pictured, |done| {
        format!(
            "{}: {} × {}, at {:.2} s",
            done.picture.display(),
            size[0],
            size[1],
            done.t_s
        )
    })
}
