//! The run as a recording that viewers open: the track's own topics, and beside them particles, film and measurements.

use std::collections::BTreeMap;

use vitriol_render::ColourBy;
use vitriol_run::output::OutDir;
use vitriol_run::particles::Particles;
use vitriol_run::track::{STATE_HASH, blame};
use vitriol_run::{
    Action, Blame, Experiment, FILM_FPS, FILM_SIZE, Failure, H264, Laboratory, Moment, Sample,
    particle_colours, stage,
};
use vitriol_xr::PoseFrame;
use vitriol_xr::track::{Annex, Existing, TrackWriter};

use crate::Origin;
use crate::sink::{Frame, Sink};
use crate::table::{self, Column};

/// Name of the file.
pub const FILE: &str = "recording.mcap";

/// A recording that is being written.
pub struct Recording {
    writer: TrackWriter,
    encoder: H264,
    /// Film frames so far.
    film: u32,
    /// The last frame.
    last: Option<PoseFrame>,
    /// Simulated time so far, ns.
    now_ns: i64,
    /// Substeps and iterations that the first frame sets.
    solver: Option<[u32; 2]>,
    /// Scenes whose measurements were begun.
    scenes: u32,
    measurements: Option<Measurements>,
}

/// The measurements of one scene: others have other flasks.
struct Measurements {
    topic: String,
    columns: Vec<Column>,
    names: Vec<String>,
}

impl Recording {
    /// One of a run of that origin.
    ///
    /// # Errors
    /// An error of the file system.
    pub fn new(origin: &Origin, out: &mut OutDir) -> Result<Self, Failure> {
        let path = out.join(FILE);
        let writer = TrackWriter::create(&path, &origin.metadata, Existing::Refuse);
        let writer = writer.map_err(blame)?;
        out.adopt(path);
        Ok(Self {
            writer,
            encoder: H264::new(FILM_SIZE, FILM_FPS).other()?,
            film: 0,
            last: None,
            now_ns: 0,
            solver: origin.solver,
            scenes: 0,
            measurements: None,
        })
    }

    /// Writes the frame of a step that ended at `end_ns`, with the time at which it began: so a replay reads the same track. The
    /// flasks are the state's, so they are written with the state's time, and not with the frame.
    fn write(&mut self, frame: &PoseFrame, end_ns: i64) -> Result<(), Failure> {
        let mut frame = frame.clone();
        frame.time_ns = std::mem::replace(&mut self.now_ns, end_ns);
        let solver = self.solver.take();
        let solver = solver.map(|effort| Action::Solver(effort).switch());
        // After a switch of scene, which brings its own.
        frame.scenario.extend(solver);
        self.writer.write(&frame, &[]).map_err(blame)?;
        self.last = Some(frame);
        Ok(())
    }

    /// Adds what is of the state at `seconds`, which is its time in the other formats too.
    fn add(&mut self, seconds: f64, annex: &Annex<'_>) -> Result<(), Failure> {
        let added = self.writer.add(nanoseconds(seconds), annex);
        added.map_err(blame)
    }

    /// Adds a picture where its time has come, with the time of the state that it shows. As in all films, the first one is of the first
    /// step's end, which makes the lists of neighbours that a liquid's surface is computed from. So `/film` begins after `/particles`.
    fn film(&mut self, moment: &Moment<'_>, laboratory: &mut Laboratory) -> Result<(), Failure> {
        let seconds = moment.time.seconds();
        let due = (seconds * f64::from(FILM_FPS) + 1e-6).floor() as u32 + 1;
        if moment.frame.is_none() || due <= self.film {
            return Ok(());
        }
        let picture = laboratory.picture(0)?;
        let Some(coded) = self.encoder.encode(picture).other()? else {
            let number = self.film;
            return Err(format!(
                "frame {number} of the film has more detail than H.264 is given room for; leave mcap out of --format"
            ))
            .other();
        };
        // The bytes are the encoder's, so that all of `self` is not free.
        let film = Annex::Film(coded.bytes);
        let added = self.writer.add(nanoseconds(seconds), &film);
        added.map_err(blame)?;
        // A step that is longer than a frame has one all the same: messages have times of their own.
        self.film = due;
        Ok(())
    }
}

