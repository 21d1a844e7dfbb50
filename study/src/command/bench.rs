//! `vitriol bench`: the time of each pass.

use vitriol_gpu::Timestamps;
use vitriol_run::{Failure, Format, device, emit};

use crate::bench::peer::Peer;
use crate::bench::report::{Benchmark, TABLE_2, describe};
use crate::bench::{features, picture, scaling, solver};
use crate::cli::BenchArgs;

/// Runs `vitriol bench`.
///
/// # Errors
/// [`Failure::NoDevice`]; [`Failure::Input`] for a scene or device that does not exist, or a figure that does; [`Failure::Other`] where a
/// peer fails or standard output cannot be written.
pub fn run(args: &BenchArgs, format: Format) -> Result<(), Failure> {
    let peers: Vec<Peer> = args.against.iter().map(|path| Peer::new(path)).collect();
    let timed = device::timed(args.device.as_deref(), Timestamps::Passes)?;
    let plain = device::open(args.device.as_deref())?;
    let names: Vec<String> = match (&args.scene, args.paper) {
        (_, true) => TABLE_2.iter().map(|(name, _)| (*name).to_owned()).collect(),
        _ if args.scaling.is_some() => Vec::new(),
        (Some(scene), false) => vec![scene.clone()],
        (None, false) if args.render => vec!["triple-dilution".to_owned()],
        (None, false) => vec!["beaker".to_owned()],
    };
    let mut found = Benchmark {
        device: device::statement(&timed),
        frames: args.frames,
        rows: Vec::new(),
        scaling: None,
        features: Vec::new(),
        pictures: Vec::new(),
    };
    if let Some(figure) = &args.scaling {
        let size = (args.most, args.frames);
        found.scaling = Some(scaling::measure(&plain, figure, size, &peers)?);
    }
    for name in &names {
        if args.render {
            found
                .pictures
                .extend(picture::rows(&timed, &plain, name, args)?);
        } else if args.features {
            found
                .features
                .extend(features::costs(&timed, &plain, name, args)?);
        } else {
            found
                .rows
                .push(solver::row(&timed, &plain, name, args, &peers)?);
        }
    }
    emit(format, &found, describe)
}
