//! `vitriol desk`: in a window, with mouse and keyboard.

use std::sync::mpsc::channel;

use vitriol_gpu::{Gpu, PlainLoader, vk};
use vitriol_run::texts::Texts;
use vitriol_run::{Blame, Failure, Format, device};
use vitriol_sim::scene::Preset;
use vitriol_xr::Headset;

use crate::cli::DeskArgs;
use crate::command::session::{self, Prepared, report};
use vitriol_session::desk::{self, DeskSpec};
use vitriol_session::foveating::Foveating;
use vitriol_session::latch::Grip;
use vitriol_session::menu;
use vitriol_session::session::{Options, Session};

/// Runs `vitriol desk`.
///
/// # Errors
/// [`Failure::NoDevice`] without a device or a screen; [`Failure::Input`] for a scene that is not there or a recording that is;
/// [`Failure::Other`] where device or disk fails.
pub fn run(args: &DeskArgs, format: Format) -> Result<(), Failure> {
    let shared = &args.session;
    let mut options = Options {
        // A screen has no lenses, away from whose axes fewer pixels would do.
        foveating: Some(Foveating::Off),
        pointer: true,
        ..session::options(shared)?
    };
    let gpu = device::timed(args.device.as_deref(), session::timestamps(&options))?;
    options.plan.preset = (shared.preset).unwrap_or_else(|| usual(gpu.info().kind));
    if format == Format::Text {
        let info = gpu.info();
        let text = session::starting("the session", &info.name, info.kind);
        eprintln!("{text}");
    }
    // Before the console's address is printed: without a screen there is nothing to direct.
    let (decisions, taken) = channel();
    let spec = DeskSpec {
        size: args.size,
        full_screen: args.full_screen,
        fov: args.fov,
        scale: args.scale,
        toggles: shared.grip == Grip::Toggle,
    };
    let (desk, window) = desk::open(&gpu, spec, decisions.clone())?;
    let titles = vitriol_lesson::Texts::of(options.language).other()?;
    let scene = titles.scene(&options.plan.scene);
    let coming = Texts::of(options.language)?.panel.coming(scene);
    window.entitle(format!("Vitriol: {coming}"));
    let opened = gpu.options().clone();
    let mut desk = desk.reopening(move || Gpu::open(&mut PlainLoader::default(), &opened));
    let prepared = Prepared::new(shared, format, options)?;
    if format == Format::Text {
        eprintln!("{}", menu::MOUSE_LINES);
    }
    let options = prepared.solved(&gpu)?;
    prepared.take_keys(decisions)?;
    let session = Session::new(&desk, options, taken)?.mirrored(window)?;
    let outcome = session.run(&mut desk)?;
    prepared.end(report::report(desk.name().to_owned(), outcome, None)?)
}

/// The preset where none is asked for. Computers that have no headset often have no graphics card of their own, and `fast` has a
/// fraction of the particles.
fn usual(kind: vk::PhysicalDeviceType) -> Preset {
    match kind {
        vk::PhysicalDeviceType::DISCRETE_GPU => Preset::Balanced,
        _ => Preset::Fast,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_graphics_card_has_the_balanced_preset() {
        use vk::PhysicalDeviceType as Kind;
        assert_eq!(usual(Kind::DISCRETE_GPU), Preset::Balanced);
        for kind in [Kind::INTEGRATED_GPU, Kind::VIRTUAL_GPU, Kind::CPU] {
            assert_eq!(usual(kind), Preset::Fast, "{kind:?}");
        }
    }
}
