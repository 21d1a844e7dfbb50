//! `vitriol trade`: the cost of accuracy.

use std::time::Instant;

use vitriol_gpu::Gpu;
use vitriol_run::{Blame, Failure, Format, device, emit, output, track};
use vitriol_shaders::Library;
use vitriol_sim::scene::{Feature, Preset, Scene, SolverSettings};
use vitriol_xr::track::Track;

use super::calorimeter::resolution;
use crate::calorimeter::{self, Feed};
use crate::cli::{TradeArgs, TradePart};
use crate::merge::read;
use crate::trade::constants::{self, Change};
use crate::trade::report::{Calorimetry, Effect};
use crate::trade::{
    Errors, Point, Seeds, Setting, Tipped, Trade, boil, convergence, describe, finest, merge, page,
    rest, sweep, tip, vouch,
};
use vitriol_run::several::at_a_time;

/// File names in the folder.
const NUMBERS: &str = "trade.json";
const PAGE: &str = "trade.html";

/// The scene with the liquid and the presets of the settings.
const SCENE: &str = "beaker";
/// Scene and track of water that is poured into acid.
const BOILING: (&str, &str) = ("water-into-acid", "two-flasks");
/// Scene of acid that is poured into water, by the track of [`BOILING`].
const REVERSED: &str = "acid-into-water";
/// Features that are left out, one at a time, with those that are built upon it.
const ABLATED: [Feature; 8] = [
    Feature::Air,
    Feature::Spray,
    Feature::Bubbles,
    Feature::Density,
    Feature::Viscosity,
    Feature::Evaporation,
    Feature::Losses,
    Feature::Segregation,
];
/// Number of seeds of chaotic runs, and of those that leave a feature out.
const SEEDS: [u64; 2] = [10, 4];

/// Constants that `--quick` changes: one of scenes, one of shaders.
const QUICK: [&str; 2] = ["mixing", "CONTACT"];

/// Number of seeds that run at once.
const AT_ONCE: usize = 3;

/// Water of 20 °C and acid of 98 %, mL, and the mixture's temperature, °C: enthalpies by Wagman et al. (1982), boiling by the boiling
/// points of the composition.
const MIXES: [([f64; 2], f64); 6] = [
    ([10.0, 100.0], 75.5),
    ([50.0, 100.0], 154.5),
    ([100.0, 100.0], 149.1),
    ([200.0, 100.0], 120.5),
    ([400.0, 100.0], 82.9),
    ([100.0, 10.0], 48.5),
];

/// Runs `vitriol trade`.
///
/// # Errors
/// [`Failure::NoDevice`]; [`Failure::Input`] where a file of that name exists
/// already, or parts do not belong together; [`Failure::Other`] where device or folder fails.
pub fn run(args: &TradeArgs, format: Format) -> Result<(), Failure> {
    let files = output::new_files(args.out.as_deref(), [NUMBERS, PAGE])?;
    let found = if args.merge.is_empty() {
        find(args)?
    } else {
        merge(read(&args.merge)?).input()?
    };
    if let Some([numbers, html]) = files {
        output::write_new(&html, page(&found).as_bytes())?;
        output::write_json(&numbers, &found)?;
    }
    emit(format, &found, describe)
}

fn find(args: &TradeArgs) -> Result<Trade, Failure> {
    let gpu = device::open(args.device.as_deref())?;
    let mut work = Work {
        gpu: &gpu,
        begin: Instant::now(),
        args,
        found: Trade {
            device: device::statement(&gpu),
            quick: args.quick,
            part: args.part,
            ..Trade::default()
        },
    };
    let wanted = |part| args.part.is_none_or(|only| only == part);
    if wanted(TradePart::Truth) {
        work.truth()?;
    }
    if wanted(TradePart::Chemistry) {
        work.chemistry()?;
    }
    if wanted(TradePart::Constants) {
        work.constants()?;
    }
    if wanted(TradePart::Solver) {
        work.solver()?;
    }
    let mut found = work.found;
    found.cases = match &args.cases {
        None => [0, found.of],
        Some(range) => [range.start, range.end].map(|number| number.min(found.of)),
    };
    found.seconds = work.begin.elapsed().as_secs_f64();
    Ok(found)
}

struct Work<'a> {
    gpu: &'a Gpu,
    begin: Instant,
    args: &'a TradeArgs,
    found: Trade,
}

