//! Recordings of a class, the experiment whose answers are known, and a grading by it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use vitriol::cli::{Cli, Command};
use vitriol::command::grade::{Class, Line, grade};
use vitriol_lesson::{Cause, Content, Ending, Event, Incident, Pour, What};
use vitriol_run::{Experiment, Failure, Format, Setup};
use vitriol_sim::scene::Scene;
use vitriol_xr::track::{Existing, Track, save};

use crate::replay::toy::{DEVICE, Toy};

pub(super) const SCENE: &str = "acid-into-water";

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

/// A simulation that finds what it is told, by such a driver; of a track that is graded nobody sees a picture.
pub(super) fn finding(events: Vec<Event>, driver: &'static str) -> Toy {
    Toy {
        finds: Box::new(move |_| events.clone()),
        driver,
        unseen: true,
        ..Toy::new(u64::MAX)
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
