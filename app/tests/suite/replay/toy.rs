//! The experiment whose answers are known, and a replay of it.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::ops::Range;
use std::path::Path;

use vitriol::cli::{Cli, Command, ReplayArgs};
use vitriol::command::replay::run;
use vitriol::report::Report;
use vitriol_lesson::procedure::Progress;
use vitriol_lesson::{Cause, Ending, Event, Incident, What};
use vitriol_render::PassPicture;
use vitriol_run::{
    Action, Blame, Counters, DeviceStatement, Experiment, Failure, Format, Heard, HeatSample,
    Judging, LedgerSample, MassByPlace, Outcome, Sample, Taken, Worth,
};
use vitriol_xr::PoseFrame;

/// Pours 200 g from one flask into another along a smooth curve; every number
/// is a formula of the step.
pub(crate) struct Toy {
    pub(crate) steps: u64,
    /// The step that fails; 0 for the end, after the film.
    pub(crate) fails_at: u64,
    /// Whether its scene models heat.
    pub(crate) hot: bool,
    /// What is found in so many seconds.
    pub(crate) finds: Box<dyn Fn(f64) -> Vec<Event>>,
    /// What it says of a lesson, where it is asked to judge one.
    pub(crate) progress: Vec<Progress>,
    pub(crate) judges: bool,
    /// Whether nobody may look at it.
    pub(crate) unseen: bool,
    pub(crate) driver: &'static str,
    /// Steps in which nothing is worth showing.
    pub(crate) idle: Range<u64>,
    /// The step that is most worth a poster.
    pub(crate) most: u64,
    pub(crate) instructions: Vec<(f64, Action)>,
    pub(crate) picture: Vec<u8>,
}

/// Boils from second 2 on; half of what it loses is steam.
pub(super) fn heat(t: f64) -> HeatSample {
    HeatSample {
        temperature_mean_c: 20.0 + 20.0 * t,
        temperature_p99_c: 30.0 + 20.0 * t,
        temperature_max_c: 40.0 + 20.0 * t,
        temperatures_in_flasks_c: BTreeMap::from([
            ("erlenmeyer".into(), [20.0, 20.0]),
            (FLASK.into(), [20.0, 40.0 + 20.0 * t]),
        ]),
        temperatures_of_glass_c: BTreeMap::new(),
        acid_mean: 0.5,
        acid_min: 0.0,
        acid_max: 0.98,
        superheat_max_k: Some(10.0 * (t - 2.0)),
        boiling_particles: Some(if t > 2.05 { 100 } else { 0 }),
        boiling_in_flasks: BTreeMap::from([
            ("erlenmeyer".into(), 0),
            (FLASK.into(), if t > 2.05 { 90 } else { 0 }),
        ]),
        ledger: Some(LedgerSample {
            initial_j: -9000.0,
            exchanged_j: -50.0 * t,
            held_j: -9000.0 - 100.0 * t,
            steam_j: 49.9 * t,
            closure: 2e-7,
            steam_kg: 1e-5 * t,
            mist_kg: 0.0,
            dew_kg: 0.0,
            vapour_kg: 0.0,
            spray_kg: 0.0,
            spray_fallen_kg: 0.0,
            air_kg: 0.0,
            air_held_kg: 0.0,
            bubbles_m3: 2e-6 * t,
            foam_m3: 1e-6 * t,
        }),
    }
}

/// As of the scene that the track names, s.
pub(super) const FRAME_TIME: f64 = 0.011111111111111;

/// A name that breaks a page which does not escape it.
pub(super) const FLASK: &str = "beaker <script>alert(1)</script>";

/// The name of its device, and its driver.
pub(crate) const DEVICE: [&str; 2] = ["Toy & Sons", "none"];

impl Toy {
    pub(crate) fn new(fails_at: u64) -> Self {
        Self {
            steps: 0,
            fails_at,
            hot: false,
            finds: Box::new(|_| Vec::new()),
            progress: Vec::new(),
            judges: false,
            unseen: false,
            driver: DEVICE[1],
            idle: 0..0,
            most: 0,
            instructions: Vec::new(),
            picture: Vec::new(),
        }
    }
}

impl Experiment for Toy {
    fn step(&mut self, frame: &PoseFrame) -> Result<Taken, Failure> {
        assert_eq!(frame.step, self.steps, "steps come in order, none twice");
        self.steps += 1;
        if self.steps == self.fails_at {
            return Err("the device was lost").other();
        }
        Ok(Taken {
            frame_time: FRAME_TIME,
            anew: false,
        })
    }

