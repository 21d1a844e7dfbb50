//! How far runs are: a bar each for a person who watches, JSON lines for a program.

use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use serde::Serialize;

use crate::clock::{SimulatedTime, Span};
use crate::console::{Format, in_a_line, json_escaped};

/// Time between two lines of a run.
const BETWEEN_LINES: Duration = Duration::from_millis(500);

/// Progress of one run after the other, all of which stay in sight.
#[derive(Debug)]
pub struct Runs {
    bars: MultiProgress,
    format: Format,
}

impl Runs {
    /// Progress for runs whose results are handed over in that format.
    pub fn new(format: Format) -> Self {
        Self {
            bars: MultiProgress::new(),
            format,
        }
    }

    /// The progress of a run of that name and span.
    pub fn of(&self, name: &str, span: Span) -> Progress {
        let shown = match self.format {
            Format::Json => Shown::Lines(Line::new(name, span)),
            // Where nobody watches, a bar would only fill a log.
            Format::Text if !std::io::stderr().is_terminal() => Shown::Nothing,
            Format::Text => Shown::Bar(self.bars.add(bar(name, span.steps))),
        };
        Progress(shown)
    }
}

/// Progress of one run.
#[derive(Debug)]
pub struct Progress(Shown);

#[derive(Debug)]
enum Shown {
    Nothing,
    Bar(ProgressBar),
    Lines(Line),
}

impl Progress {
    /// Progress of which nothing is shown.
    pub fn hidden() -> Self {
        Self(Shown::Nothing)
    }

    /// Shows that the run is at that time.
    pub fn at(&mut self, time: &SimulatedTime) {
        match &mut self.0 {
            Shown::Nothing => {}
            Shown::Bar(bar) => bar.set_position(time.steps()),
            Shown::Lines(line) => line.at(time),
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        match &mut self.0 {
            Shown::Nothing => {}
            // The bar of a run that failed stays where it was.
            Shown::Bar(bar) => bar.abandon(),
            Shown::Lines(line) => line.last(),
        }
    }
}

fn bar(name: &str, steps: u64) -> ProgressBar {
    let bar = ProgressBar::new(steps);
    let template = "{prefix} {bar:40} step {pos} of {len}, {eta} left";
    // The template is ours; where it could not be read, the plain bar does.
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.set_prefix(in_a_line(name));
    bar
}

/// Lines of one run, on standard error.
#[derive(Debug)]
struct Line {
    said: Said,
    begin: Instant,
    /// When the last line was written, and whether it has the last step.
    written: Option<Instant>,
    told: bool,
}

#[derive(Debug, Clone, Serialize)]
struct Said {
    run: String,
    step: u64,
    steps: u64,
    simulated_s: f64,
    wall_s: f64,
}

impl Line {
    fn new(name: &str, span: Span) -> Self {
        Self {
            said: Said {
                run: name.to_owned(),
                step: 0,
                steps: span.steps,
                simulated_s: 0.0,
                wall_s: 0.0,
            },
            begin: Instant::now(),
            written: None,
            told: true,
        }
    }

    fn at(&mut self, time: &SimulatedTime) {
        self.said.step = time.steps();
        self.said.simulated_s = time.seconds();
        self.said.wall_s = self.begin.elapsed().as_secs_f64();
        self.told = false;
        let due = self.written.is_none_or(|at| at.elapsed() >= BETWEEN_LINES);
        if due {
            self.write();
        }
    }

    fn last(&mut self) {
        if !self.told {
            self.write();
        }
    }

    fn write(&mut self) {
        #[derive(Serialize)]
        struct Whole<'a> {
            progress: &'a Said,
        }
        let whole = Whole {
            progress: &self.said,
        };
        if let Ok(line) = serde_json::to_string(&whole) {
            // A reader that has gone is no reason to end the run.
            let _ = writeln!(std::io::stderr(), "{}", json_escaped(&line));
        }
        self.written = Some(Instant::now());
        self.told = true;
    }
}