impl Work<'_> {
    fn late(&self) -> bool {
        let spent = self.begin.elapsed().as_secs_f64();
        self.args.within.is_some_and(|within| spent > within)
    }

    /// Counts a case; returns whether it is one of those that are asked for.
    fn takes_next(&mut self) -> bool {
        let number = self.found.of;
        self.found.of += 1;
        let cases = self.args.cases.as_ref();
        cases.is_none_or(|cases| cases.contains(&number))
    }

    /// The finest setting's pour, with which others are compared: run before the first of them.
    fn finest(&mut self, scene: &Scene) -> Result<Tipped, Failure> {
        if let Some((_, poured)) = self.found.finest {
            return Ok(poured);
        }
        // The device's clocks rise with its first work.
        rest(self.gpu, scene, &Setting::of(scene, Preset::Fast), 0.5)?;
        let particles = if self.args.quick { 6e3 } else { 110e3 };
        let truth = finest(scene, particles);
        let poured = tip(self.gpu, scene, &truth)?;
        self.found.finest = Some((truth, poured));
        Ok(poured)
    }

    fn solver(&mut self) -> Result<(), Failure> {
        let scene = Scene::builtin(SCENE).other()?;
        let seconds = if self.args.quick { 0.6 } else { 1.5 };
        for (preset, knob, setting) in sweep(&scene, self.args.quick) {
            if !self.takes_next() {
                continue;
            }
            let poured = self.finest(&scene)?;
            if self.late() {
                self.found.skipped += 1;
                continue;
            }
            let rested = rest(self.gpu, &scene, &setting, seconds)?;
            let tipped = tip(self.gpu, &scene, &setting)?;
            self.found.points.push(Point {
                preset: preset.name().into(),
                knob,
                setting,
                stiffness: setting.stiffness(scene.scale.gravity, DEPTH),
                errors: Errors {
                    rest_p99: rested.density_p99,
                    pour_p99: tipped.density_p99,
                    poured: (tipped.poured / poured.poured - 1.0).abs(),
                    lost_volume: rested.lost_volume,
                },
                rest: rested,
                pour: tipped,
            });
            tracing::info!(
                "{} after {:.0} s",
                setting.label(),
                self.begin.elapsed().as_secs_f64()
            );
        }
        Ok(())
    }

    fn chemistry(&mut self) -> Result<(), Failure> {
        let quick = self.args.quick;
        let presets = if quick { 0..1 } else { 0..3 };
        let mixes = if quick { 2..3 } else { 0..6 };
        for &preset in &Preset::ALL[presets] {
            for &mix in &MIXES[mixes.clone()] {
                if !self.takes_next() {
                    continue;
                }
                let found = calorimetry(self.gpu, preset, mix)?;
                self.found.calorimetry.push(found);
            }
        }
        let scene = Scene::builtin(BOILING.0).other()?;
        let track = track::load(BOILING.1)?;
        if quick {
            let coarse = vitriol_sim::scene::PresetOverrides {
                spacing: Some(0.004),
                substeps: Some(6),
                ..scene.presets[&Preset::Fast]
            };
            let mut scene = scene;
            scene.presets.insert(Preset::Fast, coarse);
            return self.seeds("coarse", &scene.with_preset(Preset::Fast), &track, (2, 5.0));
        }
        let whole = track.duration();
        let all = (SEEDS[0], whole);
        let fine = finest_boiling(&scene);
        self.seeds("finest", &fine, &track, all)?;
        for preset in [Preset::Reference, Preset::Balanced, Preset::Fast] {
            self.seeds(preset.name(), &scene.with_preset(preset), &track, all)?;
        }
        let balanced = scene.with_preset(Preset::Balanced);
        self.seeds(
            "balanced without sleep",
            &balanced.without_sleep(),
            &track,
            (SEEDS[1], whole),
        )?;
        for feature in ABLATED {
            let (less, gone) = balanced.without(feature);
            let names: Vec<String> = gone.iter().map(|feature| feature.name()).collect();
            let name = format!("balanced without {}", names.join(", "));
            self.seeds(&name, &less, &track, (SEEDS[1], whole))?;
        }
        Ok(())
    }

    /// Both orders of pouring, with each constant of scene and shaders as it is, halved and doubled.
    fn constants(&mut self) -> Result<(), Failure> {
        let track = track::load(BOILING.1)?;
        let quick = self.args.quick;
        let (seeds, seconds) = if quick {
            (1, 3.0)
        } else {
            (SEEDS[1], track.duration())
        };
        for name in [BOILING.0, REVERSED] {
            let scene = Scene::builtin(name).other()?.with_preset(Preset::Balanced);
            let mut rows = vec![(None, 1.0, 1.0)];
            for constant in constants::all().filter(|it| !quick || QUICK.contains(&it.key)) {
                if let Some(value) = constant.of(&scene).other()? {
                    rows.extend([0.5, 2.0].map(|times| (Some(constant), value, times)));
                }
            }
            for (constant, value, times) in rows {
                if !self.takes_next() {
                    continue;
                }
                if self.late() {
                    self.found.skipped += 1;
                    continue;
                }
                let (other, shaders) = match constant {
                    Some(constant) => constant.times(&scene, times).other()?,
                    None => (scene.clone(), Library::embedded()),
                };
                let of = (&other, &shaders);
                let numbers: Vec<u64> = (1..=seeds).collect();
                let boil = |&seed: &u64| Ok(boil(self.gpu, of, &track, seconds, seed)?.0);
                let found = at_a_time(AT_ONCE, &numbers, boil)?;
                self.found.constants.push(Change {
                    constant,
                    value,
                    times,
                    seeds: Seeds::of(name.to_owned(), found),
                });
            }
        }
        Ok(())
    }

    fn seeds(
        &mut self,
        name: &str,
        scene: &Scene,
        track: &Track,
        (count, seconds): (u64, f64),
    ) -> Result<(), Failure> {
        if !self.takes_next() {
            return Ok(());
        }
        if self.late() {
            self.found.skipped += 1;
            return Ok(());
        }
        // The first alone, for its time; the others, whose time is not used, several at once.
        let shaders = Library::embedded();
        let of = (scene, &shaders);
        let (first, cost) = boil(self.gpu, of, track, seconds, 1)?;
        let others: Vec<u64> = (2..=count).collect();
        let boil = |&seed: &u64| Ok(boil(self.gpu, of, track, seconds, seed)?.0);
        let others = at_a_time(AT_ONCE, &others, boil)?;
        let seeds = std::iter::once(first).chain(others);
        self.found
            .boiling
            .push(Seeds::of(name.to_owned(), seeds.collect()));
        self.found.boiling_costs.push(cost);
        tracing::info!("{name} after {:.0} s", self.begin.elapsed().as_secs_f64());
        Ok(())
    }

    fn truth(&mut self) -> Result<(), Failure> {
        let scene = Scene::builtin(SCENE).other()?;
        if self.takes_next() {
            self.found.orders = convergence(self.gpu, self.args.quick)?;
        }
        let (count, seconds) = if self.args.quick {
            (300, 0.1)
        } else {
            (3000, 0.3)
        };
        if self.takes_next() {
            let vouched = vouch(self.gpu, &scene, &finest(&scene, 28e3), count, seconds)?;
            self.found.vouched = Some(vouched);
        }
        self.effects(&scene)
    }

    /// Pours as the scene has it, with each effect that it leaves out, and without all that is numerics alone.
    fn effects(&mut self, scene: &Scene) -> Result<(), Failure> {
        type Change = fn(&mut SolverSettings);
        let all: [(&'static str, Change); 4] = [
            ("as it is", |_| {}),
            ("with surface tension of 0.0728 N/m", |s| {
                s.surface_tension = Some(0.0728);
            }),
            ("with vorticity confinement of 0.005 m/s", |s| {
                s.vorticity = Some(0.005)
            }),
            ("without viscosity of the numerics", |s| s.viscosity = 0.0),
        ];
        let (preset, seconds) = if self.args.quick {
            (Preset::Fast, 0.3)
        } else {
            (Preset::Balanced, 1.5)
        };
        for (name, change) in &all[..if self.args.quick { 2 } else { 4 }] {
            if !self.takes_next() {
                continue;
            }
            let mut scene = scene.clone();
            change(&mut scene.solver);
            let setting = Setting::of(&scene, preset);
            self.found.effects.push(Effect {
                name: (*name).into(),
                rest: rest(self.gpu, &scene, &setting, seconds)?,
                pour: tip(self.gpu, &scene, &setting)?,
            });
        }
        Ok(())
    }
}

/// Depth of the water at rest, m.
const DEPTH: f64 = 0.063;

/// The finest run of the scene that boils: half as many particles again as
/// `reference`, and more substeps.
fn finest_boiling(scene: &Scene) -> Scene {
    let mut fine = scene.with_preset(Preset::Reference);
    fine.scale.spacing *= 0.87;
    fine.solver.substeps = 20;
    fine
}

fn calorimetry(
    gpu: &Gpu,
    preset: Preset,
    (millilitres, table): ([f64; 2], f64),
) -> Result<Calorimetry, Failure> {
    let feed = |volume: f64, acid: f64| Feed {
        volume: 1e-6 * volume,
        temperature: 20.0,
        acid,
    };
    let feeds = [feed(millilitres[0], 0.0), feed(millilitres[1], 0.98)];
    let mixed = calorimeter::mix(gpu, feeds, resolution(preset), 1)?;
    Ok(Calorimetry {
        preset: preset.name().into(),
        millilitres,
        temperature: [mixed.end.temperature_mean, table],
        drifts: mixed.drifts,
    })
}
