//! `vitriol scenes`: the built-in scenes, each with what it states.

use std::fmt::Write;

use serde::Serialize;
use vitriol_sim::scene::{Preset, Scene};

use crate::cli::PresetName;
use crate::console::{Format, emit};
use crate::failure::{Blame, Failure};
use crate::report::units::{grouped, length, three_digits, with_unit};
use crate::report::{SceneStatement, SolverStatement};
use crate::statement;

#[derive(Debug, Serialize)]
struct SceneList {
    scenes: Vec<SceneInfo>,
}

#[derive(Debug, Serialize)]
struct SceneInfo {
    #[serde(flatten)]
    scene: SceneStatement,
    description: String,
    flasks: Vec<String>,
    /// Under each preset.
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
pub fn run(format: Format) -> Result<(), Failure> {
    let scenes = Scene::builtin_names().into_iter().map(look_into);
    let scenes = scenes.collect::<Result<_, _>>()?;
    emit(format, &SceneList { scenes }, |list| {
        let scenes: Vec<String> = list.scenes.iter().map(describe).collect();
        scenes.join("\n")
    })
}

fn look_into(name: &str) -> Result<SceneInfo, Failure> {
    let scene = Scene::load(name).other()?;
    let all = [
        PresetName::Fast,
        PresetName::Balanced,
        PresetName::Reference,
    ];
    let presets = all.map(|preset| {
        let scene = scene.with_preset(Preset::from(preset));
        PresetInfo {
            preset: preset.name(),
            fluid_particles: scene.liquids.iter().map(|l| scene.particle_count(l)).sum(),
            d_m: scene.scale.spacing,
            solver: statement::of_solver(&scene),
        }
    });
    Ok(SceneInfo {
        scene: statement::of_scene(name, &scene),
        description: scene
            .description
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" "),
        flasks: scene.flasks.iter().map(|f| f.name.clone()).collect(),
        presets: presets.into(),
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
        "{}\n  {}\n  flasks {}; models {}\n  h/d {}, frame {} ms, g {} m/s², length scale {}\n",
        scene.name,
        info.description,
        info.flasks.join(", "),
        models,
        three_digits(scene.h_over_d),
        three_digits(scene.frame_time_s * 1e3),
        three_digits(scene.gravity_m_s2),
        three_digits(scene.length_scale),
    );
    for preset in &info.presets {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "  {:<10} {:>8} particles of {}, {} substeps × {} iterations, ω {}",
            preset.preset,
            grouped(preset.fluid_particles as u64),
            with_unit(preset.d_m, length(preset.d_m)),
            preset.solver.substeps,
            preset.solver.iterations,
            three_digits(preset.solver.omega)
        );
    }
    text
}
