//! Recordings of a class, the experiment whose answers are known, and a grading by it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use vitriol::cli::{Cli, Command};
use vitriol::command::grade::{Class, Line, grade};
use vitriol_lesson::procedure::Progress;
use vitriol_lesson::{Cause, Content, Ending, Event, Incident, Pour, What};
use vitriol_render::PassPicture;
use vitriol_run::{
    Counters, DeviceStatement, Experiment, Failure, Format, Heard, Judging, MassByPlace, Outcome,
    Sample, Setup, Taken,
};
use vitriol_sim::scene::Scene;
use vitriol_xr::PoseFrame;
use vitriol_xr::track::{Existing, Track, save};

pub(super) const SCENE: &str = "acid-into-water";
pub(super) const DEVICE: [&str; 2] = ["Toy & Sons", "none"];

/// One attempt: 20 mL of acid poured into water, at 4 mL/s, and `spilt_ml` of it spilt.
pub(super) fn events(spilt_ml: f64) -> Vec<Event> {
    let incident = Incident {
        t_s: 0.2,
        until_s: 0.3,
        what: What::Spilt {
            surface: vitriol_lesson::Surface::Bench,
            volume_m3: 1e-6 * spilt_ml,
            acid: 0.98,
        },
        cause: Cause::Pouring {
            from: "acid".into(),
        },
        place_m: [0.1, 0.8, -0.4],
    };
    let pour = Pour {
        t_s: 0.1,
        until_s: 5.1,
        from: "acid".into(),
        into: Some("water".into()),
        volume_m3: 20e-6,
        fastest_m3_s: 4e-6,
        acid: 0.98,
        met: Some(Content {
            volume_m3: 160e-6,
            acid: 0.0,
            temperature_c: None,
        }),
        bare_face: false,
    };
    let begun = Event::Begun {
        t_s: 0.0,
        scene: SCENE.into(),
        contents: BTreeMap::new(),
        glass: BTreeMap::new(),
    };
    let ended = Event::Ended(Ending {
        t_s: 0.5,
        contents: BTreeMap::new(),
        hottest: None,
        bench_m3: 1e-6 * spilt_ml,
        floor_m3: 0.0,
    });
    let incident = (spilt_ml > 0.0).then_some(Event::Incident(incident));
    [
        Some(begun),
        Some(Event::Poured(pour)),
        incident,
        Some(ended),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// A recording of half a second that says this of what happened.
pub(super) fn recording(events: &[Event]) -> Track {
    let mut track = vitriol_run::track::load("two-flasks").unwrap();
    track.frames.truncate(46);
    track.stage_from_flasks.truncate(46);
    let text = Scene::builtin_text(SCENE).unwrap();
    track.metadata.scene = SCENE.into();
    track.metadata.scenes = [(SCENE.to_owned(), text.to_owned())].into();
    track.metadata.program_version = env!("CARGO_PKG_VERSION").into();
    let parameters = [
        ("preset", "fast"),
        ("device", DEVICE[0]),
        ("driver", DEVICE[1]),
    ];
    track.metadata.parameters = parameters.map(|(k, v)| (k.to_owned(), v.to_owned())).into();
    let json = |event| (400_000_000, serde_json::to_string(event).unwrap());
    track.events = events.iter().map(json).collect();
    track
}

pub(super) fn put(folder: &Path, name: &str, track: &Track) -> PathBuf {
    let file = folder.join(name);
    save(track, &file, Existing::Replace).unwrap();
    file
}

/// A class of that many, of whom each spilt more than the one before.
pub(super) fn class(folder: &Path, students: u32) {
    for n in 0..students {
        let track = recording(&events(0.5 * f64::from(n)));
        put(folder, &format!("student-{n:02}.mcap"), &track);
    }
}

/// Finds what it is told.
pub(super) struct Toy {
    pub(super) events: Vec<Event>,
    pub(super) driver: &'static str,
    /// What it says of a lesson, where it is asked to judge one.
    pub(super) progress: Vec<Progress>,
    pub(super) judges: bool,
}

impl Toy {
    pub(super) fn new(events: Vec<Event>, driver: &'static str) -> Self {
        Self {
            events,
            driver,
            progress: Vec::new(),
            judges: false,
        }
    }
}

impl Experiment for Toy {
    fn step(&mut self, _: &PoseFrame) -> Result<Taken, Failure> {
        Ok(Taken {
            frame_time: 1.0 / 90.0,
            anew: false,
        })
    }

    fn sample(&mut self, t: f64) -> Result<Sample, Failure> {
        Ok(Sample {
            t_s: t,
            density_error_mean: 0.0,
            density_error_p99: 0.0,
            kinetic_energy_j: 0.0,
            mass_kg: MassByPlace::default(),
            neighbour_rebuilds: 0,
            left_kg: BTreeMap::new(),
            above_rim_kg: BTreeMap::new(),
            surface_m2: BTreeMap::new(),
            highest_drop_m: None,
            heat: None,
        })
    }

    fn picture(&mut self, _: usize) -> Result<&[u8], Failure> {
        panic!("nobody looks at a track that is graded")
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
        Ok(Outcome {
            events: self.events.clone(),
            progress: match self.judges {
                true => self.progress.clone(),
                false => Vec::new(),
            },
            instructions: Vec::new(),
            scene: None,
            effort: [8, 4],
            fluid_particles: 1,
            lost_particles: 0,
            nan_particles: 0,
            state_hash: 0,
            device: DeviceStatement {
                name: DEVICE[0].into(),
                driver: self.driver.into(),
                api: "1.3.0".into(),
            },
            counters: Counters::default(),
        })
    }
}

pub(super) type Made = Result<Box<dyn Experiment>, Failure>;

pub(super) fn nobody(_: &Setup<'_>) -> Made {
    panic!("reading simulates nothing")
}

/// What `vitriol grade WHAT --scene acid-into-water …` finds.
pub(super) fn graded(
    what: &Path,
    more: &[&str],
    prepare: impl Fn(&Setup<'_>) -> Made + Sync,
) -> Result<(Class, Option<Failure>), Failure> {
    let of_scene = [&["--scene", SCENE][..], more].concat();
    graded_by(what, &of_scene, prepare)
}

/// Likewise by what `more` says alone.
pub(super) fn graded_by(
    what: &Path,
    more: &[&str],
    prepare: impl Fn(&Setup<'_>) -> Made + Sync,
) -> Result<(Class, Option<Failure>), Failure> {
    let start = ["vitriol", "grade", what.to_str().unwrap()];
    let Command::Grade(args) = <Cli as clap::Parser>::parse_from(start.iter().chain(more)).command
    else {
        panic!("grade is parsed as another command");
    };
    grade(&args, Format::Json, prepare)
}

pub(super) fn read(what: &Path, more: &[&str]) -> Class {
    graded(what, more, nobody).unwrap().0
}

pub(super) fn line<'a>(class: &'a Class, student: &str) -> &'a Line {
    let mut lines = class.lines.iter().filter(|it| it.student == student);
    let line = lines.next().unwrap();
    assert!(lines.next().is_none(), "{student} has two lines");
    line
}
