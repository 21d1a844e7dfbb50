//! `vitriol vr`: in the headset, or on its stand-in.

#[cfg(feature = "vr")]
mod headset;

use std::sync::mpsc::{Sender, channel};

use vitriol_gpu::{Gpu, PlainLoader};
use vitriol_run::{Blame, Failure, Format, device, track};
use vitriol_sound::Device;
use vitriol_xr::Headset;

use crate::cli::VrArgs;
use crate::command::recorded::whole;
use crate::command::session::{self, Prepared, report};
use vitriol_live::Watchers;
use vitriol_session::decision::Decision;
use vitriol_session::mirror::Window;
use vitriol_session::session::{Options, Session};
use vitriol_session::stand_in::{StandIn, StandInSpec, Timing};

/// Runs `vitriol vr`.
///
/// # Errors
/// [`Failure::NoDevice`] without runtime or device; [`Failure::Input`] for a scene or track that is
/// not there or a recording that is; [`Failure::Other`].
pub fn run(args: &VrArgs, format: Format) -> Result<(), Failure> {
    #[cfg(not(feature = "vr"))]
    if args.stand_in.is_none() {
        return no_headset();
    }
    let mut options = Options {
        posture: args.posture,
        foveating: args.foveation,
        ..session::options(&args.session)?
    };
    // Nobody hears a stand-in unless an output is named.
    if args.stand_in.is_some() && args.session.sound.is_none() {
        options.sound = Device::Silent;
    }
    let timestamps = session::timestamps(&options);
    // Before the console's address is printed: without a runtime there is nothing to direct.
    #[cfg(feature = "vr")]
    if args.stand_in.is_none() {
        headset::check()?;
    }
    // Likewise track and device of a stand-in.
    let stand_in = args.stand_in.as_ref().map(|wearer| {
        let track = whole(wearer, track::load(wearer)?, true, args.session.language)?;
        let gpu = device::timed(args.device.as_deref(), timestamps)?;
        Ok::<_, Failure>((track, gpu))
    });
    let stand_in = stand_in.transpose()?;
    // Before the headset is waited for, so that who directs the session may come in meanwhile.
    let prepared = Prepared::new(&args.session, format, options)?;
    let watchers = match (prepared.serving(), args.watchers) {
        (Some(serving), Some(count)) => Some(serving.watched(count)?),
        _ => None,
    };
    let worn = |headset: &mut dyn Headset| -> Result<_, Failure> {
        let options = prepared.solved(headset.gpu())?;
        let (decisions, taken) = channel();
        prepared.take_keys(decisions.clone())?;
        let mut session = Session::new(headset, options, taken)?;
        if !args.no_mirror {
            session = mirrored(session, headset, decisions)?;
        }
        if args.stand_in.is_some() && format == Format::Text {
            eprintln!("the stand-in runs; Ctrl-C ends it");
        }
        let outcome = session.run(headset)?;
        Ok((headset.name().to_owned(), outcome))
    };
    let ((name, outcome), stand_in) = match stand_in {
        Some((track, gpu)) => {
            if format == Format::Text {
                let info = gpu.info();
                let text = session::starting("the stand-in", &info.name, info.kind);
                eprintln!("{text}");
            }
            let spec = StandInSpec {
                extent: args.size,
                rate_hz: args.rate,
                timing: Timing::Real,
            };
            let opened = gpu.options().clone();
            let mut headset = StandIn::new(&gpu, track, spec).other()?;
            headset = headset.reopening(move || Gpu::open(&mut PlainLoader::default(), &opened));
            (worn(&mut headset)?, Some((spec, headset.ready())))
        }
        #[cfg(feature = "vr")]
        None => (worn(&mut headset::open(args.foveation, timestamps)?)?, None),
        #[cfg(not(feature = "vr"))]
        None => return no_headset(),
    };
    let mut report = report::report(name, outcome, stand_in)?;
    report.watched = watchers.map(Watchers::report);
    prepared.end(report)
}

/// Says that the build has no OpenXR.
#[cfg(not(feature = "vr"))]
fn no_headset() -> Result<(), Failure> {
    use crate::cli::left_out::REMEDY;
    Err(format!(
        "this build leaves headsets out: use `vitriol desk`, give --stand-in, or {REMEDY}"
    ))
    .input()
}

/// The session with a window on the computer, if there is a screen.
fn mirrored(
    session: Session,
    headset: &dyn Headset,
    decisions: Sender<Decision>,
) -> Result<Session, Failure> {
    match Window::open(headset.extent(), decisions) {
        Ok(window) => session.mirrored(window),
        Err(cause) => {
            tracing::warn!("no mirror window: {cause}");
            Ok(session)
        }
    }
}