fn nanoseconds(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

impl Sink for Recording {
    fn step(
        &mut self,
        moment: &Moment<'_>,
        laboratory: &mut Laboratory,
        _out: &mut OutDir,
    ) -> Result<(), Failure> {
        let seconds = moment.time.seconds();
        if let Some(frame) = moment.frame {
            self.write(frame, nanoseconds(seconds))?;
        }
        let flasks = stage::flasks(laboratory.world());
        self.add(seconds, &Annex::Flasks(&flasks))?;
        self.film(moment, laboratory)
    }

    fn frame(&mut self, frame: &Frame<'_>, _out: &mut OutDir) -> Result<(), Failure> {
        let particles = frame.particles();
        let (fields, rows) = rows(particles);
        let world = frame.world();
        let scale = world.scene().scale.length_scale as f32;
        let colours = colours(particles, particle_colours(world), scale);
        let points = Annex::Points {
            fields: &fields,
            rows: &rows,
            colours: &colours,
        };
        self.add(frame.seconds, &points)
    }

    fn sample(&mut self, sample: &Sample, _out: &mut OutDir) -> Result<(), Failure> {
        if self.measurements.is_none() {
            self.scenes += 1;
        }
        let scene = self.scenes;
        let measurements = self
            .measurements
            .get_or_insert_with(|| Measurements::new(scene, sample));
        let columns = measurements.columns.iter();
        let values: Vec<f64> = columns
            .map(|column| column.value(sample).unwrap_or(f64::NAN))
            .collect();
        let annex = Annex::Measurements {
            topic: &measurements.topic,
            names: &measurements.names,
            values: &values,
        };
        let added = self.writer.add(nanoseconds(sample.t_s), &annex);
        added.map_err(blame)
    }

    fn start_over(&mut self, _out: &mut OutDir) -> Result<(), Failure> {
        self.measurements = None;
        Ok(())
    }

    fn finish(&mut self, hash: u64, _out: &mut OutDir) -> Result<(), Failure> {
        // A track lasts to its last frame, so that a replay needs one at the last step's end.
        if let Some(mut end) = self.last.take() {
            end.step += 1;
            end.time_ns = self.now_ns;
            end.scenario.clear();
            self.writer.write(&end, &[]).map_err(blame)?;
        }
        let said = BTreeMap::from([(STATE_HASH.to_owned(), format!("{hash:016x}"))]);
        self.writer.conclude(&said).map_err(blame)?;
        self.writer.finish().map_err(blame)?;
        if !self.writer.fits_a_reader() {
            tracing::warn!(
                "{FILE} is too long to be replayed; viewers open it. Export fewer --seconds, or at a lower --rate"
            );
        }
        Ok(())
    }
}

impl Measurements {
    fn new(scene: u32, first: &Sample) -> Self {
        let columns = table::columns(first);
        let topic = match scene {
            0 | 1 => "/measurements".into(),
            scene => format!("/measurements-{scene}"),
        };
        Self {
            topic,
            names: table::identifiers(&columns),
            columns,
        }
    }
}

/// Each particle's colour, opaque; a unit of the scene is `length_scale` metres of the stage.
fn colours(particles: &Particles, colour_by: ColourBy, length_scale: f32) -> Vec<[u8; 4]> {
    let ([start, end], map) = (colour_by.range(), colour_by.map());
    let value = |index: usize| match colour_by {
        ColourBy::Temperature(..) => particles.temperature[index],
        ColourBy::Acid => particles.acid[index],
        ColourBy::Speed(_) => particles.velocity[index].length() as f32 / length_scale,
    };
    let byte = |component: f32| (255.0 * component).round() as u8;
    let numbers = 0..particles.len();
    numbers
        .map(|index| {
            let [red, green, blue] = map.at((value(index) - start) / (end - start));
            [byte(red), byte(green), byte(blue), u8::MAX]
        })
        .collect()
}

/// Names of the columns, and the rows.
fn rows(particles: &Particles) -> (Vec<&'static str>, Vec<f32>) {
    let heat = !particles.temperature.is_empty();
    let mut fields = vec!["x", "y", "z", "speed", "flask"];
    if heat {
        fields.extend(["temperature", "acid"]);
    }
    let mut rows = Vec::with_capacity(fields.len() * particles.len());
    for index in 0..particles.len() {
        let place = particles.position[index].as_vec3();
        rows.extend(place.to_array());
        rows.push(particles.velocity[index].length() as f32);
        rows.push(particles.flask[index] as f32);
        if heat {
            rows.extend([particles.temperature[index], particles.acid[index]]);
        }
    }
    (fields, rows)
}

#[cfg(test)]
#[path = "tests/recording.rs"]
mod tests;
