//! Tests with sights and events that are arranged by hand.
#![allow(clippy::unwrap_used, clippy::panic)]

mod any;
mod builtin;
mod conditions;
mod dilution;
mod faults;
mod fits;
mod keeping;
mod modes;
mod order;
mod page;
mod questions;
mod retold;
mod spoiled;

use super::*;
use crate::event::{Cause, Content, Ending, Event, Incident, Pour, Surface, What};

/// Time between observations here, s.
const STEP: f64 = 0.1;

/// A lesson with steps and rules of these ids and bodies, and texts for them.
fn lesson(steps: &[(&str, &str)], rules: &[(&str, &str)]) -> Lesson {
    Lesson::parse(&text(steps, rules), "own.toml").unwrap()
}

fn text(steps: &[(&str, &str)], rules: &[(&str, &str)]) -> String {
    let mut text = "version = 1\nname = \"own\"\nscene = \"bench\"\n".to_owned();
    text += "modes = [\"guided\", \"free\", \"examination\"]\n";
    for (id, body) in steps {
        text += &format!("[[step]]\nid = \"{id}\"\npoints = 10\n{body}\n");
    }
    for (id, keep) in rules {
        text += &format!("[[rule]]\nid = \"{id}\"\npoints = 10\nkeep = {keep}\n");
    }
    text += "[texts.en]\ntitle = \"Own\"\nsummary = \"What it is.\"\n";
    for (id, _) in steps {
        text += &format!("step.{id} = {{ text = \"Do {id}.\", hint = \"So.\" }}\n");
    }
    for (id, _) in rules {
        text += &format!("rule.{id} = \"Keep {id}.\"\n");
    }
    text
}

/// A case of a table: what is replaced in a good lesson => by what => what is told then. `⏎` is a line's end.
fn case(line: &str) -> [String; 3] {
    let parts = line.split(" => ").map(|it| it.replace('⏎', "\n"));
    parts.collect::<Vec<_>>().try_into().unwrap()
}

/// Checks that a lesson is refused that is good but for one case of a table, a line each: the message has each part that ` | ` divides.
fn assert_each_is_refused(good: &str, table: &str) {
    for line in table.trim().lines() {
        let [from, to, parts] = case(line);
        assert!(good.contains(&from), "{from} is not in the good lesson");
        let spoiled = Lesson::parse(&good.replacen(&from, &to, 1), "bad.toml");
        let error = spoiled.map(|_| line).unwrap_err().to_string();
        assert!(error.starts_with("bad.toml: "), "{error}");
        for part in parts.split(" | ") {
            assert!(error.contains(part), "{line}: {part} is not in\n{error}");
        }
    }
}

/// The beginning of the bench's scene at that time, s.
fn begun(t_s: f64) -> Event {
    Event::Begun {
        t_s,
        scene: "bench".to_owned(),
        contents: Default::default(),
        glass: Default::default(),
    }
}

/// A bench with all bodies: acid in `a`, water in `b`, both stand.
fn sight(t_s: f64) -> Sight {
    let flask = |name: &str, volume_m3, acid| FlaskSight {
        name: name.to_owned(),
        volume_m3,
        acid,
        temperature_c: Some(20.0),
        held: false,
        standing: true,
    };
    Sight {
        t_s,
        flasks: vec![flask("a", 20e-6, 0.98), flask("b", 160e-6, 0.0)],
        goggles: Some(true),
        gloves: Some([true; 2]),
        sash_m: Some(0.4),
        rod: Some(Dip::default()),
        thermometer: Some(Dip::default()),
        rinsed_m3: Some([0.0; 2]),
        ..Sight::default()
    }
}

/// A lesson under way.
struct Run {
    procedure: Procedure,
    t: f64,
    said: Vec<Progress>,
}

impl Run {
    /// Begins at 10 s: times are of the run, and not of the lesson.
    fn new(lesson: Lesson, mode: Mode) -> Self {
        let mut run = Self {
            procedure: Procedure::new(lesson, mode),
            t: 10.0,
            said: Vec::new(),
        };
        run.said = run.procedure.advance(&sight(10.0), &[begun(10.0)]);
        run
    }

    /// Takes in observations for `long` seconds of a bench with `change`.
    fn look(&mut self, long: f64, change: &dyn Fn(&mut Sight)) {
        for _ in 0..(long / STEP).round() as usize {
            self.t += STEP;
            let mut sight = sight(self.t);
            change(&mut sight);
            self.said.extend(self.procedure.advance(&sight, &[]));
        }
    }

    /// Takes in these events with an observation of the unchanged bench.
    fn hear(&mut self, events: &[Event]) {
        self.t += STEP;
        let said = self.procedure.advance(&sight(self.t), events);
        self.said.extend(said);
    }

    fn wait(&mut self, long: f64) {
        self.look(long, &|_| {});
    }

    fn status(&self, id: &str) -> Status {
        let steps = self.procedure.state().steps;
        steps.iter().find(|step| step.id == id).unwrap().status
    }

    fn both(&self) -> [Status; 2] {
        ["one", "two"].map(|id| self.status(id))
    }

    fn line(&self, id: &str) -> VerdictLine {
        let lines = self.procedure.verdict().lines;
        lines.into_iter().find(|line| line.id == id).unwrap()
    }

    /// Reasons of all failures that were reported.
    fn whys(&self) -> Vec<Why> {
        let whys = self.said.iter().filter_map(|it| match it {
            Progress::StepFailed { why, .. } | Progress::RuleBroken { why, .. } => Some(why),
            _ => None,
        });
        whys.cloned().collect()
    }

    fn hints(&self) -> usize {
        let hint = |it: &&Progress| matches!(it, Progress::HintDue { .. });
        self.said.iter().filter(hint).count()
    }
}

/// A pour from `a` into `b`: its times, s, volume, mL, rate, mL/s, and acid mass fraction.
fn pour([t_s, until_s]: [f64; 2], ml: f64, ml_s: f64, acid: f64) -> Event {
    Event::Poured(Pour {
        t_s,
        until_s,
        from: "a".to_owned(),
        into: Some("b".to_owned()),
        volume_m3: ml * 1e-6,
        fastest_m3_s: ml_s * 1e-6,
        acid,
        met: Some(Content::default()),
        bare_face: false,
    })
}

fn incident(t_s: f64, what: What) -> Event {
    Event::Incident(Incident {
        t_s,
        until_s: t_s + 0.5,
        what,
        cause: Cause::Unknown,
        place_m: [0.0; 3],
    })
}

fn boiled_over(t_s: f64) -> Event {
    incident(
        t_s,
        What::BoiledOver {
            flask: "b".to_owned(),
            volume_m3: 1e-6,
            acid: 0.5,
        },
    )
}

fn spilt(t_s: f64, ml: f64) -> Event {
    incident(
        t_s,
        What::Spilt {
            surface: Surface::Bench,
            volume_m3: ml * 1e-6,
            acid: 0.5,
        },
    )
}

fn ended(t_s: f64) -> Event {
    Event::Ended(Ending {
        t_s,
        contents: Default::default(),
        hottest: None,
        bench_m3: 0.0,
        floor_m3: 0.0,
    })
}
