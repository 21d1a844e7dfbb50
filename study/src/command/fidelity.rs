//! `vitriol fidelity`: the renderer's surface against that of Yu and Turk of the same particles, marched on the CPU.

use std::time::Instant;

use vitriol_run::output::ColorType;
use vitriol_run::{Failure, Format, device, emit, output};
use vitriol_shaders::Library;

use crate::cli::FidelityArgs;
use crate::fidelity::judge::{self, Sample, Task};
use crate::fidelity::report::{self, Fidelity, Manner, StateRow, describe};
use crate::fidelity::screen::{MANNERS, Screen};
use crate::fidelity::sheet;
use crate::fidelity::states::{self, State};

/// File name of the numbers in the folder.
const NUMBERS: &str = "fidelity.json";
/// File name of the picture.
const DIFFERENCE: &str = "fidelity.png";

/// Width and height of an eye's picture, pixels. A particle spacing is 3 to 8
/// pixels wide in the widest views; in a headset, half a metre away, about 5.
const SIZES: [[u32; 2]; 4] = [[320, 240], [480, 360], [640, 480], [960, 720]];
/// Index in [`SIZES`] of the picture of the difference.
const SHOWN: usize = 1;

/// Runs `vitriol fidelity`.
///
/// # Errors
/// [`Failure::NoDevice`]; [`Failure::Input`] where a file of that name exists
/// already; [`Failure::Other`] where device or folder fails.
pub fn run(args: &FidelityArgs, format: Format) -> Result<(), Failure> {
    let files = output::new_files(args.out.as_deref(), [NUMBERS, DIFFERENCE])?;
    let gpu = device::open(args.device.as_deref())?;
    let start = Instant::now();
    let library = Library::watching();
    let states = states::run(&gpu, &library, args.preset)?;
    tracing::info!("states after {:.0} s", start.elapsed().as_secs_f64());
    let sizes = if args.quick {
        &SIZES[..=SHOWN]
    } else {
        &SIZES[..]
    };
    let shapes: Vec<_> = states.iter().map(judge::shapes).collect();
    let most = states
        .iter()
        .map(|state| state.world.solver().count())
        .max();
    let (mut pictures, mut samples) = (Vec::new(), Vec::new());
    for (index, &size) in sizes.iter().enumerate() {
        let mut screen = Screen::new(&gpu, &library, size, most.unwrap_or(0))?;
        for (state, shapes) in states.iter().zip(&shapes) {
            screen.set_scene(state)?;
            let task = Task {
                state,
                shapes,
                size,
                whole: index == 0,
                manners: &MANNERS,
            };
            let keep = |manner: Manner, sample: Sample| {
                if index == SHOWN && manner == MANNERS[0] {
                    samples.push(sample);
                }
            };
            pictures.extend(task.judge(&mut screen, keep)?);
            tracing::info!(
                "{} at {size:?} after {:.0} s",
                state.spec.name,
                start.elapsed().as_secs_f64()
            );
        }
    }
    let found = Fidelity {
        device: device::statement(&gpu),
        states: states.iter().map(state_row).collect(),
        rows: report::rows(&pictures),
        pictures,
        seconds: start.elapsed().as_secs_f64(),
    };
    if let Some([numbers, difference]) = files {
        let (pixels, size) = sheet::picture(&samples);
        output::write_new(&difference, &output::png(&pixels, size, ColorType::Rgb)?)?;
        output::write_json(&numbers, &found)?;
    }
    emit(format, &found, describe)
}

fn state_row(state: &State) -> StateRow {
    StateRow {
        state: state.spec.name.to_owned(),
        scene: state.spec.scene.to_owned(),
        seconds: state.spec.seconds,
        particles: state.positions.len(),
        spacing_m: state.world.scene().scale.spacing,
        volume_ml: 1e6 * state.volumes.iter().sum::<f64>(),
    }
}