    fn sample(&mut self, t: f64) -> Result<Sample, Failure> {
        let poured = 0.2 * (t / 4.0).clamp(0.0, 1.0).powi(2);
        let spilled = 0.05 * poured;
        Ok(Sample {
            t_s: t,
            density_error_mean: 0.012 + 0.004 * (3.0 * t).sin(),
            density_error_p99: 0.041 + 0.009 * (3.0 * t).sin(),
            kinetic_energy_j: 0.02 * t * (-t / 2.0).exp(),
            mass_kg: MassByPlace {
                flasks: BTreeMap::from([
                    ("erlenmeyer".into(), 0.217 - poured),
                    (FLASK.into(), poured - spilled),
                ]),
                table: 0.8 * spilled,
                floor: 0.0,
                air: 0.2 * spilled,
            },
            neighbour_rebuilds: (t * 40.0) as u64,
            left_kg: BTreeMap::from([("erlenmeyer".into(), poured), (FLASK.into(), 0.0)]),
            above_rim_kg: BTreeMap::from([("erlenmeyer".into(), 0.0), (FLASK.into(), 0.0)]),
            surface_m2: BTreeMap::from([("erlenmeyer".into(), 0.001), (FLASK.into(), 0.005)]),
            // Highest at 3 s.
            highest_drop_m: self.hot.then(|| 0.12 - 0.01 * (t - 3.0).abs()),
            heat: self.hot.then(|| heat(t)),
        })
    }

    fn picture(&mut self, _film: usize) -> Result<&[u8], Failure> {
        assert!(!self.unseen, "nobody looks at it");
        let shade = (self.steps % 256) as u8;
        self.picture = [shade, 90, 160, 255].repeat(960 * 540);
        Ok(&self.picture)
    }

    fn worth(&self) -> Worth {
        Worth {
            shown: !self.idle.contains(&self.steps),
            interest: -(self.steps.abs_diff(self.most) as f64),
        }
    }

    fn heard(&mut self) -> Result<Heard, Failure> {
        Ok(Heard::default())
    }

    fn passes(&mut self) -> Result<Vec<PassPicture>, Failure> {
        Ok(Vec::new())
    }

    fn judge(&mut self, _: Judging) {
        self.judges = true;
    }

    fn outcome(&mut self) -> Result<Outcome, Failure> {
        if self.fails_at == 0 {
            return Err("the device was lost").other();
        }
        Ok(Outcome {
            events: (self.finds)(self.steps as f64 * FRAME_TIME),
            progress: match self.judges {
                true => self.progress.clone(),
                false => Vec::new(),
            },
            scene: None,
            effort: [8, 4],
            fluid_particles: 13_894,
            lost_particles: 0,
            nan_particles: 0,
            state_hash: 0xfeed_f00d,
            device: DeviceStatement {
                name: DEVICE[0].into(),
                driver: self.driver.into(),
                api: "1.3.0".into(),
            },
            instructions: self.instructions.clone(),
            counters: Counters {
                substeps: self.steps * 4,
                solver_changes: 0,
                flasks_broken: 0,
                neighbour_rebuilds: 320,
                limiters: BTreeMap::from([("v_max".into(), 0), ("max neighbours".into(), 3)]),
            },
        })
    }
}

/// Water was poured into acid, and the attempt ended at `t` (s).
pub(super) fn events(t: f64) -> Vec<Event> {
    let incident = Incident {
        t_s: 0.02,
        until_s: 0.05,
        what: What::WaterIntoAcid {
            flask: FLASK.into(),
            met_acid: 0.96,
            volume_m3: 12e-6,
        },
        cause: Cause::Pouring {
            from: "erlenmeyer".into(),
        },
        place_m: [0.1, 0.8, -0.4],
    };
    let (scene, contents) = ("two-flasks".to_owned(), BTreeMap::new());
    vec![
        Event::Begun {
            t_s: 0.0,
            scene,
            contents,
            glass: BTreeMap::new(),
        },
        Event::Incident(incident),
        Event::Ended(Ending {
            t_s: t,
            contents: BTreeMap::new(),
            hottest: None,
            bench_m3: 0.0,
            floor_m3: 0.0,
        }),
    ]
}

/// What such a line asks of `vitriol replay`.
pub(crate) fn asked(
    line: impl IntoIterator<Item = impl Into<OsString> + Clone>,
) -> Box<ReplayArgs> {
    match <Cli as clap::Parser>::parse_from(line).command {
        Command::Replay(args) => args,
        _ => panic!("replay is parsed as another command"),
    }
}

/// What `vitriol replay two-flasks --out OUT …` does, with the toy.
pub(super) fn replay(out: &Path, more: &[&str], fails_at: u64) -> Result<(), Failure> {
    replay_with(out, more, || Toy::new(fails_at))
}

pub(super) fn replay_with(out: &Path, more: &[&str], toy: impl Fn() -> Toy) -> Result<(), Failure> {
    replay_of("two-flasks", out, more, toy)
}

pub(super) fn replay_of(
    track: &str,
    out: &Path,
    more: &[&str],
    toy: impl Fn() -> Toy,
) -> Result<(), Failure> {
    let out = out.to_str().unwrap();
    let arguments = ["vitriol", "replay", track, "--out", out];
    let args = asked(arguments.iter().chain(more));
    run(&args, Format::Json, |setup| {
        assert_eq!(
            setup.scene.name, "two-flasks",
            "the scene that the track names"
        );
        Ok(Box::new(toy()))
    })
}

pub(super) fn report_of(out: &Path) -> Report {
    serde_json::from_slice(&fs::read(out.join("report.json")).unwrap()).unwrap()
}
