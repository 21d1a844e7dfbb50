//! `vitriol replay --compare`: the same hands in two scenes at the same time, side by side in one film.

mod reel;
mod side;

use serde::Serialize;
use vitriol_run::captions;
use vitriol_run::output::{COMPARE_FILM, COMPARE_JSON, COMPARE_PICTURE, OutDir};
use vitriol_run::progress::Runs;
use vitriol_run::units::{mass, three_digits, with_unit};
use vitriol_run::{
    Blame, Cut, DeviceStatement, Experiment, FILM_FPS, FILM_SIZE, Failure, Film, Format, Setup,
    emit, in_a_line,
};

use crate::cli::ReplayArgs;
use crate::command::plan::{Ask, ReplayPlan};
use crate::command::recorded::changes_scene;
use crate::command::stem;

use reel::Reel;
use side::Side;

/// Width and height of each picture, pixels.
const HALF: [u32; 2] = [FILM_SIZE[0] / 2, FILM_SIZE[1]];

/// What was compared.
#[derive(Debug, Serialize)]
struct Compared {
    program: &'static str,
    track: String,
    preset: &'static str,
    seed: u64,
    device: DeviceStatement,
    film_frames: u64,
    /// Where the film goes on at another simulated time; the first one is its begin.
    cuts: Vec<Cut>,
    /// The left one and the right one.
    scenes: Vec<Measured>,
}

/// What was measured in one of the scenes.
#[derive(Debug, Serialize)]
struct Measured {
    scene: String,
    simulated_s: f64,
    fluid_particles: u64,
    /// Highest temperature of any moment, °C, and when that was, s; where heat is modelled.
    #[serde(skip_serializing_if = "Option::is_none")]
    hottest_c: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    hottest_at_s: Option<f64>,
    /// What was thrown out until the end, kg, as the film's captions say.
    thrown_kg: f64,
    /// What of it was in the first two seconds of contact, as a report says.
    #[serde(skip_serializing_if = "Option::is_none")]
    thrown_first_kg: Option<f64>,
    /// Water that left as steam until the end, kg.
    #[serde(skip_serializing_if = "Option::is_none")]
    steam_kg: Option<f64>,
    state_hash: String,
}

/// What is printed of it: that, and where things are.
#[derive(Debug, Serialize)]
struct Told<'a> {
    #[serde(flatten)]
    compared: &'a Compared,
    /// It has no sound: those of two rooms at once would be of neither.
    film: String,
    picture: String,
    compare_json: String,
}

/// Runs the comparison.
///
/// # Errors
/// As [`super::run`].
pub(super) fn run(
    (args, names): (&ReplayArgs, &[String; 2]),
    bars: &Runs,
    format: Format,
    prepare: &impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure>,
) -> Result<(), Failure> {
    let [track] = &args.tracks[..] else {
        return Err("--compare is of one track; name one, or replay several without it").input();
    };
    let plan = |scene: &str| -> Result<ReplayPlan, Failure> {
        let plan = ReplayPlan::new(&Ask {
            scene: Some(scene),
            ..super::ask(args, track)
        })?;
        if changes_scene(&plan.track) {
            return Err(format!(
                "{}: the track changes the scene itself, so that not two are compared; replay it without --compare",
                in_a_line(track)
            ))
            .input();
        }
        Ok(plan)
    };
    let plans = [plan(&names[0])?, plan(&names[1])?];
    let (preset, seed) = (plans[0].preset.name(), plans[0].seed);
    let seconds = plans[0].span.seconds().min(plans[1].span.seconds());
    let mut progress = bars.of(track, plans[0].span);
    let mut out = OutDir::take(args.out.as_deref(), &stem(track))?;
    let [left, right] = plans.map(|plan| Side::new(args, plan, prepare));
    let mut sides = [left?, right?];
    let [width, height] = FILM_SIZE;
    let film = Film::create(&out.join(COMPARE_FILM), width, height, FILM_FPS).other()?;
    let mut reel = Reel::new(film)?;
    let frames = (seconds * f64::from(FILM_FPS) - 1e-6).ceil() as u64;
    for number in 0..frames {
        for side in &mut sides {
            side.reach(number)?;
        }
        progress.at(&sides[0].time());
        let said = sides.each_ref().map(Side::caption);
        let shown = sides.iter().any(Side::is_shown);
        let [left, right] = &mut sides;
        let pictures = [left.picture()?, right.picture()?];
        let mut picture = captions::side_by_side(pictures, HALF[0] as usize);
        let time = number as f64 / f64::from(FILM_FPS);
        captions::draw(&mut picture, width as usize, &said, time);
        reel.take(number, picture, shown)?;
    }
    for side in &mut sides {
        side.end()?;
    }
    progress.at(&sides[0].time());
    let reeled = reel.finish()?;
    out.adopt(reeled.film);
    out.write(COMPARE_PICTURE, &reeled.animated)?;

    let mut device = DeviceStatement::default();
    let mut scenes = Vec::new();
    for side in sides {
        let (measured, on) = side.measured()?;
        scenes.push(measured);
        device = on;
    }
    let compared = Compared {
        program: concat!("vitriol ", env!("CARGO_PKG_VERSION")),
        track: track.clone(),
        preset,
        seed,
        device,
        film_frames: reeled.frames,
        cuts: reeled.cuts,
        scenes,
    };
    out.write(COMPARE_JSON, &serde_json::to_vec_pretty(&compared).other()?)?;
    let place = |name: &str| out.join(name).display().to_string();
    let (film, picture) = (place(COMPARE_FILM), place(COMPARE_PICTURE));
    let compare_json = place(COMPARE_JSON);
    out.complete();
    let told = Told {
        compared: &compared,
        film,
        picture,
        compare_json,
    };
    emit(format, &told, describe)
}

fn describe(told: &Told<'_>) -> String {
    let compared = told.compared;
    let mut lines = vec![format!(
        "{}, seed {}, preset {}, on {}",
        in_a_line(&compared.track),
        compared.seed,
        compared.preset,
        compared.device.name
    )];
    let names = compared.scenes.iter().map(|it| in_a_line(&it.scene));
    let names: Vec<String> = names.collect();
    let longest = names.iter().map(|name| name.chars().count()).max();
    let wide = longest.unwrap_or(0);
    for (scene, name) in compared.scenes.iter().zip(&names) {
        let mut said = Vec::new();
        if let (Some(celsius), Some(t)) = (scene.hottest_c, scene.hottest_at_s) {
            let t = three_digits(t);
            said.push(format!("hottest {celsius:.1} °C at {t} s"));
        }
        said.push(format!("thrown {}", weight(scene.thrown_kg)));
        said.extend(scene.steam_kg.map(|kg| format!("steam {}", weight(kg))));
        said.push(format!("state {}", scene.state_hash));
        lines.push(format!("{name:wide$}  {}", said.join(", ")));
    }
    lines.push(String::new());
    lines.push(format!("film    {} (without sound)", told.film));
    lines.push(format!("picture {}", told.picture));
    lines.push(format!("numbers {}", told.compare_json));
    lines.join("\n")
}

fn weight(kg: f64) -> String {
    with_unit(kg, mass(kg))
}
