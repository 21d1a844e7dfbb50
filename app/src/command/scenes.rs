//! `vitriol scenes`: the built-in scenes, each with what it states.

use std::collections::BTreeMap;

use serde::Serialize;
use vitriol_gpu::Timestamps;
use vitriol_lesson::Texts;
use vitriol_run::passes::anatomy;
use vitriol_run::units::{count, grouped, length, three_digits, with_unit};
use vitriol_run::{Blame, DeviceStatement, Failure, Format, device, emit};
use vitriol_sim::scene::{Feature, Preset, Scene};

use crate::cli::ScenesArgs;
use crate::report::{SceneStatement, SolverStatement};

#[derive(Debug, Serialize)]
struct SceneInfo {
    #[serde(flatten)]
    scene: SceneStatement,
    /// Its title in the language that was asked for.
    title: String,
    description: String,
    flasks: Vec<String>,
    /// Under each preset, or that which was asked for.
    presets: Vec<PresetInfo>,
}

#[derive(Debug, Serialize)]
struct PresetInfo {
    preset: &'static str,
    fluid_particles: usize,
    d_m: f64,
    #[serde(flatten)]
    solver: SolverStatement,
}

/// Runs `vitriol scenes`.
///
/// # Errors
/// [`Failure::Other`] where a built-in scene is broken or standard output
/// cannot be written.
pub fn run(args: &ScenesArgs, format: Format) -> Result<(), Failure> {
    if args.cost {
        return cost(args, format);
    }
    let texts = Texts::of(args.language).other()?;
    let names = Scene::builtin_names().into_iter();
    let scenes = names.map(|name| look_into((name, texts.scene(name)), args.preset));
    let scenes: Vec<SceneInfo> = scenes.collect::<Result<_, _>>()?;
    emit(format, &BTreeMap::from([("scenes", &scenes)]), |_| {
        let texts: Vec<String> = scenes.iter().map(describe).collect();
        texts.join("\n")
    })
}

/// What a scene takes.
#[derive(Debug, Serialize)]
struct SceneCost {
    scene: String,
    preset: &'static str,
    fluid_particles: usize,
    /// What is modelled beyond incompressible flow.
    models: Vec<String>,
    /// What is not; the size of what that makes is in docs/measurements/accuracy.md.
    left_out: Vec<String>,
    /// Walls: maps or boundary particles.
    boundary: String,
    bytes_per_particle: u64,
    /// Dispatches of a frame, all together.
    dispatches: u32,
    /// Label and dispatches of each pass.
    passes: Vec<(String, u32)>,
}

#[derive(Debug, Serialize)]
struct Costs {
    device: DeviceStatement,
    scenes: Vec<SceneCost>,
}

fn cost(args: &ScenesArgs, format: Format) -> Result<(), Failure> {
    let preset = args.preset.unwrap_or(Preset::Balanced);
    let gpu = device::timed(args.device.as_deref(), Timestamps::Passes)?;
    let scenes = Scene::builtin_names().into_iter().map(|name| {
        let scene = Scene::builtin(name).other()?.with_preset(preset);
        let (passes, bytes_per_particle) = anatomy(&gpu, &scene)?;
        let [mut models, mut left_out] = [Vec::new(), Vec::new()];
        for feature in Feature::ALL {
            let list = if scene.models(feature) {
                &mut models
            } else {
                &mut left_out
            };
            list.push(feature.name());
        }
        Ok(SceneCost {
            scene: name.to_owned(),
            preset: preset.name(),
            fluid_particles: scene.liquids.iter().map(|l| scene.particle_count(l)).sum(),
            models,
            left_out,
            boundary: SolverStatement::of(&scene).boundary,
            bytes_per_particle,
            dispatches: passes.iter().map(|pass| pass.dispatches).sum(),
            passes: passes.into_iter().map(|p| (p.name, p.dispatches)).collect(),
        })
    });
    let costs = Costs {
        device: device::statement(&gpu),
        scenes: scenes.collect::<Result<_, Failure>>()?,
    };
    emit(format, &costs, |costs| {
        let scenes: Vec<String> = costs.scenes.iter().map(describe_cost).collect();
        scenes.join("\n")
    })
}

fn describe_cost(cost: &SceneCost) -> String {
    let list = |names: &[String]| {
        if names.is_empty() {
            "nothing".to_owned()
        } else {
            names.join(", ")
        }
    };
    let passes: Vec<String> = cost
        .passes
        .iter()
        .map(|(name, dispatches)| format!("{name} {dispatches}"))
        .collect();
    format!(
        "{}, {}: {}, {} each; walls by {}\n  modelled: {}\n  left out: {}\n  \
         {} a frame: {}\n",
        cost.scene,
        cost.preset,
        count(cost.fluid_particles as u64, "particle"),
        count(cost.bytes_per_particle, "byte"),
        cost.boundary,
        list(&cost.models),
        list(&cost.left_out),
        count(cost.dispatches.into(), "dispatch"),
        passes.join(", ")
    )
}

fn look_into((name, title): (&str, &str), asked: Option<Preset>) -> Result<SceneInfo, Failure> {
    let scene = Scene::builtin(name).other()?;
    let presets = Preset::ALL.into_iter();
    let presets = presets.filter(|preset| asked.is_none_or(|asked| asked == *preset));
    let presets = presets.map(|preset| {
        let scene = scene.with_preset(preset);
        PresetInfo {
            preset: preset.name(),
            fluid_particles: scene.liquids.iter().map(|l| scene.particle_count(l)).sum(),
            d_m: scene.scale.spacing,
            solver: SolverStatement::of(&scene),
        }
    });
    Ok(SceneInfo {
        scene: SceneStatement::of(name, &scene),
        title: title.to_owned(),
        description: scene
            .description
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" "),
        flasks: scene.flasks.iter().map(|f| f.name.clone()).collect(),
        presets: presets.collect(),
    })
}

fn describe(info: &SceneInfo) -> String {
    let scene = &info.scene;
    let models = if scene.models.is_empty() {
        "nothing beyond incompressible flow".to_owned()
    } else {
        scene.models.join(", ")
    };
    let mut text = format!(
        "{}: {}\n  {}\n  flasks {}; models {}\n  h/d {}, frame {} ms, g {} m/s², length scale {}\n",
        scene.name,
        info.title,
        info.description,
        info.flasks.join(", "),
        models,
        three_digits(scene.h_over_d),
        three_digits(scene.frame_time_s * 1e3),
        three_digits(scene.gravity_m_s2),
        three_digits(scene.length_scale),
    );
    for preset in &info.presets {
        text += &format!(
            "  {:<10} {:>8} particles of {}, {} × {}, ω {}\n",
            preset.preset,
            grouped(preset.fluid_particles as u64),
            with_unit(preset.d_m, length(preset.d_m)),
            count(preset.solver.substeps.into(), "substep"),
            count(preset.solver.iterations.into(), "iteration"),
            three_digits(preset.solver.omega)
        );
    }
    text
}
