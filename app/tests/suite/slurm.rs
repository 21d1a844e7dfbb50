//! A class on a cluster: each track is a task of its own, one of which is killed; a second round runs what is missing, and the table
//! is that of one process.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::VITRIOL;
use crate::vr::common::scene;
use vitriol_lesson::{Cause, Event, Incident, Surface, What};
use vitriol_run::{Observer, Progress, Scenes, Setup, Span, on_device};
use vitriol_sim::scene::Preset;
use vitriol_tests::slurm::Slurm;
use vitriol_tests::{gpu, wait};
use vitriol_xr::track::{Existing, Track, TrackSource, save};

/// Twice as many as run at a time, so that some wait.
const STUDENTS: u32 = 4;
/// The one whose task is killed.
const KILLED: u32 = 3;
/// The one whose recording says what did not happen.
const FORGER: u32 = 2;

/// What a task of the array does.
const SCRIPT: &str = r#"#!/bin/sh
#SBATCH --array=1-4
track=$(ls class/*.mcap | sed -n "${SLURM_ARRAY_TASK_ID}p")
exec vitriol grade "$track" --scene small.toml --preset fast --verify --out grades
"#;

/// Half a second, with what a simulation finds in it.
fn recording(folder: &Path) -> Track {
    let mut track = vitriol_run::track::load("two-flasks").unwrap();
    track.frames.truncate(46);
    track.stage_from_flasks.truncate(46);
    let text = fs::read_to_string(scene(folder)).unwrap();
    track.metadata.scene = "small.toml".into();
    track.metadata.scenes = [("small.toml".to_owned(), text)].into();
    track.metadata.program_version = env!("CARGO_PKG_VERSION").into();

    let gpu = gpu::device();
    let info = gpu.info();
    let of = [
        ("preset", "fast"),
        ("device", &info.name),
        ("driver", &info.driver),
    ];
    track.metadata.parameters = of.map(|(k, v)| (k.to_owned(), v.to_owned())).into();

    let mut scenes = Scenes::default();
    let name = scenes
        .open(folder.join("small.toml").to_str().unwrap())
        .unwrap();
    let scene = scenes.get(&name).unwrap().with_preset(Preset::Fast);
    let setup =
        Setup::without_pictures(&scene, (&name, &scenes), Preset::Fast, track.metadata.seed);
    let mut experiment = on_device(&gpu, &setup).unwrap();
    let span = Span::covering(track.duration(), scene.scale.frame_time);
    let mut observer = Observer::new(span, Vec::new(), Progress::hidden());
    let mut source = TrackSource::new(track.clone());
    vitriol_run::replay(&mut source, experiment.as_mut(), span, &mut observer).unwrap();
    say(&mut track, &experiment.outcome().unwrap().events);
    track
}

fn say(track: &mut Track, events: &[Event]) {
    let json = |event| (500_000_000, serde_json::to_string(event).unwrap());
    track.events = events.iter().map(json).collect();
}

/// A spill that never was, behind what there was.
fn forged(mut track: Track) -> Track {
    let said = track.events.iter();
    let mut events: Vec<Event> = said
        .map(|(_, json)| serde_json::from_str(json).unwrap())
        .collect();
    events.push(Event::Incident(Incident {
        t_s: 0.2,
        until_s: 0.3,
        what: What::Spilt {
            surface: Surface::Bench,
            volume_m3: 3e-6,
            acid: 0.0,
        },
        cause: Cause::Unknown,
        place_m: [0.0; 3],
    }));
    say(&mut track, &events);
    track
}

fn result(folder: &Path, student: u32) -> PathBuf {
    folder
        .join("grades")
        .join(format!("student-{student:02}.grade.json"))
}

/// When the result of each student was written, where it is there.
fn written(folder: &Path) -> Vec<Option<SystemTime>> {
    let times = (1..=STUDENTS).map(|student| result(folder, student).metadata().ok());
    times.map(|it| it?.modified().ok()).collect()
}

mod long {
    use super::*;

    #[test]
    fn a_class_is_spread_over_a_cluster() {
        let Some(slurm) = Slurm::find("a class on a cluster") else {
            return;
        };
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path();
        fs::create_dir(here.join("class")).unwrap();
        let honest = recording(here);
        for student in 1..=STUDENTS {
            let mut track = match student {
                FORGER => forged(honest.clone()),
                _ => honest.clone(),
            };
            let parameters = &mut track.metadata.parameters;
            parameters.insert("copy".into(), student.to_string());
            let file = here.join(format!("class/student-{student:02}.mcap"));
            save(&track, &file, Existing::Refuse).unwrap();
        }
        let script = here.join("grade.sh");
        fs::write(&script, SCRIPT.replace("vitriol", VITRIOL.0)).unwrap();

        let of_cluster = tempfile::tempdir().unwrap();
        let cluster = slurm.start(of_cluster.path(), 2);
        let job = cluster.submit(here, &script, &[]);
        wait::until("the task runs", || {
            let states = cluster.states(&job);
            let of_task = states.iter().find(|(task, _)| *task == KILLED);
            of_task.filter(|(_, state)| state == "RUNNING").map(drop)
        });
        let task = format!("{job}_{KILLED}");
        let killed = cluster.ask("scancel", &["--signal=KILL", "--full", &task]);
        assert!(killed.status.success(), "{killed:?}");
        let states = cluster.ends(&job);
        let unfinished: Vec<u32> = states
            .iter()
            .filter(|(_, state)| state != "COMPLETED")
            .map(|(task, _)| *task)
            .collect();
        assert_eq!(unfinished, [KILLED], "{states:?}");
        assert!(!result(here, KILLED).exists());
        let before = written(here);
        assert_eq!(before.iter().flatten().count(), 3);

        // The same again: what is there is taken as it is.
        let job = cluster.submit(here, &script, &[]);
        let states = cluster.ends(&job);
        assert!(
            states.iter().all(|(_, state)| state == "COMPLETED"),
            "{states:?}"
        );
        let after = written(here);
        for (student, (before, after)) in (1..).zip(before.iter().zip(&after)) {
            assert_eq!(before == after, student != KILLED, "student {student}");
            assert!(after.is_some());
        }

        // Each job left a table of its own track. The one of the class a single process finds as well.
        let grade = "grade class --scene small.toml --preset fast --out";
        let told = VITRIOL.object(here, &format!("{grade} grades"));
        assert_eq!((&told["graded"], &told["taken"]), (&4.into(), &4.into()));
        for line in told["lines"].as_array().unwrap() {
            let forger = line["student"] == format!("student-{FORGER:02}");
            let expected = if forger { "differs" } else { "to-the-bit" };
            assert_eq!(line["verified"], expected, "{line}");
        }
        VITRIOL.object(here, &format!("{grade} alone --verify"));
        let table = |out: &str| fs::read_to_string(here.join(out).join("grades.csv")).unwrap();
        assert_eq!(table("grades"), table("alone"));
    }
}
